#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include <gazebo/common/SkeletonAnimation.hh>
#include <gazebo/physics/Model.hh>

namespace gazebo
{
namespace physics
{

class GAZEBO_VISIBLE TrajectoryInfo
{
public:
  unsigned int id = 0;
  std::string type;  // name of an animation of the skeleton
  double duration = 0, startTime = 0, endTime = 0;
  bool translated = false;
};

/// A person. The simulator plays its script, or, while a plugin has set a trajectory of its own, the animation that this names at the
/// script time, wherever the plugin puts the model.
class GAZEBO_VISIBLE Actor : public Model
{
public:
  typedef std::map<std::string, common::SkeletonAnimation*> SkeletonAnimation_M;

  explicit Actor(BasePtr parent) : Model(parent) { AddType(ACTOR); }
  ~Actor() override;
  virtual void Play();
  virtual void Stop();
  virtual bool IsActive() const;
  void Fini() override;
  void Reset() override;
  using Model::Reset;
  void SetScriptTime(const double time);
  double ScriptTime() const;
  const SkeletonAnimation_M& SkeletonAnimations() const { return animations_; }
  void SetCustomTrajectory(TrajectoryInfoPtr& trajectory);
  TrajectoryInfoPtr CustomTrajectory() const;
  void ResetCustomTrajectory();
  bool IsStatic() const override { return false; }
  bool GetSelfCollide() const override { return false; }
  void SetSelfCollide(bool) override {}

  /// Between the plugins and what moves the limbs.
  struct State
  {
    bool custom = false;
    std::string type;
    double script_time = 0;
    bool active = false;
    int64_t started_ns = 0;
    bool collides = false;
  };
  State Wanted() const;
  /// What is played now; `anew`: the script begins once more, and what plugins asked for is over.
  void Plays(const State& state, bool anew);
  void LetCollide();

private:
  friend class Mirror;
  SkeletonAnimation_M animations_;
  mutable std::mutex mutex_;
  TrajectoryInfoPtr trajectory_;
  State state_;
};

}  // namespace physics
}  // namespace gazebo

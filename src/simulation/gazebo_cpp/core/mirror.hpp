// The tree of physics objects over the models of an ode_sim::World, and what calls plugins in each step.
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gazebo/common/common.hh>
#include <gazebo/physics/physics.hh>

#include "convert.hpp"

namespace gazebo
{
namespace physics
{

struct CollisionRecord
{
  std::string name;
  int shape = 0;
  std::string kind, uri;
  std::vector<double> numbers;
  double retro = 0;
};

struct LinkRecord
{
  std::string name;
  int id = 0;
  std::vector<CollisionRecord> collisions;
  std::vector<std::string> sensors;
};

struct JointRecord
{
  std::string name, type;
  int id = 0;
};

struct ModelRecord
{
  std::string name, text;  // text: SDF
  int id = 0;
  ode_sim::Pose X_WM;
  std::vector<LinkRecord> links;
  std::vector<JointRecord> joints;
  bool actor = false;
  std::vector<std::pair<std::string, double>> animations;  // of an actor: names and lengths, s
};

/// What the simulator alone can do. May be called in any thread; it is done between two steps.
struct Host
{
  std::function<void(const std::string&, const std::vector<double>&)> insert;  // SDF of a model; x y z qx qy qz qw, or nothing
  std::function<void(const std::string&, const std::string&, const std::string&)> plugin;  // of the world: file, name, <plugin>
  std::function<void(const std::string&)> remove;                                          // name of a model
  std::function<void(const std::string&)> order;              // pause, unpause, reset, reset_poses, reset_time, set_time NS
  std::function<void(unsigned int)> step;                     // so many steps, while paused
  std::function<void(const std::string&, double)> parameter;  // of Physics
  /// Draws a picture of now: number of the camera, model::link::sensor, which of its cameras, how it looks, what is wanted; false: left out.
  /// How it looks: x y z qx qy qz qw in its link, field of view, near, far, width, height, whether a lens' border is cut off.
  std::function<bool(int, const std::string&, int, const std::vector<double>&, const std::vector<std::string>&)> shoot;
  std::function<bool(const std::string&, const std::string&, unsigned int, unsigned int, const std::string&)>
      save;                           // file, pixels ...
  std::function<void(double)> clock;  // of roscpp, s; in the thread that steps
};

class Topics;

/// The lock of the step, held by the simulator's thread while it changes the world between two steps: threads of plugins do so, too.
/// It is given back while plugins are called, which may wait for such a thread.
class GAZEBO_VISIBLE WorldLock
{
public:
  static void Take();
  /// False where a thread of a plugin has it.
  static bool TakeAtOnce();
  static void Give();

  /// While it lives, this thread does not have it.
  struct GAZEBO_VISIBLE Without
  {
    Without();
    ~Without();
    int held;
  };
};

class GAZEBO_VISIBLE Mirror : public ode_sim::StepObserver
{
public:
  static Mirror& Get();
  Host host;
  common::Time began;  // of the simulator, by the wall's clock; 0: unknown

  void Start(ode_sim::World* core, const std::string& name, const std::string& text, double update_rate);
  void Describe(const std::vector<double>& magnetic_field, const std::vector<double>& place);
  void Stop();
  WorldPtr GetWorld() const { return world_; }
  Topics* GetTopics() const { return topics_; }
  void Add(const ModelRecord& record);
  void Remove(const std::string& name);
  ActorPtr FindActor(const std::string& name) const;
  /// Whether the text of a model has such an element; parsing it costs a megabyte and 4 ms for each link.
  static bool Mentions(const Model& model, const std::string& element);
  void SetPaused(bool paused);
  void WasReset(bool time);
  void before(int64_t time_ns) override;
  void after(int64_t time_ns) override;
  int64_t Now() const { return now_ns_; }
  void SetNow(int64_t time_ns) { last_ns_ += time_ns - now_ns_, now_ns_ = time_ns; }  // until the end of this step
  void Watch(const LinkPtr& link);

private:
  void addLink(Model& model, const LinkRecord& record);
  void readWindModes(Model& model);
  void readBatteries(Model& model);
  void addJoint(Model& model, const JointRecord& record);
  void accelerations();
  WorldPtr world_;
  std::atomic<int64_t> now_ns_{ 0 };
  std::vector<common::BatteryPtr> batteries_;
  int64_t last_ns_ = 0;
  std::vector<boost::weak_ptr<Link>> watched_;
  Topics* topics_ = nullptr;  // as long as the process
  std::unique_ptr<boost::recursive_mutex::scoped_lock> frozen_;
};

}  // namespace physics
}  // namespace gazebo

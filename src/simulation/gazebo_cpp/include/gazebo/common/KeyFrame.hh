#pragma once
#include <ignition/math/Quaternion.hh>
#include <ignition/math/Vector3.hh>

#include <gazebo/util/system.hh>

namespace gazebo
{
namespace common
{

/// A moment of an animation; s.
class GAZEBO_VISIBLE KeyFrame
{
public:
  explicit KeyFrame(double time) : time_(time) {}
  virtual ~KeyFrame() = default;
  double GetTime() const { return time_; }

private:
  double time_;
};

class GAZEBO_VISIBLE PoseKeyFrame : public KeyFrame
{
public:
  explicit PoseKeyFrame(double time) : KeyFrame(time) {}
  void Translation(const ignition::math::Vector3d& place) { place_ = place; }
  ignition::math::Vector3d Translation() const { return place_; }
  void Rotation(const ignition::math::Quaterniond& turn) { turn_ = turn; }
  ignition::math::Quaterniond Rotation() const { return turn_; }

private:
  ignition::math::Vector3d place_;
  ignition::math::Quaterniond turn_{ 1, 0, 0, 0 };
};

class GAZEBO_VISIBLE NumericKeyFrame : public KeyFrame
{
public:
  explicit NumericKeyFrame(double time) : KeyFrame(time) {}
  void SetValue(const double& value) { value_ = value; }
  const double& GetValue() const { return value_; }

private:
  double value_ = 0;
};

}  // namespace common
}  // namespace gazebo

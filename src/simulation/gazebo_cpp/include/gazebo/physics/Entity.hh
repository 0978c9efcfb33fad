#pragma once
#include <string>

#include <boost/function.hpp>
#include <ignition/math/AxisAlignedBox.hh>
#include <ignition/math/Pose3.hh>
#include <ignition/math/Vector3.hh>

#include <gazebo/common/CommonTypes.hh>
#include <gazebo/msgs/msgs.hh>
#include <gazebo/physics/Base.hh>

namespace gazebo
{
namespace physics
{

/// What has a pose. World axes, m, rad; poses that are returned by reference change with the next question.
class GAZEBO_VISIBLE Entity : public Base
{
public:
  explicit Entity(BasePtr parent) : Base(parent) { AddType(ENTITY); }
  void SetStatic(const bool&) {}
  virtual bool IsStatic() const;
  void SetInitialRelativePose(const ignition::math::Pose3d& pose) { initial_ = pose; }
  ignition::math::Pose3d InitialRelativePose() const { return initial_; }
  virtual ignition::math::AxisAlignedBox BoundingBox() const { return {}; }
  ignition::math::AxisAlignedBox CollisionBoundingBox() const { return BoundingBox(); }
  virtual const ignition::math::Pose3d& WorldPose() const { return worldPose; }
  const ignition::math::Pose3d& DirtyPose() const { return WorldPose(); }
  ignition::math::Pose3d RelativePose() const;
  void SetRelativePose(const ignition::math::Pose3d& pose, bool notify = true, bool publish = true);
  void SetWorldPose(const ignition::math::Pose3d& pose, bool notify = true, bool publish = true);
  virtual ignition::math::Vector3d WorldLinearVel() const { return {}; }
  virtual ignition::math::Vector3d WorldAngularVel() const { return {}; }
  virtual ignition::math::Vector3d WorldLinearAccel() const { return {}; }
  virtual ignition::math::Vector3d WorldAngularAccel() const { return {}; }
  virtual ignition::math::Vector3d RelativeLinearVel() const { return local(WorldLinearVel()); }
  virtual ignition::math::Vector3d RelativeAngularVel() const { return local(WorldAngularVel()); }
  virtual ignition::math::Vector3d RelativeLinearAccel() const { return local(WorldLinearAccel()); }
  virtual ignition::math::Vector3d RelativeAngularAccel() const { return local(WorldAngularAccel()); }
  virtual void SetWorldTwist(const ignition::math::Vector3d&, const ignition::math::Vector3d&, bool = true) {}
  void SetCanonicalLink(bool canonical) { canonical_ = canonical; }
  bool IsCanonicalLink() const { return canonical_; }
  ModelPtr GetParentModel();
  CollisionPtr GetChildCollision(const std::string& name);
  LinkPtr GetChildLink(const std::string& name);
  void GetNearestEntityBelow(double& distance, std::string& name);
  void PlaceOnNearestEntityBelow();
  /// Moves it along from the next step on, until the animation ends; one that loops never does.
  void SetAnimation(common::PoseAnimationPtr animation) { SetAnimation(animation, {}); }
  void SetAnimation(const common::PoseAnimationPtr& animation, boost::function<void()> on_complete);
  virtual void StopAnimation();

protected:
  virtual void place(const ignition::math::Pose3d& X_WE) { worldPose = X_WE; }
  ignition::math::Vector3d local(const ignition::math::Vector3d& v) const { return WorldPose().Rot().RotateVectorReverse(v); }

  mutable ignition::math::Pose3d worldPose;

private:
  ignition::math::Pose3d initial_;
  bool canonical_ = false;
};

}  // namespace physics
}  // namespace gazebo

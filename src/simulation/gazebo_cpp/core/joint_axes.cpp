// Joint: where its axes are, and what lies about them.
#include <gazebo/physics/physics.hh>

#include "convert.hpp"
#include "sdf_text.hpp"

namespace gazebo
{
namespace physics
{

using ignition::math::Pose3d;
using ignition::math::Vector3d;

void Joint::SetAxis(unsigned int index, const Vector3d& direction)
{
  auto* axis = settings(index);
  if (!axis || !(direction.Length() > 1e-9) || !direction.IsFinite())
    return;
  const Vector3d world = AxisFrame(index).RotateVector(direction.Normalized());
  axis->xyz = ode(ParentWorldPose().Rot().RotateVectorReverse(world));
  changed();
}

Vector3d Joint::LocalAxis(unsigned int index) const
{
  const auto* axis = settings(index);
  return axis ? ign(axis->xyz) : Vector3d();
}

// The first axis goes with the parent, the second with the child.
Vector3d Joint::GlobalAxis(unsigned int index) const
{
  return (index == 0 ? ParentWorldPose() : WorldPose()).Rot().RotateVector(LocalAxis(index));
}

Vector3d Joint::Anchor(unsigned int) const { return WorldPose().Pos(); }

Pose3d Joint::InitialAnchorPose() const { return ign(wanted().X_CJ); }
Pose3d Joint::WorldPose() const
{
  if (core_)
    return ign(core_->child_frame_W());
  const LinkPtr& link = child_ ? child_ : parent_;
  return link ? ign(link->Core()->X_WL * wanted().X_CJ) : Pose3d();
}
Pose3d Joint::ParentWorldPose() const { return core_ ? ign(core_->frame_W()) : WorldPose(); }

double Joint::GetInertiaRatio(unsigned int index) const { return InertiaRatio(GlobalAxis(index)); }

double Joint::InertiaRatio(const Vector3d& axis) const
{
  if (!parent_ || !child_)
    return 0.0;
  const double parent = axis.Dot(parent_->WorldInertiaMatrix() * axis);
  return parent > 0 ? axis.Dot(child_->WorldInertiaMatrix() * axis) / parent : 0.0;
}

double Joint::GetWorldEnergyPotentialSpring(unsigned int index) const
{
  const auto* axis = settings(index);
  if (!axis)
    return 0.0;
  const double stretched = Position(index) - axis->spring_reference;
  return 0.5 * axis->spring_stiffness * stretched * stretched;
}

double Joint::stop(const std::string& what, unsigned int index, double otherwise) const
{
  const auto set = params_.find("stop_" + what + std::to_string(index));
  return set == params_.end() ? otherwise : set->second;
}

bool Joint::inModelAxes(unsigned int index) const
{
  const sdf::ElementPtr axis = inside(const_cast<Joint*>(this)->GetSDF(), index == 1 ? "axis2" : "axis");
  return inside(axis, "use_parent_model_frame") && axis->Get<bool>("use_parent_model_frame");
}

ignition::math::Quaterniond Joint::AxisFrameOffset(unsigned int index) const
{
  if (!inModelAxes(index) || !child_)
    return ignition::math::Quaterniond::Identity;
  return WorldPose().Rot().Inverse() * child_->GetModel()->WorldPose().Rot();
}

ignition::math::Quaterniond Joint::AxisFrame(unsigned int index) const { return WorldPose().Rot() * AxisFrameOffset(index); }

}  // namespace physics
}  // namespace gazebo

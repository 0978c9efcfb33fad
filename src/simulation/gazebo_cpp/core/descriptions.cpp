// What models are, as messages.
#include <gazebo/msgs/msgs.hh>
#include <gazebo/physics/physics.hh>

#include "convert.hpp"

namespace gazebo
{
namespace physics
{
namespace
{

msgs::Joint::Type type_of(const Joint& joint)
{
  const std::pair<Base::EntityType, msgs::Joint::Type> types[] = {
    { Base::SLIDER_JOINT, msgs::Joint::PRISMATIC }, { Base::FIXED_JOINT, msgs::Joint::FIXED },
    { Base::BALL_JOINT, msgs::Joint::BALL },        { Base::UNIVERSAL_JOINT, msgs::Joint::UNIVERSAL },
    { Base::HINGE2_JOINT, msgs::Joint::REVOLUTE2 }, { Base::SCREW_JOINT, msgs::Joint::SCREW },
    { Base::GEARBOX_JOINT, msgs::Joint::GEARBOX }
  };
  for (const auto& type : types)
    if (joint.HasType(type.first))
      return type.second;
  return msgs::Joint::REVOLUTE;
}

}  // namespace

void Collision::FillMsg(msgs::Collision& message)
{
  message.set_id(GetId());
  message.set_name(GetScopedName());
  message.set_laser_retro(GetLaserRetro());
  msgs::Set(message.mutable_pose(), RelativePose());
  if (shape_)
    shape_->FillMsg(*message.mutable_geometry());
}

void Link::FillMsg(msgs::Link& message)
{
  message.set_id(GetId());
  message.set_name(GetScopedName());
  message.set_gravity(GetGravityMode());
  message.set_kinematic(GetKinematic());
  message.set_enabled(GetEnabled());
  message.set_canonical(IsCanonicalLink());
  msgs::Inertial& inertial = *message.mutable_inertial();
  inertial.set_mass(GetInertial()->Mass());
  inertial.set_ixx(GetInertial()->IXX()), inertial.set_ixy(GetInertial()->IXY()), inertial.set_ixz(GetInertial()->IXZ());
  inertial.set_iyy(GetInertial()->IYY()), inertial.set_iyz(GetInertial()->IYZ()), inertial.set_izz(GetInertial()->IZZ());
  msgs::Set(inertial.mutable_pose(), GetInertial()->Pose());
  msgs::Set(message.mutable_pose(), RelativePose());
  for (const CollisionPtr& collision : collisions_)
    collision->FillMsg(*message.add_collision());
}

void Joint::FillMsg(msgs::Joint& message)
{
  message.set_name(GetScopedName());
  message.set_id(GetId());
  message.set_type(type_of(*this));
  if (parent_)
    message.set_parent(parent_->GetScopedName()), message.set_parent_id(parent_->GetId());
  if (child_)
    message.set_child(child_->GetScopedName()), message.set_child_id(child_->GetId());
  for (unsigned int i = 0; i < DOF() && i < 2; ++i)
  {
    message.add_angle(Position(i));
    msgs::Axis& axis = i ? *message.mutable_axis2() : *message.mutable_axis1();
    msgs::Set(axis.mutable_xyz(), LocalAxis(i));
    axis.set_limit_lower(LowerLimit(i)), axis.set_limit_upper(UpperLimit(i));
    axis.set_limit_effort(GetEffortLimit(i)), axis.set_limit_velocity(GetVelocityLimit(i));
    axis.set_damping(GetDamping(i)), axis.set_friction(GetParam("friction", i));
    axis.set_xyz_expressed_in("");
    // Deprecated, and required.
    axis.GetReflection()->SetBool(&axis, axis.GetDescriptor()->FindFieldByName("use_parent_model_frame"), false);
  }
  if (HasType(Base::SCREW_JOINT))
    message.mutable_screw()->set_thread_pitch(GetParam("thread_pitch", 0));
  if (HasType(Base::GEARBOX_JOINT))
  {
    message.mutable_gearbox()->set_gearbox_ratio(GetParam("gearbox_ratio", 0));
    message.mutable_gearbox()->set_gearbox_reference_body(
        GetSDF() && GetSDF()->HasElement("gearbox_reference_body") ? GetSDF()->Get<std::string>("gearbox_reference_body") : "");
  }
}

void Model::FillMsg(msgs::Model& message)
{
  message.set_name(GetScopedName());
  message.set_id(GetId());
  message.set_is_static(IsStatic());
  message.set_self_collide(GetSelfCollide());
  message.set_deleted(false);
  msgs::Set(message.mutable_pose(), RelativePose());
  msgs::Set(message.mutable_scale(), Scale());
  for (const LinkPtr& link : links_)
    link->FillMsg(*message.add_link());
  for (const JointPtr& joint : joints_)
    joint->FillMsg(*message.add_joint());
}

}  // namespace physics
}  // namespace gazebo

// Limits of a joint from its robot's description; what it says: limit_sources.h.
#pragma once

#include <joint_limits_interface/limit_sources.h>
#include <ros/console.h>
#include <urdf/urdfdom_compatibility.h>
#include <urdf_model/joint.h>

namespace joint_limits_interface
{

/// What <limit> says, on top of what \p limits has. \return false: the joint has none, nothing was changed
inline bool getJointLimits(urdf::JointConstSharedPtr urdf_joint, JointLimits& limits)
{
  if (!urdf_joint || !urdf_joint->limits)
    return false;
  const urdf::JointLimits& limit = *urdf_joint->limits;
  apply_description(urdf_joint->type == urdf::Joint::REVOLUTE || urdf_joint->type == urdf::Joint::PRISMATIC,
                    urdf_joint->type == urdf::Joint::CONTINUOUS, limit.lower, limit.upper, limit.velocity, limit.effort,
                    limits);
  return true;
}

/// What <safety_controller> says. \return false: the joint has none, nothing was changed
inline bool getSoftJointLimits(urdf::JointConstSharedPtr urdf_joint, SoftJointLimits& soft_limits)
{
  if (!urdf_joint || !urdf_joint->safety)
    return false;
  soft_limits.min_position = urdf_joint->safety->soft_lower_limit;
  soft_limits.max_position = urdf_joint->safety->soft_upper_limit;
  soft_limits.k_position = urdf_joint->safety->k_position;
  soft_limits.k_velocity = urdf_joint->safety->k_velocity;
  return true;
}

}  // namespace joint_limits_interface

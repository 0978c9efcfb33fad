// Limits of a joint.
#pragma once

namespace joint_limits_interface
{

/// Hard limits; a value counts only if its flag is set. Units: rad or m and their derivatives, Nm or N.
struct JointLimits
{
  double min_position = 0.0;
  double max_position = 0.0;
  double max_velocity = 0.0;
  double max_acceleration = 0.0;
  double max_jerk = 0.0;
  double max_effort = 0.0;
  bool has_position_limits = false;
  bool has_velocity_limits = false;
  bool has_acceleration_limits = false;
  bool has_jerk_limits = false;
  bool has_effort_limits = false;
  bool angle_wraparound = false;
};

/// A window inside the hard limits, in which the joint is slowed down.
struct SoftJointLimits
{
  double min_position = 0.0;
  double max_position = 0.0;
  double k_position = 0.0;
  double k_velocity = 0.0;
};

}  // namespace joint_limits_interface

// Paths into trajectories: all way points get times, velocities and accelerations within the limits of the joints.
#pragma once

#include <moveit/macros/class_forward.h>
#include <moveit/robot_trajectory/robot_trajectory.h>

namespace trajectory_processing
{
MOVEIT_CLASS_FORWARD(TimeParameterization);

class TimeParameterization
{
public:
  virtual ~TimeParameterization() {}
  // Scaling factors in (0, 1]. False when there is no group or no trajectory can be made.
  virtual bool computeTimeStamps(robot_trajectory::RobotTrajectory& trajectory, const double max_velocity_scaling_factor = 1.0,
                                 const double max_acceleration_scaling_factor = 1.0) const = 0;
};
}  // namespace trajectory_processing

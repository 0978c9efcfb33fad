#pragma once

#include <moveit/trajectory_processing/time_parameterization.h>

namespace trajectory_processing
{
MOVEIT_CLASS_FORWARD(IterativeParabolicTimeParameterization);

// The way points stay; times are stretched until velocities and accelerations fit.
class IterativeParabolicTimeParameterization : public TimeParameterization
{
public:
  // The arguments count for nothing: it goes on until the limits are kept.
  IterativeParabolicTimeParameterization(unsigned int max_iterations = 100, double max_time_change_per_it = .01);
  bool computeTimeStamps(robot_trajectory::RobotTrajectory& trajectory, const double max_velocity_scaling_factor = 1.0,
                         const double max_acceleration_scaling_factor = 1.0) const override;
};
}  // namespace trajectory_processing

#pragma once

#include <moveit/trajectory_processing/time_parameterization.h>

namespace trajectory_processing
{
MOVEIT_CLASS_FORWARD(IterativeSplineParameterization);

// The same with a cubic spline through the way points.
class IterativeSplineParameterization : public TimeParameterization
{
public:
  explicit IterativeSplineParameterization(bool add_points = true);
  bool computeTimeStamps(robot_trajectory::RobotTrajectory& trajectory, const double max_velocity_scaling_factor = 1.0,
                         const double max_acceleration_scaling_factor = 1.0) const override;
};
}  // namespace trajectory_processing

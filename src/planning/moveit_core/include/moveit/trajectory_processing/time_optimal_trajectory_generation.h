#pragma once

#include <string>
#include <unordered_map>

#include <moveit/trajectory_processing/time_parameterization.h>

namespace trajectory_processing
{
MOVEIT_CLASS_FORWARD(TimeOptimalTrajectoryGeneration);

// As fast as the limits allow along the path with its corners rounded; new way points at equal times.
class TimeOptimalTrajectoryGeneration : public TimeParameterization
{
public:
  // How far corners may be cut, the time between way points (s), and the least change between two that are kept.
  TimeOptimalTrajectoryGeneration(const double path_tolerance = 0.1, const double resample_dt = 0.1,
                                  const double min_angle_change = 0.001);
  bool computeTimeStamps(robot_trajectory::RobotTrajectory& trajectory, const double max_velocity_scaling_factor = 1.0,
                         const double max_acceleration_scaling_factor = 1.0) const override;
  // With limits of some variables other than the robot's.
  bool computeTimeStamps(robot_trajectory::RobotTrajectory& trajectory,
                         const std::unordered_map<std::string, double>& velocity_limits,
                         const std::unordered_map<std::string, double>& acceleration_limits,
                         const double max_velocity_scaling_factor = 1.0,
                         const double max_acceleration_scaling_factor = 1.0) const;

private:
  const double path_tolerance_, resample_dt_, min_angle_change_;
};
}  // namespace trajectory_processing

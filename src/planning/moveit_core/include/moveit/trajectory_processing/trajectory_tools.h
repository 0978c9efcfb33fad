#pragma once

#include <moveit_msgs/RobotTrajectory.h>

namespace trajectory_processing
{
bool isTrajectoryEmpty(const moveit_msgs::RobotTrajectory& trajectory);
std::size_t trajectoryWaypointCount(const moveit_msgs::RobotTrajectory& trajectory);
}  // namespace trajectory_processing

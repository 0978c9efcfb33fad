// Trajectories slowed down where a link is too fast.
#pragma once

#include <string>

#include <moveit/robot_trajectory/robot_trajectory.h>

namespace trajectory_processing
{
// Segments are stretched until the link moves at no more than `speed` m/s between way points. False: no such link, no group, or
// a speed that is not above 0.
bool limitMaxCartesianLinkSpeed(robot_trajectory::RobotTrajectory& trajectory, const double speed,
                                const moveit::core::LinkModel* link_model);
// "": the tip that the group's end effectors are mounted on.
bool limitMaxCartesianLinkSpeed(robot_trajectory::RobotTrajectory& trajectory, const double speed,
                                const std::string& link_name = "");
}  // namespace trajectory_processing

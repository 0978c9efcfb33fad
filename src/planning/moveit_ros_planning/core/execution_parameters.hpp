// Parameters of execution that single joints and controllers have for themselves.
#pragma once

#include <ros/node_handle.h>

#include <map>
#include <string>

namespace trajectory_execution_manager
{
// joints_allowed_start_tolerance below nh: rad or m by joint. What is no number of 0 or more is named and left out.
std::map<std::string, double> readStartTolerances(const ros::NodeHandle& nh);

// The number under the key of each entry of controller_list below nh that has one, by the controller's name.
std::map<std::string, double> readOfControllers(const ros::NodeHandle& nh, const std::string& key);
}  // namespace trajectory_execution_manager

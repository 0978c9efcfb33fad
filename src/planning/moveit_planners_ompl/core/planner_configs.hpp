// What ompl_planning.yaml says of the planners of each group.
#pragma once

#include <moveit/planning_interface/planning_interface.h>
#include <ros/node_handle.h>

#include <map>
#include <string>

#include "motion/planning.hpp"

namespace ompl_interface
{
constexpr char LOGNAME[] = "ompl_interface";

// The table name -> settings; names are `group` (its default) and `group[config]`.
planning_interface::PlannerConfigurationMap readPlannerConfigs(const moveit::core::RobotModel& model,
                                                               const ros::NodeHandle& nh);

// The settings for a request; of an unknown planner the log tells, and the group's default is used.
std::map<std::string, std::string> findConfig(const planning_interface::PlannerConfigurationMap& configs,
                                              const std::string& group, const std::string& planner_id);

// Settings of the search go into the request's fields, those of the planner stay its parameters.
void applyConfig(std::map<std::string, std::string> settings, motion::PlanRequest& request);
}  // namespace ompl_interface

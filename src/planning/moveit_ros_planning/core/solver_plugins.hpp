// Compiled inverse kinematics, found by pluginlib.
#pragma once

#include <string>
#include <vector>

#include <moveit/kinematics_base/kinematics_base.h>
#include <moveit/robot_model/robot_model.h>

namespace kinematics_plugin_loader
{
struct SolverRequest
{
  std::string plugin;             // the class, as kinematics.yaml has it
  std::string robot_description;  // the parameter, for solvers that read it themselves
  std::vector<std::string> tips;  // empty: those of the group
  double resolution = kinematics::KinematicsBase::DEFAULT_SEARCH_DISCRETIZATION;
  double timeout = 0.0;  // s, of one question while planning; 0: as much as is left
};

// Does a package export this class?
bool isExported(const std::string& plugin);
// The package that exports it; "" if none does.
std::string packageOf(const std::string& plugin);

// Throws std::runtime_error with one line: not exported, not built, or it does not want this group.
kinematics::KinematicsBasePtr makeSolver(const SolverRequest& request, const moveit::core::JointModelGroup& group);
}  // namespace kinematics_plugin_loader

// Inverse kinematics solvers as kinematics.yaml names them: a compiled plugin if there is one, else the motion library's.
#pragma once

#include <boost/function.hpp>

#include <moveit/kinematics_base/kinematics_base.h>
#include <moveit/macros/class_forward.h>
#include <moveit/robot_model/robot_model.h>

namespace kinematics_plugin_loader
{
MOVEIT_CLASS_FORWARD(KinematicsPluginLoader);

class KinematicsPluginLoader
{
public:
  KinematicsPluginLoader(const std::string& robot_description = "robot_description", double default_search_resolution = 0.0);
  // A solver for groups that kinematics.yaml says nothing of; the number of attempts counts for nothing.
  KinematicsPluginLoader(const std::string& solver_plugin, double solve_timeout, unsigned int ik_attempts,
                         const std::string& robot_description = "robot_description", double default_search_resolution = 0.0);

  // A function that makes the solver of a group; null when there is none.
  moveit::core::SolverAllocatorFn getLoaderFunction();
  moveit::core::SolverAllocatorFn getLoaderFunction(const srdf::ModelSharedPtr& srdf_model);

  const std::vector<std::string>& getKnownGroups() const { return groups_; }
  const std::map<std::string, double>& getIKTimeout() const { return ik_timeout_; }  // s
  // Let vendors' plugins also answer where `model` itself is asked: planning in this process samples its goals with them.
  void solveFor(const moveit::core::RobotModel& model) const;
  void status() const;

private:
  std::string robot_description_;
  double default_search_resolution_;
  MOVEIT_CLASS_FORWARD(KinematicsLoaderImpl);
  KinematicsLoaderImplPtr loader_;
  std::vector<std::string> groups_;
  std::map<std::string, double> ik_timeout_;
  std::string default_solver_plugin_;
  double default_solver_timeout_ = 0.0;
};
}  // namespace kinematics_plugin_loader

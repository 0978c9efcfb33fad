// A compiled kinematics plugin in the place of the motion library's own inverse kinematics.
#pragma once

#include <memory>
#include <string>

#include "motion/robot_model.hpp"
#include "solver_plugins.hpp"

namespace kinematics_plugin_loader
{
// Loads the plugin for the group and puts it into the robot. Throws std::runtime_error with one line when it cannot be loaded,
// or when its solutions are not where they should be: a solver made for another robot.
void installSolver(const std::shared_ptr<motion::RobotModel>& robot, const std::string& urdf, const std::string& srdf,
                   const std::string& group, const SolverRequest& request);

// The same for a C++ program's robot, when the group's inverse kinematics is asked for the first time: most programs never do.
// A plugin that cannot be loaded then is told in a line, and the motion library's own solver stays.
void installSolverLate(const moveit::core::RobotModel& model, const std::string& group, const SolverRequest& request);
}  // namespace kinematics_plugin_loader

// Robots for tests, of the packages moveit_resources_<name>_description and moveit_resources_<name>_moveit_config.
#pragma once

#include <srdfdom/model.h>
#include <urdf/model.h>

#include <string>

#include <moveit/robot_model/robot_model.h>

namespace moveit
{
namespace core
{
// "panda", "fanuc", "pr2" ... Null, and a line in the log, when the packages are not there.
RobotModelPtr loadTestingRobotModel(const std::string& robot_name);
urdf::ModelInterfaceSharedPtr loadModelInterface(const std::string& robot_name);
srdf::ModelSharedPtr loadSRDFModel(const std::string& robot_name);
}  // namespace core
}  // namespace moveit

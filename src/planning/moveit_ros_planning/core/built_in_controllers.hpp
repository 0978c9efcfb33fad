// The controllers of controller_list: behind actions, or only pretended.
#pragma once

#include <control_msgs/JointTolerance.h>
#include <moveit/controller_manager/controller_manager.h>
#include <moveit/robot_model/robot_model.h>
#include <ros/node_handle.h>

#include <map>
#include <string>
#include <vector>

namespace trajectory_execution_manager
{
// An entry of controller_list. Python's half reads the same: entries.py of moveit_simple_controller_manager.
struct ControllerEntry
{
  std::string name, action_ns, type;
  std::vector<std::string> joints;
  XmlRpc::XmlRpcValue all;

  bool has(const char* key, XmlRpc::XmlRpcValue::Type kind) const;
  // Is the key there, with anything but false or 0?
  bool flag(const char* key) const;
  // `standard` where there is none, and an error line where it is no number.
  double number(const char* key, double standard) const;
  std::string text(const char* key) const;
  // By the names of joints. A table of position, velocity and acceleration, each one number for all joints or a list in the order of
  // `joints`; or a list of tables with the `name` of a joint. What is neither is told in one line and is 0: the controller's own.
  std::vector<control_msgs::JointTolerance> tolerances(const char* key) const;
};

// The usable entries of controller_list below nh; of the others the log tells what is wrong.
std::vector<ControllerEntry> readControllerList(const ros::NodeHandle& nh, bool actions);

using Handles = std::map<std::string, moveit_controller_manager::MoveItControllerHandlePtr>;
Handles makeActionHandles(const std::vector<ControllerEntry>& entries);
Handles makeFakeHandles(const std::vector<ControllerEntry>& entries, const ros::NodeHandle& nh,
                        const moveit::core::RobotModel& model);

// The manager of that name if it is one of the two; else null.
moveit_controller_manager::MoveItControllerManagerPtr makeBuiltInManager(const std::string& name, const ros::NodeHandle& nh,
                                                                         const moveit::core::RobotModel& model);
}  // namespace trajectory_execution_manager

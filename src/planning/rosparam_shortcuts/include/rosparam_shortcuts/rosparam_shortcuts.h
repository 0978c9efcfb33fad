// Parameters without which a program is not to run: there are no default values.
//
//   std::size_t error = 0;
//   error += !rosparam_shortcuts::get("my_node", nh, "rate", rate);
//   error += !rosparam_shortcuts::get("my_node", nh, "tool", pose);  // [x, y, z, roll, pitch, yaw] or [x, y, z, qw, qx, qy, qz]
//   rosparam_shortcuts::shutdownIfError("my_node", error);
#pragma once

#include <geometry_msgs/Pose.h>
#include <ros/ros.h>
#include <rosparam_shortcuts/deprecation.h>

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

namespace rosparam_shortcuts
{
// Each: true when the parameter is there and of that kind. Else an error of the logger `parent_name` says which, where, and what
// is wrong with it, and the value stays as it was. What was read is told at the level DEBUG.
bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name, bool& value);
bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& params_namespace,
         std::map<std::string, bool>& parameters);
bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name, double& value);
bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name, std::vector<double>& values);
bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name, int& value);
bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name, std::size_t& value);
bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name, std::string& value);
bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name,
         std::vector<std::string>& values);
bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name, ros::Duration& value);  // s
bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name, Eigen::Isometry3d& value);
bool get(const std::string& parent_name, const ros::NodeHandle& nh, const std::string& param_name, geometry_msgs::Pose& value);

// "1,2,3,"
std::string getDebugArrayString(std::vector<double> values);
std::string getDebugArrayString(std::vector<std::string> values);

// Of [x, y, z] in m and a turn: [roll, pitch, yaw] in rad, about x, then the new y, then the new z, or [qw, qx, qy, qz].
bool convertDoublesToEigen(const std::string& parent_name, std::vector<double> values, Eigen::Isometry3d& transform);

// Ends the program unless the count of errors is 0.
void shutdownIfError(const std::string& parent_name, std::size_t error_count);
}  // namespace rosparam_shortcuts

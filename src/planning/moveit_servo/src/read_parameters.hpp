// The private parameters of this node.
#pragma once

#include <string>

#include <ros/ros.h>

#include <moveit_servo/servo_parameters.h>

namespace moveit_servo
{
// Counts what is missing or of another type, with a line for each.
class ParameterReader
{
public:
  explicit ParameterReader(const std::string& logger) : logger_(logger), nh_("~") {}

  template <typename T>
  void get(const std::string& name, T& value)
  {
    if (read(name, value))
      return;
    ++errors_;
    ROS_ERROR_NAMED(logger_, "Parameter %s is missing: set it in the node's yaml file", nh_.resolveName(name).c_str());
  }

  // Leaves the value as it is where there is none.
  template <typename T>
  bool read(const std::string& name, T& value)
  {
    if (!nh_.hasParam(name))
      return false;
    if (!nh_.getParam(name, value))
    {
      ++errors_;
      ROS_ERROR_NAMED(logger_, "Parameter %s is not %s", nh_.resolveName(name).c_str(), kind(value));
    }
    return true;
  }

  int errors() const { return errors_; }
  const ros::NodeHandle& node() const { return nh_; }

private:
  static const char* kind(double) { return "a number"; }
  static const char* kind(int) { return "a whole number"; }
  static const char* kind(bool) { return "true or false"; }
  static const char* kind(const std::string&) { return "a text"; }

  std::string logger_;
  ros::NodeHandle nh_;
  int errors_ = 0;
};

// False, with a line for each thing that is wrong.
bool readParameters(ServoParameters& parameters);
// What is wrong with the values, in one line; "" when nothing is.
std::string whatIsWrong(const ServoParameters& parameters);
}  // namespace moveit_servo

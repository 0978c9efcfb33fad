// Limits of a joint from parameters.
#pragma once

#include <string>

#include <joint_limits_interface/joint_limits.h>
#include <ros/ros.h>

namespace joint_limits_interface
{
namespace internal
{

/// Whether parameter has_<kind>_limits is true and all its values are there; a flag that is false takes the limit away.
template <class... V>
inline bool has_limits(const ros::NodeHandle& nh, const std::string& kind, bool& flag, const V&... names)
{
  bool has = false;
  if (!nh.getParam("has_" + kind + "_limits", has))
    return false;
  if (!has)
    flag = false;
  double value;
  const bool there[] = { true, nh.getParam(names, value)... };
  for (const bool one : there)
    has = has && one;
  return has;
}

}  // namespace internal

/// What <nh>/joint_limits/<joint> says, on top of what \p limits has. \return false: there is no such namespace
inline bool getJointLimits(const std::string& joint_name, const ros::NodeHandle& nh, JointLimits& limits)
{
  const std::string name = "joint_limits/" + joint_name;
  if (!nh.hasParam(name))
  {
    ROS_DEBUG_STREAM("No joint limits specification found for joint '" << joint_name << "' in the parameter server (namespace "
                                                                       << nh.getNamespace() + "/" + name << ").");
    return false;
  }
  const ros::NodeHandle own(nh, name);
  if (internal::has_limits(own, "position", limits.has_position_limits, std::string("min_position"),
                           std::string("max_position")))
  {
    limits.has_position_limits = true;
    own.getParam("min_position", limits.min_position);
    own.getParam("max_position", limits.max_position);
  }
  bool positions = true;
  if (own.getParam("has_position_limits", positions) && !positions)
    own.getParam("angle_wraparound", limits.angle_wraparound);

  struct Entry
  {
    const char* kind;
    bool& flag;
    double& value;
  };
  const Entry entries[] = { { "velocity", limits.has_velocity_limits, limits.max_velocity },
                            { "acceleration", limits.has_acceleration_limits, limits.max_acceleration },
                            { "jerk", limits.has_jerk_limits, limits.max_jerk },
                            { "effort", limits.has_effort_limits, limits.max_effort } };
  for (const Entry& entry : entries)
  {
    const std::string value = std::string("max_") + entry.kind;
    if (internal::has_limits(own, entry.kind, entry.flag, value))
    {
      entry.flag = true;
      own.getParam(value, entry.value);
    }
  }
  return true;
}

/// \return false: no has_soft_limits, or not all four values; nothing was changed
inline bool getSoftJointLimits(const std::string& joint_name, const ros::NodeHandle& nh, SoftJointLimits& soft_joint_limits)
{
  const ros::NodeHandle own(nh, "joint_limits/" + joint_name);
  bool has = false;
  SoftJointLimits read;
  if (!own.getParam("has_soft_limits", has) || !has || !own.getParam("k_position", read.k_position) ||
      !own.getParam("k_velocity", read.k_velocity) || !own.getParam("soft_lower_limit", read.min_position) ||
      !own.getParam("soft_upper_limit", read.max_position))
    return false;
  soft_joint_limits = read;
  return true;
}

}  // namespace joint_limits_interface

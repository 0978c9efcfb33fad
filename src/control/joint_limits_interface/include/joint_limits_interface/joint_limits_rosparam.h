// Limits of a joint from parameters; what they say: limit_sources.h.
#pragma once

#include <string>

#include <joint_limits_interface/limit_sources.h>
#include <ros/ros.h>
#include <xmlrpcpp/XmlRpcValue.h>

namespace joint_limits_interface
{
namespace internal
{

/// Values of a map of parameters; whole numbers are numbers as well. What is no map has no values.
class ParameterMap
{
public:
  explicit ParameterMap(const XmlRpc::XmlRpcValue& map) : map_(map) {}

  bool flag(const std::string& name, bool& value) const
  {
    if (!is(name, XmlRpc::XmlRpcValue::TypeBoolean))
      return false;
    value = static_cast<bool>(map_[name]);
    return true;
  }
  bool number(const std::string& name, double& value) const
  {
    if (is(name, XmlRpc::XmlRpcValue::TypeDouble))
      value = static_cast<double>(map_[name]);
    else if (is(name, XmlRpc::XmlRpcValue::TypeInt))
      value = static_cast<int>(map_[name]);
    else
      return false;
    return true;
  }

private:
  bool is(const std::string& name, XmlRpc::XmlRpcValue::Type type) const
  {
    return map_.getType() == XmlRpc::XmlRpcValue::TypeStruct && map_.hasMember(name) && map_[name].getType() == type;
  }

  mutable XmlRpc::XmlRpcValue map_;  ///< Its [] is not const in every release.
};

/// What stands at <nh>/joint_limits/<joint>. \return false: nothing; also for a joint of a name that no parameter can have
inline bool read_limits(const std::string& joint_name, const ros::NodeHandle& nh, XmlRpc::XmlRpcValue& values)
{
  const std::string name = "joint_limits/" + joint_name;
  try
  {
    if (nh.getParam(name, values))
      return true;
    ROS_DEBUG_STREAM("No joint limits specification found for joint '" << joint_name << "' in the parameter server (namespace "
                                                                       << nh.getNamespace() + "/" + name << ").");
  }
  catch (const ros::InvalidNameException& error)
  {
    ROS_ERROR_STREAM("joint '" << joint_name
                               << "': no parameter can have this name, so it has no limits of joint_limits: " << error.what());
  }
  return false;
}

}  // namespace internal

/// What <nh>/joint_limits/<joint> says, on top of what \p limits has. \return false: there is no such namespace
inline bool getJointLimits(const std::string& joint_name, const ros::NodeHandle& nh, JointLimits& limits)
{
  XmlRpc::XmlRpcValue values;
  if (!internal::read_limits(joint_name, nh, values))
    return false;
  apply_parameters(internal::ParameterMap(values), limits);
  return true;
}

/// \return false: no has_soft_limits, or not all four values; nothing was changed
inline bool getSoftJointLimits(const std::string& joint_name, const ros::NodeHandle& nh, SoftJointLimits& soft_joint_limits)
{
  XmlRpc::XmlRpcValue values;
  return internal::read_limits(joint_name, nh, values) &&
         apply_soft_parameters(internal::ParameterMap(values), soft_joint_limits);
}

}  // namespace joint_limits_interface

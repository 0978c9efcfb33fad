// What plugins of others take from gazebo_plugins: a node in the robot's namespace, and parameters of <plugin> with a word about each.
#pragma once
#include <map>
#include <sstream>
#include <string>

#include <boost/algorithm/string.hpp>
#include <boost/shared_ptr.hpp>
#include <gazebo/common/common.hh>
#include <gazebo/gazebo_config.h>
#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/Sensor.hh>
#include <ros/ros.h>

#ifndef GAZEBO_SENSORS_USING_DYNAMIC_POINTER_CAST
#define GAZEBO_SENSORS_USING_DYNAMIC_POINTER_CAST using std::dynamic_pointer_cast
#endif

namespace gazebo
{

/// <robotNamespace>, else the name of the model, with a slash at its end where it is not empty.
inline std::string GetModelName(const sensors::SensorPtr& parent)
{
  const std::string name = parent->ParentName();
  return name.substr(0, name.find("::"));
}

inline std::string GetRobotNamespace(const std::string& fallback, const sdf::ElementPtr& sdf, const char* info = nullptr)
{
  std::string space = fallback;
  if (sdf->HasElement("robotNamespace"))
    space = sdf->Get<std::string>("robotNamespace");
  if (info)
    ROS_INFO_NAMED("utils", "%s Plugin: the namespace is '%s'", info, space.c_str());
  return space.empty() ? "" : space + "/";
}

inline std::string GetRobotNamespace(const physics::ModelPtr& parent, const sdf::ElementPtr& sdf, const char* info = nullptr)
{
  return GetRobotNamespace(parent->GetName(), sdf, info);
}

/// Of a sensor: <robotNamespace>; the name of the model where that is empty; nothing where it is missing.
inline std::string GetRobotNamespace(const sensors::SensorPtr& parent, const sdf::ElementPtr& sdf, const char* info = nullptr)
{
  std::string space;
  if (sdf->HasElement("robotNamespace"))
    space = sdf->Get<std::string>("robotNamespace");
  if (sdf->HasElement("robotNamespace") && space.empty())
    space = GetModelName(parent);
  if (info)
    ROS_INFO_NAMED("utils", "%s Plugin: the namespace is '%s'", info, space.c_str());
  return space;
}

class GazeboRos
{
public:
  /// \param plugin its name, for what is printed
  GazeboRos(physics::ModelPtr& model, sdf::ElementPtr sdf, const std::string& plugin) : GazeboRos(model->GetName(), sdf, plugin)
  {
  }
  GazeboRos(sensors::SensorPtr sensor, sdf::ElementPtr sdf, const std::string& plugin)
    : GazeboRos(GetModelName(sensor), sdf, plugin)
  {
  }

  boost::shared_ptr<ros::NodeHandle>& node() { return node_; }
  const boost::shared_ptr<ros::NodeHandle>& node() const { return node_; }
  const char* info() const { return info_.c_str(); }  // plugin(ns = ...)
  void isInitialized()
  {
    if (!ros::isInitialized())
      ROS_FATAL_STREAM_NAMED("utils", info() << ": a ROS node for Gazebo has not been initialized, the plugin cannot load");
  }

  /// A frame with the robot's tf_prefix before it.
  std::string resolveTF(const std::string& frame) const
  {
    if (tf_prefix_.empty() || frame.empty())
      return frame;
    return frame[0] == '/' ? frame.substr(1) : boost::trim_right_copy_if(tf_prefix_, boost::is_any_of("/")) + "/" + frame;
  }

  void getParameterBoolean(bool& value, const char* tag, const bool& fallback)
  {
    value = fallback;
    if (!sdf_->HasElement(tag))
      return missing(tag, fallback ? "true" : "false");
    getParameterBoolean(value, tag);
  }
  void getParameterBoolean(bool& value, const char* tag)
  {
    if (!sdf_->HasElement(tag))
      return;
    const std::string text = boost::trim_copy(sdf_->GetElement(tag)->Get<std::string>());
    if (boost::iequals(text, "true") || text == "1")
      value = true;
    else if (boost::iequals(text, "false") || text == "0")
      value = false;
    else
      ROS_WARN_NAMED("utils", "%s: <%s> is neither true nor false: '%s'", info(), tag, text.c_str());
  }

  template <class T>
  void getParameter(T& value, const char* tag, const T& fallback)
  {
    value = fallback;
    std::ostringstream text;
    text << fallback;
    if (!sdf_->HasElement(tag))
      return missing(tag, text.str());
    getParameter<T>(value, tag);
  }
  template <class T>
  void getParameter(T& value, const char* tag)
  {
    if (!sdf_->HasElement(tag))
      return;
    value = sdf_->GetElement(tag)->Get<T>();
    ROS_DEBUG_STREAM_NAMED("utils", info() << ": <" << tag << "> = " << value);
  }
  /// One of some words, each of which stands for a value.
  template <class T>
  void getParameter(T& value, const char* tag, const std::map<std::string, T>& options, const T& fallback)
  {
    value = fallback;
    if (!sdf_->HasElement(tag))
      return missing(tag, "the one that it begins with");
    getParameter<T>(value, tag, options);
  }
  template <class T>
  void getParameter(T& value, const char* tag, const std::map<std::string, T>& options)
  {
    if (!sdf_->HasElement(tag))
      return;
    const std::string word = sdf_->GetElement(tag)->Get<std::string>();
    const auto found = options.find(word);
    if (found != options.end())
      value = found->second;
    else
      ROS_WARN_STREAM_NAMED("utils", info() << ": <" << tag << "> has no option '" << word << "'");
  }

  /// A joint of the model, by the name that <tag> gives.
  physics::JointPtr getJoint(physics::ModelPtr& parent, const char* tag, const std::string& fallback)
  {
    std::string name;
    getParameter<std::string>(name, tag, fallback);
    const physics::JointPtr joint = parent->GetJoint(name);
    if (!joint)
      gzthrow(info() << ": the model has no joint '" << name << "'");
    return joint;
  }

private:
  GazeboRos(const std::string& model, const sdf::ElementPtr& sdf, const std::string& plugin) : sdf_(sdf)
  {
    std::string space = model;
    if (sdf->HasElement("robotNamespace") && !sdf->Get<std::string>("robotNamespace").empty())
      space = sdf->Get<std::string>("robotNamespace");
    info_ = plugin + "(ns = " + space + ")";
    isInitialized();
    node_.reset(new ros::NodeHandle(space));
    std::string key;
    if (node_->searchParam("tf_prefix", key))
      node_->getParam(key, tf_prefix_);
  }

  void missing(const char* tag, const std::string& fallback)
  {
    ROS_WARN_NAMED("utils", "%s: missing <%s>, taken is %s", info(), tag, fallback.c_str());
  }

  sdf::ElementPtr sdf_;
  std::string info_, tf_prefix_;
  boost::shared_ptr<ros::NodeHandle> node_;
};

typedef boost::shared_ptr<GazeboRos> GazeboRosPtr;

}  // namespace gazebo

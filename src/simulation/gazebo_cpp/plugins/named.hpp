// What elements of plugins name: it is there, or the plugin's Load() ends with a line that says what is missing.
#pragma once
#include <stdexcept>
#include <string>

#include <gazebo/physics/physics.hh>

namespace gazebo
{

inline std::string text_of(const sdf::ElementPtr& sdf, const std::string& tag)
{
  return sdf->HasElement(tag) ? sdf->Get<std::string>(tag) : "";
}

inline physics::LinkPtr named_link(physics::Model& model, const sdf::ElementPtr& sdf, const std::string& tag)
{
  const std::string name = text_of(sdf, tag);
  const physics::LinkPtr found = name.empty() ? physics::LinkPtr() : model.GetLink(name);
  if (!found)
    throw std::runtime_error("<" + tag + ">: the model has no link '" + name + "'");
  return found;
}

inline physics::JointPtr named_joint(physics::Model& model, const sdf::ElementPtr& sdf, const std::string& tag)
{
  const std::string name = text_of(sdf, tag);
  const physics::JointPtr found = model.GetJoint(name);
  if (!found)
    throw std::runtime_error("<" + tag + ">: the model has no joint '" + name + "'");
  return found;
}

inline common::BatteryPtr named_battery(physics::Link& link, const sdf::ElementPtr& sdf)
{
  const std::string name = text_of(sdf, "battery_name");
  const common::BatteryPtr found = link.Battery(name);
  if (!found)
    throw std::runtime_error("<battery_name>: link '" + link.GetName() + "' has no <battery> '" + name + "'");
  return found;
}

}  // namespace gazebo

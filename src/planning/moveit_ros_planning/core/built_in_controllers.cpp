#include "built_in_controllers.hpp"
#include "log_names.hpp"

#include <ros/console.h>

namespace trajectory_execution_manager
{
namespace
{
using moveit_controller_manager::MoveItControllerHandlePtr;
using Value = XmlRpc::XmlRpcValue;

class ListManager : public moveit_controller_manager::MoveItControllerManager
{
public:
  ListManager(const std::vector<ControllerEntry>& entries, const Handles& handles) : handles_(handles)
  {
    for (const ControllerEntry& entry : entries)
      if (handles_.count(entry.name))
        entries_[entry.name] = entry;
    ROS_INFO_NAMED(log_names::CONTROLLER_MANAGER, "Returned %zu controllers in list", handles_.size());
  }
  MoveItControllerHandlePtr getControllerHandle(const std::string& name) override
  {
    const auto found = handles_.find(name);
    return found == handles_.end() ? nullptr : found->second;
  }
  void getControllersList(std::vector<std::string>& names) override
  {
    names.clear();
    for (const auto& handle : handles_)
      names.push_back(handle.first);
  }
  void getActiveControllers(std::vector<std::string>& names) override { getControllersList(names); }
  void getControllerJoints(const std::string& name, std::vector<std::string>& joints) override
  {
    const auto found = entries_.find(name);
    joints = found == entries_.end() ? std::vector<std::string>() : found->second.joints;
  }
  ControllerState getControllerState(const std::string& name) override
  {
    ControllerState state;
    const auto found = entries_.find(name);
    state.active_ = found != entries_.end();
    state.default_ = state.active_ && found->second.flag("default");
    return state;
  }
  bool switchControllers(const std::vector<std::string>& /*activate*/, const std::vector<std::string>& /*deactivate*/) override
  {
    return false;
  }

private:
  std::map<std::string, ControllerEntry> entries_;
  Handles handles_;
};
}  // namespace

std::vector<ControllerEntry> readControllerList(const ros::NodeHandle& nh, bool actions)
{
  std::vector<ControllerEntry> usable;
  const std::string parameter = nh.resolveName("controller_list");
  Value list;
  if (!nh.getParam("controller_list", list))
  {
    ROS_ERROR_NAMED(log_names::CONTROLLER_MANAGER, "No controller_list specified: parameter %s is not set", parameter.c_str());
    return usable;
  }
  if (list.getType() != Value::TypeArray)
  {
    ROS_ERROR_NAMED(log_names::CONTROLLER_MANAGER, "Parameter controller_list should be specified as an array: %s",
                    parameter.c_str());
    return usable;
  }
  for (int i = 0; i < list.size(); ++i)
  {
    ControllerEntry entry;
    entry.all = list[i];
    entry.name = entry.text("name");
    entry.action_ns = entry.text("action_ns");
    entry.type = entry.text("type");
    if (!entry.has("name", Value::TypeString) || !entry.has("joints", Value::TypeArray) ||
        (actions && (entry.type.empty() || !entry.has("action_ns", Value::TypeString))))
    {
      ROS_ERROR_NAMED(log_names::CONTROLLER_MANAGER, "Entry %d of %s needs a name, a list of joints%s: left out", i,
                      parameter.c_str(), actions ? ", action_ns and type" : "");
      continue;
    }
    Value& joints = list[i]["joints"];
    for (int k = 0; k < joints.size(); ++k)
      if (joints[k].getType() == Value::TypeString)
        entry.joints.push_back(joints[k]);
    usable.push_back(entry);
  }
  return usable;
}

moveit_controller_manager::MoveItControllerManagerPtr makeBuiltInManager(const std::string& name, const ros::NodeHandle& nh,
                                                                         const moveit::core::RobotModel& model)
{
  if (name == "moveit_simple_controller_manager/MoveItSimpleControllerManager")
  {
    const std::vector<ControllerEntry> entries = readControllerList(nh, true);
    return std::make_shared<ListManager>(entries, makeActionHandles(entries));
  }
  if (name == "moveit_fake_controller_manager/MoveItFakeControllerManager")
  {
    const std::vector<ControllerEntry> entries = readControllerList(nh, false);
    return std::make_shared<ListManager>(entries, makeFakeHandles(entries, nh, model));
  }
  return nullptr;
}
}  // namespace trajectory_execution_manager

// A robot made of others, which are loaded as plugins.
#pragma once

#include <algorithm>
#include <list>
#include <set>
#include <string>
#include <vector>

#include <hardware_interface/hardware_interface.h>
#include <hardware_interface/robot_hw.h>
#include <pluginlib/class_loader.hpp>
#include <ros/console.h>
#include <ros/node_handle.h>

namespace combined_robot_hw
{

/// The parameter robot_hardware names the parts; each has its parameters in a namespace of its name, type is its class.
class CombinedRobotHW : public hardware_interface::RobotHW
{
public:
  typedef std::list<hardware_interface::ControllerInfo> Controllers;

  /// \return false: a part could not be loaded or refused, the log says which
  bool init(ros::NodeHandle& root_nh, ros::NodeHandle& robot_hw_nh) override
  {
    root_nh_ = root_nh;
    robot_hw_nh_ = robot_hw_nh;
    std::vector<std::string> names;
    if (!robot_hw_nh.getParam("robot_hardware", names))
    {
      ROS_ERROR_STREAM("Could not find 'robot_hardware' parameter (namespace: " << robot_hw_nh.getNamespace()
                                                                                << "): the names of the robot's parts");
      return false;
    }
    return std::all_of(names.begin(), names.end(), [this](const std::string& name) { return loadRobotHW(name); });
  }

  bool prepareSwitch(const Controllers& start_list, const Controllers& stop_list) override
  {
    return std::all_of(robot_hw_list_.begin(), robot_hw_list_.end(), [&](const hardware_interface::RobotHWSharedPtr& part) {
      Controllers start, stop;
      filterControllerList(start_list, start, part);
      filterControllerList(stop_list, stop, part);
      return part->prepareSwitch(start, stop);
    });
  }

  void doSwitch(const Controllers& start_list, const Controllers& stop_list) override
  {
    for (const hardware_interface::RobotHWSharedPtr& part : robot_hw_list_)
    {
      Controllers start, stop;
      filterControllerList(start_list, start, part);
      filterControllerList(stop_list, stop, part);
      part->doSwitch(start, stop);
    }
  }

  void read(const ros::Time& time, const ros::Duration& period) override
  {
    for (const hardware_interface::RobotHWSharedPtr& part : robot_hw_list_)
      part->read(time, period);
  }

  void write(const ros::Time& time, const ros::Duration& period) override
  {
    for (const hardware_interface::RobotHWSharedPtr& part : robot_hw_list_)
      part->write(time, period);
  }

protected:
  virtual bool loadRobotHW(const std::string& name)
  {
    try
    {
      ros::NodeHandle nh(robot_hw_nh_, name);
      std::string type;
      if (!nh.getParam("type", type))
      {
        ROS_ERROR(
            "Could not load robot HW '%s' because the type was not specified. Did you load the robot HW configuration on the "
            "parameter server (namespace: '%s')?",
            name.c_str(), nh.getNamespace().c_str());
        return false;
      }
      const hardware_interface::RobotHWSharedPtr part(robot_hw_loader_.createUnmanagedInstance(type));
      if (!part->init(root_nh_, nh))
      {
        ROS_ERROR("Initializing robot HW '%s' failed", name.c_str());
        return false;
      }
      robot_hw_list_.push_back(part);
      registerInterfaceManager(part.get());
      return true;
    }
    catch (const std::exception& error)
    {
      ROS_ERROR("Could not load robot HW '%s': %s", name.c_str(), error.what());
      return false;
    }
  }

  /// Of each controller, what it claims of \p robot_hw; controllers that claim nothing of it are left out, unless they claim nothing.
  void filterControllerList(const Controllers& list, Controllers& filtered_list, hardware_interface::RobotHWSharedPtr robot_hw)
  {
    filtered_list.clear();
    for (const hardware_interface::ControllerInfo& controller : list)
    {
      hardware_interface::ControllerInfo filtered(controller.name, controller.type, {});
      for (const hardware_interface::InterfaceResources& claimed : controller.claimed_resources)
      {
        std::set<std::string> resources;
        for (const std::string& resource : robot_hw->getInterfaceResources(claimed.hardware_interface))
          if (claimed.resources.count(resource))
            resources.insert(resource);
        if (!resources.empty())
          filtered.claimed_resources.emplace_back(claimed.hardware_interface, resources);
      }
      if (controller.claimed_resources.empty() || !filtered.claimed_resources.empty())
        filtered_list.push_back(filtered);
    }
  }

  ros::NodeHandle root_nh_;
  ros::NodeHandle robot_hw_nh_;
  pluginlib::ClassLoader<hardware_interface::RobotHW> robot_hw_loader_{ "hardware_interface", "hardware_interface::RobotHW" };
  std::vector<hardware_interface::RobotHWSharedPtr> robot_hw_list_;
};

}  // namespace combined_robot_hw

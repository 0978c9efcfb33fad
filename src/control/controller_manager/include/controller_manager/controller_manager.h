// The controller manager for robots written in C++.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <controller_interface/controller_base.h>
#include <controller_manager/controller_loader.h>
#include <controller_manager/controller_loader_interface.h>
#include <controller_manager/controller_spec.h>
#include <hardware_interface/robot_hw.h>
#include <ros/ros.h>

// Programs name the services' types, and have them from here.
#include <controller_manager_msgs/ListControllerTypes.h>
#include <controller_manager_msgs/ListControllers.h>
#include <controller_manager_msgs/LoadController.h>
#include <controller_manager_msgs/ReloadControllerLibraries.h>
#include <controller_manager_msgs/SwitchController.h>
#include <controller_manager_msgs/UnloadController.h>

namespace controller_manager
{

/// Loads, starts, switches, stops and unloads controllers, of C++ and of Python, on a robot.
///
///     controller_manager::ControllerManager manager(&robot, nh);
///     while (ros::ok()) { robot.read(...); manager.update(now, period); robot.write(...); rate.sleep(); }
///
/// It is the workspace's one manager, which is written in Python (docs/decisions): the first one in a process starts an interpreter and
/// a node of rospy beside this one, ``<node>_controller_manager``, which answers its services.
class ControllerManager
{
public:
  // How switchController() waits when nothing else is said.
  static constexpr bool WAIT_FOR_ALL_RESOURCES = false;
  static constexpr double INFINITE_TIMEOUT = 0.0;

  /// \param robot_hw lives as long as the manager
  /// \param nh services are in <nh>/controller_manager, a controller's parameters and topics in <nh>/<controller>
  ControllerManager(hardware_interface::RobotHW* robot_hw, const ros::NodeHandle& nh = ros::NodeHandle());
  virtual ~ControllerManager();
  ControllerManager(const ControllerManager&) = delete;
  ControllerManager& operator=(const ControllerManager&) = delete;

  /// One cycle: update the running controllers in load order, then go on with a switch.
  /// \param period since the last cycle \param reset_controllers stop and start every running controller first
  void update(const ros::Time& time, const ros::Duration& period, bool reset_controllers = false);

  // As the services. A switch is done by update(), for which another thread has to call.

  bool loadController(const std::string& name);
  bool unloadController(const std::string& name);
  bool switchController(const std::vector<std::string>& start_controllers, const std::vector<std::string>& stop_controllers,
                        const int strictness, bool start_asap = WAIT_FOR_ALL_RESOURCES, double timeout = INFINITE_TIMEOUT);

  /// A loaded controller of C++; null for one of Python, or if there is none of that name.
  virtual controller_interface::ControllerBase* getControllerByName(const std::string& name);

  /// Take types from this loader too, for those that no package exports.
  void registerControllerLoader(ControllerLoaderInterfaceSharedPtr controller_loader);

private:
  struct Python;
  std::unique_ptr<Python> python_;
};

}  // namespace controller_manager

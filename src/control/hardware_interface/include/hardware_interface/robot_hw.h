// RobotHW: what a robot offers to the controller manager.
#pragma once

#include <list>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <hardware_interface/controller_info.h>
#include <hardware_interface/hardware_interface.h>
#include <hardware_interface/internal/interface_manager.h>
#include <ros/console.h>
#include <ros/duration.h>
#include <ros/node_handle.h>
#include <ros/time.h>

namespace hardware_interface
{

/// Base of every robot: register interfaces, and override what the hardware needs. Never copy one: interfaces are kept by pointer.
///
/// read, write, doSwitch and switchResult are called by the control loop and must not block; init, checkForConflict and
/// prepareSwitch are called by a service's thread.
class RobotHW : public InterfaceManager
{
public:
  RobotHW() = default;
  ~RobotHW() override = default;

  /// Set up from parameters, for robots that are loaded as plugins. \return false to refuse.
  virtual bool init(ros::NodeHandle& /*root_nh*/, ros::NodeHandle& /*robot_hw_nh*/) { return true; }

  /// True if these controllers cannot run together: by default, if a resource is claimed twice, whatever the interface.
  virtual bool checkForConflict(const std::list<ControllerInfo>& controllers) const
  {
    std::map<std::string, std::vector<std::string>> owners;
    for (const ControllerInfo& controller : controllers)
      for (const InterfaceResources& claimed : controller.claimed_resources)
        for (const std::string& resource : claimed.resources)
          owners[resource].push_back(controller.name);
    bool conflict = false;
    for (const auto& entry : owners)
    {
      if (entry.second.size() < 2)
        continue;
      std::string names;
      for (const std::string& name : entry.second)
        names += (names.empty() ? "" : ", ") + name;
      ROS_WARN_STREAM("Resource conflict on [" << entry.first << "].  Controllers = [" << names << "]");
      conflict = true;
    }
    return conflict;
  }

  /// May refuse a switch (false) before anything has changed.
  virtual bool prepareSwitch(const std::list<ControllerInfo>& /*start_list*/, const std::list<ControllerInfo>& /*stop_list*/)
  {
    return true;
  }

  /// Begin the switch of the hardware.
  virtual void doSwitch(const std::list<ControllerInfo>& /*start_list*/, const std::list<ControllerInfo>& /*stop_list*/) {}

  enum class SwitchState
  {
    DONE,
    ONGOING,
    ERROR
  };

  /// How far the switch is, for all controllers, or for one that is to be started as soon as it can.
  virtual SwitchState switchResult() const { return SwitchState::DONE; }
  virtual SwitchState switchResult(const ControllerInfo& /*controller*/) const { return SwitchState::DONE; }

  /// Bring measured states to where the handles point.
  virtual void read(const ros::Time& /*time*/, const ros::Duration& /*period*/) {}
  /// Send out the commands that the handles point to.
  virtual void write(const ros::Time& /*time*/, const ros::Duration& /*period*/) {}
};

typedef std::shared_ptr<RobotHW> RobotHWSharedPtr;

}  // namespace hardware_interface

// A controller on one hardware interface.
#pragma once

#include <string>

#include <controller_interface/controller_base.h>
#include <hardware_interface/hardware_interface.h>
#include <hardware_interface/internal/demangle_symbol.h>
#include <hardware_interface/robot_hw.h>
#include <ros/ros.h>

namespace controller_interface
{

/// T is the hardware interface, for example hardware_interface::PositionJointInterface.
template <class T>
class Controller : public virtual ControllerBase
{
public:
  // Override one: read parameters, take handles out of hw, make topics; return false to refuse. Both are called.

  virtual bool init(T* /*hw*/, ros::NodeHandle& /*controller_nh*/) { return true; }
  virtual bool init(T* /*hw*/, ros::NodeHandle& /*root_nh*/, ros::NodeHandle& /*controller_nh*/) { return true; }

protected:
  bool initRequest(hardware_interface::RobotHW* robot_hw, ros::NodeHandle& root_nh, ros::NodeHandle& controller_nh,
                   ClaimedResources& claimed_resources) override
  {
    if (state_ != ControllerState::CONSTRUCTED)
    {
      ROS_ERROR("Cannot initialize this controller because it failed to be constructed");
      return false;
    }
    T* hw = robot_hw->get<T>();
    if (!hw)
    {
      std::string names;
      for (const std::string& name : robot_hw->getNames())
        names += (names.empty() ? "" : ", ") + name;
      ROS_ERROR(
          "This controller requires a hardware interface of type '%s'. Make sure this is registered in the "
          "hardware_interface::RobotHW class. The robot has: %s",
          getHardwareInterfaceType().c_str(), names.empty() ? "none" : names.c_str());
      return false;
    }
    hw->clearClaims();
    if (!init(hw, controller_nh) || !init(hw, root_nh, controller_nh))
    {
      ROS_ERROR("Failed to initialize the controller");
      return false;
    }
    claimed_resources.assign(1, hardware_interface::InterfaceResources(getHardwareInterfaceType(), hw->getClaims()));
    hw->clearClaims();
    state_ = ControllerState::INITIALIZED;
    return true;
  }

  std::string getHardwareInterfaceType() const { return hardware_interface::internal::demangledTypeName<T>(); }
};

}  // namespace controller_interface

// A controller as the hardware sees it.
#pragma once

#include <string>
#include <vector>

#include <hardware_interface/interface_resources.h>

namespace hardware_interface
{

/// Given to RobotHW when controllers are switched.
struct ControllerInfo
{
  ControllerInfo() = default;
  ControllerInfo(const std::string& controller, const std::string& controller_type,
                 const std::vector<InterfaceResources>& claimed)
    : name(controller)
    , type(controller_type)
    , claimed_resources(claimed)
  {
  }

  std::string name;  ///< below the controller manager's namespace
  std::string type;  ///< look-up name, package/Class
  std::vector<InterfaceResources> claimed_resources;
};

}  // namespace hardware_interface

// Resources of one hardware interface.
#pragma once

#include <set>
#include <string>

namespace hardware_interface
{

/// What a controller claims through one interface, named by its C++ type.
struct InterfaceResources
{
  InterfaceResources() = default;
  InterfaceResources(const std::string& type, const std::set<std::string>& names) : hardware_interface(type), resources(names)
  {
  }

  std::string hardware_interface;
  std::set<std::string> resources;
};

}  // namespace hardware_interface

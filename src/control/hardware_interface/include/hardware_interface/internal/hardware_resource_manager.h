// Hardware interfaces: collections of handles that know whether taking one out claims it.
#pragma once

#include <stdexcept>
#include <string>

#include <hardware_interface/hardware_interface.h>
#include <hardware_interface/internal/resource_manager.h>

namespace hardware_interface
{

/// Taking a handle out claims its resource: for interfaces that command.
struct ClaimResources
{
  static void claim(HardwareInterface* interface, const std::string& resource) { interface->claim(resource); }
};

/// Taking a handle out claims nothing: for interfaces that only read.
struct DontClaimResources
{
  static void claim(HardwareInterface* /*interface*/, const std::string& /*resource*/) {}
};

template <class ResourceHandle, class ClaimPolicy = DontClaimResources>
class HardwareResourceManager : public HardwareInterface, public ResourceManager<ResourceHandle>
{
public:
  /// Tells a template, and a class derived from an interface, what the interface holds.
  typedef ResourceHandle ResourceHandleType;

  /// A copy of the handle, claimed as the policy says. \throws HardwareInterfaceException there is none of that name.
  ResourceHandle getHandle(const std::string& name)
  {
    try
    {
      const ResourceHandle handle = this->ResourceManager<ResourceHandle>::getHandle(name);
      ClaimPolicy::claim(this, name);
      return handle;
    }
    catch (const std::logic_error& error)
    {
      throw HardwareInterfaceException(error.what());
    }
  }
};

}  // namespace hardware_interface

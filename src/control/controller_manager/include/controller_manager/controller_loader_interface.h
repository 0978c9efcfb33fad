// Where a controller manager gets controllers from.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <controller_interface/controller_base.h>

namespace controller_manager
{

/// A source of controllers, by the names of their types.
class ControllerLoaderInterface
{
public:
  ControllerLoaderInterface(const std::string& name) : name_(name) {}
  virtual ~ControllerLoaderInterface() = default;

  /// \return null: there is no such type
  virtual controller_interface::ControllerBaseSharedPtr createInstance(const std::string& lookup_name) = 0;
  virtual std::vector<std::string> getDeclaredClasses() = 0;
  /// Look for types again.
  virtual void reload() = 0;
  const std::string& getName() { return name_; }

private:
  const std::string name_;
};

typedef std::shared_ptr<ControllerLoaderInterface> ControllerLoaderInterfaceSharedPtr;

}  // namespace controller_manager

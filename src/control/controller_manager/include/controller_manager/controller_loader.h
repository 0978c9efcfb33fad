// Controllers that packages export for pluginlib.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <controller_manager/controller_loader_interface.h>
#include <pluginlib/class_loader.hpp>

namespace controller_manager
{

/// Classes that are exported for a package under a base class, for example "controller_interface" and
/// "controller_interface::ControllerBase".
template <class T>
class ControllerLoader : public ControllerLoaderInterface
{
public:
  ControllerLoader(const std::string& package, const std::string& base_class)
    : ControllerLoaderInterface(base_class)
    , package_(package)
    , base_class_(base_class)
  {
    reload();
  }

  controller_interface::ControllerBaseSharedPtr createInstance(const std::string& lookup_name) override
  {
    return std::shared_ptr<T>(loader_->createUnmanagedInstance(lookup_name));
  }

  std::vector<std::string> getDeclaredClasses() override { return loader_->getDeclaredClasses(); }

  void reload() override { loader_.reset(new pluginlib::ClassLoader<T>(package_, base_class_)); }

private:
  std::string package_, base_class_;
  std::shared_ptr<pluginlib::ClassLoader<T>> loader_;
};

}  // namespace controller_manager

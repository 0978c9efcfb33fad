// A collection of handles by name.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <hardware_interface/internal/demangle_symbol.h>
#include <ros/console.h>

namespace hardware_interface
{

/// What several collections of different handles can be kept as.
class ResourceManagerBase
{
public:
  virtual ~ResourceManagerBase() = default;
};

/// Handles by name. ResourceHandle is copyable and has getName().
template <class ResourceHandle>
class ResourceManager : public ResourceManagerBase
{
public:
  /// Tells a template that a type is a collection of handles.
  typedef ResourceManager<ResourceHandle> ResourceManagerType;

  ~ResourceManager() override = default;

  /// Names of all handles, sorted.
  std::vector<std::string> getNames() const
  {
    std::vector<std::string> names;
    names.reserve(resource_map_.size());
    for (const auto& entry : resource_map_)
      names.push_back(entry.first);
    return names;
  }

  /// Add a handle; one of the same name is replaced, with a warning.
  void registerHandle(const ResourceHandle& handle)
  {
    const std::string name = handle.getName();
    const auto there = resource_map_.find(name);
    if (there == resource_map_.end())
    {
      resource_map_.insert(std::make_pair(name, handle));
      return;
    }
    ROS_WARN_STREAM("Replacing previously registered handle '" << name << "' in '" << internal::demangledTypeName(*this)
                                                               << "'.");
    there->second = handle;
  }

  /// A copy of the handle. \throws std::logic_error there is none of that name.
  ResourceHandle getHandle(const std::string& name)
  {
    const auto there = resource_map_.find(name);
    if (there != resource_map_.end())
      return there->second;
    std::string names;
    for (const auto& entry : resource_map_)
      names += (names.empty() ? "" : ", ") + entry.first;
    throw std::logic_error("Could not find resource '" + name + "' in '" + internal::demangledTypeName(*this) +
                           "'; it has: " + (names.empty() ? "none" : names));
  }

  /// Put the handles of \p managers into \p result.
  static void concatManagers(std::vector<ResourceManagerType*>& managers, ResourceManagerType* result)
  {
    for (ResourceManagerType* manager : managers)
      for (const auto& entry : manager->resource_map_)
        result->registerHandle(entry.second);
  }

protected:
  typedef std::map<std::string, ResourceHandle> ResourceMap;
  ResourceMap resource_map_;
};

}  // namespace hardware_interface

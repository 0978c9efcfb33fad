// A collection of hardware interfaces by type, from one robot or from several.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <hardware_interface/internal/demangle_symbol.h>
#include <hardware_interface/internal/resource_manager.h>
#include <ros/console.h>

namespace hardware_interface
{
namespace internal
{

/// Chooses by overload between collections of handles, which can be merged, and other types, which cannot.
template <class T>
struct InterfaceTraits
{
  template <class C>
  static std::vector<std::string> names(C* interface, typename C::ResourceManagerType*)
  {
    return interface->getNames();
  }
  template <class C>
  static std::vector<std::string> names(C*, ...)
  {
    return std::vector<std::string>();
  }

  template <class C>
  static std::shared_ptr<C> merged(const std::vector<C*>& parts, typename C::ResourceManagerType*)
  {
    std::shared_ptr<C> result = std::make_shared<C>();
    std::vector<typename C::ResourceManagerType*> managers(parts.begin(), parts.end());
    C::concatManagers(managers, result.get());
    return result;
  }
  template <class C>
  static std::shared_ptr<C> merged(const std::vector<C*>&, ...)
  {
    ROS_ERROR_STREAM(
        "You cannot register multiple interfaces of the same type which are not of type ResourceManager. There is no "
        "established protocol for combining them. ("
        << demangledTypeName<C>() << ")");
    return std::shared_ptr<C>();
  }
};

}  // namespace internal

/// Interfaces by their C++ type. It keeps pointers: the interfaces live as long as it does.
class InterfaceManager
{
public:
  virtual ~InterfaceManager() = default;

  /// Offer an interface; one of the same type is replaced, with a warning.
  template <class T>
  void registerInterface(T* interface)
  {
    const std::string type = internal::demangledTypeName<T>();
    if (interfaces_.count(type))
      ROS_WARN_STREAM("Replacing previously registered interface '" << type << "'.");
    interfaces_[type] = interface;
    resources_[type] = internal::InterfaceTraits<T>::names(interface, nullptr);
  }

  /// Offer the interfaces of another manager too; those of one type are merged when asked for.
  void registerInterfaceManager(InterfaceManager* manager) { interface_managers_.push_back(manager); }

  /// The interface of that type, or null. The same object every time, as long as nothing is registered in between.
  template <class T>
  T* get()
  {
    const std::string type = internal::demangledTypeName<T>();
    std::vector<T*> parts;
    const auto own = interfaces_.find(type);
    if (own != interfaces_.end())
      parts.push_back(static_cast<T*>(own->second));
    for (InterfaceManager* manager : interface_managers_)
      if (T* part = manager->get<T>())
        parts.push_back(part);
    if (parts.size() < 2)
      return parts.empty() ? nullptr : parts.front();
    Combined& combined = interfaces_combo_[type];
    const std::vector<void*> of(parts.begin(), parts.end());
    if (!combined.interface || combined.parts != of)
    {
      const std::shared_ptr<T> interface = internal::InterfaceTraits<T>::merged(parts, nullptr);
      if (combined.interface)
        outdated_.push_back(combined.interface);  // somebody may hold it still
      combined.interface = interface;
      combined.address = interface.get();
      combined.parts = of;
    }
    return static_cast<T*>(combined.address);
  }

  /// Type names of all interfaces, each once.
  std::vector<std::string> getNames() const
  {
    std::vector<std::string> names;
    for (const auto& entry : interfaces_)
      names.push_back(entry.first);
    for (const InterfaceManager* manager : interface_managers_)
      for (const std::string& name : manager->getNames())
        if (std::find(names.begin(), names.end(), name) == names.end())
          names.push_back(name);
    return names;
  }

  /// Names of the handles that the interface of that type name had when it was registered.
  std::vector<std::string> getInterfaceResources(std::string type) const
  {
    std::vector<std::string> names;
    const auto own = resources_.find(type);
    if (own != resources_.end())
      names = own->second;
    for (const InterfaceManager* manager : interface_managers_)
    {
      const std::vector<std::string> more = manager->getInterfaceResources(type);
      names.insert(names.end(), more.begin(), more.end());
    }
    return names;
  }

protected:
  typedef std::map<std::string, void*> InterfaceMap;
  typedef std::vector<InterfaceManager*> InterfaceManagerVector;
  typedef std::map<std::string, std::vector<std::string>> ResourceMap;

  struct Combined
  {
    std::shared_ptr<void> interface;
    void* address = nullptr;
    std::vector<void*> parts;
  };

  InterfaceMap interfaces_;
  InterfaceManagerVector interface_managers_;
  std::map<std::string, Combined> interfaces_combo_;
  std::vector<std::shared_ptr<void>> outdated_;
  ResourceMap resources_;
};

}  // namespace hardware_interface

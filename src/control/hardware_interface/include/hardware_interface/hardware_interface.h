// What all hardware interfaces have: a set of claimed resources; and the exception that handles and interfaces throw.
#pragma once

#include <exception>
#include <set>
#include <string>

namespace hardware_interface
{

/// Base of hardware interfaces. A controller's claims are what it took out of the interface since clearClaims().
class HardwareInterface
{
public:
  virtual ~HardwareInterface() = default;

  /// Note that whoever is being initialised commands this resource.
  virtual void claim(std::string resource) { claims_.insert(resource); }
  void clearClaims() { claims_.clear(); }
  std::set<std::string> getClaims() const { return claims_; }

private:
  std::set<std::string> claims_;
};

/// A resource that is not there, or a handle that points to nothing.
class HardwareInterfaceException : public std::exception
{
public:
  HardwareInterfaceException(const std::string& message) : message_(message) {}
  const char* what() const noexcept override { return message_.c_str(); }

private:
  std::string message_;
};

namespace internal
{

/// \return \p data \throws HardwareInterfaceException it is null: a handle was made of nothing.
template <class T>
inline T* required(T* data, const std::string& handle, const char* what)
{
  if (!data)
    throw HardwareInterfaceException("Cannot create handle '" + handle + "'. " + what + " data pointer is null.");
  return data;
}

/// \return \p data \throws HardwareInterfaceException it is null: an empty handle was used.
template <class T>
inline T* filled(T* data, const std::string& handle)
{
  if (!data)
    throw HardwareInterfaceException("The handle '" + handle +
                                     "' is empty: take one out of a hardware interface by getHandle()");
  return data;
}

}  // namespace internal
}  // namespace hardware_interface

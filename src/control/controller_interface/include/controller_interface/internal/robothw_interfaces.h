// The interfaces of a robot that a list of types names, dealt with one by one.
#pragma once

#include <string>

#include <controller_interface/controller_base.h>
#include <hardware_interface/internal/demangle_symbol.h>
#include <hardware_interface/robot_hw.h>

namespace controller_interface
{
namespace internal
{

/// \p val with \p delimiter between its elements, each in \p prefix and \p suffix.
template <class T>
inline std::string enumerateElements(const T& val, const std::string& delimiter, const std::string& prefix,
                                     const std::string& suffix)
{
  std::string result;
  for (const auto& element : val)
    result += (result.empty() ? "" : delimiter) + prefix + element + suffix;
  return result;
}

template <typename T>
inline bool hasInterface(hardware_interface::RobotHW* robot_hw)
{
  if (robot_hw->get<T>())
    return true;
  ROS_ERROR_STREAM("This controller requires a hardware interface of type '"
                   << hardware_interface::internal::demangledTypeName<T>()
                   << "', but is not exposed by the robot. Available interfaces in robot:\n"
                   << enumerateElements(robot_hw->getNames(), "\n", "- '", "'"));
  return false;
}

template <typename T>
inline void clearClaimsOf(hardware_interface::RobotHW* robot_hw)
{
  if (T* interface = robot_hw->get<T>())
    interface->clearClaims();
}

template <typename T>
inline void extractInterface(hardware_interface::RobotHW* from, hardware_interface::RobotHW* to)
{
  if (T* interface = from->get<T>())
    to->registerInterface(interface);
}

template <typename T>
inline void populateClaims(hardware_interface::RobotHW* robot_hw, ControllerBase::ClaimedResources& claimed)
{
  if (T* interface = robot_hw->get<T>())
    claimed.push_back(
        hardware_interface::InterfaceResources(hardware_interface::internal::demangledTypeName<T>(), interface->getClaims()));
}

// For each type of the list, in its order; an array's elements are evaluated so.

template <typename... T>
inline bool hasInterfaces(hardware_interface::RobotHW* robot_hw)
{
  bool all = true;
  const bool each[] = { true, (all = all && hasInterface<T>(robot_hw))... };
  (void)each;
  return all;
}

template <typename... T>
inline void clearClaims(hardware_interface::RobotHW* robot_hw)
{
  const int each[] = { 0, (clearClaimsOf<T>(robot_hw), 0)... };
  (void)each;
}

template <typename... T>
inline void extractInterfaceResources(hardware_interface::RobotHW* robot_hw_in, hardware_interface::RobotHW* robot_hw_out)
{
  const int each[] = { 0, (extractInterface<T>(robot_hw_in, robot_hw_out), 0)... };
  (void)each;
}

template <typename... T>
inline void populateClaimedResources(hardware_interface::RobotHW* robot_hw, ControllerBase::ClaimedResources& claimed_resources)
{
  const int each[] = { 0, (populateClaims<T>(robot_hw, claimed_resources), 0)... };
  (void)each;
}

}  // namespace internal
}  // namespace controller_interface

// What a limit handle throws.
#pragma once

#include <exception>
#include <string>

namespace joint_limits_interface
{

/// A handle needs limits that the joint does not have.
class JointLimitsInterfaceException : public std::exception
{
public:
  JointLimitsInterfaceException(const std::string& message) : message_(message) {}
  const char* what() const noexcept override { return message_.c_str(); }

private:
  std::string message_;
};

}  // namespace joint_limits_interface

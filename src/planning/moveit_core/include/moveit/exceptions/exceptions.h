// What these classes throw.
#pragma once

#include <stdexcept>
#include <string>

namespace moveit
{
// Something cannot be made.
class ConstructException : public std::runtime_error
{
public:
  explicit ConstructException(const std::string& what_arg);
};

class Exception : public std::runtime_error
{
public:
  explicit Exception(const std::string& what_arg);
};
}  // namespace moveit

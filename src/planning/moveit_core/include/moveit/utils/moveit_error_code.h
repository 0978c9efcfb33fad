// An error code that can be asked whether it is none.
#pragma once

#include <moveit_msgs/MoveItErrorCodes.h>

#include <iosfwd>
#include <string>

namespace moveit
{
namespace core
{
class MoveItErrorCode : public moveit_msgs::MoveItErrorCodes
{
public:
  // The name of the constant, "PLANNING_FAILED".
  static const char* toString(const moveit_msgs::MoveItErrorCodes& error_code);

  MoveItErrorCode(int code = 0) { val = code; }
  MoveItErrorCode(const moveit_msgs::MoveItErrorCodes& code) { val = code.val; }

  explicit operator bool() const { return val == moveit_msgs::MoveItErrorCodes::SUCCESS; }
  explicit operator std::string() const { return toString(*this); }
  bool operator==(const int c) const { return val == c; }
  bool operator!=(const int c) const { return val != c; }
};

std::ostream& operator<<(std::ostream& out, const MoveItErrorCode& e);
}  // namespace core
}  // namespace moveit

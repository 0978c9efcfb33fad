// Numbers as text and back, the same in every locale.
#pragma once

#include <string>

namespace moveit
{
namespace core
{
std::string toString(double d);
std::string toString(float f);

// Throw std::runtime_error when the text is no number.
double toDouble(const std::string& s);
float toFloat(const std::string& s);
}  // namespace core
}  // namespace moveit

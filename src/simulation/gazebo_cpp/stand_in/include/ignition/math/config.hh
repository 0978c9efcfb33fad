#pragma once

#define IGNITION_MATH_MAJOR_VERSION 6
#define IGNITION_MATH_MINOR_VERSION 10
#define IGNITION_MATH_PATCH_VERSION 0
#define IGNITION_MATH_VERSION "6.10"
#define IGNITION_MATH_VERSION_FULL "6.10.0"
#define IGNITION_MATH_VERSION_NAMESPACE v6
#define IGNITION_MATH_VISIBLE __attribute__((visibility("default")))
#ifndef IGN_DEPRECATED
#define IGN_DEPRECATED(version) __attribute__((deprecated))
#endif

namespace ignition
{
namespace math
{
inline namespace v6
{
}
}  // namespace math
}  // namespace ignition

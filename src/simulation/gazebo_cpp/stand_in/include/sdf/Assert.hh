#pragma once
#include <sdf/Exception.hh>

#define SDF_ASSERT(expression, message) \
  ((!!(expression)) ? ((void)0) : sdf::assertFailed(#expression, __FUNCTION__, __FILE__, __LINE__, message))

namespace sdf
{
[[noreturn]] inline void assertFailed(const std::string& expression, const std::string& function, const char* file,
                                      std::int64_t line, const std::string& message)
{
  throw AssertionInternalError(file, line, expression, function, message);
}
}  // namespace sdf

#pragma once
#include <cmath>
#include <cstdint>
#include <istream>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <sdf/sdf_config.h>
#include <sdf/system_util.hh>

#define SDF_DEPRECATED(version) __attribute__((deprecated))
#define SDF_FORCEINLINE __attribute__((always_inline))
#define SDF_SUPPRESS_DEPRECATED_BEGIN \
  _Pragma("GCC diagnostic push") _Pragma("GCC diagnostic ignored \"-Wdeprecated-declarations\"")
#define SDF_SUPPRESS_DEPRECATED_END _Pragma("GCC diagnostic pop")

namespace sdf
{
inline namespace v12
{

class Error;
typedef std::vector<Error> Errors;

const std::string kSdfScopeDelimiter = "::";

std::vector<std::string> SDFORMAT_VISIBLE split(const std::string& text, const std::string& splitter);
std::string SDFORMAT_VISIBLE trim(const char* text);
std::string SDFORMAT_VISIBLE trim(const std::string& text);
std::string SDFORMAT_VISIBLE lowercase(const std::string& text);
/// All scopes, and the name in them.
std::pair<std::string, std::string> SDFORMAT_VISIBLE SplitName(const std::string& absolute);
std::string SDFORMAT_VISIBLE JoinName(const std::string& scope, const std::string& local);

template <typename T>
inline bool equal(const T& a, const T& b, const T& epsilon = T(1e-6f))
{
  return std::fabs(a - b) <= epsilon;
}

class SDFORMAT_VISIBLE Time
{
public:
  Time() = default;
  Time(std::int32_t seconds, std::int32_t nanoseconds) : sec(seconds), nsec(nanoseconds) {}
  bool operator==(const Time& time) const { return sec == time.sec && nsec == time.nsec; }
  friend std::ostream& operator<<(std::ostream& out, const Time& time) { return out << time.sec << " " << time.nsec; }
  friend std::istream& operator>>(std::istream& in, Time& time)
  {
    in.setf(std::ios_base::skipws);
    return in >> time.sec >> time.nsec;
  }

  std::int32_t sec = 0, nsec = 0;
};

}  // namespace v12
}  // namespace sdf

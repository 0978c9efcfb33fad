#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <ignition/math/config.hh>

#define IGN_PI 3.14159265358979323846
#define IGN_PI_2 1.57079632679489661923
#define IGN_PI_4 0.78539816339744830962
#define IGN_SQRT2 1.41421356237309504880
#define IGN_RTOD(radian) ((radian)*180.0 / IGN_PI)
#define IGN_DTOR(degree) ((degree)*IGN_PI / 180.0)
#define IGN_NORMALIZE(angle) (std::atan2(std::sin(angle), std::cos(angle)))
#define IGN_FP_VOLATILE
#define IGN_SPHERE_VOLUME(radius) (4.0 * IGN_PI * std::pow(radius, 3) / 3.0)
#define IGN_CYLINDER_VOLUME(radius, length) ((length)*IGN_PI * std::pow(radius, 2))
#define IGN_BOX_VOLUME(x, y, z) ((x) * (y) * (z))
#define IGN_BOX_VOLUME_V(size) ((size).X() * (size).Y() * (size).Z())
#define IGN_DBL_MAX ignition::math::MAX_D
#define IGN_DBL_MIN ignition::math::MIN_D
#define IGN_DBL_LOW ignition::math::LOW_D
#define IGN_DBL_INF ignition::math::INF_D
#define IGN_FLT_MAX ignition::math::MAX_F
#define IGN_FLT_MIN ignition::math::MIN_F
#define IGN_FLT_LOW ignition::math::LOW_F
#define IGN_FLT_INF ignition::math::INF_F
#define IGN_UINT16_MAX ignition::math::MAX_UI16
#define IGN_INT16_MAX ignition::math::MAX_I16
#define IGN_UINT32_MAX ignition::math::MAX_UI32
#define IGN_INT32_MAX ignition::math::MAX_I32
#define IGN_UINT64_MAX ignition::math::MAX_UI64
#define IGN_INT64_MAX ignition::math::MAX_I64

namespace ignition
{
namespace math
{
inline namespace v6
{

static const std::size_t IGN_ZERO_SIZE_T = 0u, IGN_ONE_SIZE_T = 1u, IGN_TWO_SIZE_T = 2u, IGN_THREE_SIZE_T = 3u;
static const std::size_t IGN_FOUR_SIZE_T = 4u, IGN_FIVE_SIZE_T = 5u, IGN_SIX_SIZE_T = 6u, IGN_SEVEN_SIZE_T = 7u;
static const std::size_t IGN_EIGHT_SIZE_T = 8u, IGN_NINE_SIZE_T = 9u;

static const double MAX_D = std::numeric_limits<double>::max(), MIN_D = std::numeric_limits<double>::min();
static const double LOW_D = std::numeric_limits<double>::lowest(), INF_D = std::numeric_limits<double>::infinity();
static const double NAN_D = std::numeric_limits<double>::quiet_NaN();
static const float MAX_F = std::numeric_limits<float>::max(), MIN_F = std::numeric_limits<float>::min();
static const float LOW_F = std::numeric_limits<float>::lowest(), INF_F = std::numeric_limits<float>::infinity();
static const float NAN_F = std::numeric_limits<float>::quiet_NaN();
static const std::uint16_t MAX_UI16 = UINT16_MAX, MIN_UI16 = 0, LOW_UI16 = 0, INF_UI16 = 0;
static const std::int16_t MAX_I16 = INT16_MAX, MIN_I16 = INT16_MIN, LOW_I16 = INT16_MIN, INF_I16 = 0;
static const std::uint32_t MAX_UI32 = UINT32_MAX, MIN_UI32 = 0, LOW_UI32 = 0, INF_UI32 = 0;
static const std::int32_t MAX_I32 = INT32_MAX, MIN_I32 = INT32_MIN, LOW_I32 = INT32_MIN, INF_I32 = 0;
static const std::uint64_t MAX_UI64 = UINT64_MAX, MIN_UI64 = 0, LOW_UI64 = 0, INF_UI64 = 0;
static const std::int64_t MAX_I64 = INT64_MAX, MIN_I64 = INT64_MIN, LOW_I64 = INT64_MIN, INF_I64 = 0;
static const int NAN_I = 0;  // what numeric_limits<int> has for it

template <typename T>
inline T clamp(T v, T min, T max)
{
  return std::max(std::min(v, max), min);
}

inline bool isnan(float v) { return std::isnan(v); }
inline bool isnan(double v) { return std::isnan(v); }
inline float fixnan(float v) { return std::isfinite(v) ? v : 0.0f; }
inline double fixnan(double v) { return std::isfinite(v) ? v : 0.0; }
inline bool isEven(int v) { return v % 2 == 0; }
inline bool isEven(unsigned int v) { return v % 2 == 0; }
inline bool isOdd(int v) { return v % 2 != 0; }
inline bool isOdd(unsigned int v) { return v % 2 != 0; }

template <typename T>
inline int sgn(T value)
{
  return (T(0) < value) - (value < T(0));
}

template <typename T>
inline int signum(T value)
{
  return sgn(value);
}

template <typename T>
inline T mean(const std::vector<T>& values)
{
  T sum = 0;
  for (const T& each : values)
    sum += each;
  return sum / values.size();
}

template <typename T>
inline T variance(const std::vector<T>& values)
{
  const T middle = mean<T>(values);
  T sum = 0;
  for (const T& each : values)
    sum += (each - middle) * (each - middle);
  return sum / values.size();
}

template <typename T>
inline T max(const std::vector<T>& values)
{
  T found = std::numeric_limits<T>::min();
  for (const T& each : values)
    found = std::max(found, each);
  return found;
}

template <typename T>
inline T min(const std::vector<T>& values)
{
  T found = std::numeric_limits<T>::max();
  for (const T& each : values)
    found = std::min(found, each);
  return found;
}

template <typename T>
inline bool equal(const T& a, const T& b, const T& epsilon = T(1e-6))
{
  const T larger = std::max(a, b), smaller = std::min(a, b);
  return std::isnan(static_cast<double>(a)) || std::isnan(static_cast<double>(b)) ? false
                                                                                  : a == b || larger - smaller <= epsilon;
}

template <typename T>
inline bool lessOrNearEqual(const T& a, const T& b, const T& epsilon = 1e-6)
{
  return a < b + epsilon;
}

template <typename T>
inline bool greaterOrNearEqual(const T& a, const T& b, const T& epsilon = 1e-6)
{
  return a > b - epsilon;
}

template <typename T>
inline T precision(const T& a, const unsigned int& digits)
{
  const auto power = std::pow(10, digits);
  return static_cast<T>(std::round(a * power) / power);
}

template <typename T>
inline void sort2(T& a, T& b)
{
  if (b < a)
    std::swap(a, b);
}

template <typename T>
inline void sort3(T& a, T& b, T& c)
{
  sort2(a, b);
  sort2(b, c);
  sort2(a, b);
}

inline bool isPowerOfTwo(unsigned int x) { return x != 0 && (x & (x - 1)) == 0; }

inline unsigned int roundUpPowerOfTwo(unsigned int x)
{
  unsigned int power = 1;
  while (power < x && power != 0)
    power <<= 1;
  return power;
}

inline int roundUpMultiple(int number, int multiple)
{
  if (multiple == 0)
    return number;
  const int rest = std::abs(number) % multiple;
  if (rest == 0)
    return number;
  return number < 0 ? -(std::abs(number) - rest) : number + multiple - rest;
}

/// NAN_I where the text is no whole number.
int IGNITION_MATH_VISIBLE parseInt(const std::string& input);
/// NAN_D where the text is no number.
double IGNITION_MATH_VISIBLE parseFloat(const std::string& input);

}  // namespace v6
}  // namespace math
}  // namespace ignition

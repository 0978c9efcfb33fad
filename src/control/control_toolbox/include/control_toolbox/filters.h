// Filters of one line.
#pragma once

#include <algorithm>

namespace filters
{

/// \p a between \p b and \p c.
template <typename T>
static inline T clamp(const T& a, const T& b, const T& c)
{
  return std::min<T>(std::max<T>(b, a), c);
}

/// alpha 1 is no smoothing.
static inline double exponentialSmoothing(double current_raw_value, double last_smoothed_value, double alpha)
{
  return alpha * current_raw_value + (1 - alpha) * last_smoothed_value;
}

}  // namespace filters

// What numbers the core takes. Each check throws std::invalid_argument (ValueError in Python) with one line.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "math.hpp"

namespace ode_sim {

constexpr double kFarthest = 1e7;      // m from the origin, and the largest size; 2 nanometres is the last digit there
constexpr double kFarthestPart = 2e7;  // m: parts of what is placed at kFarthest, and what has moved, may be beyond it
constexpr double kOutOfReach = 1e8;    // m: shapes beyond do not collide; boxes of a micrometre have no size there any more
constexpr double kFastestSet = 1e10;   // m/s, rad/s that may be asked for
constexpr double kStrongest = 1e12;    // N, N m: forces beyond are cut to it, so that sums and products stay finite
constexpr double kStiffest = 1e18;     // N/m, N s/m
constexpr double kRoughest = 1e15;     // friction coefficients

inline std::string shown(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", v);
  return text;
}

inline double checked(double v, const char* what) {
  if (!std::isfinite(v)) throw std::invalid_argument(std::string(what) + " must be a finite number, not " + shown(v));
  return v;
}
inline Vec3 checked(const Vec3& v, const char* what) {
  checked(v.x, what), checked(v.y, what), checked(v.z, what);
  return v;
}
inline bool within(const Vec3& p, double most) {
  return std::abs(p.x) <= most && std::abs(p.y) <= most && std::abs(p.z) <= most;
}
inline const Vec3& checked_place(const Vec3& p, const char* what, double most = kFarthestPart) {
  if (within(p, most)) return p;
  const double far = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  throw std::invalid_argument(std::string(what) + (finite(p)
                                                       ? " lies " + shown(far) + " m away; stay within " + shown(most) + " m"
                                                       : " must be finite numbers"));
}
inline Pose checked(const Pose& X, const char* what, double most = kFarthestPart) {
  checked_place(X.p, what, most);
  if (!finite(X)) throw std::invalid_argument(std::string(what) + " must be finite numbers");
  return normalized(X);
}
inline double checked_size(double v, const char* what) {
  if (v > 0 && v <= kFarthest) return v;
  throw std::invalid_argument(std::string(what) + " must be positive and at most " + shown(kFarthest) + " m, not " + shown(v));
}
// Cut to +-most; only a NaN is refused.
inline double limited(double v, double most, const char* what) {
  if (std::isnan(v)) throw std::invalid_argument(std::string(what) + " must be a number, not NaN");
  return std::min(std::max(v, -most), most);
}
inline Vec3 limited(const Vec3& v, double most, const char* what) {
  return {limited(v.x, most, what), limited(v.y, most, what), limited(v.z, most, what)};
}

}  // namespace ode_sim

// Vectors, quaternions (x, y, z, w) and rigid transforms X_AB (pose of frame B in A) of the physics core.
#pragma once
#include <cmath>

namespace ode_sim {

constexpr double kPi = 3.14159265358979323846;

struct Vec3 {
  double x = 0, y = 0, z = 0;
};
inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(const Vec3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3& operator+=(Vec3& a, const Vec3& b) { return a = a + b; }
inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline bool finite(const Vec3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

struct Quat {
  double x = 0, y = 0, z = 0, w = 1;
};
inline Quat operator*(const Quat& a, const Quat& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
inline Quat conjugate(const Quat& q) { return {-q.x, -q.y, -q.z, q.w}; }
inline Vec3 rotate(const Quat& q, const Vec3& v) {
  const Vec3 u{q.x, q.y, q.z};
  const Vec3 t = cross(u, v) * 2.0;
  return v + t * q.w + cross(u, t);
}
inline Quat normalized(const Quat& q) {
  const double n = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (n > 0 && std::isfinite(n)) return {q.x / n, q.y / n, q.z / n, q.w / n};
  // The squares are too small or too large for a number: another scale, or no rotation at all.
  const double most = std::fmax(std::fmax(std::fabs(q.x), std::fabs(q.y)), std::fmax(std::fabs(q.z), std::fabs(q.w)));
  if (std::isnan(n) || !(most > 0) || !std::isfinite(most)) return {};
  return normalized(Quat{q.x / most, q.y / most, q.z / most, q.w / most});
}
// Rotation by `angle` (rad) about the unit vector `axis`.
inline Quat axis_angle(const Vec3& axis, double angle) {
  const double s = std::sin(angle / 2);
  return {axis.x * s, axis.y * s, axis.z * s, std::cos(angle / 2)};
}

struct Pose {
  Vec3 p;
  Quat q;
};
inline Pose operator*(const Pose& a, const Pose& b) { return {a.p + rotate(a.q, b.p), a.q * b.q}; }
inline Vec3 operator*(const Pose& a, const Vec3& v) { return a.p + rotate(a.q, v); }
inline Pose inverse(const Pose& a) {
  const Quat q = conjugate(a.q);
  return {rotate(q, -a.p), q};
}
inline Pose normalized(const Pose& a) { return {a.p, normalized(a.q)}; }
inline bool finite(const Pose& a) {
  return finite(a.p) && std::isfinite(a.q.x) && std::isfinite(a.q.y) && std::isfinite(a.q.z) && std::isfinite(a.q.w);
}

// Symmetric 3x3 matrix (inertia tensor, kg m^2).
struct Sym3 {
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
};
inline Sym3& operator+=(Sym3& a, const Sym3& b) {
  a.xx += b.xx;
  a.yy += b.yy;
  a.zz += b.zz;
  a.xy += b.xy;
  a.xz += b.xz;
  a.yz += b.yz;
  return a;
}
inline Vec3 operator*(const Sym3& m, const Vec3& v) {
  return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z, m.xz * v.x + m.yz * v.y + m.zz * v.z};
}
// R m R^T for the rotation R of `q`.
inline Sym3 rotate(const Quat& q, const Sym3& m) {
  const Vec3 ex = rotate(q, Vec3{1, 0, 0}), ey = rotate(q, Vec3{0, 1, 0}), ez = rotate(q, Vec3{0, 0, 1});
  // Rows of R expressed in the body axes.
  const Vec3 rx{ex.x, ey.x, ez.x}, ry{ex.y, ey.y, ez.y}, rz{ex.z, ey.z, ez.z};
  const Vec3 mx = m * rx, my = m * ry, mz = m * rz;
  return {dot(rx, mx), dot(ry, my), dot(rz, mz), dot(rx, my), dot(rx, mz), dot(ry, mz)};
}
// Inertia about the origin of a point mass at `r`.
inline Sym3 point_inertia(double mass, const Vec3& r) {
  return {mass * (r.y * r.y + r.z * r.z),
          mass * (r.x * r.x + r.z * r.z),
          mass * (r.x * r.x + r.y * r.y),
          -mass * r.x * r.y,
          -mass * r.x * r.z,
          -mass * r.y * r.z};
}
// Component of the inverse of `m` along `n`: n^T m^-1 n.
inline double inverse_along(const Sym3& m, const Vec3& n) {
  const double a = m.yy * m.zz - m.yz * m.yz, b = m.xz * m.yz - m.xy * m.zz, c = m.xy * m.yz - m.xz * m.yy;
  const double det = m.xx * a + m.xy * b + m.xz * c;
  const Sym3 inv{a, m.xx * m.zz - m.xz * m.xz, m.xx * m.yy - m.xy * m.xy, b, c, m.xy * m.xz - m.xx * m.yz};
  return dot(n, inv * n) / det;
}

}  // namespace ode_sim

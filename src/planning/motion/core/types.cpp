#include "motion/types.hpp"

namespace motion
{
std::string listed(const std::vector<std::string>& names)
{
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < 8; ++i)
    text += (i ? ", '" : "'") + names[i] + "'";
  if (names.size() > 8)
    text += " and " + std::to_string(names.size() - 8) + " more";
  return text.empty() ? "none" : text;
}

void throwUnknown(const std::string& kind, const std::string& name, const std::string& where,
                  const std::vector<std::string>& known)
{
  throw UnknownName("no " + kind + " '" + name.substr(0, 80) + "' in " + where + " (there is: " + listed(known) + ")");
}

Vector3 rotationVector(const Eigen::Matrix3d& R)
{
  const Vector3 skew(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  const double sine = 0.5 * skew.norm(), cosine = 0.5 * (R.trace() - 1.0);
  if (cosine > -0.99)
  {
    if (sine < 1e-9)
      return 0.5 * skew;
    return (std::atan2(sine, cosine) / (2.0 * sine)) * skew;
  }
  // Near half a turn the skew part vanishes: the quaternion still knows the axis.
  Quaternion q(R);
  if (q.w() < 0)
    q.coeffs() = -q.coeffs();
  const double length = q.vec().norm();
  return (2.0 * std::atan2(length, q.w()) / length) * q.vec();
}

Quaternion turnBetween(const Vector3& a, const Vector3& b)
{
  const Vector3 from = a.normalized(), to = b.normalized();
  const double cosine = from.dot(to);
  if (cosine < -1.0 + 1e-12)
  {
    const Vector3 across = from.unitOrthogonal();
    return {0.0, across.x(), across.y(), across.z()};
  }
  const double twice_w = std::sqrt(2.0 * (1.0 + cosine));
  const Vector3 axis = from.cross(to) * (1.0 / twice_w);
  return {0.5 * twice_w, axis.x(), axis.y(), axis.z()};
}

Eigen::Matrix<double, 6, 1> poseError(const Transform& from, const Transform& to)
{
  Eigen::Matrix<double, 6, 1> error;
  error.head<3>() = to.translation() - from.translation();
  error.tail<3>() = rotationVector(to.linear() * from.linear().transpose());
  return error;
}

bool isFinite(const Transform& pose) { return pose.matrix().allFinite(); }
}  // namespace motion

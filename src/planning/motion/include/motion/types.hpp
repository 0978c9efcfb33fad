// What every part of the library shares: transforms, names in messages, and the three kinds of error.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace motion
{
using Transform = Eigen::Isometry3d;
using Vector3 = Eigen::Vector3d;
using Quaternion = Eigen::Quaterniond;
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

struct Error : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

// The description cannot be made into a robot.
struct ModelError : Error
{
  using Error::Error;
};

// A name that the model or the scene does not have.
struct UnknownName : Error
{
  using Error::Error;
};

// Wrong length, not finite, a shape without size ...
struct InvalidInput : Error
{
  using Error::Error;
};

// "'a', 'b', 'c' ..." for messages: never more than eight names.
std::string listed(const std::vector<std::string>& names);

// "no link 'x' in robot 'y' (there are 'a', 'b' ...)"
[[noreturn]] void throwUnknown(const std::string& kind, const std::string& name, const std::string& where,
                               const std::vector<std::string>& known);

inline double wrapAngle(double angle) { return std::remainder(angle, 2.0 * M_PI); }

// Rotation vector (rad) of a rotation matrix; exact near zero and near pi.
Vector3 rotationVector(const Eigen::Matrix3d& rotation);

// The rotation that turns direction a into direction b the short way; opposite ones half a turn about some axis across them. Lengths do
// not matter, but neither is zero. As Eigen's FromTwoVectors, whose templates take a compiler four seconds wherever they are named.
Quaternion turnBetween(const Vector3& a, const Vector3& b);

// (position error in m, rotation error in rad), both in the frame in which the two poses are given.
Eigen::Matrix<double, 6, 1> poseError(const Transform& from, const Transform& to);

bool isFinite(const Transform& pose);
}  // namespace motion

// Where the joints of a trajectory are, and how they move.
#pragma once

#include <vector>

namespace trajectory_interface
{

/// One number for each joint: rad, rad/s, rad/s^2 or m, m/s, m/s^2; velocities and accelerations may be left out. Times are in s.
template <class ScalarType>
struct PosVelAccState
{
  typedef ScalarType Scalar;

  PosVelAccState() = default;
  /// All of them zero.
  PosVelAccState(const typename std::vector<Scalar>::size_type size)
    : position(size, Scalar(0))
    , velocity(size, Scalar(0))
    , acceleration(size, Scalar(0))
  {
  }

  std::vector<Scalar> position;
  std::vector<Scalar> velocity;
  std::vector<Scalar> acceleration;
  Scalar time_from_start = Scalar(0);
};

}  // namespace trajectory_interface

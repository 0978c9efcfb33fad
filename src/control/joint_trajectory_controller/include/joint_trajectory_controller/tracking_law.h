// The laws of following a trajectory: errors, tolerances, where a new motion joins the one under way, and the stop. The controllers of C++
// (joint_trajectory_controller_impl.h), of Python (controller.py) and the sampler of the control loop stand on them. Without ROS.
//
//   error       e = desired - measured; of angles the short way round, in (-pi, pi] (shortest_angular_distance)
//   tolerance   an error is over a tolerance > 0 unless |e| <= tolerance, so that NaN is over each; 0 or less is no tolerance
//   override    a goal's value above 0 takes the place of the parameter's, below 0 switches it off, 0 and NaN leave it
//   splice      a message with start time S, points at S + t_i, joins at J = max(S, N), N the next cycle. Points with t_i <= N - S have
//               passed. The old motion goes on to J; a bridge leads from its desired state there to the first point that is left.
//   turns       a joint that turns without end goes the short way to that point: all points get whole turns added; at half a turn it
//               goes as the numbers say
//   stop        from (p, v) within T to p + 5/8 v T: the first half of the quintic that turns (p, v) into (p, -v) in 2 T; T = 0: at rest at once
//
// Units: rad or m, and per s; times in s. Source: ros_controllers' joint_trajectory_controller (noetic).
//
// Threads: everything but violation() may be called from the control loop; nothing waits or allocates. violation() makes a text, for
// the end of a goal.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <trajectory_interface/spline_law.h>

namespace joint_trajectory_controller
{
namespace law
{

constexpr double kTurn = 6.283185307179586;  // rad

/// In (-pi, pi].
inline double shortest_way(double from, double to)
{
  const double way = std::remainder(to - from, kTurn);
  return way == -kTurn / 2 ? kTurn / 2 : way;
}

inline double position_error(double measured, double desired, bool angular)
{
  const double error = desired - measured;
  return angular && !(-kTurn / 2 < error && error <= kTurn / 2) ? shortest_way(measured, desired) : error;
}

template <class Scalar>
inline bool exceeds(Scalar error, Scalar tolerance)
{
  return tolerance > Scalar(0) && !(std::abs(error) <= tolerance);
}

/// What is over its tolerance, in words; nothing if nothing is.
inline std::string violation(const char* what, double error, double tolerance)
{
  if (!exceeds(error, tolerance))
    return std::string();
  char text[120];
  std::snprintf(text, sizeof text, "%s error %.6g is over the tolerance %g", what, error, tolerance);
  return text;
}

/// \param asked by a goal
template <class Scalar>
inline Scalar overridden(Scalar tolerance, double asked)
{
  return asked > 0.0 ? Scalar(asked) : asked < 0.0 ? Scalar(0) : tolerance;
}

/// Whether a point has passed. \param elapsed since the message began
inline bool has_passed(double time_from_start, double elapsed) { return time_from_start <= elapsed; }

inline double joining_time(double start, double next_cycle) { return std::max(start, next_cycle); }

/// Whole turns, in rad, to add to where the joint is to go.
inline double turns_to_add(double from, double to)
{
  double way = shortest_way(from, to);
  if (std::abs(std::abs(way) - kTurn / 2) < 1e-9)
    way = std::copysign(kTurn / 2, to - from);
  return std::round((from + way - to) / kTurn) * kTurn;
}

/// Both ends of a segment.
template <class Scalar>
struct Ends
{
  trajectory_interface::Knot<Scalar> first, last;
};

/// \param duration s; 0 or less: at rest at once
template <class Scalar>
inline Ends<Scalar> stop(Scalar position, Scalar velocity, Scalar duration)
{
  Ends<Scalar> ends;
  ends.first.has_velocity = ends.first.has_acceleration = ends.last.has_velocity = ends.last.has_acceleration = true;
  ends.first.position = ends.last.position = position;
  if (!(duration > Scalar(0)))
    return ends;
  ends.first.velocity = velocity;
  ends.last.position = position + Scalar(0.625) * velocity * duration;
  ends.last.acceleration = Scalar(-1.5) * velocity / duration;
  return ends;
}

}  // namespace law
}  // namespace joint_trajectory_controller

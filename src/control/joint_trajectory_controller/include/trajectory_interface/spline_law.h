// The law of a trajectory's segment: one polynomial in time for one joint. QuinticSplineSegment (many joints, in C++), Segment of Python
// (segment.py) and the sampler of the control loop stand on it. Without ROS.
//
//   p(t) = c0 + c1 t + ... + c5 t^5, t in s since the start; position in rad or m
//
// Of the highest order that both ends specify: with positions alone a line; with velocities at both ends the cubic, with accelerations
// as well the quintic that has the values of both. A segment without duration is its start. At the start and at the end the polynomial
// counts with its derivatives; before and after them the joint is at rest at the position there.
//
// Source: ros_controllers' trajectory_interface (noetic). It differs in two things: after the end the position is the one that was
// given, where the polynomial is off it by rounding, and sums are in Horner's order.
//
// Threads: sample() and all that reads may be called from the control loop; nothing waits or allocates, the constructor throws.
#pragma once

#include <array>
#include <cmath>
#include <stdexcept>

namespace trajectory_interface
{

/// One joint at one end of a segment.
template <class Scalar>
struct Knot
{
  Scalar position = Scalar(0);
  Scalar velocity = Scalar(0);
  Scalar acceleration = Scalar(0);
  bool has_velocity = false;
  bool has_acceleration = false;
};

/// One joint at one instant.
template <class Scalar>
struct Sample
{
  Scalar position;
  Scalar velocity;
  Scalar acceleration;
};

template <class Scalar>
class SplineLaw
{
public:
  typedef std::array<Scalar, 6> Coefficients;  // of ascending powers

  SplineLaw() = default;

  /// \throws std::invalid_argument the end is before the start
  SplineLaw(Scalar start, const Knot<Scalar>& first, Scalar end, const Knot<Scalar>& last) : start_(start), end_(end)
  {
    if (end < start)
      throw std::invalid_argument("a segment ends before its start");
    const Scalar t = end - start;
    rest_ = t == Scalar(0) ? first.position : last.position;
    c_.fill(Scalar(0));
    c_[0] = first.position;
    if (!first.has_velocity || !last.has_velocity)
      c_[1] = t == Scalar(0) ? Scalar(0) : (last.position - first.position) / t;
    else if (!first.has_acceleration || !last.has_acceleration)
      cubic(t, first, last);
    else
      quintic(t, first, last);
  }

  Sample<Scalar> sample(Scalar time) const
  {
    if (time > end_)
      return { rest_, Scalar(0), Scalar(0) };
    const Scalar t = time - start_;
    if (t < Scalar(0))
      return { c_[0], Scalar(0), Scalar(0) };
    return { c_[0] + t * (c_[1] + t * (c_[2] + t * (c_[3] + t * (c_[4] + t * c_[5])))),
             c_[1] + t * (2 * c_[2] + t * (3 * c_[3] + t * (4 * c_[4] + t * 5 * c_[5]))),
             2 * c_[2] + t * (6 * c_[3] + t * (12 * c_[4] + t * 20 * c_[5])) };
  }

  /// The same motion, later and elsewhere.
  void move(Scalar delay, Scalar offset)
  {
    start_ += delay;
    end_ += delay;
    c_[0] += offset;
    rest_ += offset;
  }

  Scalar start() const { return start_; }
  Scalar end() const { return end_; }
  /// The position after the end.
  Scalar rest() const { return rest_; }
  const Coefficients& coefficients() const { return c_; }

private:
  void cubic(Scalar t, const Knot<Scalar>& first, const Knot<Scalar>& last)
  {
    c_[1] = first.velocity;
    if (t == Scalar(0))
      return;
    const Scalar way = last.position - first.position, v0 = first.velocity, v1 = last.velocity;
    c_[2] = (3 * way / t - 2 * v0 - v1) / t;
    c_[3] = (v0 + v1 - 2 * way / t) / (t * t);
  }

  void quintic(Scalar t, const Knot<Scalar>& first, const Knot<Scalar>& last)
  {
    const Scalar v0 = first.velocity, v1 = last.velocity, a0 = first.acceleration, a1 = last.acceleration;
    c_[1] = v0;
    c_[2] = a0 / 2;
    if (t == Scalar(0))
      return;
    const Scalar way = last.position - first.position;
    c_[3] = (20 * way - (8 * v1 + 12 * v0) * t - (3 * a0 - a1) * t * t) / (2 * std::pow(t, Scalar(3)));
    c_[4] = (-30 * way + (14 * v1 + 16 * v0) * t + (3 * a0 - 2 * a1) * t * t) / (2 * std::pow(t, Scalar(4)));
    c_[5] = (12 * way - 6 * (v1 + v0) * t + (a1 - a0) * t * t) / (2 * std::pow(t, Scalar(5)));
  }

  Scalar start_ = Scalar(0), end_ = Scalar(0), rest_ = Scalar(0);
  Coefficients c_{};
};

}  // namespace trajectory_interface

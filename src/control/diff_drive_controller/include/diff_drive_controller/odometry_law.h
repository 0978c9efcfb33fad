// The law of wheel odometry: pose and velocity of a base from the ways of its wheels. All faces stand on it: odometry.h here and in
// ackermann_steering_controller for C++, and the controllers of wheeled bases in Python. Without ROS.
//
//   two sides l, r (m), b m apart:                 d = (l + r) / 2, a = (r - l) / b
//   driven axle, d m, and one steered at an angle s (rad), h m before it:  a = d tan s / h
//   |a| >= 1e-6 (an arc):                          x += d/a (sin(heading + a) - sin heading), y -= d/a (cos(heading + a) - cos heading)
//   else (Runge-Kutta of 2nd order):               x += d cos(heading + a/2), y += d sin(heading + a/2);  heading += a in both
//   velocities v = mean of the last d / dt, w = mean of the last a / dt; those of an open loop are the commands
//
// Units: m, rad, s. The heading is not wrapped. Below 1e-4 s (also backwards) the pose goes on, but there is no velocity: the
// interval lasts until the next step. In an open loop a negative dt leads back.
//
// Source: ros_controllers 0.21, value by value. It differs where a wheel is seen for the first time (its position is where it begins,
// not a way), where the odometry restarts (no velocity is left), in ways and velocities beyond 1e12 or NaN (the base has not moved,
// its velocities stay), and in means, which are summed anew. A base that moves sideways takes the heading midway through the step.
//
// Threads: everything may be called from the control loop; nothing waits or throws, and beyond windows of 1024 values nothing
// allocates after construction. One odometry belongs to one thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace diff_drive_controller
{

/// Mean of the last values; a window of 0 is one of 1.
class RollingMean
{
public:
  explicit RollingMean(std::size_t size) : size_(std::max<std::size_t>(1, size))
  {
    values_.reserve(std::min<std::size_t>(size_, 1024));
  }

  /// Add a value. \return the mean
  double operator()(double value)
  {
    if (values_.size() < size_)
      values_.push_back(value);
    else
    {
      values_[oldest_] = value;
      oldest_ = (oldest_ + 1) % size_;
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < values_.size(); ++i)
      sum += values_[(oldest_ + i) % values_.size()];
    return sum / static_cast<double>(values_.size());
  }

  void clear()
  {
    values_.clear();
    oldest_ = 0;
  }

private:
  std::size_t size_, oldest_ = 0;
  std::vector<double> values_;
};

/// What a joint has turned since it was last asked (rad). The first answer is 0: joints need not start at 0.
class WheelTravel
{
public:
  /// The next answer is 0 again.
  void restart() { last_ = std::numeric_limits<double>::quiet_NaN(); }

  double operator()(double position)
  {
    const double last = last_;
    last_ = position;
    return std::isnan(last) ? 0.0 : position - last;
  }

private:
  double last_ = std::numeric_limits<double>::quiet_NaN();
};

/// m forward, and rad turned to the left.
struct Way
{
  double distance, angle;
};

inline Way differential(double left, double right, double separation)
{
  return Way{ (right + left) * 0.5, (right - left) / separation };
}

inline Way bicycle(double distance, double steering, double wheel_base)
{
  return Way{ distance, std::tan(steering) * distance / wheel_base };
}

/// Pose in the odom frame, velocities in the base frame.
class OdometryLaw
{
public:
  explicit OdometryLaw(std::size_t window) : mean_linear_(window), mean_angular_(window) {}

  /// Shorter intervals (s) give no usable velocity.
  static constexpr double min_interval() { return 1e-4; }

  /// Forget velocities; the pose stays.
  void restart()
  {
    mean_linear_.clear();
    mean_angular_.clear();
    linear = linear_y = angular = 0.0;
  }

  /// Velocities are means of so many values from now on.
  void set_window(std::size_t window) { mean_linear_ = mean_angular_ = RollingMean(window); }

  /// The base went this way, in dt s. \return false: dt is too short for a velocity, the interval goes on
  bool travelled(const Way& way, double dt)
  {
    const bool usable = advance(way);
    if (dt < min_interval())
      return false;
    if (usable)
    {
      linear = mean_linear_(way.distance / dt);
      angular = mean_angular_(way.angle / dt);
    }
    return true;
  }

  /// Open loop: the base has been doing this for dt s.
  void commanded(double forward, double turning, double dt)
  {
    if (!advance(Way{ forward * dt, turning * dt }))
      return;
    linear = forward;
    angular = turning;
  }

  /// Velocities of a base that also moves to the left, over dt s. \return false: dt is too short, the interval goes on
  bool moved(double forward, double left, double turning, double dt)
  {
    if (!bounded(forward) || !bounded(left) || !bounded(turning))
      return false;
    linear = forward;
    linear_y = left;
    angular = turning;
    if (dt < min_interval())
      return false;
    const double direction = heading + 0.5 * turning * dt;
    const double cosine = std::cos(direction), sine = std::sin(direction);
    heading += turning * dt;
    x += (forward * cosine - left * sine) * dt;
    y += (forward * sine + left * cosine) * dt;
    return true;
  }

  double x = 0.0, y = 0.0, heading = 0.0;
  double linear = 0.0, linear_y = 0.0, angular = 0.0;

private:
  static bool bounded(double value) { return std::abs(value) <= 1e12; }

  bool advance(const Way& way)
  {
    if (!bounded(way.distance) || !bounded(way.angle))
      return false;
    const double before = heading;
    heading += way.angle;
    if (std::abs(way.angle) < 1e-6)
    {
      x += way.distance * std::cos(before + 0.5 * way.angle);
      y += way.distance * std::sin(before + 0.5 * way.angle);
    }
    else
    {
      const double radius = way.distance / way.angle;
      x += radius * (std::sin(heading) - std::sin(before));
      y -= radius * (std::cos(heading) - std::cos(before));
    }
    return true;
  }

  RollingMean mean_linear_, mean_angular_;
};

}  // namespace diff_drive_controller

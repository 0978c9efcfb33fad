// The law of joint limits: what is left of a command. All faces stand on it: the handles of joint_limits_interface.h, those of Python
// (handles.py), and the simulated robot (gazebo_ros_control's wiring). Without ROS.
//
// Each rule gives a corridor [low, high] for the command u, from the position x and speed v of the joint, the command u' of the cycle
// before and the time dt since then. Hard limits: positions xmin..xmax, speed V, acceleration A, effort E; soft ones smin..smax with
// the gains kp (1/s) and kv (N m s/rad or N s/m). Units: rad or m, and per s; N m or N. What a joint does not have bounds nothing.
//
//   PositionSaturation  [max(u' - V dt, xmin), min(u' + V dt, xmax)]
//   PositionSoft        [max(u' + vlow(u') dt, xmin), min(u' + vhigh(u') dt, xmax)]
//   VelocitySaturation  [max(u' - A dt, -V), min(u' + A dt, V)]
//   VelocitySoft        [max(v - A dt, vlow(x)), min(v + A dt, vhigh(x))]
//   EffortSaturation    [-E, E]; low is 0 where x < xmin or v < -V, high is 0 where x > xmax or v > V; the lower limit is asked first
//   EffortSoft          [clamp(-kv (v - vlow(x)), -E, E), clamp(-kv (v - vhigh(x)), -E, E)]
//   with vlow(x) = clamp(-kp (x - smin), -V, V), vhigh(x) = clamp(-kp (x - smax), -V, V); -V and V where there are no position limits
//
//   u = min(max(u, low), high): where the corridor is empty, as with limits the wrong way round, the high end counts.
//
// Before the first cycle u' is x for positions and 0 for velocities and efforts. Source: ros_control's joint_limits_interface 0.20,
// value by value, also for dt 0 and below. It differs in what is no number, which there goes through to the joint: a NaN bound bounds
// nothing while the others still do, and a command that the corridor leaves NaN or infinite is replaced by u', put into the corridor.
//
// Threads: everything here may be called from the control loop; nothing waits, allocates or throws. One limiter belongs to one thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <joint_limits_interface/joint_limits.h>

namespace joint_limits_interface
{

enum class LimitRule
{
  PositionSaturation,
  PositionSoft,
  VelocitySaturation,
  VelocitySoft,
  EffortSaturation,
  EffortSoft
};

namespace internal
{

/// Upstream's: where low lies above high, that is high.
template <typename T>
inline T saturate(const T value, const T low, const T high)
{
  return std::min(std::max(value, low), high);
}

}  // namespace internal

/// Least and greatest command. A bound that is NaN bounds nothing.
struct Corridor
{
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  double clamp(double value) const { return internal::saturate(value, low, high); }
  /// Both bounds hold from now on.
  void narrow(double lowest, double highest)
  {
    low = std::max(low, lowest);
    high = std::min(high, highest);
  }
};

namespace internal
{

inline Corridor between(double low, double high)
{
  Corridor c;
  c.low = low;
  c.high = high;
  return c;
}

/// [low, high], each put into [-most, most]; one that is NaN is at its end.
inline Corridor within(double most, double low, double high)
{
  const Corridor all = between(-most, most);
  return between(std::isnan(low) ? -most : all.clamp(low), std::isnan(high) ? most : all.clamp(high));
}

}  // namespace internal

/// Keeps one joint's commands within its limits.
class CommandLimiter
{
public:
  CommandLimiter() = default;
  /// \param soft of the rules that have soft limits
  CommandLimiter(LimitRule rule, const JointLimits& limits, const SoftJointLimits& soft = SoftJointLimits())
    : rule_(rule)
    , limits_(limits)
    , soft_(soft)
  {
    reset();
  }

  /// Forget the last command: the joint was moved by other means.
  void reset() { previous_ = of_positions() ? std::numeric_limits<double>::quiet_NaN() : 0.0; }

  LimitRule rule() const { return rule_; }

  /// \param command as it is wanted; becomes what is allowed \param dt s since the last cycle
  /// \return false: the command was no usable number, and the last one took its place
  bool enforce(double& command, double position, double velocity, double dt)
  {
    const double held = std::isnan(previous_) ? position : previous_;
    const Corridor allowed = corridor(position, velocity, held, dt);
    previous_ = allowed.clamp(command);
    const bool usable = std::isfinite(previous_);
    if (!usable)
      previous_ = allowed.clamp(held);
    if (!std::isfinite(previous_))
      previous_ = held;  // the limits themselves are no places to be at
    command = previous_;
    return usable;
  }

  /// \param previous the command of the cycle before
  Corridor corridor(double position, double velocity, double previous, double dt) const
  {
    switch (rule_)
    {
      case LimitRule::PositionSaturation:
        return positions(previous - fastest() * dt, previous + fastest() * dt);
      case LimitRule::PositionSoft: {
        const Corridor speeds = soft_speeds(previous);
        return positions(previous + speeds.low * dt, previous + speeds.high * dt);
      }
      case LimitRule::VelocitySaturation:
        return accelerated(internal::between(-fastest(), fastest()), previous, dt);
      case LimitRule::VelocitySoft:
        return accelerated(soft_speeds(position), velocity, dt);
      case LimitRule::EffortSaturation:
        return efforts(position, velocity);
      case LimitRule::EffortSoft:
        break;
    }
    const Corridor speeds = soft_speeds(position);
    return internal::within(strongest(), -soft_.k_velocity * (velocity - speeds.low),
                            -soft_.k_velocity * (velocity - speeds.high));
  }

private:
  static double infinite() { return std::numeric_limits<double>::infinity(); }
  double fastest() const { return limits_.has_velocity_limits ? limits_.max_velocity : infinite(); }
  double strongest() const { return limits_.has_effort_limits ? limits_.max_effort : infinite(); }
  bool of_positions() const { return rule_ == LimitRule::PositionSaturation || rule_ == LimitRule::PositionSoft; }

  Corridor positions(double low, double high) const
  {
    Corridor c = limits_.has_position_limits ? internal::between(limits_.min_position, limits_.max_position) : Corridor();
    c.narrow(low, high);
    return c;
  }

  /// Speeds that lead to the soft limits.
  Corridor soft_speeds(double position) const
  {
    if (!limits_.has_position_limits)
      return internal::between(-fastest(), fastest());
    return internal::within(fastest(), -soft_.k_position * (position - soft_.min_position),
                            -soft_.k_position * (position - soft_.max_position));
  }

  Corridor accelerated(Corridor speeds, double from, double dt) const
  {
    if (limits_.has_acceleration_limits)
      speeds.narrow(from - limits_.max_acceleration * dt, from + limits_.max_acceleration * dt);
    return speeds;
  }

  Corridor efforts(double position, double velocity) const
  {
    Corridor c = internal::between(-strongest(), strongest());
    if (limits_.has_position_limits)
      stop_beyond(c, position, limits_.min_position, limits_.max_position);
    stop_beyond(c, velocity, -fastest(), fastest());
    return c;
  }

  static void stop_beyond(Corridor& c, double at, double low, double high)
  {
    if (at < low)
      c.low = 0.0;
    else if (at > high)
      c.high = 0.0;
  }

  LimitRule rule_ = LimitRule::PositionSaturation;
  JointLimits limits_;
  SoftJointLimits soft_;
  double previous_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace joint_limits_interface

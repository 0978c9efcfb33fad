// The law of a base's speed limits, upstream's class; Python's SpeedLimiter stands on it. Without ROS.
//
//   jerk            v = v0 + (v0 - v1) + clamp((v - v0) - (v0 - v1), 2 min_jerk dt^2, 2 max_jerk dt^2)
//   acceleration    v = v0 + clamp(v - v0, min_acceleration dt, max_acceleration dt)
//   velocity        v = clamp(v, min_velocity, max_velocity),     in this order, each where has_..._limits
//   with clamp(x, low, high) = min(max(low, x), high): where low lies above high, that is high; NaN is low
//
// v is the velocity that is wanted (m/s or rad/s), v0 and v1 what came out of the last and of the last but one step, dt the time
// since the last step (s). In a negative dt low lies above high: v is v0 + max_acceleration dt.
//
// Source: ros_controllers 0.21, value by value. It differs in an infinite limit at dt 0, which there makes the velocity NaN: nothing
// changes in no time.
//
// Threads: everything may be called from the control loop; nothing waits, allocates or throws.
#pragma once

#include <algorithm>

namespace diff_drive_controller
{

class SpeedLimiter
{
public:
  SpeedLimiter(bool has_velocity_limits = false, bool has_acceleration_limits = false, bool has_jerk_limits = false,
               double min_velocity = 0.0, double max_velocity = 0.0, double min_acceleration = 0.0,
               double max_acceleration = 0.0, double min_jerk = 0.0, double max_jerk = 0.0)
    : has_velocity_limits(has_velocity_limits)
    , has_acceleration_limits(has_acceleration_limits)
    , has_jerk_limits(has_jerk_limits)
    , min_velocity(min_velocity)
    , max_velocity(max_velocity)
    , min_acceleration(min_acceleration)
    , max_acceleration(max_acceleration)
    , min_jerk(min_jerk)
    , max_jerk(max_jerk)
  {
  }

  // Each returns the factor by which v became smaller; 1 where v was 0.

  double limit(double& v, double v0, double v1, double dt)
  {
    const double wanted = v;
    limit_jerk(v, v0, v1, dt);
    limit_acceleration(v, v0, dt);
    limit_velocity(v);
    return factor(v, wanted);
  }

  double limit_velocity(double& v)
  {
    const double wanted = v;
    if (has_velocity_limits)
      v = clamp(v, min_velocity, max_velocity);
    return factor(v, wanted);
  }

  double limit_acceleration(double& v, double v0, double dt)
  {
    const double wanted = v;
    if (has_acceleration_limits)
      v = v0 + clamp(v - v0, times(min_acceleration, dt), times(max_acceleration, dt));
    return factor(v, wanted);
  }

  double limit_jerk(double& v, double v0, double v1, double dt)
  {
    const double wanted = v, scale = 2.0 * dt * dt, last_change = v0 - v1;
    if (has_jerk_limits)
      v = v0 + last_change + clamp((v - v0) - last_change, times(min_jerk, scale), times(max_jerk, scale));
    return factor(v, wanted);
  }

  bool has_velocity_limits, has_acceleration_limits, has_jerk_limits;
  double min_velocity, max_velocity, min_acceleration, max_acceleration, min_jerk, max_jerk;

private:
  static double clamp(double value, double low, double high) { return std::min(std::max(low, value), high); }
  static double times(double limit, double dt) { return dt == 0.0 ? 0.0 : limit * dt; }
  static double factor(double v, double wanted) { return wanted != 0.0 ? v / wanted : 1.0; }
};

}  // namespace diff_drive_controller

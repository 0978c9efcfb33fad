// Odometry of a base with one driven and one steered axle, as upstream's class; diff_drive_controller's odometry_law.h says what it
// computes.
#pragma once

#include <cstddef>

#include <diff_drive_controller/odometry.h>

namespace ackermann_steering_controller
{

class Odometry : public diff_drive_controller::internal::TimedOdometry
{
public:
  explicit Odometry(std::size_t velocity_rolling_window_size = 10) : TimedOdometry(velocity_rolling_window_size) {}

  /// \param rear_wheel_pos, front_steer_pos rad \return whether there are new velocities
  bool update(double rear_wheel_pos, double front_steer_pos, const ros::Time& time)
  {
    return travelled(diff_drive_controller::bicycle(wheel_(rear_wheel_pos) * radius_, front_steer_pos, base_), time);
  }

  /// In m.
  void setWheelParams(double wheel_separation_h, double wheel_radius)
  {
    base_ = wheel_separation_h;
    radius_ = wheel_radius;
  }

private:
  diff_drive_controller::WheelTravel wheel_;
  double base_ = 0.0, radius_ = 0.0;
};

}  // namespace ackermann_steering_controller

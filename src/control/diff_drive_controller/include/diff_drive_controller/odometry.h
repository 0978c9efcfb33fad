// Odometry of a base with two sides, as upstream's class; odometry_law.h says what it computes.
#pragma once

#include <cstddef>

#include <diff_drive_controller/odometry_law.h>
#include <ros/time.h>

namespace diff_drive_controller
{
namespace internal
{

/// The law by the clock of ROS, whatever the wheels.
class TimedOdometry
{
public:
  explicit TimedOdometry(std::size_t window) : law_(window) {}

  /// Forget velocities; the pose stays.
  void init(const ros::Time& time)
  {
    law_.restart();
    time_ = time;
  }

  /// \param linear m/s \param angular rad/s, both since the last call
  void updateOpenLoop(double linear, double angular, const ros::Time& time)
  {
    law_.commanded(linear, angular, (time - time_).toSec());
    time_ = time;
  }

  double getX() const { return law_.x; }
  double getY() const { return law_.y; }
  double getHeading() const { return law_.heading; }
  double getLinear() const { return law_.linear; }
  double getAngular() const { return law_.angular; }
  void setVelocityRollingWindowSize(std::size_t size) { law_.set_window(size); }

protected:
  /// \return whether there are new velocities
  bool travelled(const Way& way, const ros::Time& time)
  {
    if (!law_.travelled(way, (time - time_).toSec()))
      return false;
    time_ = time;
    return true;
  }

private:
  OdometryLaw law_;
  ros::Time time_;
};

}  // namespace internal

class Odometry : public internal::TimedOdometry
{
public:
  explicit Odometry(std::size_t velocity_rolling_window_size = 10) : TimedOdometry(velocity_rolling_window_size) {}

  /// \param left_pos, right_pos rad \return whether there are new velocities
  bool update(double left_pos, double right_pos, const ros::Time& time)
  {
    return travelled(differential(left_(left_pos) * left_radius_, right_(right_pos) * right_radius_, separation_), time);
  }

  /// In m.
  void setWheelParams(double wheel_separation, double left_wheel_radius, double right_wheel_radius)
  {
    separation_ = wheel_separation;
    left_radius_ = left_wheel_radius;
    right_radius_ = right_wheel_radius;
  }

private:
  WheelTravel left_, right_;
  double separation_ = 0.0, left_radius_ = 0.0, right_radius_ = 0.0;
};

}  // namespace diff_drive_controller

// What can be told of a trajectory message by looking at it alone.
#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include <ros/console.h>
#include <ros/time.h>
#include <trajectory_interface/trajectory_interface.h>
#include <trajectory_msgs/JointTrajectory.h>

namespace joint_trajectory_controller
{
namespace internal
{

/// A message without a stamp starts at \p time.
inline ros::Time startTime(const trajectory_msgs::JointTrajectory& msg, const ros::Time& time)
{
  return msg.header.stamp.isZero() ? time : msg.header.stamp;
}

}  // namespace internal

/// Whether positions, velocities and accelerations are of joint_dim joints, or left out.
inline bool isValid(const trajectory_msgs::JointTrajectoryPoint& point, const unsigned int joint_dim)
{
  const auto fits = [joint_dim](const std::vector<double>& values) { return values.empty() || values.size() == joint_dim; };
  return fits(point.positions) && fits(point.velocities) && fits(point.accelerations);
}

/// Whether that is so for all its points; the log names the first that it is not so for.
inline bool isValid(const trajectory_msgs::JointTrajectory& msg)
{
  for (std::size_t i = 0; i < msg.points.size(); ++i)
  {
    if (isValid(msg.points[i], msg.joint_names.size()))
      continue;
    ROS_ERROR_STREAM("Invalid trajectory point at index: "
                     << i << ". Size mismatch in joint names, position, velocity or acceleration data.");
    return false;
  }
  return true;
}

inline bool isTimeStrictlyIncreasing(const trajectory_msgs::JointTrajectory& msg)
{
  typedef trajectory_msgs::JointTrajectoryPoint Point;
  return std::adjacent_find(msg.points.begin(), msg.points.end(), [](const Point& a, const Point& b) {
           return a.time_from_start >= b.time_from_start;
         }) == msg.points.end();
}

/// The last point that is due by that time; end(), if none is.
inline std::vector<trajectory_msgs::JointTrajectoryPoint>::const_iterator findPoint(const trajectory_msgs::JointTrajectory& msg,
                                                                                    const ros::Time& time)
{
  const ros::Duration since = time - internal::startTime(msg, time);
  const auto next = std::upper_bound(
      msg.points.begin(), msg.points.end(), since,
      [](const ros::Duration& t, const trajectory_msgs::JointTrajectoryPoint& point) { return t < point.time_from_start; });
  return next == msg.points.begin() ? msg.points.end() : std::prev(next);
}

}  // namespace joint_trajectory_controller

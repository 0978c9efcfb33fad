#include <moveit/trajectory_processing/limit_cartesian_speed.h>

#include <algorithm>

#include "log_names.hpp"

namespace trajectory_processing
{
bool limitMaxCartesianLinkSpeed(robot_trajectory::RobotTrajectory& trajectory, const double speed, const std::string& link_name)
{
  if (!link_name.empty())
  {
    bool found = false;
    const moveit::core::LinkModel* link = trajectory.getRobotModel()->getLinkModel(link_name, &found);
    if (found)
      return limitMaxCartesianLinkSpeed(trajectory, speed, link);
    ROS_ERROR_NAMED(log_names::TRAJECTORY_PROCESSING, "The speed of link '%s' cannot be limited: the robot has no such link",
                    link_name.c_str());
    return false;
  }
  std::vector<const moveit::core::LinkModel*> tips;
  if (!trajectory.getGroup() || !trajectory.getGroup()->getEndEffectorTips(tips) || tips.empty())
  {
    ROS_ERROR_NAMED(log_names::TRAJECTORY_PROCESSING,
                    "No link to limit the speed of: the group '%s' has no end effector; name the link",
                    trajectory.getGroupName().c_str());
    return false;
  }
  bool good = true;
  for (const moveit::core::LinkModel* tip : tips)
    good = limitMaxCartesianLinkSpeed(trajectory, speed, tip) && good;
  return good;
}

bool limitMaxCartesianLinkSpeed(robot_trajectory::RobotTrajectory& trajectory, const double speed,
                                const moveit::core::LinkModel* link_model)
{
  const std::size_t count = trajectory.getWayPointCount();
  if (!link_model || !(speed > 0.0) || !trajectory.getGroup())
  {
    ROS_ERROR_NAMED(log_names::TRAJECTORY_PROCESSING,
                    "The speed of a link is limited to a number above 0 m/s, in a trajectory of a group");
    return false;
  }
  if (count < 2)
    return true;
  // A way point slows down as much as the slower of its two segments.
  std::vector<double> factors(count + 1, 1.0);
  for (std::size_t i = 1; i < count; ++i)
  {
    const Eigen::Vector3d way = trajectory.getWayPoint(i).getGlobalLinkTransform(link_model).translation() -
                                trajectory.getWayPoint(i - 1).getGlobalLinkTransform(link_model).translation();
    const double time = trajectory.getWayPointDurationFromPrevious(i), needed = way.norm() / speed;
    if (needed <= time)
      continue;
    trajectory.setWayPointDurationFromPrevious(i, needed);
    factors[i] = time > 0.0 ? needed / time : 1.0;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const double factor = std::max(factors[i], factors[i + 1]);
    moveit::core::RobotState& state = *trajectory.getWayPointPtr(i);
    for (const std::string& name : trajectory.getGroup()->getVariableNames())
    {
      if (state.hasVelocities())
        state.setVariableVelocity(name, state.getVariableVelocity(name) / factor);
      if (state.hasAccelerations())
        state.setVariableAcceleration(name, state.getVariableAcceleration(name) / (factor * factor));
    }
  }
  return true;
}
}  // namespace trajectory_processing

#include <moveit/trajectory_processing/iterative_spline_parameterization.h>
#include <moveit/trajectory_processing/iterative_time_parameterization.h>
#include <moveit/trajectory_processing/time_optimal_trajectory_generation.h>

#include "motion/robot_state.hpp"
#include "motion/timing.hpp"

namespace trajectory_processing
{
namespace
{
using robot_trajectory::RobotTrajectory;
using Limits = std::unordered_map<std::string, double>;

double limitOf(const Limits& own, const std::string& name, bool bounded, double bound, double otherwise)
{
  const auto found = own.find(name);
  if (found != own.end())
    return found->second;
  return bounded ? std::abs(bound) : otherwise;
}

// 0 is a message that was not filled in, above 1 a mistake.
double scaling(double factor, const char* what)
{
  if (factor > 0.0 && factor <= 1.0)
    return factor;
  if (factor != 0.0)
    ROS_WARN_NAMED("trajectory_processing", "Invalid max_%s_scaling_factor %f specified, assuming 1.0 instead.", what, factor);
  return 1.0;
}

// The way points of `path` in place of those that there are.
void setTimed(RobotTrajectory& trajectory, const moveit::core::JointModelGroup& group, const motion::TimedPath& path)
{
  const std::vector<std::string>& names = group.core().variable_names;
  const moveit::core::RobotState first = trajectory.getFirstWayPoint();
  trajectory.clear();
  for (std::size_t i = 0; i < path.positions.size(); ++i)
  {
    const auto state = std::make_shared<moveit::core::RobotState>(first);
    state->setJointGroupActivePositions(&group, path.positions[i]);
    for (std::size_t k = 0; k < names.size(); ++k)
    {
      state->setVariableVelocity(names[k], i < path.velocities.size() ? path.velocities[i][k] : 0.0);
      state->setVariableAcceleration(names[k], i < path.accelerations.size() ? path.accelerations[i][k] : 0.0);
    }
    trajectory.addSuffixWayPoint(state, i == 0 ? 0.0 : path.times[i] - path.times[i - 1]);
  }
}

template <typename Timing>
bool timed(RobotTrajectory& trajectory, const Limits& velocities, const Limits& accelerations, double velocity_scaling,
           double acceleration_scaling, const Timing& timing)
{
  const moveit::core::JointModelGroup* group = trajectory.getGroup();
  if (trajectory.empty())
    return true;
  if (!group)
  {
    ROS_ERROR_NAMED("trajectory_processing", "It looks like the planner did not set the group the plan was computed for");
    return false;
  }
  // Limits of joints whose robot has none are those of the library's other users.
  motion::TimingLimits limits;
  const std::vector<std::string>& names = group->core().variable_names;
  for (const std::string& name : names)
  {
    const moveit::core::VariableBounds& b = trajectory.getRobotModel()->getVariableBounds(name);
    limits.velocity.push_back(scaling(velocity_scaling, "velocity") *
                              limitOf(velocities, name, b.velocity_bounded_, b.max_velocity_, 1.0));
    limits.acceleration.push_back(scaling(acceleration_scaling, "acceleration") *
                                  limitOf(accelerations, name, b.acceleration_bounded_, b.max_acceleration_, 1.0));
    if (!(limits.velocity.back() > 0.0) || !(limits.acceleration.back() > 0.0))
    {
      ROS_ERROR_NAMED("trajectory_processing", "Velocity and acceleration limits of '%s' must be positive", name.c_str());
      return false;
    }
  }
  trajectory.unwind();
  motion::Rows points;
  for (std::size_t i = 0; i < trajectory.getWayPointCount(); ++i)
  {
    std::vector<double> values(names.size());
    trajectory.getWayPoint(i).core().getGroup(group->core(), values.data());
    points.push_back(values);
  }
  motion::TimedPath path;
  try
  {
    path = timing(points, limits);
  }
  catch (const motion::Error& error)
  {
    ROS_ERROR_NAMED("trajectory_processing", "%s", error.what());
    return false;
  }
  if (path.positions.empty())
    return false;
  setTimed(trajectory, *group, path);
  return true;
}
}  // namespace

IterativeParabolicTimeParameterization::IterativeParabolicTimeParameterization(unsigned int /*max_iterations*/,
                                                                               double /*max_time_change_per_it*/)
{
}

bool IterativeParabolicTimeParameterization::computeTimeStamps(RobotTrajectory& trajectory,
                                                               const double max_velocity_scaling_factor,
                                                               const double max_acceleration_scaling_factor) const
{
  return timed(trajectory, {}, {}, max_velocity_scaling_factor, max_acceleration_scaling_factor, motion::iterativeParabolic);
}

IterativeSplineParameterization::IterativeSplineParameterization(bool /*add_points*/) {}

bool IterativeSplineParameterization::computeTimeStamps(RobotTrajectory& trajectory, const double max_velocity_scaling_factor,
                                                        const double max_acceleration_scaling_factor) const
{
  return timed(trajectory, {}, {}, max_velocity_scaling_factor, max_acceleration_scaling_factor, motion::iterativeSpline);
}

TimeOptimalTrajectoryGeneration::TimeOptimalTrajectoryGeneration(const double path_tolerance, const double resample_dt,
                                                                 const double min_angle_change)
  : path_tolerance_(path_tolerance)
  , resample_dt_(resample_dt)
  , min_angle_change_(min_angle_change)
{
}

bool TimeOptimalTrajectoryGeneration::computeTimeStamps(RobotTrajectory& trajectory, const double max_velocity_scaling_factor,
                                                        const double max_acceleration_scaling_factor) const
{
  return computeTimeStamps(trajectory, Limits(), Limits(), max_velocity_scaling_factor, max_acceleration_scaling_factor);
}

bool TimeOptimalTrajectoryGeneration::computeTimeStamps(RobotTrajectory& trajectory, const Limits& velocity_limits,
                                                        const Limits& acceleration_limits,
                                                        const double max_velocity_scaling_factor,
                                                        const double max_acceleration_scaling_factor) const
{
  return timed(trajectory, velocity_limits, acceleration_limits, max_velocity_scaling_factor, max_acceleration_scaling_factor,
               [this](const motion::Rows& points, const motion::TimingLimits& limits) {
                 return motion::timeOptimal(points, limits, path_tolerance_, resample_dt_, min_angle_change_);
               });
}
}  // namespace trajectory_processing

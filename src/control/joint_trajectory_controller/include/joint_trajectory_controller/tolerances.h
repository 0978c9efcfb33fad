// How far a joint may be from its trajectory: parameters, overridden by what an action goal asks for.
#pragma once

#include <cassert>
#include <string>
#include <vector>

#include <control_msgs/FollowJointTrajectoryAction.h>
#include <joint_trajectory_controller/tracking_law.h>
#include <ros/console.h>
#include <ros/node_handle.h>

namespace joint_trajectory_controller
{

/// Largest allowed errors of one joint: rad or m, and per s and s^2. 0 is no limit.
template <class Scalar>
struct StateTolerances
{
  StateTolerances(Scalar position_tolerance = Scalar(0), Scalar velocity_tolerance = Scalar(0),
                  Scalar acceleration_tolerance = Scalar(0))
    : position(position_tolerance)
    , velocity(velocity_tolerance)
    , acceleration(acceleration_tolerance)
  {
  }

  Scalar position;
  Scalar velocity;
  Scalar acceleration;
};

/// Of all joints of a controller, on their way and at their goal.
template <class Scalar>
struct SegmentTolerances
{
  SegmentTolerances(const typename std::vector<StateTolerances<Scalar>>::size_type& size = 0)
    : state_tolerance(size)
    , goal_state_tolerance(size)
  {
  }

  std::vector<StateTolerances<Scalar>> state_tolerance;
  std::vector<StateTolerances<Scalar>> goal_state_tolerance;
  Scalar goal_time_tolerance = Scalar(0);  // s that joints may take after the end of their trajectory
};

/// The same of one joint.
template <class Scalar>
struct SegmentTolerancesPerJoint
{
  StateTolerances<Scalar> state_tolerance;
  StateTolerances<Scalar> goal_state_tolerance;
  Scalar goal_time_tolerance = Scalar(0);
};

namespace internal
{

/// The first error that is over its limit, in words; nothing if none is.
template <class State>
inline std::string violation(const State& error, std::size_t joint, const StateTolerances<typename State::Scalar>& limits)
{
  std::string text = law::violation("position", error.position[joint], limits.position);
  if (text.empty())
    text = law::violation("velocity", error.velocity[joint], limits.velocity);
  return text.empty() ? law::violation("acceleration", error.acceleration[joint], limits.acceleration) : text;
}

template <class State>
inline bool within(const State& error, std::size_t joint, const StateTolerances<typename State::Scalar>& limits)
{
  return !law::exceeds(error.position[joint], limits.position) && !law::exceeds(error.velocity[joint], limits.velocity) &&
         !law::exceeds(error.acceleration[joint], limits.acceleration);
}

}  // namespace internal

/// Whether the errors of all joints are within their limits. \param show_errors say in the log which is not
template <class State>
inline bool checkStateTolerance(const State& state_error,
                                const std::vector<StateTolerances<typename State::Scalar>>& state_tolerance,
                                bool show_errors = false)
{
  assert(state_tolerance.size() == state_error.position.size());
  assert(state_tolerance.size() == state_error.velocity.size());
  assert(state_tolerance.size() == state_error.acceleration.size());
  for (std::size_t i = 0; i < state_tolerance.size(); ++i)
  {
    if (internal::within(state_error, i, state_tolerance[i]))
      continue;
    if (show_errors)
      ROS_ERROR_STREAM_NAMED("tolerances", "Path state tolerances failed on joint "
                                               << i << ": " << internal::violation(state_error, i, state_tolerance[i]));
    return false;
  }
  return true;
}

/// The same for a state of one joint.
template <class State>
inline bool checkStateTolerancePerJoint(const State& state_error,
                                        const StateTolerances<typename State::Scalar>& state_tolerance,
                                        bool show_errors = false)
{
  if (internal::within(state_error, 0, state_tolerance))
    return true;
  if (show_errors)
    ROS_ERROR_STREAM_NAMED("tolerances",
                           "Path state tolerances failed: " << internal::violation(state_error, 0, state_tolerance));
  return false;
}

/// A positive value of the message takes a tolerance's place, a negative one switches it off, 0 leaves it.
template <class Scalar>
inline void updateStateTolerances(const control_msgs::JointTolerance& tol_msg, StateTolerances<Scalar>& tols)
{
  tols.position = law::overridden(tols.position, tol_msg.position);
  tols.velocity = law::overridden(tols.velocity, tol_msg.velocity);
  tols.acceleration = law::overridden(tols.acceleration, tol_msg.acceleration);
}

/// What a goal asks for, joint by joint. \param joint_names in the order of tols
template <class Scalar>
inline void updateSegmentTolerances(const control_msgs::FollowJointTrajectoryGoal& goal,
                                    const std::vector<std::string>& joint_names, SegmentTolerances<Scalar>& tols)
{
  assert(joint_names.size() == tols.state_tolerance.size());
  assert(joint_names.size() == tols.goal_state_tolerance.size());
  for (std::size_t i = 0; i < joint_names.size(); ++i)
  {
    for (const control_msgs::JointTolerance& asked : goal.path_tolerance)
      if (asked.name == joint_names[i])
        updateStateTolerances(asked, tols.state_tolerance[i]);
    for (const control_msgs::JointTolerance& asked : goal.goal_tolerance)
      if (asked.name == joint_names[i])
        updateStateTolerances(asked, tols.goal_state_tolerance[i]);
  }
  tols.goal_time_tolerance = law::overridden(tols.goal_time_tolerance, goal.goal_time_tolerance.toSec());
}

/// From the parameters goal_time, stopped_velocity_tolerance, JOINT/trajectory and JOINT/goal of a namespace.
template <class Scalar>
inline SegmentTolerances<Scalar> getSegmentTolerances(const ros::NodeHandle& nh, const std::vector<std::string>& joint_names)
{
  SegmentTolerances<Scalar> tolerances(joint_names.size());
  const double stopped = nh.param("stopped_velocity_tolerance", 0.01);
  for (std::size_t i = 0; i < joint_names.size(); ++i)
  {
    tolerances.state_tolerance[i].position = Scalar(nh.param(joint_names[i] + "/trajectory", 0.0));
    tolerances.goal_state_tolerance[i].position = Scalar(nh.param(joint_names[i] + "/goal", 0.0));
    tolerances.goal_state_tolerance[i].velocity = Scalar(stopped);
  }
  tolerances.goal_time_tolerance = Scalar(nh.param("goal_time", 0.0));
  return tolerances;
}

}  // namespace joint_trajectory_controller

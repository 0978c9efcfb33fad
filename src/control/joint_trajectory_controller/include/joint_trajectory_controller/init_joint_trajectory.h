// From a trajectory message to segments, joined to the motion that is running.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <boost/shared_ptr.hpp>
#include <control_msgs/FollowJointTrajectoryAction.h>
#include <joint_trajectory_controller/joint_trajectory_msg_utils.h>
#include <joint_trajectory_controller/joint_trajectory_segment.h>
#include <realtime_tools/realtime_server_goal_handle.h>
#include <ros/console.h>
#include <trajectory_msgs/JointTrajectoryPoint.h>

namespace joint_trajectory_controller
{

/// What initJointTrajectory() may be told beside the message. What is left out does not count.
template <class Trajectory>
struct InitJointTrajectoryOptions
{
  typedef realtime_tools::RealtimeServerGoalHandle<control_msgs::FollowJointTrajectoryAction> RealtimeGoalHandle;
  typedef boost::shared_ptr<RealtimeGoalHandle> RealtimeGoalHandlePtr;
  typedef typename Trajectory::value_type TrajectoryPerJoint;
  typedef typename TrajectoryPerJoint::value_type Segment;
  typedef typename Segment::Scalar Scalar;

  Trajectory* current_trajectory = nullptr;         // the motion that the message joins
  std::vector<std::string>* joint_names = nullptr;  // order of the joints in the result; else the message's
  std::vector<bool>* angle_wraparound = nullptr;    // which joints take the short way
  RealtimeGoalHandlePtr rt_goal_handle;             // whose motion it is from now on
  SegmentTolerances<Scalar>* default_tolerances = nullptr;
  ros::Time* other_time_base = nullptr;  // what the result calls the instant that is `time` for the message
  ros::Time* keep_from = nullptr;        // in that base: how far back the running motion is kept; else from other_time_base
  bool allow_partial_joints_goal = false;
  std::string name;                     // whose lines in the log these are
  std::string* error_string = nullptr;  // told why the result is empty

  void setErrorString(const std::string& msg) const
  {
    if (error_string)
      *error_string = msg;
  }
};

namespace internal
{

/// Index in t2 of each element of t1; empty if t2 lacks one.
template <class T>
inline std::vector<unsigned int> mapping(const T& t1, const T& t2)
{
  std::vector<unsigned int> indices;
  for (const auto& element : t1)
  {
    const auto found = std::find(t2.begin(), t2.end(), element);
    if (found == t2.end())
      return std::vector<unsigned int>();
    indices.push_back(static_cast<unsigned int>(std::distance(t2.begin(), found)));
  }
  return indices;
}

inline std::string list(const std::vector<std::string>& names)
{
  std::string text;
  for (const std::string& name : names)
    text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// Those of `names` that `others` has not.
inline std::vector<std::string> without(const std::vector<std::string>& names, const std::vector<std::string>& others)
{
  std::vector<std::string> rest;
  for (const std::string& name : names)
    if (std::find(others.begin(), others.end(), name) == others.end())
      rest.push_back(name);
  return rest;
}

inline std::vector<std::string> repeated(const std::vector<std::string>& names)
{
  std::vector<std::string> found;
  for (const std::string& name : names)
    if (std::count(names.begin(), names.end(), name) > 1 && std::find(found.begin(), found.end(), name) == found.end())
      found.push_back(name);
  return found;
}

/// Why a message with these names cannot be executed on these joints; nothing if it can.
/// \param partial whether fewer names than joints will do
inline std::string problemOfNames(const std::vector<std::string>& names, const std::vector<std::string>& joints, bool partial)
{
  const std::vector<std::string> unknown = without(names, joints), missing = without(joints, names), twice = repeated(names);
  std::string problem;
  if (names.empty())
    problem = "joint_names is empty, it must list " + list(joints);
  else if (!unknown.empty())
    problem = "unknown: " + list(unknown) + "; this controller moves " + list(joints);
  else if (!twice.empty())
    problem = "named more than once: " + list(twice);
  else if (!missing.empty() && !partial)
    problem = "missing: " + list(missing) + "; name them all, or set the parameter allow_partial_joints_goal";
  else
    return problem;
  return "Joints on incoming goal don't match the controller joints. " + problem;
}

/// Why a point cannot be executed; nothing if it can. \param width joints named \param length values that every point has
inline std::string problemOfPoint(std::size_t number, const trajectory_msgs::JointTrajectoryPoint& point, std::size_t width,
                                  std::size_t length)
{
  const double largest = 1e12;  // beyond it polynomials are no longer numbers
  const std::string begin = "Point " + std::to_string(number) + " has ";
  const auto count = [](const std::vector<double>& values) { return std::to_string(values.size()); };
  const std::string joints = " for " + std::to_string(width) + " joints; ";
  if (point.positions.size() != length)
    return begin + count(point.positions) + " positions" + joints + "every point needs one position per joint";
  const std::vector<double>* const groups[] = { &point.positions, &point.velocities, &point.accelerations };
  const char* const names[] = { "positions", "velocities", "accelerations" };
  for (int group = 1; group < 3; ++group)
    if (!groups[group]->empty() && groups[group]->size() != length)
      return begin + count(*groups[group]) + " " + names[group] + joints + "give one per joint or none";
  for (int group = 0; group < 3; ++group)
    for (std::size_t i = 0; i < std::min(width, groups[group]->size()); ++i)
    {
      const double value = (*groups[group])[i];
      if (!std::isfinite(value))
        return begin + names[group] + " that are not finite numbers: " + std::to_string(value);
      if (std::abs(value) > largest)
        return begin + names[group] + " beyond 1e12, which no joint can follow";
    }
  return std::string();
}

/// Why these points cannot be executed; nothing if they can. \param first the first that is not in the past
inline std::string problemOfPoints(const trajectory_msgs::JointTrajectory& msg, std::size_t first)
{
  const std::size_t width = msg.joint_names.size(), length = std::max(msg.points[first].positions.size(), width);
  for (std::size_t i = first; i < msg.points.size(); ++i)
  {
    const std::string problem = problemOfPoint(i, msg.points[i], width, length);
    if (!problem.empty())
      return problem;
  }
  if (length > width)  // once in a while: whoever streams commands sends many
    ROS_WARN_THROTTLE(5.0, "points have %d value(s) more than joints are named; the last ones are left out",
                      int(length - width));
  return std::string();
}

inline std::string problemOfTimes(const trajectory_msgs::JointTrajectory& msg)
{
  for (std::size_t i = 1; i < msg.points.size(); ++i)
    if (msg.points[i].time_from_start <= msg.points[i - 1].time_from_start)
    {
      char text[200];
      std::snprintf(text, sizeof text,
                    "Trajectory message contains waypoints that are not strictly increasing in time: point %d at "
                    "%g s follows %g s",
                    int(i), msg.points[i].time_from_start.toSec(), msg.points[i - 1].time_from_start.toSec());
      return text;
    }
  return std::string();
}

/// The state of one joint at a point. \param column its place in the message
template <class State>
inline State stateOf(const trajectory_msgs::JointTrajectoryPoint& point, std::size_t column, typename State::Scalar offset)
{
  State state;
  state.position.assign(1, point.positions[column] + offset);
  if (!point.velocities.empty())
    state.velocity.assign(1, point.velocities[column]);
  if (!point.accelerations.empty())
    state.acceleration.assign(1, point.accelerations[column]);
  state.time_from_start = point.time_from_start.toSec();
  return state;
}

/// The running motion of a joint from one instant on to another, both included; all that follows, for an end before the beginning.
template <class Trajectory>
inline Trajectory kept(const Trajectory& running, double from, double to)
{
  auto first = trajectory_interface::findSegment(running, from);
  if (first == running.end())
    first = running.begin();
  auto last = to < from ? running.end() : trajectory_interface::findSegment(running, to);
  if (to >= from)
    last = last == running.end() || last < first ? std::next(first) : std::next(last);
  return Trajectory(first, last);
}

/// A message on its way to becoming segments.
template <class Trajectory>
class Splice
{
  typedef typename Trajectory::value_type TrajectoryPerJoint;
  typedef typename TrajectoryPerJoint::value_type Segment;
  typedef typename Segment::State State;
  typedef typename Segment::Scalar Scalar;
  typedef InitJointTrajectoryOptions<Trajectory> Options;

public:
  Splice(const trajectory_msgs::JointTrajectory& msg, const ros::Time& time, const Options& options)
    : msg_(msg)
    , options_(options)
    , prefix_(options.name.empty() ? std::string() : options.name + ": ")
    , joints_(options.joint_names && !options.joint_names->empty() ? *options.joint_names : msg.joint_names)
    , joins_(options.current_trajectory && !options.current_trajectory->empty())
    , wraps_(options.angle_wraparound && !options.angle_wraparound->empty())
    , elapsed_((time - startTime(msg, time)).toSec())
    , now_((options.other_time_base ? *options.other_time_base : time).toSec())
  {
  }

  /// \return false: the message cannot be executed; the log and the options' error_string say why
  bool check()
  {
    if (msg_.points.empty())
    {
      options_.setErrorString("Trajectory message contains empty trajectory. Nothing to convert.");
      return false;
    }
    std::string problem = problemOfTimes(msg_);
    if (problem.empty())
      problem = problemOfNames(msg_.joint_names, joints_, options_.allow_partial_joints_goal);
    if (problem.empty() && wraps_ && options_.angle_wraparound->size() != joints_.size())
      problem = "Cannot create trajectory from message. Vector specifying whether joints wrap around has an invalid size.";
    if (problem.empty() && joins_ && options_.current_trajectory->size() != joints_.size())
      problem = "Cannot create trajectory from message. The current trajectory is of another number of joints.";
    if (!problem.empty())
      return refuse(problem);
    if (!find())
      return false;
    problem = problemOfPoints(msg_, first_);
    if (!problem.empty())
      return refuse(problem);
    // a first point at 0 s that starts at once says where the motion begins: nobody misses it
    if (first_ > (msg_.header.stamp.isZero() && msg_.points.front().time_from_start.isZero() ? 1u : 0u))
      ROS_WARN("%sDropping first %d trajectory point(s) out of %d, as they occur before the current time.", prefix_.c_str(),
               int(first_), int(msg_.points.size()));
    return true;
  }

  /// All joints, after check().
  Trajectory segments()
  {
    SegmentTolerances<Scalar> limits =
        options_.default_tolerances ? *options_.default_tolerances : SegmentTolerances<Scalar>(joints_.size());
    if (options_.rt_goal_handle && options_.rt_goal_handle->gh_.getGoal())
      updateSegmentTolerances<Scalar>(*options_.rt_goal_handle->gh_.getGoal(), joints_, limits);
    Trajectory all(joints_.size());
    for (std::size_t joint = 0; joint < joints_.size(); ++joint)
    {
      limits_.state_tolerance = limits.state_tolerance[joint];
      limits_.goal_state_tolerance = limits.goal_state_tolerance[joint];
      limits_.goal_time_tolerance = limits.goal_time_tolerance;
      extend(joint, all[joint]);
    }
    return all;
  }

private:
  bool refuse(const std::string& problem)
  {
    options_.setErrorString(problem);
    ROS_ERROR_STREAM(prefix_ << problem);
    return false;
  }

  /// The first point that is not in the past. \return false: there is none, which is no fault: whoever streams commands is late at times
  bool find()
  {
    while (first_ < msg_.points.size() && law::has_passed(msg_.points[first_].time_from_start.toSec(), elapsed_))
      ++first_;
    if (first_ < msg_.points.size())
      return true;
    const std::string problem =
        "Dropping all " + std::to_string(first_) + " trajectory points, as they occur before the current time. Last point is " +
        std::to_string(elapsed_ - msg_.points.back().time_from_start.toSec()) +
        "s in the past; give points a time_from_start after the start of motion, and a header.stamp of 0 to start at once.";
    options_.setErrorString(problem);
    ROS_WARN_STREAM(prefix_ << problem);
    return false;
  }

  /// One joint: what is kept of its motion, the bridge, the rest of the message. A goal has the motion of joints that it does not name
  /// at once; of the others what begins with it, as a tolerance that is broken before is no fault of its own.
  void extend(std::size_t joint, TrajectoryPerJoint& segments)
  {
    const auto name = std::find(msg_.joint_names.begin(), msg_.joint_names.end(), joints_[joint]);
    const bool named = name != msg_.joint_names.end();
    const std::size_t column = std::distance(msg_.joint_names.begin(), name);
    const double join = law::joining_time(now_ - elapsed_, now_),
                 from = options_.keep_from ? options_.keep_from->toSec() : now_;
    if (joins_)
      segments = kept((*options_.current_trajectory)[joint], from, named ? join : from - 1.0);
    if (!named)
    {
      for (Segment& segment : segments)
        segment.setGoalHandle(options_.rt_goal_handle);
      return;
    }
    Scalar offset = 0;
    if (joins_)
    {
      State begin(1u);
      segments.back().sample(join, begin);
      begin.time_from_start = 0;
      if (wraps_)
        offset = wraparoundJointOffset(begin.position[0], Scalar(msg_.points[first_].positions[column]),
                                       (*options_.angle_wraparound)[joint]);
      add(segments, join, begin, first_, column, offset);
    }
    for (std::size_t i = first_; i + 1 < msg_.points.size(); ++i)
      add(segments, when(i), stateOf<State>(msg_.points[i], column, offset), i + 1, column, offset);
  }

  void add(TrajectoryPerJoint& segments, double from, const State& begin, std::size_t to, std::size_t column, Scalar offset)
  {
    segments.push_back(Segment(from, begin, when(to), stateOf<State>(msg_.points[to], column, offset)));
    segments.back().setGoalHandle(options_.rt_goal_handle);
    segments.back().setTolerances(limits_);
  }

  double when(std::size_t point) const { return now_ - elapsed_ + msg_.points[point].time_from_start.toSec(); }

  const trajectory_msgs::JointTrajectory& msg_;
  const Options& options_;
  const std::string prefix_;
  const std::vector<std::string>& joints_;
  const bool joins_, wraps_;
  const double elapsed_;  // since the message began; negative: it will begin
  const double now_;      // in the time base of the result
  std::size_t first_ = 0;
  SegmentTolerancesPerJoint<Scalar> limits_;  // of the joint that is extended
};

}  // namespace internal

/// The motion that a message asks for; empty if it cannot be executed: the log and options.error_string say why.
///
/// With a current trajectory, that one runs on until the message begins, or until `time`; a bridge then leads from the desired state
/// there to the first point that is not in the past. Joints that the message does not name keep their motion. Points of
/// unequal sizes throw nothing, unlike upstream's: the result is empty, as for all else.
/// \param time the earliest instant at which the message can begin
template <class Trajectory>
Trajectory initJointTrajectory(const trajectory_msgs::JointTrajectory& msg, const ros::Time& time,
                               const InitJointTrajectoryOptions<Trajectory>& options = InitJointTrajectoryOptions<Trajectory>())
{
  typedef typename Trajectory::value_type TrajectoryPerJoint;
  internal::Splice<Trajectory> splice(msg, time, options);
  if (!splice.check())
    return Trajectory();
  const Trajectory all = splice.segments();
  const bool something =
      std::any_of(all.begin(), all.end(), [](const TrajectoryPerJoint& segments) { return !segments.empty(); });
  return something ? all : Trajectory();
}

}  // namespace joint_trajectory_controller

// The commands of JointTrajectoryController, in threads of roscpp. Included by joint_trajectory_controller_impl.h.
#pragma once

namespace joint_trajectory_controller
{

namespace internal
{

/// Why a goal's tolerances cannot be taken; nothing if they can.
inline std::string problemOfTolerances(const control_msgs::FollowJointTrajectoryGoal& goal)
{
  const auto check = [](const char* kind, const std::vector<control_msgs::JointTolerance>& tolerances) {
    for (const control_msgs::JointTolerance& tolerance : tolerances)
      if (std::isnan(tolerance.position) || std::isnan(tolerance.velocity) || std::isnan(tolerance.acceleration))
        return std::string(kind) + "_tolerance of joint '" + tolerance.name + "' is NaN; use -1 to switch it off";
    return std::string();
  };
  const std::string path = check("path", goal.path_tolerance);
  return path.empty() ? check("goal", goal.goal_tolerance) : path;
}

}  // namespace internal

JOINT_TRAJECTORY_CONTROLLER(bool)::updateTrajectoryCommand(const JointTrajectoryConstPtr& msg, RealtimeGoalHandlePtr gh,
                                                           std::string* error_string)
{
  const std::lock_guard<std::recursive_mutex> locked(lock_);
  const auto refuse = [&](const std::string& why) {
    ROS_ERROR("%s: %s", name_.c_str(), why.c_str());
    if (error_string)
      *error_string = why;
    return false;
  };
  if (!this->isRunning())
    return refuse(std::string("Can't accept new ") + (gh ? "action goals" : "commands") +
                  ". Controller is not running; start it first");
  if (!msg)
    return refuse("Received null-pointer trajectory message, skipping.");
  if (!known_)  // an update() of a derived class does not ask again
    known_ = rest(time_data_.readFromRT()->uptime);
  if (!known_)
    return refuse("The hardware has not reported where the joints are yet");
  TimeData* const last = time_data_.readFromRT();
  if (msg->points.empty())
  {
    setHoldPosition(last->uptime, gh);
    return true;
  }

  TrajectoryPtr running;
  curr_trajectory_box_.get(running);
  ros::Time next_uptime = last->uptime + last->period;
  InitJointTrajectoryOptions<Trajectory> options;
  options.current_trajectory = running.get();
  options.joint_names = &joint_names_;
  options.angle_wraparound = &angle_wraparound_;
  options.rt_goal_handle = gh;
  options.default_tolerances = &default_tolerances_;
  options.other_time_base = &next_uptime;
  options.keep_from = &last->uptime;
  options.allow_partial_joints_goal = allow_partial_joints_goal_;
  options.name = name_;
  options.error_string = error_string;
  try
  {
    const TrajectoryPtr joined =
        std::make_shared<Trajectory>(initJointTrajectory<Trajectory>(*msg, last->time + last->period, options));
    if (joined->empty())
      return false;
    curr_trajectory_box_.set(joined);
  }
  catch (const std::exception& error)
  {
    return refuse(error.what());
  }
  return true;
}

JOINT_TRAJECTORY_CONTROLLER(void)::trajectoryCommandCB(const JointTrajectoryConstPtr& msg)
{
  const std::lock_guard<std::recursive_mutex> locked(lock_);
  if (updateTrajectoryCommand(msg, RealtimeGoalHandlePtr()))
    preemptActiveGoal();
}

JOINT_TRAJECTORY_CONTROLLER(void)::goalCB(GoalHandle gh)
{
  typedef control_msgs::FollowJointTrajectoryResult Result;
  const std::lock_guard<std::recursive_mutex> locked(lock_);
  const auto reject = [&gh](int code, const std::string& why) {
    Result result;
    result.error_code = code;
    result.error_string = why;
    gh.setRejected(result, why);
  };
  const auto asked = gh.getGoal();
  std::string problem = internal::problemOfNames(asked->trajectory.joint_names, joint_names_, allow_partial_joints_goal_);
  if (this->isRunning() && !problem.empty())
  {
    ROS_ERROR("%s: %s", name_.c_str(), problem.c_str());
    return reject(Result::INVALID_JOINTS, problem);
  }
  problem = internal::problemOfTolerances(*asked);
  const RealtimeGoalHandlePtr goal(new RealtimeGoalHandle(gh));
  goal->preallocated_feedback_->joint_names = joint_names_;
  // an alias of the goal's pointer: its trajectory lives as long as the goal
  if (!problem.empty() || !updateTrajectoryCommand(JointTrajectoryConstPtr(asked, &asked->trajectory), goal, &problem))
    return reject(Result::INVALID_GOAL, problem);
  preemptActiveGoal();
  gh.setAccepted();
  rt_active_goal_ = goal;
  successful_joint_traj_.reset();
  monitored_goal_ = goal;
}

/// Feedback of the last goal, and the result that an update() of a derived class has left for it.
JOINT_TRAJECTORY_CONTROLLER(void)::monitorGoal(const ros::TimerEvent& event)
{
  const std::lock_guard<std::recursive_mutex> locked(lock_);
  if (monitored_goal_)
    monitored_goal_->runNonRealtime(event);
}

JOINT_TRAJECTORY_CONTROLLER(void)::cancelCB(GoalHandle gh)
{
  const std::lock_guard<std::recursive_mutex> locked(lock_);
  const RealtimeGoalHandlePtr goal = rt_active_goal_;
  if (!goal || !(goal->gh_ == gh))
    return;
  rt_active_goal_.reset();
  setHoldPosition(time_data_.readFromRT()->uptime);
  goal->gh_.setCanceled();
}

JOINT_TRAJECTORY_CONTROLLER(void)::preemptActiveGoal()
{
  const std::lock_guard<std::recursive_mutex> locked(lock_);
  const RealtimeGoalHandlePtr goal = rt_active_goal_;
  if (!goal)
    return;
  rt_active_goal_.reset();
  goal->gh_.setCanceled();
}

JOINT_TRAJECTORY_CONTROLLER(bool)::queryStateService(control_msgs::QueryTrajectoryState::Request& req,
                                                     control_msgs::QueryTrajectoryState::Response& resp)
{
  const std::lock_guard<std::recursive_mutex> locked(lock_);
  if (!this->isRunning())
  {
    ROS_ERROR("%s: Can't sample trajectory. Controller is not running.", name_.c_str());
    return false;
  }
  const TimeData* const last = time_data_.readFromRT();
  const double when = last->uptime.toSec() + (req.time - last->time).toSec();
  TrajectoryPtr trajectory;
  curr_trajectory_box_.get(trajectory);
  typename Segment::State state(1u);
  for (const TrajectoryPerJoint& segments : *trajectory)
  {
    if (sample(segments, when, state) == segments.end())
    {
      ROS_ERROR("%s: Requested sample time precedes trajectory start time: %.3f s", name_.c_str(), req.time.toSec());
      return false;
    }
    resp.position.push_back(state.position[0]);
    resp.velocity.push_back(state.velocity[0]);
    resp.acceleration.push_back(state.acceleration[0]);
  }
  resp.name = joint_names_;
  return true;
}

}  // namespace joint_trajectory_controller

// The commands of JointTrajectoryController, in threads of roscpp. Included by joint_trajectory_controller_impl.h.
#pragma once

namespace joint_trajectory_controller
{

namespace internal
{

template <class Lock, class Value>
Value read(Lock& lock, const Value& value)
{
  const std::lock_guard<Lock> locked(lock);
  return value;
}

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

/// \return why no command is taken now; nothing if one is, and *now is set
JOINT_TRAJECTORY_CONTROLLER(std::string)::look(bool is_goal, Moment* now)
{
  const std::lock_guard<std::recursive_mutex> locked(lock_);
  if (!this->isRunning())
    return std::string("Can't accept new ") + (is_goal ? "action goals" : "commands") +
           ". Controller is not running; start it first";
  now->last = *time_data_.readFromRT();
  if (!known_)  // an update() of a derived class does not ask again
    known_ = rest(now->last.uptime);
  if (!known_)
    return "The hardware has not reported where the joints are yet";
  curr_trajectory_box_.get(now->running);
  return std::string();
}

JOINT_TRAJECTORY_CONTROLLER(typename JointTrajectoryController<SegmentImpl, HardwareInterface>::TrajectoryPtr)::join(
    const trajectory_msgs::JointTrajectory& msg, Moment& now, const RealtimeGoalHandlePtr& gh, std::string* error_string)
{
  ros::Time next_uptime = now.last.uptime + now.last.period;
  InitJointTrajectoryOptions<Trajectory> options;
  options.current_trajectory = now.running.get();
  options.joint_names = &joint_names_;
  options.angle_wraparound = &angle_wraparound_;
  options.rt_goal_handle = gh;
  options.default_tolerances = &default_tolerances_;
  options.other_time_base = &next_uptime;
  options.keep_from = &now.last.uptime;
  options.allow_partial_joints_goal = allow_partial_joints_goal_;
  options.name = name_;
  options.error_string = error_string;
  return std::make_shared<Trajectory>(initJointTrajectory<Trajectory>(msg, now.last.time + now.last.period, options));
}

/// \return false: `running` is not what is followed any more
JOINT_TRAJECTORY_CONTROLLER(bool)::replace(const TrajectoryPtr& running, const TrajectoryPtr& joined)
{
  const std::lock_guard<std::recursive_mutex> locked(lock_);
  TrajectoryPtr current;
  curr_trajectory_box_.get(current);
  if (current != running)
    return false;
  curr_trajectory_box_.set(joined);
  between_goals_ = commanding_;
  return true;
}

JOINT_TRAJECTORY_CONTROLLER(bool)::updateTrajectoryCommand(const JointTrajectoryConstPtr& msg, RealtimeGoalHandlePtr gh,
                                                           std::string* error_string)
{
  const std::lock_guard<std::recursive_mutex> one_at_a_time(commands_lock_);
  const auto refuse = [&](const std::string& why) {
    ROS_ERROR("%s: %s", name_.c_str(), why.c_str());
    if (error_string)
      *error_string = why;
    return false;
  };
  Moment now;
  TrajectoryPtr joined;
  do  // again if update() has stopped the joints meanwhile
  {
    const std::string problem = look(bool(gh), &now);
    if (!problem.empty())
      return refuse(problem);
    if (!msg)
      return refuse("Received null-pointer trajectory message, skipping.");
    if (msg->points.empty())
    {
      const std::lock_guard<std::recursive_mutex> locked(lock_);
      setHoldPosition(time_data_.readFromRT()->uptime, gh);
      between_goals_ = commanding_;
      return true;
    }
    try
    {
      joined = join(*msg, now, gh, error_string);
    }
    catch (const std::exception& error)
    {
      return refuse(error.what());
    }
    if (joined->empty())
      return false;
  } while (!replace(now.running, joined));
  return true;
}

/// From now on the active goal is this one, or none. \return false: the controller was stopped since
JOINT_TRAJECTORY_CONTROLLER(bool)::follow(const RealtimeGoalHandlePtr& goal, unsigned int stops)
{
  const std::lock_guard<std::recursive_mutex> locked(lock_);
  between_goals_ = false;
  if (stops_ != stops)
    return false;
  rt_active_goal_ = goal;
  successful_joint_traj_.reset();
  return true;
}

/// A derived class may refuse what this one has taken already.
JOINT_TRAJECTORY_CONTROLLER(void)::judgeAgain()
{
  const std::lock_guard<std::recursive_mutex> locked(lock_);
  between_goals_ = false;
}

JOINT_TRAJECTORY_CONTROLLER(void)::trajectoryCommandCB(const JointTrajectoryConstPtr& msg)
{
  const std::lock_guard<std::recursive_mutex> one_at_a_time(commands_lock_);
  commanding_ = true;
  const unsigned int stops = internal::read(lock_, stops_);
  if (updateTrajectoryCommand(msg, RealtimeGoalHandlePtr()))
  {
    preemptActiveGoal();
    follow(RealtimeGoalHandlePtr(), stops);
  }
  commanding_ = false;
  judgeAgain();
}

JOINT_TRAJECTORY_CONTROLLER(void)::goalCB(GoalHandle gh)
{
  typedef control_msgs::FollowJointTrajectoryResult Result;
  const std::lock_guard<std::recursive_mutex> one_at_a_time(commands_lock_);
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
  const unsigned int stops = internal::read(lock_, stops_);
  commanding_ = true;
  // an alias of the goal's pointer: its trajectory lives as long as the goal
  const bool taken =
      problem.empty() && updateTrajectoryCommand(JointTrajectoryConstPtr(asked, &asked->trajectory), goal, &problem);
  commanding_ = false;
  if (!taken)
  {
    judgeAgain();
    return reject(Result::INVALID_GOAL, problem);
  }
  preemptActiveGoal();
  gh.setAccepted();
  if (follow(goal, stops))
    monitored_goal_ = goal;
  else
    gh.setCanceled();
}

/// Feedback of the last goal, and the result that an update() of a derived class has left for it.
JOINT_TRAJECTORY_CONTROLLER(void)::monitorGoal(const ros::TimerEvent& event)
{
  const std::lock_guard<std::recursive_mutex> one_at_a_time(commands_lock_);
  const std::lock_guard<std::mutex> sending(feedback_lock_);
  if (monitored_goal_)
    monitored_goal_->runNonRealtime(event);
}

JOINT_TRAJECTORY_CONTROLLER(void)::cancelCB(GoalHandle gh)
{
  const std::lock_guard<std::recursive_mutex> one_at_a_time(commands_lock_);
  RealtimeGoalHandlePtr goal;
  {
    const std::lock_guard<std::recursive_mutex> locked(lock_);
    if (!rt_active_goal_ || !(rt_active_goal_->gh_ == gh))
      return;
    goal.swap(rt_active_goal_);
    setHoldPosition(time_data_.readFromRT()->uptime);
  }
  goal->gh_.setCanceled();
}

JOINT_TRAJECTORY_CONTROLLER(void)::preemptActiveGoal()
{
  RealtimeGoalHandlePtr goal;
  {
    const std::lock_guard<std::recursive_mutex> locked(lock_);
    goal.swap(rt_active_goal_);
  }
  if (goal)
    goal->gh_.setCanceled();
}

JOINT_TRAJECTORY_CONTROLLER(bool)::queryStateService(control_msgs::QueryTrajectoryState::Request& req,
                                                     control_msgs::QueryTrajectoryState::Response& resp)
{
  Moment now;
  {
    const std::lock_guard<std::recursive_mutex> locked(lock_);
    if (!this->isRunning())
    {
      ROS_ERROR("%s: Can't sample trajectory. Controller is not running.", name_.c_str());
      return false;
    }
    now.last = *time_data_.readFromRT();
    curr_trajectory_box_.get(now.running);
  }
  const double when = now.last.uptime.toSec() + (req.time - now.last.time).toSec();
  typename Segment::State state(1u);
  for (const TrajectoryPerJoint& segments : *now.running)
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

// What joint_trajectory_controller.h declares.
#pragma once

#include <algorithm>
#include <cmath>

namespace joint_trajectory_controller
{

namespace internal
{

/// A rate in Hz. \return 0: the log says why
inline double rateParameter(const ros::NodeHandle& nh, const char* name, double usual)
{
  const double rate = nh.param(name, usual);
  if (rate > 0.0 && std::isfinite(rate))
    return rate;
  ROS_ERROR("parameter %s must be a positive number of Hz, it is %g", nh.resolveName(name).c_str(), rate);
  return 0.0;
}

/// What the topic state and an action's feedback tell alike. \param message its vectors have their lengths already
template <class Message, class State>
inline void fill(Message& message, const ros::Time& stamp, const State& desired, const State& actual, const State& error)
{
  message.header.stamp = stamp;
  message.desired.positions = desired.position;
  message.desired.velocities = desired.velocity;
  message.desired.accelerations = desired.acceleration;
  message.desired.time_from_start = ros::Duration(desired.time_from_start);
  message.actual.positions = actual.position;
  message.actual.velocities = actual.velocity;
  message.actual.time_from_start = ros::Duration(actual.time_from_start);
  message.error.positions = error.position;
  message.error.velocities = error.velocity;
  message.error.time_from_start = ros::Duration(error.time_from_start);
}

}  // namespace internal

#define JOINT_TRAJECTORY_CONTROLLER(...)                \
  template <class SegmentImpl, class HardwareInterface> \
  __VA_ARGS__ JointTrajectoryController<SegmentImpl, HardwareInterface>

// -- life-cycle ----------------------------------------------------------------------------------------------------------

template <class SegmentImpl, class HardwareInterface>
JointTrajectoryController<SegmentImpl, HardwareInterface>::~JointTrajectoryController()
{
  // Nothing must call back any more when the members go.
  trajectory_command_sub_.shutdown();
  query_state_service_.shutdown();
  goal_handle_timer_.stop();
  action_server_.reset();
}

JOINT_TRAJECTORY_CONTROLLER(bool)::init(HardwareInterface* hw, ros::NodeHandle& root_nh, ros::NodeHandle& controller_nh)
{
  controller_nh_ = controller_nh;
  const std::string whole = controller_nh_.getNamespace();
  name_ = whole.substr(whole.find_last_of('/') + 1);
  if (!readParameters() || !readJoints(hw, root_nh) || !hw_iface_adapter_.init(joints_, controller_nh_))
    return false;

  const unsigned int n = getNumberOfJoints();
  current_state_ = desired_state_ = old_desired_state_ = state_error_ = typename Segment::State(n);
  desired_joint_state_ = state_joint_error_ = typename Segment::State(1u);
  successful_joint_traj_ = boost::dynamic_bitset<>(n);
  hold_trajectory_ptr_ = createHoldTrajectory(n);
  curr_trajectory_box_.set(hold_trajectory_ptr_);
  if (stop_trajectory_duration_ == 0)
    hold_traj_builder_.reset(new HoldTrajectoryBuilder<SegmentImpl, HardwareInterface>(joints_));
  else
    hold_traj_builder_.reset(new StopTrajectoryBuilder<SegmentImpl>(stop_trajectory_duration_, desired_state_));
  advertise();
  return true;
}

JOINT_TRAJECTORY_CONTROLLER(bool)::readParameters()
{
  const double state_rate = internal::rateParameter(controller_nh_, "state_publish_rate", 50.0);
  const double monitor_rate = internal::rateParameter(controller_nh_, "action_monitor_rate", 20.0);
  if (state_rate == 0.0 || monitor_rate == 0.0)
    return false;
  state_publisher_period_ = ros::Duration(1.0 / state_rate);
  action_monitor_period_ = ros::Duration(1.0 / monitor_rate);
  stop_trajectory_duration_ = controller_nh_.param("stop_trajectory_duration", 0.0);
  if (!(stop_trajectory_duration_ >= 0.0) || !std::isfinite(stop_trajectory_duration_))
  {
    ROS_ERROR("parameter %s must not be negative, it is %g", controller_nh_.resolveName("stop_trajectory_duration").c_str(),
              double(stop_trajectory_duration_));
    return false;
  }
  allow_partial_joints_goal_ = controller_nh_.param("allow_partial_joints_goal", false);
  if (!controller_nh_.getParam("joints", joint_names_) || joint_names_.empty())
  {
    ROS_ERROR("parameter %s must be a list of names of joints", controller_nh_.resolveName("joints").c_str());
    return false;
  }
  const std::vector<std::string> twice = internal::repeated(joint_names_);
  if (!twice.empty())
    ROS_ERROR("parameter %s names %s more than once", controller_nh_.resolveName("joints").c_str(),
              internal::list(twice).c_str());
  default_tolerances_ = getSegmentTolerances<Scalar>(ros::NodeHandle(controller_nh_, "constraints"), joint_names_);
  return twice.empty();
}

JOINT_TRAJECTORY_CONTROLLER(bool)::readJoints(HardwareInterface* hw, const ros::NodeHandle& root_nh)
{
  const std::string name = root_nh.resolveName("robot_description");
  std::string text;
  urdf::Model robot;
  // of the robot, or else of all robots
  if (!root_nh.getParam(name, text) && !root_nh.getParam("/robot_description", text))
  {
    ROS_ERROR("%s: there is no URDF in the parameter %s", name_.c_str(), name.c_str());
    return false;
  }
  if (!robot.initString(text))
  {
    ROS_ERROR("%s: the URDF in the parameter %s cannot be read; the lines above say why", name_.c_str(), name.c_str());
    return false;
  }
  joints_.clear();
  angle_wraparound_.clear();
  angular_.clear();
  for (const std::string& joint : joint_names_)
  {
    const urdf::JointConstSharedPtr described = robot.getJoint(joint);
    if (!described)
    {
      ROS_ERROR("%s: Could not find joint '%s' in URDF model.", name_.c_str(), joint.c_str());
      return false;
    }
    try
    {
      joints_.push_back(hw->getHandle(joint));
    }
    catch (const std::exception& error)
    {
      ROS_ERROR("%s: Could not find joint '%s' in '%s': %s", name_.c_str(), joint.c_str(),
                this->getHardwareInterfaceType().c_str(), error.what());
      return false;
    }
    angle_wraparound_.push_back(described->type == urdf::Joint::CONTINUOUS);
    angular_.push_back(described->type != urdf::Joint::PRISMATIC);
  }
  return true;
}

JOINT_TRAJECTORY_CONTROLLER(void)::advertise()
{
  const std::size_t n = getNumberOfJoints();
  state_publisher_.reset(new StatePublisher(controller_nh_, "state", 1));
  control_msgs::JointTrajectoryControllerState& state = state_publisher_->msg_;
  state.joint_names = joint_names_;
  for (std::vector<double>* values :
       { &state.desired.positions, &state.desired.velocities, &state.desired.accelerations, &state.actual.positions,
         &state.actual.velocities, &state.error.positions, &state.error.velocities })
    values->resize(n);
  trajectory_command_sub_ = controller_nh_.subscribe("command", 1, &JointTrajectoryController::trajectoryCommandCB, this);
  action_server_ = std::make_shared<ActionServer>(
      controller_nh_, "follow_joint_trajectory", [this](GoalHandle goal) { goalCB(goal); },
      [this](GoalHandle goal) { cancelCB(goal); }, false);
  action_server_->start();
  // One for all goals: to replace it would mean to wait for its callback.
  goal_handle_timer_ = controller_nh_.createTimer(action_monitor_period_, &JointTrajectoryController::monitorGoal, this);
  query_state_service_ = controller_nh_.advertiseService("query_state", &JointTrajectoryController::queryStateService, this);
}

JOINT_TRAJECTORY_CONTROLLER(void)::starting(const ros::Time& time)
{
  const std::lock_guard<std::recursive_mutex> locked(lock_);
  TimeData now;
  now.time = time;
  time_data_.initRT(now);
  old_time_data_ = now;
  last_state_publish_time_ = now.uptime;
  for (unsigned int i = 0; i < getNumberOfJoints(); ++i)
  {
    desired_state_.position[i] = joints_[i].getPosition();
    desired_state_.velocity[i] = desired_state_.acceleration[i] = 0.0;
  }
  known_ = rest(now.uptime);
  if (!known_)
    ROS_ERROR("%s: the hardware reports no position for some of its joints yet; waiting for it before moving", name_.c_str());
  hw_iface_adapter_.starting(now.uptime);
}

JOINT_TRAJECTORY_CONTROLLER(void)::stopping(const ros::Time& /*time*/)
{
  const std::lock_guard<std::recursive_mutex> locked(lock_);
  ++stops_;
  preemptActiveGoal();
}

// -- the loop ------------------------------------------------------------------------------------------------------------

JOINT_TRAJECTORY_CONTROLLER(void)::update(const ros::Time& time, const ros::Duration& period)
{
  const std::lock_guard<std::recursive_mutex> locked(lock_);
  old_time_data_ = *time_data_.readFromRT();
  TimeData now;
  now.time = time;
  now.period = period;
  now.uptime = old_time_data_.uptime + period;
  time_data_.writeFromNonRT(now);
  if (!known_)
    known_ = rest(now.uptime);
  if (!known_)
    return;

  TrajectoryPtr trajectory;
  curr_trajectory_box_.get(trajectory);
  updateStates(now.uptime, trajectory.get());
  if (rt_active_goal_ && !between_goals_ && supervise(*trajectory, now.uptime.toSec()) && successful_joint_traj_.all())
  {
    const RealtimeGoalHandlePtr goal = rt_active_goal_;
    rt_active_goal_.reset();
    successful_joint_traj_.reset();
    goal->preallocated_result_->error_code = control_msgs::FollowJointTrajectoryResult::SUCCESSFUL;
    goal->setSucceeded(goal->preallocated_result_);
    goal->runNonRealtime(ros::TimerEvent());  // at once: a simulation may stand still before the timer is due
  }
  updateFuncExtensionPoint(*trajectory, now);
  hw_iface_adapter_.updateCommand(now.uptime, now.period, desired_state_, state_error_);
  setActionFeedback();
  publishState(now.uptime);
}

JOINT_TRAJECTORY_CONTROLLER(void)::updateStates(const ros::Time& sample_time, const Trajectory* const traj)
{
  const double now = sample_time.toSec();
  old_desired_state_ = desired_state_;
  for (unsigned int i = 0; i < getNumberOfJoints(); ++i)
  {
    const auto segment = sample((*traj)[i], now, desired_joint_state_);
    const double position = joints_[i].getPosition(), velocity = joints_[i].getVelocity();
    current_state_.position[i] = position;
    current_state_.velocity[i] = velocity;
    desired_state_.position[i] = desired_joint_state_.position[0];
    desired_state_.velocity[i] = desired_joint_state_.velocity[0];
    desired_state_.acceleration[i] = desired_joint_state_.acceleration[0];
    state_error_.position[i] = law::position_error(position, desired_joint_state_.position[0], angular_[i]);
    state_error_.velocity[i] = desired_joint_state_.velocity[0] - velocity;
    state_error_.acceleration[i] = 0.0;  // accelerations are not measured
    if (i == 0 && segment != (*traj)[i].end())
    {
      desired_state_.time_from_start = segment->timeFromStart();
      current_state_.time_from_start = segment->timeFromStart() + now - segment->startTime();
      state_error_.time_from_start = desired_state_.time_from_start - current_state_.time_from_start;
    }
  }
}

/// Which joints are at the active goal. \return false: it was aborted
JOINT_TRAJECTORY_CONTROLLER(bool)::supervise(const Trajectory& trajectory, double uptime)
{
  typedef control_msgs::FollowJointTrajectoryResult Result;
  for (unsigned int i = 0; i < getNumberOfJoints(); ++i)
  {
    const auto segment = trajectory_interface::findSegment(trajectory[i], uptime);
    if (segment == trajectory[i].end() || segment->getGoalHandle() != rt_active_goal_)
      continue;
    const SegmentTolerancesPerJoint<Scalar>& limits = segment->getTolerances();
    const bool under_way = uptime < segment->endTime();
    if (!under_way && std::next(segment) != trajectory[i].end())
      continue;
    if (internal::within(state_error_, i, under_way ? limits.state_tolerance : limits.goal_state_tolerance))
    {
      if (!under_way)
        successful_joint_traj_.set(i);
      continue;
    }
    if (!under_way && (successful_joint_traj_[i] || uptime < segment->endTime() + limits.goal_time_tolerance))
      continue;
    const char* const phase = under_way ? "path" : "goal";
    abort(under_way ? int(Result::PATH_TOLERANCE_VIOLATED) : int(Result::GOAL_TOLERANCE_VIOLATED),
          joint_names_[i] + " " + phase + " error " + std::to_string(state_error_.position[i]) + ": " +
              internal::violation(state_error_, i, under_way ? limits.state_tolerance : limits.goal_state_tolerance));
    return false;
  }
  return true;
}

/// End the active goal, and stop the joints where they are, from the next cycle on: what was desired proved out of reach.
JOINT_TRAJECTORY_CONTROLLER(void)::abort(int code, const std::string& why)
{
  const RealtimeGoalHandlePtr goal = rt_active_goal_;
  rt_active_goal_.reset();
  successful_joint_traj_.reset();
  const ros::Time uptime = time_data_.readFromRT()->uptime;
  if (!rest(uptime))
    setHoldPosition(uptime);
  goal->preallocated_result_->error_code = code;
  goal->preallocated_result_->error_string = why;
  goal->setAborted(goal->preallocated_result_);
  goal->runNonRealtime(ros::TimerEvent());
}

/// Be at rest where the joints are. \return false: the hardware does not say where that is
JOINT_TRAJECTORY_CONTROLLER(bool)::rest(const ros::Time& uptime)
{
  const TrajectoryPtr trajectory = createHoldTrajectory(getNumberOfJoints());
  HoldTrajectoryBuilder<SegmentImpl, HardwareInterface> builder(joints_);
  if (!builder.setStartTime(uptime.toSec())->buildTrajectory(trajectory.get()))
    return false;
  hold_trajectory_ptr_ = trajectory;
  curr_trajectory_box_.set(trajectory);
  return true;
}

JOINT_TRAJECTORY_CONTROLLER(void)::setHoldPosition(const ros::Time& time, RealtimeGoalHandlePtr gh)
{
  const std::lock_guard<std::recursive_mutex> locked(lock_);
  // A new one each time: the loop of a derived class may be reading the last.
  const TrajectoryPtr trajectory = createHoldTrajectory(getNumberOfJoints());
  const bool done = hold_traj_builder_->setStartTime(time.toSec())->setGoalHandle(gh)->buildTrajectory(trajectory.get());
  hold_traj_builder_->reset();
  if (!done)  // the hardware does not say where the joints are
    StopTrajectoryBuilder<SegmentImpl>(stop_trajectory_duration_, desired_state_)
        .setStartTime(time.toSec())
        ->setGoalHandle(gh)
        ->buildTrajectory(trajectory.get());
  for (unsigned int i = 0; i < getNumberOfJoints(); ++i)
  {
    SegmentTolerancesPerJoint<Scalar> limits;
    limits.state_tolerance = default_tolerances_.state_tolerance[i];
    limits.goal_state_tolerance = default_tolerances_.goal_state_tolerance[i];
    limits.goal_time_tolerance = default_tolerances_.goal_time_tolerance;
    (*trajectory)[i].front().setTolerances(limits);
  }
  hold_trajectory_ptr_ = trajectory;
  curr_trajectory_box_.set(trajectory);
}

JOINT_TRAJECTORY_CONTROLLER(typename JointTrajectoryController<SegmentImpl, HardwareInterface>::TrajectoryPtr)::
    createHoldTrajectory(const unsigned int& number_of_joints)
{
  const typename Segment::State zero(1u);
  return std::make_shared<Trajectory>(number_of_joints, TrajectoryPerJoint(1, Segment(0.0, zero, 0.0, zero)));
}

JOINT_TRAJECTORY_CONTROLLER(void)::publishState(const ros::Time& time)
{
  if (time < last_state_publish_time_ + state_publisher_period_ || !state_publisher_->trylock())
    return;
  // on a grid, and not to catch up what was missed
  last_state_publish_time_ = std::max(last_state_publish_time_ + state_publisher_period_, time - state_publisher_period_);
  internal::fill(state_publisher_->msg_, time_data_.readFromRT()->time, desired_state_, current_state_, state_error_);
  state_publisher_->unlockAndPublish();
}

JOINT_TRAJECTORY_CONTROLLER(void)::setActionFeedback()
{
  const std::unique_lock<std::mutex> free(feedback_lock_, std::try_to_lock);
  if (!rt_active_goal_ || !free.owns_lock())
    return;
  internal::fill(*rt_active_goal_->preallocated_feedback_, time_data_.readFromRT()->time, desired_state_, current_state_,
                 state_error_);
  rt_active_goal_->setFeedback(rt_active_goal_->preallocated_feedback_);
}

}  // namespace joint_trajectory_controller

#include <joint_trajectory_controller/internal/commands.h>

#undef JOINT_TRAJECTORY_CONTROLLER

// What comes in, when, and what goes out; servo_motion.cpp computes it.
#include <moveit_servo/servo_calcs.h>

#include <chrono>
#include <stdexcept>

#include <std_msgs/Float64MultiArray.h>

#include <moveit_servo/make_shared_from_pool.h>

#include "laws.hpp"
#include "say.hpp"

namespace moveit_servo
{
namespace
{
const char* const LOGNAME = "servo_calcs";
constexpr double ROS_LOG_THROTTLE_PERIOD = 30.0;  // s

std::array<double, 6> numbers(const geometry_msgs::TwistStamped& msg)
{
  const auto& v = msg.twist.linear;
  const auto& w = msg.twist.angular;
  return { v.x, v.y, v.z, w.x, w.y, w.z };
}

const std::vector<double>& numbers(const control_msgs::JointJog& msg) { return msg.velocities; }

template <typename Message>
bool isNonZero(const Message& msg)
{
  const auto& all = numbers(msg);
  return std::any_of(all.begin(), all.end(), [](double value) { return value != 0.0; });
}

template <typename Message>
bool isFinite(const Message& msg)
{
  const auto& all = numbers(msg);
  return std::all_of(all.begin(), all.end(), [](double value) { return std::isfinite(value); });
}

const char* whatIsWrong(const geometry_msgs::TwistStamped& msg, bool unitless)
{
  if (!isFinite(msg))
    return "nan or infinity in a twist";
  const auto all = numbers(msg);
  if (unitless && std::any_of(all.begin(), all.end(), [](double value) { return std::abs(value) > 1.0; }))
    return "a component of a twist is beyond 1, and command_in_type is 'unitless'";
  return nullptr;
}

const char* whatIsWrong(const control_msgs::JointJog& msg, bool /*unitless*/)
{
  if (!isFinite(msg))
    return "nan or infinity in a JointJog";
  return msg.velocities.size() < msg.joint_names.size() ? "a JointJog has fewer velocities than joint_names" : nullptr;
}

geometry_msgs::TransformStamped toMessage(const Eigen::Isometry3d& pose, const std::string& parent, const std::string& child)
{
  geometry_msgs::TransformStamped message = tf2::eigenToTransform(pose);
  message.header.frame_id = parent;
  message.child_frame_id = child;
  return message;
}

bool knows(const moveit::core::RobotState& state, const std::string& frame)
{
  return frame == state.getRobotModel()->getModelFrame() || state.knowsFrameTransform(frame);
}
}  // namespace

ServoCalcs::ServoCalcs(ros::NodeHandle& nh, ServoParameters& parameters,
                       const planning_scene_monitor::PlanningSceneMonitorPtr& planning_scene_monitor)
  : nh_(nh)
  , parameters_(parameters)
  , planning_scene_monitor_(planning_scene_monitor)
{
  current_state_ = planning_scene_monitor_->getStateMonitor()->getCurrentState();
  joint_model_group_ = current_state_->getJointModelGroup(parameters_.move_group_name);
  if (!joint_model_group_)
    throw std::invalid_argument("Parameter move_group_name: there is no group '" + parameters_.move_group_name + "'");
  joints_ = joint_model_group_->getActiveJointModels();
  for (const auto* joint : joints_)
  {
    if (joint->getVariableCount() != 1)
      throw std::invalid_argument("Group '" + parameters_.move_group_name + "' has joint '" + joint->getName() + "' of " +
                                  std::to_string(joint->getVariableCount()) +
                                  " degrees of freedom: servoing moves joints of one");
    joint_names_.push_back(joint->getName());
  }
  const std::pair<const char*, std::string> frames[] = { { "planning_frame", parameters_.planning_frame },
                                                         { "ee_frame_name", parameters_.ee_frame_name },
                                                         { "robot_link_command_frame", parameters_.robot_link_command_frame } };
  for (const auto& frame : frames)
    if (!knows(*current_state_, frame.second))
      throw std::invalid_argument("Parameter " + std::string(frame.first) + ": robot '" +
                                  current_state_->getRobotModel()->getName() + "' has no link '" + frame.second + "'");
  position_filters_.assign(joints_.size(), LowPassFilter(parameters_.low_pass_filter_coeff));

  ros::NodeHandle internal(nh_, "internal");
  status_pub_ = nh_.advertise<std_msgs::Int8>(parameters_.status_topic, ROS_QUEUE_SIZE);
  worst_case_stop_time_pub_ = internal.advertise<std_msgs::Float64>("worst_case_stop_time", ROS_QUEUE_SIZE);
  if (parameters_.command_out_type == "std_msgs/Float64MultiArray")
    outgoing_cmd_pub_ = nh_.advertise<std_msgs::Float64MultiArray>(parameters_.command_out_topic, ROS_QUEUE_SIZE);
  else
    outgoing_cmd_pub_ = nh_.advertise<Trajectory>(parameters_.command_out_topic, ROS_QUEUE_SIZE);

  twist_stamped_sub_ = nh_.subscribe(parameters_.cartesian_command_in_topic, ROS_QUEUE_SIZE, &ServoCalcs::twistStampedCB, this);
  joint_cmd_sub_ = nh_.subscribe(parameters_.joint_command_in_topic, ROS_QUEUE_SIZE, &ServoCalcs::jointCmdCB, this);
  const boost::function<void(const std_msgs::Float64ConstPtr&)> scale = [this](const std_msgs::Float64ConstPtr& message) {
    collision_velocity_scale_ = message->data;
  };
  collision_velocity_scale_sub_ = internal.subscribe<std_msgs::Float64>("collision_velocity_scale", ROS_QUEUE_SIZE, scale);
  const auto service = [this](const char* name) { return ros::names::append(nh_.getNamespace(), name); };
  drift_dimensions_server_ = nh_.advertiseService(service("change_drift_dimensions"), &ServoCalcs::changeDriftDimensions, this);
  control_dimensions_server_ =
      nh_.advertiseService(service("change_control_dimensions"), &ServoCalcs::changeControlDimensions, this);
  reset_servo_status_ = nh_.advertiseService(service("reset_servo_status"), &ServoCalcs::resetServoStatus, this);
}

ServoCalcs::~ServoCalcs()
{
  // No callback may find this half gone.
  for (auto* subscriber : { &twist_stamped_sub_, &joint_cmd_sub_, &collision_velocity_scale_sub_ })
    subscriber->shutdown();
  for (auto* server : { &drift_dimensions_server_, &control_dimensions_server_, &reset_servo_status_ })
    server->shutdown();
  stop();
}

// ---------------------------------------------------------------- the thread

void ServoCalcs::start()
{
  stop();
  {
    const std::lock_guard<std::mutex> lock(input_mutex_);
    new_input_cmd_ = false;
    last_motion_.reset();
    updateState();
    resetPositions();
    started_ = true;
  }
  stop_requested_ = false;
  thread_ = std::thread([this] { mainCalcLoop(); });
}

void ServoCalcs::stop()
{
  {
    const std::lock_guard<std::mutex> lock(input_mutex_);
    stop_requested_ = true;
    input_cv_.notify_all();
  }
  if (thread_.joinable())
    thread_.join();
}

void ServoCalcs::mainCalcLoop()
{
  ros::Rate rate(1.0 / parameters_.publish_period);
  while (ros::ok() && !stop_requested_)
  {
    std::unique_lock<std::mutex> lock(input_mutex_);
    if (parameters_.low_latency_mode)
    {
      // Commands set the pace; when none comes any more, the arm is to be halted nevertheless.
      input_cv_.wait_for(lock, std::chrono::duration<double>(parameters_.publish_period),
                         [this] { return new_input_cmd_ || stop_requested_; });
      if (stop_requested_ || !(new_input_cmd_ || haltIsDue()))
        continue;
    }
    new_input_cmd_ = false;
    const ros::WallTime begin = ros::WallTime::now();
    try
    {
      calculateSingleIteration();
    }
    catch (const std::exception& error)
    {
      SAY_EVERY(ROS_LOG_THROTTLE_PERIOD, ROS_ERROR_NAMED, LOGNAME, "A command cannot be followed: %s", error.what());
    }
    lock.unlock();
    const double took = (ros::WallTime::now() - begin).toSec();
    if (took > parameters_.publish_period)
      SAY_EVERY(ROS_LOG_THROTTLE_PERIOD, ROS_WARN_NAMED, LOGNAME,
                "A command took %.4f s and is due every %.4f s: raise publish_period", took, parameters_.publish_period);
    if (!parameters_.low_latency_mode)
      rate.sleep();
  }
}

bool ServoCalcs::haltIsDue() const
{
  if (paused_)
    return in_motion_;
  const bool wanted = (twist_.nonzero && !isStale(twist_)) || (jog_.nonzero && !isStale(jog_));
  const int count = parameters_.num_outgoing_halt_msgs_to_publish;
  return !wanted && last_motion_ && (count == 0 || zero_velocity_count_ < count);
}

void ServoCalcs::calculateSingleIteration()
{
  const auto status = moveit::util::make_shared_from_pool<std_msgs::Int8>();
  status->data = static_cast<int8_t>(status_.load());
  status_pub_.publish(status);
  updateState();

  const auto trajectory = moveit::util::make_shared_from_pool<Trajectory>();
  *trajectory = emptyTrajectory();
  const bool waits = twist_.stamp.isZero() && jog_.stamp.isZero();
  if (paused_ || waits)
  {
    if (in_motion_)
    {
      suddenHalt(*trajectory);
      publish(trajectory);
    }
    // Others may move the arm meanwhile: where it was sent before counts no more.
    last_motion_.reset();
    zero_velocity_count_ = paused_ ? parameters_.num_outgoing_halt_msgs_to_publish : 0;
    resetPositions();
    return;
  }
  if (move(*trajectory))
  {
    publish(trajectory);
    last_motion_ = trajectory;
    zero_velocity_count_ = 0;
    return;
  }
  const int count = parameters_.num_outgoing_halt_msgs_to_publish;
  if (count == 0 || zero_velocity_count_ < count)
  {
    halt(*trajectory);
    publish(trajectory);
    zero_velocity_count_ = count == 0 ? 1 : zero_velocity_count_ + 1;
  }
  resetPositions();
}

void ServoCalcs::updateState()
{
  current_state_ = planning_scene_monitor_->getStateMonitor()->getCurrentState();
  current_state_->update();
  measured_.resize(joints_.size());
  measured_velocity_.resize(joints_.size());
  for (std::size_t i = 0; i < joints_.size(); ++i)
  {
    measured_[i] = current_state_->getJointPositions(joints_[i])[0];
    measured_velocity_[i] = current_state_->getJointVelocities(joints_[i])[0];
  }
  command_frame_ = poseInPlanningFrame(parameters_.robot_link_command_frame);
  ee_frame_ = poseInPlanningFrame(parameters_.ee_frame_name);
  publishStopTime();
}

void ServoCalcs::publishStopTime()
{
  Eigen::ArrayXd decelerations(joints_.size());
  for (std::size_t i = 0; i < joints_.size(); ++i)
  {
    const auto& bounds = joints_[i]->getVariableBounds()[0];
    decelerations[i] =
        bounds.acceleration_bounded_ ? std::min(std::abs(bounds.min_acceleration_), std::abs(bounds.max_acceleration_)) : 0.0;
    if (decelerations[i] == 0.0 && parameters_.check_collisions && parameters_.collision_check_type == "stop_distance")
      SAY_EVERY(ROS_LOG_THROTTLE_PERIOD, ROS_WARN_NAMED, LOGNAME,
                "Joint '%s' has no acceleration limit, which collision_check_type 'stop_distance' needs: set "
                "max_acceleration in joint_limits.yaml, or choose 'threshold_distance'",
                joint_names_[i].c_str());
  }
  const auto time = moveit::util::make_shared_from_pool<std_msgs::Float64>();
  time->data = laws::worstCaseStopTime(measured_velocity_, decelerations);
  worst_case_stop_time_pub_.publish(time);
}

bool ServoCalcs::move(Trajectory& trajectory)
{
  if (twist_.nonzero && !isStale(twist_))
    return cartesianServoCalcs(*twist_.latest, trajectory);
  if (jog_.nonzero && !isStale(jog_))
    return jointServoCalcs(*jog_.latest, trajectory);
  return false;
}

void ServoCalcs::halt(Trajectory& trajectory)
{
  const bool wanted = twist_.nonzero || jog_.nonzero;
  if (wanted && in_motion_)
    SAY_EVERY(10, ROS_WARN_NAMED, LOGNAME,
              "Stale command: none came for %g s, the arm halts. Send them faster, or try a larger "
              "'incoming_command_timeout' parameter.",
              parameters_.incoming_command_timeout);
  if (!wanted || !last_motion_)
  {
    suddenHalt(trajectory);
    return;
  }
  // Where it was sent last, without the sag of measured positions.
  trajectory = *last_motion_;
  for (auto& point : trajectory.points)
    point.velocities.assign(point.velocities.size(), 0.0);
}

void ServoCalcs::publish(const boost::shared_ptr<Trajectory>& trajectory)
{
  if (parameters_.command_out_type == "trajectory_msgs/JointTrajectory")
  {
    outgoing_cmd_pub_.publish(trajectory);
    return;
  }
  const auto joints = moveit::util::make_shared_from_pool<std_msgs::Float64MultiArray>();
  if (parameters_.publish_joint_positions)
    joints->data = trajectory->points[0].positions;
  else if (parameters_.publish_joint_velocities)
    joints->data = trajectory->points[0].velocities;
  outgoing_cmd_pub_.publish(joints);
}

// ---------------------------------------------------------------- what comes in

template <typename Message>
void ServoCalcs::take(const boost::shared_ptr<const Message>& message, Input<Message>& input)
{
  if (const char* wrong = whatIsWrong(*message, parameters_.command_in_type == "unitless"))
  {
    SAY_EVERY(ROS_LOG_THROTTLE_PERIOD, ROS_WARN_NAMED, LOGNAME, "A command is skipped: %s", wrong);
    return;
  }
  const std::lock_guard<std::mutex> lock(input_mutex_);
  input.latest = message;
  input.nonzero = isNonZero(*message);
  if (message->header.stamp.isZero())
    SAY_EVERY(ROS_LOG_THROTTLE_PERIOD, ROS_WARN_NAMED, LOGNAME,
              "A command without a stamp does not count as new: set header.stamp to "
              "the time now ('header: auto' for rostopic pub)");
  else  // one of another clock, ahead of this one, would never be old
    input.stamp = std::min(message->header.stamp, ros::Time::now());
  new_input_cmd_ = true;
  input_cv_.notify_all();
}

template void ServoCalcs::take(const geometry_msgs::TwistStampedConstPtr&, Input<geometry_msgs::TwistStamped>&);
template void ServoCalcs::take(const control_msgs::JointJogConstPtr&, Input<control_msgs::JointJog>&);

template <typename Message>
bool ServoCalcs::isStale(const Input<Message>& input) const
{
  return (ros::Time::now() - input.stamp).toSec() >= parameters_.incoming_command_timeout;
}

bool ServoCalcs::changeDriftDimensions(moveit_msgs::ChangeDriftDimensions::Request& req,
                                       moveit_msgs::ChangeDriftDimensions::Response& res)
{
  const std::lock_guard<std::mutex> lock(input_mutex_);
  drift_dimensions_ = Dimensions{ { bool(req.drift_x_translation), bool(req.drift_y_translation), bool(req.drift_z_translation),
                                    bool(req.drift_x_rotation), bool(req.drift_y_rotation), bool(req.drift_z_rotation) } };
  res.success = true;
  return true;
}

bool ServoCalcs::changeControlDimensions(moveit_msgs::ChangeControlDimensions::Request& req,
                                         moveit_msgs::ChangeControlDimensions::Response& res)
{
  const std::lock_guard<std::mutex> lock(input_mutex_);
  control_dimensions_ =
      Dimensions{ { bool(req.control_x_translation), bool(req.control_y_translation), bool(req.control_z_translation),
                    bool(req.control_x_rotation), bool(req.control_y_rotation), bool(req.control_z_rotation) } };
  res.success = true;
  return true;
}

bool ServoCalcs::resetServoStatus(std_srvs::Empty::Request& /*req*/, std_srvs::Empty::Response& /*res*/)
{
  status_ = StatusCode::NO_WARNING;
  return true;
}

// ---------------------------------------------------------------- frames

Eigen::Isometry3d ServoCalcs::poseInPlanningFrame(const std::string& frame) const
{
  const auto pose = [this](const std::string& name) -> Eigen::Isometry3d {
    return name == current_state_->getRobotModel()->getModelFrame() ? Eigen::Isometry3d::Identity()
                                                                    : current_state_->getFrameTransform(name);
  };
  return pose(parameters_.planning_frame).inverse() * pose(frame);
}

void ServoCalcs::changeRobotLinkCommandFrame(const std::string& new_command_frame)
{
  const std::lock_guard<std::mutex> lock(input_mutex_);
  if (knows(*current_state_, new_command_frame))
    parameters_.robot_link_command_frame = new_command_frame;
  else
    ROS_ERROR_NAMED(LOGNAME, "Commands stay in '%s': the robot has no link '%s'", parameters_.robot_link_command_frame.c_str(),
                    new_command_frame.c_str());
}

bool ServoCalcs::getCommandFrameTransform(Eigen::Isometry3d& transform)
{
  const std::lock_guard<std::mutex> lock(input_mutex_);
  transform = command_frame_;
  return started_;
}

bool ServoCalcs::getCommandFrameTransform(geometry_msgs::TransformStamped& transform)
{
  const std::lock_guard<std::mutex> lock(input_mutex_);
  transform = toMessage(command_frame_, parameters_.planning_frame, parameters_.robot_link_command_frame);
  return started_;
}

bool ServoCalcs::getEEFrameTransform(Eigen::Isometry3d& transform)
{
  const std::lock_guard<std::mutex> lock(input_mutex_);
  transform = ee_frame_;
  return started_;
}

bool ServoCalcs::getEEFrameTransform(geometry_msgs::TransformStamped& transform)
{
  const std::lock_guard<std::mutex> lock(input_mutex_);
  transform = toMessage(ee_frame_, parameters_.planning_frame, parameters_.ee_frame_name);
  return started_;
}
}  // namespace moveit_servo

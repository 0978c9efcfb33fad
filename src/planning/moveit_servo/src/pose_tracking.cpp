#include <moveit_servo/pose_tracking.h>

#include "read_parameters.hpp"
#include "say.hpp"

namespace moveit_servo
{
namespace
{
const char* const LOGNAME = "pose_tracking";
constexpr double DEFAULT_LOOP_RATE = 100.0;  // Hz
const char* const AXES[] = { "x", "y", "z", "angular" };
}  // namespace

PoseTracking::PoseTracking(const ros::NodeHandle& nh,
                           const planning_scene_monitor::PlanningSceneMonitorPtr& planning_scene_monitor)
  : nh_(nh)
  , planning_scene_monitor_(planning_scene_monitor)
  , loop_rate_(DEFAULT_LOOP_RATE)
  , configs_(4)
  , pids_(4)
  , transform_listener_(transform_buffer_)
{
  readROSParams();
  setGains();
  servo_ = std::make_unique<Servo>(nh_, planning_scene_monitor_);
  servo_->start();
  target_pose_sub_ = nh_.subscribe("target_pose", 1, &PoseTracking::targetPoseCallback, this);
  twist_stamped_pub_ = nh_.advertise<geometry_msgs::TwistStamped>(servo_->getParameters().cartesian_command_in_topic, 1);
}

void PoseTracking::readROSParams()
{
  ParameterReader reader(LOGNAME);
  double period = 1.0 / DEFAULT_LOOP_RATE, windup_limit = 0.0;
  reader.get("planning_frame", planning_frame_);
  reader.get("publish_period", period);
  reader.get("windup_limit", windup_limit);
  for (std::size_t i = 0; i < configs_.size(); ++i)
  {
    PIDConfig& config = configs_[i];
    const std::string axis = AXES[i];
    reader.get(axis + "_proportional_gain", config.k_p);
    reader.get(axis + "_integral_gain", config.k_i);
    reader.get(axis + "_derivative_gain", config.k_d);
    config.dt = period;
    config.windup_limit = windup_limit;
  }
  if (reader.errors() == 0 && !(period > 0.0))
    ROS_FATAL_NAMED(LOGNAME, "Parameter publish_period has to be greater than zero");
  if (reader.errors() > 0 || !(period > 0.0))
    endProgram();
  loop_rate_ = ros::Rate(1.0 / period);
}

void PoseTracking::setGains()
{
  for (std::size_t i = 0; i < configs_.size(); ++i)
  {
    const PIDConfig& c = configs_[i];
    pids_[i].setGains(c.k_p, c.k_i, c.k_d, c.windup_limit, -c.windup_limit, true);
  }
}

// ---------------------------------------------------------------- a motion

PoseTrackingStatusCode PoseTracking::moveToPose(const Eigen::Vector3d& positional_tolerance, const double angular_tolerance,
                                                const double target_pose_timeout)
{
  const std::lock_guard<std::mutex> lock(motion_mtx_);
  stop_requested_ = false;
  const ros::Time start = ros::Time::now();
  while (ros::ok() && !stop_requested_ && isRecent(start, target_pose_timeout) &&
         !(haveRecentTargetPose(target_pose_timeout) && isRecent(link_pose_stamp_, target_pose_timeout)))
  {
    updateLinkPose();
    ros::Duration(0.001).sleep();
  }
  if (!haveRecentTargetPose(target_pose_timeout))
  {
    ROS_ERROR_NAMED(LOGNAME, "The target pose was not updated for %g s. Aborting.", target_pose_timeout);
    return PoseTrackingStatusCode::NO_RECENT_TARGET_POSE;
  }
  PoseTrackingStatusCode outcome = PoseTrackingStatusCode::SUCCESS;
  while (ros::ok() && !satisfiesPoseTolerance(positional_tolerance, angular_tolerance))
  {
    updateLinkPose();
    if (!isRecent(link_pose_stamp_, target_pose_timeout))
    {
      ROS_ERROR_NAMED(LOGNAME, "The end effector pose was not updated in time. Aborting.");
      outcome = PoseTrackingStatusCode::NO_RECENT_END_EFFECTOR_POSE;
    }
    else if (stop_requested_)
    {
      ROS_INFO_NAMED(LOGNAME, "Halting servo motion, a stop was requested.");
      outcome = PoseTrackingStatusCode::STOP_REQUESTED;
    }
    if (outcome != PoseTrackingStatusCode::SUCCESS)
      break;
    twist_stamped_pub_.publish(calculateTwistCommand());
    if (!loop_rate_.sleep())
      SAY_EVERY(1, ROS_WARN_NAMED, LOGNAME, "Target control rate was missed");
  }
  doPostMotionReset();
  return outcome;
}

bool PoseTracking::haveRecentTargetPose(double timeout) const
{
  const std::lock_guard<std::mutex> lock(target_pose_mtx_);
  // Simulated time begins at zero, which is also the stamp of no target.
  return !target_pose_.header.stamp.isZero() && isRecent(target_pose_.header.stamp, timeout);
}

void PoseTracking::updateLinkPose()
{
  if (servo_->getCommandFrameTransform(link_pose_))
    link_pose_stamp_ = ros::Time::now();
}

bool PoseTracking::satisfiesPoseTolerance(const Eigen::Vector3d& positional_tolerance, double angular_tolerance) const
{
  if (!angular_error_)  // not compared yet
    return false;
  const std::lock_guard<std::mutex> lock(target_pose_mtx_);
  const auto& target = target_pose_.pose.position;
  const Eigen::Vector3d error = Eigen::Vector3d(target.x, target.y, target.z) - link_pose_.translation();
  return (error.array().abs() < positional_tolerance.array()).all() && std::abs(*angular_error_) < angular_tolerance;
}

geometry_msgs::TwistStampedConstPtr PoseTracking::calculateTwistCommand()
{
  const auto msg = moveit::util::make_shared_from_pool<geometry_msgs::TwistStamped>();
  Eigen::Vector3d target;
  Eigen::Quaterniond wanted;
  {
    const std::lock_guard<std::mutex> lock(target_pose_mtx_);
    const geometry_msgs::Pose& pose = target_pose_.pose;
    target = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
    wanted = Eigen::Quaterniond(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
  }
  const ros::Duration dt = loop_rate_.expectedCycleTime();
  const Eigen::Vector3d error = target - link_pose_.translation();
  msg->twist.linear.x = pids_[0].computeCommand(error.x(), dt);
  msg->twist.linear.y = pids_[1].computeCommand(error.y(), dt);
  msg->twist.linear.z = pids_[2].computeCommand(error.z(), dt);

  const Eigen::AngleAxisd turn(wanted.normalized() * Eigen::Quaterniond(link_pose_.linear()).inverse());
  angular_error_ = turn.angle();
  const Eigen::Vector3d rate = pids_[3].computeCommand(turn.angle(), dt) * turn.axis();
  msg->twist.angular.x = rate.x();
  msg->twist.angular.y = rate.y();
  msg->twist.angular.z = rate.z();
  msg->header.frame_id = planning_frame_;
  msg->header.stamp = ros::Time::now();
  return msg;
}

void PoseTracking::publishZero()
{
  const auto msg = moveit::util::make_shared_from_pool<geometry_msgs::TwistStamped>();
  msg->header.frame_id = planning_frame_;
  msg->header.stamp = ros::Time::now();
  twist_stamped_pub_.publish(msg);
}

void PoseTracking::stopMotion()
{
  stop_requested_ = true;
  publishZero();
}

void PoseTracking::doPostMotionReset()
{
  publishZero();
  stop_requested_ = false;
  angular_error_ = boost::none;
  for (auto& pid : pids_)
    pid.reset();
}

// ---------------------------------------------------------------- targets and gains

void PoseTracking::targetPoseCallback(const geometry_msgs::PoseStampedConstPtr& msg)
{
  geometry_msgs::PoseStamped target = *msg;
  const auto& p = msg->pose.position;
  const auto& q = msg->pose.orientation;
  const Eigen::Vector4d turn(q.x, q.y, q.z, q.w);
  if (!Eigen::Vector3d(p.x, p.y, p.z).allFinite() || !turn.allFinite() || turn.norm() < 1e-6)
  {
    SAY_EVERY(10, ROS_WARN_NAMED, LOGNAME, "A target pose is skipped: nan or infinity, or a quaternion of length 0");
    return;
  }
  if (target.header.frame_id != planning_frame_)
  {
    try
    {
      tf2::doTransform(
          target, target,
          transform_buffer_.lookupTransform(planning_frame_, target.header.frame_id, ros::Time(0), ros::Duration(0.1)));
    }
    catch (const tf2::TransformException& error)
    {
      ROS_WARN_NAMED(LOGNAME, "A target pose is skipped: %s", error.what());
      return;
    }
    target.header.stamp = ros::Time::now();  // TF's may be zero, of a transform that never changes
  }
  const std::lock_guard<std::mutex> lock(target_pose_mtx_);
  target_pose_ = target;
}

void PoseTracking::resetTargetPose()
{
  const std::lock_guard<std::mutex> lock(target_pose_mtx_);
  target_pose_ = geometry_msgs::PoseStamped();
}

void PoseTracking::updatePIDConfig(const double x_proportional_gain, const double x_integral_gain,
                                   const double x_derivative_gain, const double y_proportional_gain,
                                   const double y_integral_gain, const double y_derivative_gain,
                                   const double z_proportional_gain, const double z_integral_gain,
                                   const double z_derivative_gain, const double angular_proportional_gain,
                                   const double angular_integral_gain, const double angular_derivative_gain)
{
  stopMotion();
  const std::lock_guard<std::mutex> lock(motion_mtx_);  // it has ended
  const double gains[4][3] = { { x_proportional_gain, x_integral_gain, x_derivative_gain },
                               { y_proportional_gain, y_integral_gain, y_derivative_gain },
                               { z_proportional_gain, z_integral_gain, z_derivative_gain },
                               { angular_proportional_gain, angular_integral_gain, angular_derivative_gain } };
  for (std::size_t i = 0; i < configs_.size(); ++i)
  {
    configs_[i].k_p = gains[i][0];
    configs_[i].k_i = gains[i][1];
    configs_[i].k_d = gains[i][2];
  }
  setGains();
  doPostMotionReset();
}

void PoseTracking::getPIDErrors(double& x_error, double& y_error, double& z_error, double& orientation_error)
{
  double* const errors[] = { &x_error, &y_error, &z_error, &orientation_error };
  double integral, derivative;
  for (std::size_t i = 0; i < pids_.size(); ++i)
    pids_[i].getCurrentPIDErrors(errors[i], &integral, &derivative);
}
}  // namespace moveit_servo

// Leads a link of the arm to a pose that may move.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include <boost/optional.hpp>
#include <control_toolbox/pid.h>
#include <geometry_msgs/PoseStamped.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <moveit_servo/make_shared_from_pool.h>
#include <moveit_servo/servo.h>

namespace moveit_servo
{
struct PIDConfig
{
  double dt = 0.001;  // s
  double k_p = 1;
  double k_i = 0;
  double k_d = 0;
  double windup_limit = 0.1;
};

enum class PoseTrackingStatusCode : int8_t
{
  INVALID = -1,
  SUCCESS = 0,
  NO_RECENT_TARGET_POSE = 1,
  NO_RECENT_END_EFFECTOR_POSE = 2,
  STOP_REQUESTED = 3
};

const std::unordered_map<PoseTrackingStatusCode, std::string> POSE_TRACKING_STATUS_CODE_MAP(
    { { PoseTrackingStatusCode::INVALID, "Invalid" },
      { PoseTrackingStatusCode::SUCCESS, "Success" },
      { PoseTrackingStatusCode::NO_RECENT_TARGET_POSE, "No recent target pose" },
      { PoseTrackingStatusCode::NO_RECENT_END_EFFECTOR_POSE, "No recent end effector pose" },
      { PoseTrackingStatusCode::STOP_REQUESTED, "Stop requested" } });

// Follows the topic target_pose (geometry_msgs/PoseStamped, in any frame of TF) with robot_link_command_frame: a PID controller for
// each axis and one for the angle give the twist that its own Servo follows. All is in planning_frame.
class PoseTracking
{
public:
  // Reads the private parameters: those of Servo, windup_limit, and {x,y,z,angular}_{proportional,integral,derivative}_gain. What
  // is missing ends the program with a line for each.
  PoseTracking(const ros::NodeHandle& nh, const planning_scene_monitor::PlanningSceneMonitorPtr& planning_scene_monitor);

  // Until the link is there (m, per axis of planning_frame; rad) or stopMotion() is called. The target is not to be older than
  // target_pose_timeout s when the motion begins, the pose of the link never.
  PoseTrackingStatusCode moveToPose(const Eigen::Vector3d& positional_tolerance, const double angular_tolerance,
                                    const double target_pose_timeout);
  // From another thread.
  void stopMotion();

  // Stops, waits until moveToPose() has ended, then takes these gains.
  void updatePIDConfig(const double x_proportional_gain, const double x_integral_gain, const double x_derivative_gain,
                       const double y_proportional_gain, const double y_integral_gain, const double y_derivative_gain,
                       const double z_proportional_gain, const double z_integral_gain, const double z_derivative_gain,
                       const double angular_proportional_gain, const double angular_integral_gain,
                       const double angular_derivative_gain);
  void getPIDErrors(double& x_error, double& y_error, double& z_error, double& orientation_error);

  // The pose of robot_link_command_frame in planning_frame.
  bool getCommandFrameTransform(geometry_msgs::TransformStamped& transform)
  {
    return servo_->getCommandFrameTransform(transform);
  }
  // Forget the target: moveToPose() waits for the next.
  void resetTargetPose();

  std::unique_ptr<moveit_servo::Servo> servo_;

private:
  void readROSParams();
  void setGains();
  bool isRecent(const ros::Time& stamp, double timeout) const { return (ros::Time::now() - stamp).toSec() < timeout; }
  bool haveRecentTargetPose(double timeout) const;
  void updateLinkPose();
  bool satisfiesPoseTolerance(const Eigen::Vector3d& positional_tolerance, double angular_tolerance) const;
  void targetPoseCallback(const geometry_msgs::PoseStampedConstPtr& msg);
  geometry_msgs::TwistStampedConstPtr calculateTwistCommand();
  void publishZero();
  void doPostMotionReset();

  ros::NodeHandle nh_;
  planning_scene_monitor::PlanningSceneMonitorPtr planning_scene_monitor_;
  std::string planning_frame_;
  ros::Rate loop_rate_;
  std::vector<PIDConfig> configs_;          // x, y, z, angle
  std::vector<control_toolbox::Pid> pids_;  // as configs_
  std::mutex motion_mtx_;                   // held by a motion
  Eigen::Isometry3d link_pose_ = Eigen::Isometry3d::Identity();
  ros::Time link_pose_stamp_;
  mutable std::mutex target_pose_mtx_;
  geometry_msgs::PoseStamped target_pose_;
  boost::optional<double> angular_error_;  // rad
  std::atomic<bool> stop_requested_{ false };

  tf2_ros::Buffer transform_buffer_;
  tf2_ros::TransformListener transform_listener_;
  ros::Publisher twist_stamped_pub_;
  ros::Subscriber target_pose_sub_;
};

using PoseTrackingPtr = std::shared_ptr<PoseTracking>;
}  // namespace moveit_servo

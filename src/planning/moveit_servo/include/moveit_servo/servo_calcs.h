// From commands to joint commands, one per period.
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <Eigen/SVD>
#include <control_msgs/JointJog.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <moveit/planning_scene_monitor/planning_scene_monitor.h>
#include <moveit/robot_model_loader/robot_model_loader.h>
#include <moveit_msgs/ChangeControlDimensions.h>
#include <moveit_msgs/ChangeDriftDimensions.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Int8.h>
#include <std_srvs/Empty.h>
#include <tf2_eigen/tf2_eigen.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <moveit_servo/low_pass_filter.h>
#include <moveit_servo/servo_parameters.h>
#include <moveit_servo/status_codes.h>

namespace moveit_servo
{
class ServoCalcs
{
public:
  // Throws std::invalid_argument for a group or a frame that the robot has not.
  ServoCalcs(ros::NodeHandle& nh, ServoParameters& parameters,
             const planning_scene_monitor::PlanningSceneMonitorPtr& planning_scene_monitor);
  ~ServoCalcs();

  // Starts, or starts anew, the thread that works.
  void start();
  void setPaused(bool paused) { paused_ = paused; }

  // The pose of robot_link_command_frame, and of ee_frame_name, in planning_frame. False before start().
  bool getCommandFrameTransform(Eigen::Isometry3d& transform);
  bool getCommandFrameTransform(geometry_msgs::TransformStamped& transform);
  bool getEEFrameTransform(Eigen::Isometry3d& transform);
  bool getEEFrameTransform(geometry_msgs::TransformStamped& transform);

  // A frame that the robot has not is refused with a line.
  void changeRobotLinkCommandFrame(const std::string& new_command_frame);

  friend class ServoFixture;  // of packages that test it

private:
  using Trajectory = trajectory_msgs::JointTrajectory;
  using Dimensions = std::array<bool, 6>;  // x, y, z, roll, pitch, yaw

  template <typename Message>
  struct Input
  {
    boost::shared_ptr<const Message> latest;
    ros::Time stamp;  // zero while none had one
    bool nonzero = false;
  };

  void mainCalcLoop();
  void stop();
  bool haltIsDue() const;
  void calculateSingleIteration();
  void updateState();
  void publishStopTime();
  bool move(Trajectory& trajectory);
  void halt(Trajectory& trajectory);
  void publish(const boost::shared_ptr<Trajectory>& trajectory);

  // False, with a line, where the command cannot be followed.
  bool cartesianServoCalcs(geometry_msgs::TwistStamped cmd, Trajectory& joint_trajectory);
  bool jointServoCalcs(const control_msgs::JointJog& cmd, Trajectory& joint_trajectory);
  bool rotationToPlanningFrame(const std::string& frame, Eigen::Matrix3d& rotation) const;
  Eigen::VectorXd scaleCartesianCommand(const geometry_msgs::TwistStamped& command) const;
  Eigen::VectorXd scaleJointCommand(const control_msgs::JointJog& command) const;

  // Those that do not drift; the first where all may.
  std::vector<int> heldDimensions() const;
  // Rows are the dimensions that do not drift, in planning_frame; columns are the joints of the group.
  Eigen::MatrixXd jacobian(const moveit::core::RobotState& state) const;
  double velocityScalingFactorForSingularity(const Eigen::VectorXd& delta_x, const Eigen::JacobiSVD<Eigen::MatrixXd>& svd);
  void enforceVelLimits(Eigen::ArrayXd& delta_theta);
  void applyVelocityScaling(Eigen::ArrayXd& delta_theta, double singularity_scale);
  // Whether a joint would go further beyond its margin; says which.
  bool meetsPositionLimit(const Eigen::ArrayXd& delta_theta) const;

  void convertDeltasToOutgoingCmd(const Eigen::ArrayXd& delta_theta, Trajectory& joint_trajectory);
  void suddenHalt(Trajectory& joint_trajectory) const;
  void resetPositions();
  Trajectory emptyTrajectory() const;
  void setStatus(StatusCode status);

  Eigen::Isometry3d poseInPlanningFrame(const std::string& frame) const;
  void twistStampedCB(const geometry_msgs::TwistStampedConstPtr& msg) { take(msg, twist_); }
  void jointCmdCB(const control_msgs::JointJogConstPtr& msg) { take(msg, jog_); }
  template <typename Message>
  void take(const boost::shared_ptr<const Message>& message, Input<Message>& input);
  template <typename Message>
  bool isStale(const Input<Message>& input) const;
  bool changeDriftDimensions(moveit_msgs::ChangeDriftDimensions::Request& req,
                             moveit_msgs::ChangeDriftDimensions::Response& res);
  bool changeControlDimensions(moveit_msgs::ChangeControlDimensions::Request& req,
                               moveit_msgs::ChangeControlDimensions::Response& res);
  bool resetServoStatus(std_srvs::Empty::Request& req, std_srvs::Empty::Response& res);

  ros::NodeHandle nh_;
  ServoParameters& parameters_;
  planning_scene_monitor::PlanningSceneMonitorPtr planning_scene_monitor_;
  const moveit::core::JointModelGroup* joint_model_group_;
  std::vector<const moveit::core::JointModel*> joints_;
  std::vector<std::string> joint_names_;

  // All below is guarded by it, but for what is atomic.
  mutable std::mutex input_mutex_;
  std::condition_variable input_cv_;
  bool new_input_cmd_ = false;
  Input<geometry_msgs::TwistStamped> twist_;
  Input<control_msgs::JointJog> jog_;
  Dimensions drift_dimensions_{ { false, false, false, false, false, false } };
  Dimensions control_dimensions_{ { true, true, true, true, true, true } };
  bool started_ = false;
  Eigen::Isometry3d command_frame_ = Eigen::Isometry3d::Identity(), ee_frame_ = Eigen::Isometry3d::Identity();

  moveit::core::RobotStatePtr current_state_;
  Eigen::ArrayXd measured_, measured_velocity_;  // of the joints
  Eigen::ArrayXd commanded_;                     // positions before they are smoothed
  std::vector<LowPassFilter> position_filters_;
  boost::shared_ptr<const Trajectory> last_motion_;  // null when none was sent, or the arm may have been moved by others since
  bool in_motion_ = false;
  int zero_velocity_count_ = 0;  // halt messages since the last motion

  std::atomic<StatusCode> status_{ StatusCode::NO_WARNING };
  std::atomic<bool> paused_{ false };
  std::atomic<bool> stop_requested_{ true };
  std::atomic<double> collision_velocity_scale_{ 1.0 };
  std::thread thread_;

  ros::Subscriber twist_stamped_sub_, joint_cmd_sub_, collision_velocity_scale_sub_;
  ros::Publisher status_pub_, worst_case_stop_time_pub_, outgoing_cmd_pub_;
  ros::ServiceServer drift_dimensions_server_, control_dimensions_server_, reset_servo_status_;
};
}  // namespace moveit_servo

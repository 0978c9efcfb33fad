// The state that a robot is in: from joint states, and from TF for joints of several degrees of freedom.
#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <boost/function.hpp>
#include <boost/signals2/connection.hpp>

#include <moveit/robot_state/robot_state.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <tf2_ros/buffer.h>

namespace planning_scene_monitor
{

using JointStateUpdateCallback = boost::function<void(const sensor_msgs::JointStateConstPtr& joint_state)>;

/// Takes joint states in a thread of its own, so that a program may wait for them without a spinner. Thread-safe.
class CurrentStateMonitor
{
public:
  CurrentStateMonitor(const moveit::core::RobotModelConstPtr& robot_model, const std::shared_ptr<tf2_ros::Buffer>& tf_buffer);
  CurrentStateMonitor(const moveit::core::RobotModelConstPtr& robot_model, const std::shared_ptr<tf2_ros::Buffer>& tf_buffer,
                      const ros::NodeHandle& nh);
  ~CurrentStateMonitor();
  CurrentStateMonitor(const CurrentStateMonitor&) = delete;
  CurrentStateMonitor& operator=(const CurrentStateMonitor&) = delete;

  void startStateMonitor(const std::string& joint_states_topic = "joint_states");
  void stopStateMonitor();
  bool isActive() const;
  const moveit::core::RobotModelConstPtr& getRobotModel() const { return robot_model_; }
  std::string getMonitoredTopic() const;
  /// Zero before the first start.
  const ros::Time& getMonitorStartTime() const { return monitor_start_time_; }

  // Whether all active joints, of the group or of the robot, have been heard of, since the time or within the age.
  bool haveCompleteState(const std::string& group = "") const { return isComplete(ros::Time(0), nullptr, group); }
  bool haveCompleteState(const ros::Time& oldest_allowed_update_time, const std::string& group = "") const
  {
    return isComplete(oldest_allowed_update_time, nullptr, group);
  }
  bool haveCompleteState(const ros::Duration& age, const std::string& group = "") const
  {
    return isComplete(ros::Time::now() - age, nullptr, group);
  }
  bool haveCompleteState(std::vector<std::string>& missing_joints, const std::string& group = "") const
  {
    return isComplete(ros::Time(0), &missing_joints, group);
  }
  bool haveCompleteState(const ros::Time& oldest_allowed_update_time, std::vector<std::string>& missing_joints,
                         const std::string& group = "") const
  {
    return isComplete(oldest_allowed_update_time, &missing_joints, group);
  }
  bool haveCompleteState(const ros::Duration& age, std::vector<std::string>& missing_joints,
                         const std::string& group = "") const
  {
    return isComplete(ros::Time::now() - age, &missing_joints, group);
  }

  moveit::core::RobotStatePtr getCurrentState() const;
  void setToCurrentState(moveit::core::RobotState& upd) const;
  /// The stamp of the joint that was heard of longest ago; zero when one never was.
  ros::Time getCurrentStateTime(const std::string& group = "") const;
  std::pair<moveit::core::RobotStatePtr, ros::Time> getCurrentStateAndTime(const std::string& group = "") const;
  std::map<std::string, double> getCurrentStateValues() const;

  /// Wait (s of wall time) until the state is newer than t. Joints that nobody publishes are waited for once, and named then.
  bool waitForCurrentState(const ros::Time t = ros::Time::now(), double wait_time = 1.0) const;
  bool waitForCompleteState(double wait_time) const;
  bool waitForCompleteState(const std::string& group, double wait_time) const;

  /// Called after each message that changes the state, from the monitor's thread.
  void addUpdateCallback(const JointStateUpdateCallback& fn);
  void clearUpdateCallbacks();

  /// How far beyond its limits a joint may be to be put on them.
  void setBoundsError(double error) { error_ = std::abs(error); }
  double getBoundsError() const { return error_; }
  /// Take velocities and efforts, too.
  void enableCopyDynamics(bool enabled) { copy_dynamics_ = enabled; }

private:
  using Joints = std::vector<const moveit::core::JointModel*>;

  const Joints& activeJoints(const std::string& group) const;
  bool isComplete(const ros::Time& since, std::vector<std::string>* missing, const std::string& group) const;
  ros::Time oldest(const std::string& group, bool leave_out_the_unheard) const;
  std::string whatIsWrong(const ros::Time& t) const;
  void take(const sensor_msgs::JointStateConstPtr& joint_state);
  bool isNews(const moveit::core::JointModel& joint, const ros::Time& stamp);
  bool takeJoint(const sensor_msgs::JointState& joint_state, const ros::Time& stamp, std::size_t i);
  void takeTransforms();

  ros::NodeHandle nh_;
  ros::CallbackQueue queue_;
  std::unique_ptr<ros::AsyncSpinner> spinner_;
  std::shared_ptr<tf2_ros::Buffer> tf_buffer_;
  moveit::core::RobotModelConstPtr robot_model_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  moveit::core::RobotState robot_state_;
  std::map<const moveit::core::JointModel*, ros::Time> joint_time_;
  mutable bool told_of_unheard_ = false;
  bool started_ = false;
  bool copy_dynamics_ = false;
  ros::Time monitor_start_time_;
  double error_;
  ros::Subscriber joint_state_subscriber_;
  std::vector<JointStateUpdateCallback> update_callbacks_;
  std::unique_ptr<boost::signals2::connection> tf_connection_;
};

MOVEIT_CLASS_FORWARD(CurrentStateMonitor);

}  // namespace planning_scene_monitor

// What a MoveGroupInterface keeps, and how it talks to move_group.
#pragma once

#include <moveit/common_planning_interface_objects/common_objects.h>
#include <moveit/move_group_interface/move_group_interface.h>
#include <moveit_msgs/ExecuteTrajectoryAction.h>
#include <moveit_msgs/PickupAction.h>
#include <moveit_msgs/PlaceAction.h>
#include <ros/ros.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "action_queue.h"

namespace moveit {
namespace planning_interface {

extern const char LOGNAME[];

struct MoveGroupInterface::Impl {
  enum Target { JOINT, POSE, POSITION, ORIENTATION };

  template <class Action>
  using Client = std::unique_ptr<actionlib::SimpleActionClient<Action>>;

  Impl(const Options& options, const std::shared_ptr<tf2_ros::Buffer>& tf, const ros::WallDuration& wait_for_servers);

  /// Null, after an ERROR line, when no state newer than the call comes within the time.
  moveit::core::RobotStatePtr currentState(double wait = 1.0) const;
  /// The current state with what setStartState() said; null as above.
  moveit::core::RobotStatePtr startState() const;
  const std::string& link(const std::string& named) const { return named.empty() ? end_effector_link : named; }
  void setScalingFactor(double& factor, double wanted, const char* name);
  moveit_msgs::PlanningOptions planningOptions(bool plan_only) const;

  /// Send the goal and wait, if asked to; fills the result when one came.
  template <class Action, class Goal, class Result>
  moveit::core::MoveItErrorCode call(const Client<Action>& client, const Goal& goal, const char* name, bool wait,
                                     boost::shared_ptr<const Result>& result) const;

  Options options;
  ros::NodeHandle nh;
  std::unique_ptr<ActionQueue> queue = std::make_unique<ActionQueue>();  // outlives the clients below
  std::shared_ptr<tf2_ros::Buffer> tf_buffer;
  moveit::core::RobotModelConstPtr model;
  const moveit::core::JointModelGroup* group = nullptr;
  planning_scene_monitor::CurrentStateMonitorPtr monitor;

  Client<moveit_msgs::MoveGroupAction> move_client;
  Client<moveit_msgs::ExecuteTrajectoryAction> execute_client;
  Client<moveit_msgs::PickupAction> pick_client;
  Client<moveit_msgs::PlaceAction> place_client;
  mutable ros::ServiceClient query_service, get_params_service, set_params_service, cartesian_service, grasps_service;
  ros::Publisher event_publisher, attached_publisher;

  moveit_msgs::RobotState start_state;
  moveit_msgs::WorkspaceParameters workspace;
  double planning_time = DEFAULT_ALLOWED_PLANNING_TIME;
  unsigned int attempts = DEFAULT_NUM_PLANNING_ATTEMPTS;
  std::string pipeline_id, planner_id;
  double velocity_scaling = 0.1, acceleration_scaling = 0.1;
  std::string speed_limited_link;
  double max_cartesian_speed = 0;
  double joint_tolerance, position_tolerance, orientation_tolerance;
  bool look = false, replan = false;
  int32_t look_attempts = 0, replan_attempts = 0;  // 0: as many as move_group likes
  double replan_delay = 2.0;

  Target target = JOINT;
  moveit::core::RobotStatePtr joint_target;
  std::map<std::string, std::vector<geometry_msgs::PoseStamped>> pose_targets;  // by link
  std::unique_ptr<moveit_msgs::Constraints> path_constraints;
  std::unique_ptr<moveit_msgs::TrajectoryConstraints> trajectory_constraints;
  std::string end_effector_link, pose_frame, support_surface;

  /// A stop has just been sent. A goal that comes to move_group within STOP_HOLDS of it may have been sent before it.
  static void noteStop() { stopped() = std::chrono::steady_clock::now(); }
  static void outlastStop() { std::this_thread::sleep_until(stopped().load() + STOP_HOLDS); }

 private:
  static constexpr std::chrono::milliseconds STOP_HOLDS{100};
  static std::atomic<std::chrono::steady_clock::time_point>& stopped() {
    static std::atomic<std::chrono::steady_clock::time_point> when{{}};
    return when;
  }
};

template <class Action, class Goal, class Result>
moveit::core::MoveItErrorCode MoveGroupInterface::Impl::call(const Client<Action>& client, const Goal& goal, const char* name,
                                                             bool wait, boost::shared_ptr<const Result>& result) const {
  if (!client->isServerConnected()) {
    ROS_WARN_STREAM_NAMED(LOGNAME, name << " action server not connected");
    return moveit_msgs::MoveItErrorCodes::COMMUNICATION_FAILURE;
  }
  outlastStop();
  {
    const auto lock = queue->lock();
    client->sendGoal(goal);
  }
  if (!wait) return moveit_msgs::MoveItErrorCodes::SUCCESS;
  if (!client->waitForResult()) ROS_INFO_STREAM_NAMED(LOGNAME, name << " action returned early");
  const actionlib::SimpleClientGoalState state = client->getState();
  if (state != actionlib::SimpleClientGoalState::SUCCEEDED)
    ROS_WARN_STREAM_NAMED(LOGNAME, "Fail: " << state.toString() << ": " << state.getText());
  result = client->getResult();
  return result ? result->error_code.val : moveit_msgs::MoveItErrorCodes::COMMUNICATION_FAILURE;
}

}  // namespace planning_interface
}  // namespace moveit

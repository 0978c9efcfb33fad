// The base of compiled capabilities: plugins of move_group, exported for moveit_ros_move_group and named in ~capabilities.
#pragma once

#include <ros/ros.h>

#include <string>
#include <vector>

#include <moveit/macros/class_forward.h>
#include <moveit/move_group/move_group_context.h>
#include <moveit/plan_execution/plan_representation.h>
#include <moveit/planning_interface/planning_interface.h>
#include <moveit/planning_scene_monitor/planning_scene_monitor.h>

namespace move_group
{
enum MoveGroupState
{
  IDLE,
  PLANNING,
  MONITOR,
  LOOK
};

namespace detail
{
// The name of move_group, whose private names capabilities have. That of this node until it is set.
void setMoveGroupName(const std::string& name);
std::string moveGroupName();
}  // namespace detail

MOVEIT_CLASS_FORWARD(MoveGroupCapability);

class MoveGroupCapability
{
public:
  MoveGroupCapability(const std::string& capability_name)
    : node_handle_(detail::moveGroupName())
    , capability_name_(capability_name)
  {
  }
  virtual ~MoveGroupCapability() {}

  void setContext(const MoveGroupContextPtr& context) { context_ = context; }
  virtual void initialize() = 0;  // with the context
  const std::string& getName() const { return capability_name_; }

protected:
  std::string getActionResultString(const moveit_msgs::MoveItErrorCodes& error_code, bool planned_trajectory_empty,
                                    bool plan_only);
  std::string stateToStr(MoveGroupState state) const;

  void convertToMsg(const std::vector<plan_execution::ExecutableTrajectory>& trajectory,
                    moveit_msgs::RobotState& first_state_msg, std::vector<moveit_msgs::RobotTrajectory>& trajectory_msg) const;
  void convertToMsg(const robot_trajectory::RobotTrajectoryPtr& trajectory, moveit_msgs::RobotState& first_state_msg,
                    moveit_msgs::RobotTrajectory& trajectory_msg) const;
  // Of the first alone.
  void convertToMsg(const std::vector<plan_execution::ExecutableTrajectory>& trajectory,
                    moveit_msgs::RobotState& first_state_msg, moveit_msgs::RobotTrajectory& trajectory_msg) const;

  // Copies that start where the robot is.
  planning_interface::MotionPlanRequest clearRequestStartState(const planning_interface::MotionPlanRequest& request) const;
  moveit_msgs::PlanningScene clearSceneRobotState(const moveit_msgs::PlanningScene& scene) const;
  bool performTransform(geometry_msgs::PoseStamped& pose_msg, const std::string& target_frame) const;
  // "": the default one. Null when there is none of that name.
  planning_pipeline::PlanningPipelinePtr resolvePlanningPipeline(const std::string& pipeline_id) const;

  ros::NodeHandle root_node_handle_;
  ros::NodeHandle node_handle_;  // below move_group's name
  std::string capability_name_;
  MoveGroupContextPtr context_;
};
}  // namespace move_group

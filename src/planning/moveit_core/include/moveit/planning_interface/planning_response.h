// What planning ended with.
#pragma once

#include <moveit_msgs/MotionPlanDetailedResponse.h>
#include <moveit_msgs/MotionPlanResponse.h>

#include <moveit/robot_state/conversions.h>
#include <moveit/robot_trajectory/robot_trajectory.h>
#include <moveit/utils/moveit_error_code.h>

namespace planning_interface
{
struct MotionPlanResponse
{
  robot_trajectory::RobotTrajectoryPtr trajectory_;
  double planning_time_ = 0.0;  // s
  moveit::core::MoveItErrorCode error_code_;
  moveit_msgs::RobotState start_state_;
  std::string planner_id_;

  void getMessage(moveit_msgs::MotionPlanResponse& msg) const;
  explicit operator bool() const { return static_cast<bool>(error_code_); }
};

struct MotionPlanDetailedResponse
{
  void getMessage(moveit_msgs::MotionPlanDetailedResponse& msg) const;

  std::vector<robot_trajectory::RobotTrajectoryPtr> trajectory_;
  std::vector<std::string> description_;
  std::vector<double> processing_time_;  // s
  moveit::core::MoveItErrorCode error_code_;
  moveit_msgs::RobotState start_state_;
  std::string planner_id_;

  explicit operator bool() const { return static_cast<bool>(error_code_); }
};
}  // namespace planning_interface

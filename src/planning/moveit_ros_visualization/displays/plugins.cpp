#include <pluginlib/class_list_macros.hpp>

#include "motion_planning_display.hpp"
#include "robot_state_display.hpp"
#include "trajectory_display.hpp"

PLUGINLIB_EXPORT_CLASS(moveit_rviz_plugin::MotionPlanningDisplay, rviz::Display)
PLUGINLIB_EXPORT_CLASS(moveit_rviz_plugin::PlanningSceneDisplay, rviz::Display)
PLUGINLIB_EXPORT_CLASS(moveit_rviz_plugin::RobotStateDisplay, rviz::Display)
PLUGINLIB_EXPORT_CLASS(moveit_rviz_plugin::TrajectoryDisplay, rviz::Display)

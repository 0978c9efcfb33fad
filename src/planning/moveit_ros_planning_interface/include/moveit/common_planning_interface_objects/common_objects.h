// One TF buffer, robot model and state monitor for all interfaces of a process.
#pragma once

#include <memory>
#include <string>

#include <moveit/planning_scene_monitor/current_state_monitor.h>

namespace moveit {
namespace planning_interface {

// Each lives as long as somebody holds it.
std::shared_ptr<tf2_ros::Buffer> getSharedTF();

/// Null when the parameter holds no robot.
moveit::core::RobotModelConstPtr getSharedRobotModel(const std::string& robot_description);

planning_scene_monitor::CurrentStateMonitorPtr getSharedStateMonitor(const moveit::core::RobotModelConstPtr& robot_model,
                                                                     const std::shared_ptr<tf2_ros::Buffer>& tf_buffer);
planning_scene_monitor::CurrentStateMonitorPtr getSharedStateMonitor(const moveit::core::RobotModelConstPtr& robot_model,
                                                                     const std::shared_ptr<tf2_ros::Buffer>& tf_buffer,
                                                                     const ros::NodeHandle& nh);

}  // namespace planning_interface
}  // namespace moveit

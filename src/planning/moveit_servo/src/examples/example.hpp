// What both examples do first.
#pragma once

#include <moveit_servo/servo.h>
#include <moveit_servo/status_codes.h>

// A monitor of the robot's state and of its scene; null when there is no robot.
inline planning_scene_monitor::PlanningSceneMonitorPtr monitorScene()
{
  using planning_scene_monitor::PlanningSceneMonitor;
  const auto monitor = std::make_shared<PlanningSceneMonitor>("robot_description");
  if (!monitor->getPlanningScene())
    return nullptr;
  monitor->startSceneMonitor();
  monitor->startWorldGeometryMonitor(PlanningSceneMonitor::DEFAULT_COLLISION_OBJECT_TOPIC,
                                     PlanningSceneMonitor::DEFAULT_PLANNING_SCENE_WORLD_TOPIC, false);
  monitor->startStateMonitor();
  return monitor;
}

// Prints each change of the status.
inline ros::Subscriber printStatus(ros::NodeHandle& nh, const std::string& topic)
{
  const auto last = std::make_shared<int>(static_cast<int>(moveit_servo::StatusCode::INVALID));
  const boost::function<void(const std_msgs::Int8ConstPtr&)> print = [last](const std_msgs::Int8ConstPtr& msg) {
    if (msg->data != *last)
      ROS_INFO_STREAM(
          "Servo status: " << moveit_servo::SERVO_STATUS_CODE_MAP.at(static_cast<moveit_servo::StatusCode>(msg->data)));
    *last = msg->data;
  };
  return nh.subscribe<std_msgs::Int8>(topic, 1, print);
}

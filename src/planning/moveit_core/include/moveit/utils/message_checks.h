// Do messages say anything?
#pragma once

#include <geometry_msgs/Pose.h>
#include <moveit_msgs/Constraints.h>
#include <moveit_msgs/PlanningScene.h>
#include <moveit_msgs/PlanningSceneWorld.h>
#include <moveit_msgs/RobotState.h>

namespace moveit
{
namespace core
{
bool isEmpty(const moveit_msgs::PlanningScene& msg);
bool isEmpty(const moveit_msgs::PlanningSceneWorld& msg);
bool isEmpty(const moveit_msgs::RobotState& msg);
bool isEmpty(const moveit_msgs::Constraints& msg);
bool isEmpty(const geometry_msgs::Quaternion& msg);  // the identity
bool isEmpty(const geometry_msgs::Pose& msg);        // the identity
}  // namespace core
}  // namespace moveit

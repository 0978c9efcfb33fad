// What changes from one scene to another, as a message.
#pragma once

#include <moveit_msgs/PlanningScene.h>

#include <moveit/planning_scene/planning_scene.h>

namespace planning_scene
{
// The message that makes `now` of `before`, scenes of one robot: objects, what is attached, octomap, allowed collisions, padding, scale
// and colours. Joint values and fixed frames are left out. Where nothing changed it holds nothing but its is_diff.
moveit_msgs::PlanningScene difference(const PlanningScene& before, const PlanningScene& now);
}  // namespace planning_scene

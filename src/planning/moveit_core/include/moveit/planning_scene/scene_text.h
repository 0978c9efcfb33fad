// Text files of scenes (.scene), as upstream's PlanningScene::saveGeometryToStream() writes them; moveit_core's scene_text.py says how.
#pragma once

#include <moveit_msgs/PlanningScene.h>

#include <string>

namespace planning_scene
{
// The objects of a scene, all in its own frame.
std::string writeScene(const moveit_msgs::PlanningScene& scene);

// A diff with the objects of the text, whose poses are in the frame. Throws std::runtime_error that names the line.
moveit_msgs::PlanningScene readScene(const std::string& text, const std::string& frame);
}  // namespace planning_scene

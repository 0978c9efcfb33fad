// Text files of scenes (.scene), as RViz, the warehouse's tools and PlanningScene::saveGeometryToStream() of MoveIt 1 write them.
//
// A scene's name; then for each object "* name", its pose (a line of x y z, a line of the quaternion x y z w), the number of shapes, for
// each of them its kind, size, pose and colour, and the number of subframes with their names and poses; a line "." ends it. Files of
// before Noetic have neither object poses nor subframes. Metres.
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

// What the tests of scenes begin with: the arm, ready, and boxes.
#pragma once

#include <moveit/planning_scene/planning_scene.h>

#include <string>

#include "arm.hpp"

using planning_scene::PlanningScene;
using planning_scene::PlanningScenePtr;

inline moveit_msgs::CollisionObject box(const std::string& id, double x, double y, double z, double edge)
{
  moveit_msgs::CollisionObject object;
  object.header.frame_id = "floor";
  object.id = id;
  object.primitives.resize(1);
  object.primitives[0].type = shape_msgs::SolidPrimitive::BOX;
  object.primitives[0].dimensions.assign(3, edge);
  object.primitive_poses.resize(1);
  object.primitive_poses[0].position.x = x;
  object.primitive_poses[0].position.y = y;
  object.primitive_poses[0].position.z = z;
  object.primitive_poses[0].orientation.w = 1.0;
  object.operation = moveit_msgs::CollisionObject::ADD;
  return object;
}

inline PlanningScenePtr readyScene()
{
  const auto scene = std::make_shared<PlanningScene>(makeArm());
  scene->getCurrentStateNonConst().setToDefaultValues("manipulator", "ready");
  return scene;
}

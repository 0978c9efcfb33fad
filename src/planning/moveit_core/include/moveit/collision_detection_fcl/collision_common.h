// The version of FCL, and the name of upstream's geometry; that class itself does not exist here: planning_scene::PlanningScene checks
// with FCL (docs/differences.md, 'MoveIt in C++').
#pragma once

#include <moveit/collision_detection/collision_common.h>
#include <moveit/collision_detection_fcl/fcl_compat.h>
#include <moveit/macros/class_forward.h>

namespace collision_detection
{
MOVEIT_STRUCT_FORWARD(FCLGeometry);
}  // namespace collision_detection

// Where a robot and what it meets share room, as FCL counts it.
#pragma once

#include "motion/planning_scene.hpp"

namespace motion
{
// A box along the axes of the model frame, m.
struct CostSource
{
  Vector3 low, high;
  double density;

  double cost() const { return density * (high - low).prod(); }
};

// Of shapes that collide: the boxes that their bounds share (cells of an octomap, triangles of a mesh: each its own), the most
// costly first. Of equal costs one is kept, as MoveIt's set of them does.
std::vector<CostSource> costSources(const PlanningScene& scene, const RobotState& state, const CollisionRequest& request,
                                    std::size_t most, const AllowedCollisionMatrix* acm = nullptr);
}  // namespace motion

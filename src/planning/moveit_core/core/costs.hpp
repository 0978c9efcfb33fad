// The costs of collisions, as the motion library finds them, in MoveIt's set.
#pragma once

#include <moveit/collision_detection/collision_common.h>

#include "motion/cost_sources.hpp"

namespace planning_scene
{
// Keeps the `most` costly ones.
inline void addCosts(const std::vector<motion::CostSource>& found, std::size_t most,
                     std::set<collision_detection::CostSource>& costs)
{
  for (const motion::CostSource& source : found)
  {
    collision_detection::CostSource cost;
    for (int i = 0; i < 3; ++i)
    {
      cost.aabb_min[i] = source.low[i];
      cost.aabb_max[i] = source.high[i];
    }
    cost.cost = source.density;
    costs.insert(cost);
  }
  while (costs.size() > most)
    costs.erase(std::prev(costs.end()));
}
}  // namespace planning_scene

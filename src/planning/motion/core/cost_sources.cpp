#include "motion/cost_sources.hpp"

#include <algorithm>

#include "checker.hpp"

namespace motion
{
std::vector<CostSource> costSources(const PlanningScene& scene, const RobotState& state, const CollisionRequest& request,
                                    std::size_t most, const AllowedCollisionMatrix* acm)
{
  std::vector<CostSource> found = scene.checker(state, request.group, request.padded, acm)->costs(state, request, most);
  std::stable_sort(found.begin(), found.end(), [](const CostSource& a, const CostSource& b) { return a.cost() > b.cost(); });
  found.erase(
      std::unique(found.begin(), found.end(), [](const CostSource& a, const CostSource& b) { return a.cost() == b.cost(); }),
      found.end());
  if (found.size() > most)
    found.resize(most);
  return found;
}
}  // namespace motion

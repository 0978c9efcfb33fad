#include "hybrid.hpp"

#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/PathHybridization.h>

namespace motion
{
void hybridize(const ompl::base::SpaceInformationPtr& space, ompl::base::ProblemDefinition& problem)
{
  ompl::geometric::PathHybridization mix(space);
  for (const ompl::base::PlannerSolution& solution : problem.getSolutions())
    if (!solution.approximate_)
      mix.recordPath(std::static_pointer_cast<ompl::geometric::PathGeometric>(solution.path_), false);
  if (mix.pathCount() < 2)
    return;
  mix.computeHybridPath();
  if (mix.getHybridPath())
    problem.addSolutionPath(mix.getHybridPath(), false, 0.0, mix.getName());
}
}  // namespace motion

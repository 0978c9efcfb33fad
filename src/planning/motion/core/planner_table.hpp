// OMPL's planners by the names of ompl_planning.yaml.
#pragma once

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/Planner.h>
#include <ompl/base/PlannerTerminationCondition.h>

#include <functional>
#include <map>
#include <string>

namespace motion
{
// "geometric::KPIECE1", "KPIECE", "RRTConnectkConfigDefault" ... as the table has it; "" if it has none such.
std::string plannerName(const std::string& given);
std::vector<std::string> plannerNames();
ompl::base::PlannerPtr makePlanner(const std::string& name, const ompl::base::SpaceInformationPtr& si);
// Null for a name that is not known.
ompl::base::OptimizationObjectivePtr makeObjective(const std::string& name, const ompl::base::SpaceInformationPtr& si);
// "Iteration[n]", "CostConvergence[window,epsilon]" or "ExactSolution", as ompl_planning.yaml has it, or `stopped`; else that alone.
ompl::base::PlannerTerminationCondition makeTermination(const std::string& text,
                                                        const ompl::base::ProblemDefinitionPtr& problem,
                                                        const std::function<bool()>& stopped);
// Is it RRTConnect, and how far its steps go left to OMPL (a range of 0, or none)?
bool hasNoRange(const std::string& name, const std::map<std::string, std::string>& parameters);
// OMPL's own range, a fifth of the space, soon crosses what is wide, but seldom gets into what is narrow. `extent`: of the space.
void stepShort(ompl::base::Planner& planner, double extent);
// OMPL writes on the console; what matters comes back in the result.
void quiet();
}  // namespace motion

// OMPL's planners by the names of ompl_planning.yaml.
#pragma once

#include <ompl/base/Planner.h>

#include <map>
#include <string>

namespace motion
{
// "geometric::KPIECE1", "KPIECE", "RRTConnectkConfigDefault" ... as the table has it; "" if it has none such.
std::string plannerName(const std::string& given);
std::vector<std::string> plannerNames();
ompl::base::PlannerPtr makePlanner(const std::string& name, const ompl::base::SpaceInformationPtr& si);
}  // namespace motion

#include "planner_table.hpp"

#include <ompl/base/objectives/MaximizeMinClearanceObjective.h>
#include <ompl/base/objectives/MechanicalWorkOptimizationObjective.h>
#include <ompl/base/objectives/MinimaxObjective.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/objectives/StateCostIntegralObjective.h>
#include <ompl/base/terminationconditions/CostConvergenceTerminationCondition.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/planners/AnytimePathShortening.h>
#include <ompl/geometric/planners/est/BiEST.h>
#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/est/ProjEST.h>
#include <ompl/geometric/planners/fmt/BFMT.h>
#include <ompl/geometric/planners/fmt/FMT.h>
#include <ompl/geometric/planners/informedtrees/ABITstar.h>
#include <ompl/geometric/planners/informedtrees/AITstar.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/kpiece/BKPIECE1.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/kpiece/LBKPIECE1.h>
#include <ompl/geometric/planners/pdst/PDST.h>
#include <ompl/geometric/planners/prm/LazyPRM.h>
#include <ompl/geometric/planners/prm/LazyPRMstar.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/prm/PRMstar.h>
#include <ompl/geometric/planners/prm/SPARS.h>
#include <ompl/geometric/planners/prm/SPARStwo.h>
#include <ompl/geometric/planners/rrt/BiTRRT.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/LBTRRT.h>
#include <ompl/geometric/planners/rrt/LazyRRT.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTsharp.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/geometric/planners/rrt/SORRTstar.h>
#include <ompl/geometric/planners/rrt/TRRT.h>
#include <ompl/geometric/planners/sbl/SBL.h>
#include <ompl/geometric/planners/stride/STRIDE.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>

namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace motion
{
namespace
{
using Make = std::function<ob::PlannerPtr(const ob::SpaceInformationPtr&)>;

template <typename Planner>
Make maker()
{
  return [](const ob::SpaceInformationPtr& si) { return std::make_shared<Planner>(si); };
}

const std::map<std::string, Make>& table()
{
  static const std::map<std::string, Make> planners{{"ABITstar", maker<og::ABITstar>()},
                                                    {"AITstar", maker<og::AITstar>()},
                                                    {"AnytimePathShortening", maker<og::AnytimePathShortening>()},
                                                    {"BFMT", maker<og::BFMT>()},
                                                    {"BITstar", maker<og::BITstar>()},
                                                    {"BKPIECE", maker<og::BKPIECE1>()},
                                                    {"BiEST", maker<og::BiEST>()},
                                                    {"BiTRRT", maker<og::BiTRRT>()},
                                                    {"EST", maker<og::EST>()},
                                                    {"FMT", maker<og::FMT>()},
                                                    {"InformedRRTstar", maker<og::InformedRRTstar>()},
                                                    {"KPIECE", maker<og::KPIECE1>()},
                                                    {"LBKPIECE", maker<og::LBKPIECE1>()},
                                                    {"LBTRRT", maker<og::LBTRRT>()},
                                                    {"LazyPRM", maker<og::LazyPRM>()},
                                                    {"LazyPRMstar", maker<og::LazyPRMstar>()},
                                                    {"LazyRRT", maker<og::LazyRRT>()},
                                                    {"PDST", maker<og::PDST>()},
                                                    {"PRM", maker<og::PRM>()},
                                                    {"PRMstar", maker<og::PRMstar>()},
                                                    {"ProjEST", maker<og::ProjEST>()},
                                                    {"RRT", maker<og::RRT>()},
                                                    {"RRTConnect", maker<og::RRTConnect>()},
                                                    {"RRTsharp", maker<og::RRTsharp>()},
                                                    {"RRTstar", maker<og::RRTstar>()},
                                                    {"SBL", maker<og::SBL>()},
                                                    {"SORRTstar", maker<og::SORRTstar>()},
                                                    {"SPARS", maker<og::SPARS>()},
                                                    {"SPARStwo", maker<og::SPARStwo>()},
                                                    {"STRIDE", maker<og::STRIDE>()},
                                                    {"TRRT", maker<og::TRRT>()}};
  return planners;
}
}  // namespace

std::string plannerName(const std::string& given)
{
  std::string name = given.empty() ? "RRTConnect" : given;
  const std::size_t colon = name.rfind(':');
  if (colon != std::string::npos)
    name = name.substr(colon + 1);
  for (const char* ending : {"kConfigDefault", "1"})
  {
    const std::size_t length = std::string(ending).size();
    if (!table().count(name) && name.size() > length && name.compare(name.size() - length, length, ending) == 0)
      name.erase(name.size() - length);
  }
  return table().count(name) ? name : "";
}

std::vector<std::string> plannerNames()
{
  std::vector<std::string> names;
  for (const auto& [name, make] : table())
    names.push_back(name);
  return names;
}

ob::PlannerPtr makePlanner(const std::string& name, const ob::SpaceInformationPtr& si) { return table().at(name)(si); }

ob::OptimizationObjectivePtr makeObjective(const std::string& name, const ob::SpaceInformationPtr& si)
{
  if (name == "MinimaxObjective")
    return std::make_shared<ob::MinimaxObjective>(si);
  if (name == "StateCostIntegralObjective")
    return std::make_shared<ob::StateCostIntegralObjective>(si);
  if (name == "MechanicalWorkOptimizationObjective")
    return std::make_shared<ob::MechanicalWorkOptimizationObjective>(si);
  if (name == "MaximizeMinClearanceObjective")
    return std::make_shared<ob::MaximizeMinClearanceObjective>(si);
  if (name == "PathLengthOptimizationObjective")
    return std::make_shared<ob::PathLengthOptimizationObjective>(si);
  return nullptr;
}

ob::PlannerTerminationCondition makeTermination(const std::string& text, const ob::ProblemDefinitionPtr& problem,
                                                const std::function<bool()>& stopped)
{
  const ob::PlannerTerminationCondition clock(stopped);
  const std::size_t open = text.find('[');
  const std::string kind = text.substr(0, open);
  if (kind == "Iteration" && open != std::string::npos)
  {
    // The condition that OMPL makes of it points to this very object, whoever holds the condition.
    const auto counter = std::make_shared<ob::IterationTerminationCondition>(std::max(1, std::atoi(text.c_str() + open + 1)));
    return ob::PlannerTerminationCondition([stopped, counter]() { return stopped() || counter->eval(); });
  }
  if (kind == "CostConvergence")
  {
    int window = 10;
    double epsilon = 0.1;
    if (open != std::string::npos)
      std::sscanf(text.c_str() + open, "[%d,%lf", &window, &epsilon);
    ob::ProblemDefinitionPtr told = problem;
    // The problem calls this very object with each better path: it must live as long as the planner looks for one.
    const auto converged = std::make_shared<ob::CostConvergenceTerminationCondition>(told, window, epsilon);
    return ob::PlannerTerminationCondition([stopped, converged]() { return stopped() || (*converged)(); });
  }
  if (kind == "ExactSolution")
    return ob::plannerOrTerminationCondition(clock, ob::exactSolnPlannerTerminationCondition(problem));
  return clock;
}
}  // namespace motion

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/util/Console.h>

#include <cstdlib>
#include <set>

#include "motion/planning.hpp"
#include "planner_table.hpp"

namespace ob = ompl::base;

namespace motion
{
namespace
{
// Keys of ompl_planning.yaml that are not the planner's own.
const std::set<std::string>& generalKeys()
{
  static const std::set<std::string> keys{"type",
                                          "optimization_objective",
                                          "termination_condition",
                                          "interpolate",
                                          "hybridize",
                                          "multi_query_planning_enabled",
                                          "load_planner_data",
                                          "store_planner_data",
                                          "planner_data_path",
                                          "projection_evaluator",
                                          "longest_valid_segment_fraction",
                                          "enforce_joint_model_state_space",
                                          "enforce_constrained_state_space",
                                          "maximum_waypoint_distance",
                                          "minimum_waypoint_count",
                                          "simplify_solutions"};
  return keys;
}
}  // namespace

void quiet()
{
  static const bool done = (ompl::msg::noOutputHandler(), true);
  (void)done;
}

std::map<std::string, std::map<std::string, std::string>> plannerParameters()
{
  quiet();
  auto space = std::make_shared<ob::RealVectorStateSpace>(2);
  space->setBounds(-1, 1);
  const auto si = std::make_shared<ob::SpaceInformation>(space);
  si->setStateValidityChecker([](const ob::State*) { return true; });
  si->setup();
  std::map<std::string, std::map<std::string, std::string>> out;
  for (const std::string& name : plannerNames())
    makePlanner(name, si)->params().getParams(out[name]);
  return out;
}

std::string plannerProblem(const std::string& name, const std::map<std::string, std::string>& parameters)
{
  const std::string known = plannerName(name);
  if (known.empty())
  {
    for (const char* other : {"STOMP", "CHOMP"})
      if (name.find(other) != std::string::npos)
        return std::string(other) + " is not part of this library; use an OMPL planner such as RRTConnect";
    return "there is no planner '" + name.substr(0, 60) + "' (there is: " + listed(plannerNames()) + ")";
  }
  if (parameters.empty())
    return "";
  static const auto all = plannerParameters();
  for (const auto& [key, value] : parameters)
    if (!all.at(known).count(key) && !generalKeys().count(key))
    {
      std::vector<std::string> keys;
      for (const auto& [own, unused] : all.at(known))
        keys.push_back(own);
      return "planner " + known + " has no parameter '" + key.substr(0, 60) + "' (there is: " + listed(keys) + ")";
    }
  return "";
}

bool hasNoRange(const std::string& name, const std::map<std::string, std::string>& parameters)
{
  const auto range = parameters.find("range");
  return name == "RRTConnect" && (range == parameters.end() || std::strtod(range->second.c_str(), nullptr) == 0);
}

void stepShort(ob::Planner& planner, double extent)
{
  constexpr double PART = 0.06;
  planner.params().setParam("range", std::to_string(PART * extent));
}
}  // namespace motion

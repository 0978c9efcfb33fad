// Parameters that both faces have (MoveIt's classes in C++, move_group's in Python): names, values and bounds are those of MoveIt 1's
// TrajectoryExecution-, PlanExecution- and PlanningSceneMonitorDynamicReconfigure.cfg. No node is needed: any thread may call these.
#pragma once

#include <string>
#include <vector>

namespace execution
{
enum class Kind
{
  FLAG,    // true or false; its value is 1 or 0
  COUNT,   // a whole number
  NUMBER,  // any
};

// One of a server of dynamic_reconfigure.
struct Parameter
{
  std::string name, description;
  Kind kind;
  double value, low, high;
  unsigned int level;  // what a client is told to have changed

  // What is given, inside the bounds; the parameter's own value where that is not a number.
  double within(double given) const;
};
using Parameters = std::vector<Parameter>;  // in the order in which tools show them

// Of <ns>/trajectory_execution.
const Parameters& parameters();
// Of <ns>/plan_execution.
const Parameters& planParameters();
// Of <ns>/planning_scene_monitor.
const Parameters& sceneParameters();
}  // namespace execution

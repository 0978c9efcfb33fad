// Parameters of execution that both faces read (TrajectoryExecutionManager in C++, move_group's in Python): names, values and bounds are
// those of MoveIt 1's TrajectoryExecutionDynamicReconfigure.cfg. No node is needed: any thread may call these.
#pragma once

#include <string>
#include <vector>

namespace execution
{
// One of <ns>/trajectory_execution, as MoveIt's dynamic_reconfigure has it.
struct Parameter
{
  std::string name, description;
  bool flag;  // true or false; its value is 1 or 0
  double value, low, high;

  // What is given, inside the bounds; the parameter's own value where that is not a number.
  double within(double given) const;
};

// In the order in which tools show them.
const std::vector<Parameter>& parameters();
}  // namespace execution

#include "parameters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace execution
{
double Parameter::within(double given) const { return std::isnan(given) ? value : std::min(std::max(given, low), high); }

const std::vector<Parameter>& parameters()
{
  constexpr double ANY = std::numeric_limits<double>::infinity();
  static const std::vector<Parameter> all = {
    { "execution_duration_monitoring",
      "Monitor the execution duration of a trajectory. If expected duration is exceeded, the trajectory is canceled.", true, 1,
      0, 1 },
    { "allowed_execution_duration_scaling", "Accept durations that take a little more time than specified", false, 1.1, 1.0,
      10.0 },
    { "allowed_goal_duration_margin",
      "Allow more than the expected execution time before triggering a trajectory cancel (applied after scaling)", false, 0.5,
      0.1, 30.0 },
    { "execution_velocity_scaling", "Multiplicative factor for execution speed", false, 1.0, 0.1, 10.0 },
    { "allowed_start_tolerance",
      "Allowed joint-value tolerance for validation of trajectory's start point against current robot state", false, 0.01, 0.0,
      ANY },
    { "wait_for_trajectory_completion",
      "Wait for trajectory completion. If set to false, do not wait for controllers to converge to last way point, before reporting "
      "success.",
      true, 1, 0, 1 },
  };
  return all;
}
}  // namespace execution

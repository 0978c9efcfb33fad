#include "parameters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace execution
{
double Parameter::within(double given) const { return std::isnan(given) ? value : std::min(std::max(given, low), high); }

const Parameters& parameters()
{
  constexpr double ANY = std::numeric_limits<double>::infinity();
  static const Parameters all = {
    { "execution_duration_monitoring",
      "Monitor the execution duration of a trajectory. If expected duration is exceeded, the trajectory is canceled.",
      Kind::FLAG, 1, 0, 1, 1 },
    { "allowed_execution_duration_scaling", "Accept durations that take a little more time than specified", Kind::NUMBER, 1.1,
      1.0, 10.0, 2 },
    { "allowed_goal_duration_margin",
      "Allow more than the expected execution time before triggering a trajectory cancel (applied after scaling)", Kind::NUMBER,
      0.5, 0.1, 30.0, 3 },
    { "execution_velocity_scaling", "Multiplicative factor for execution speed", Kind::NUMBER, 1.0, 0.1, 10.0, 4 },
    { "allowed_start_tolerance",
      "Allowed joint-value tolerance for validation of trajectory's start point against current robot state", Kind::NUMBER,
      0.01, 0.0, ANY, 5 },
    { "wait_for_trajectory_completion",
      "Wait for trajectory completion. If set to false, do not wait for controllers to converge to last way point, before "
      "reporting success.",
      Kind::FLAG, 1, 0, 1, 6 },
  };
  return all;
}

const Parameters& planParameters()
{
  static const Parameters all = {
    { "max_replan_attempts", "Set the maximum number of times a motion is planned again", Kind::COUNT, 5, 0, 1000, 1 },
    { "record_trajectory_state_frequency", "The frequency at which to record states when monitoring trajectories", Kind::NUMBER,
      0, 0, 1000, 6 },
  };
  return all;
}

const Parameters& sceneParameters()
{
  static const Parameters all = {
    { "publish_planning_scene", "Set to True to publish Planning Scenes", Kind::FLAG, 0, 0, 1, 1 },
    { "publish_planning_scene_hz", "Set the maximum frequency at which planning scene updates are published", Kind::NUMBER, 4,
      0.1, 100, 2 },
    { "publish_geometry_updates", "Set to True to publish geometry updates of the planning scene", Kind::FLAG, 1, 0, 1, 3 },
    { "publish_state_updates", "Set to True to publish state updates of the planning scene", Kind::FLAG, 0, 0, 1, 4 },
    { "publish_transforms_updates", "Set to True to publish transform updates of the planning scene", Kind::FLAG, 0, 0, 1, 5 },
  };
  return all;
}
}  // namespace execution

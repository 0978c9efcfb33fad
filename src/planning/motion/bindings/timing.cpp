#include "motion/timing.hpp"

#include "casters.hpp"
#include "motion/cartesian.hpp"

namespace motion
{
void bindTiming(py::module_& m)
{
  m.def("_time", [](const std::string& method, const Array& points, const Array& velocity, const Array& acceleration,
                    double path_tolerance, double resample_dt, double min_angle_change) {
    const std::size_t n = velocity.size();
    const Rows rows = rowsFromArray(points, n, "way points");
    const TimingLimits limits{fromArray(velocity, n, "velocity limits"), fromArray(acceleration, n, "acceleration limits")};
    for (std::size_t j = 0; j < n; ++j)
      if (!(limits.velocity[j] > 0) || !(limits.acceleration[j] > 0))
        throw InvalidInput("velocity and acceleration limits must be above 0");
    if (!(path_tolerance >= 0) || !(resample_dt > 0))
      throw InvalidInput("the path tolerance must be 0 or more and the resampling time above 0");
    TimedPath timed;
    {
      py::gil_scoped_release release;
      timed = method == "iterative_parabolic" ? iterativeParabolic(rows, limits)
              : method == "iterative_spline"  ? iterativeSpline(rows, limits)
                                              : timeOptimal(rows, limits, path_tolerance, resample_dt, min_angle_change);
    }
    return py::make_tuple(toArray(timed.times), toArray(timed.positions, n), toArray(timed.velocities, n),
                          toArray(timed.accelerations, n));
  });
  m.def("_cartesian_path",
        [](const PlanningScene& scene, const RobotState& start, const std::string& group, const std::string& link,
           const std::vector<Transform>& waypoints, double max_step, double jump, double prismatic, double revolute,
           bool avoid_collisions, double timeout, const Constraints* constraints, bool position_only) {
          CartesianRequest request{group,     link,     waypoints,        max_step, jump,
                                   prismatic, revolute, avoid_collisions, timeout,  position_only};
          CartesianPath path;
          {
            py::gil_scoped_release release;
            path = cartesianPath(scene, start, request, ConstraintSet(scene, constraints ? *constraints : Constraints()));
          }
          return py::make_tuple(path.fraction, toArray(path.points, scene.model()->group(group).size()), path.message);
        });
}
}  // namespace motion

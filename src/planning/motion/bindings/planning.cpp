#include "motion/planning.hpp"

#include "casters.hpp"

namespace motion
{
namespace
{
const char* statusName(PlanStatus status)
{
  static const char* names[] = {"solved",
                                "approximate",
                                "timeout",
                                "cancelled",
                                "invalid_start",
                                "start_in_collision",
                                "start_violates_path_constraints",
                                "no_goal",
                                "invalid_goal",
                                "goal_in_collision",
                                "goal_violates_path_constraints",
                                "no_ik",
                                "unknown_planner",
                                "failed",
                                "invalid_plan"};
  return names[static_cast<int>(status)];
}

struct CancelToken
{
  CancelFlag flag = std::make_shared<std::atomic<bool>>(false);
};
}  // namespace

void bindPlanning(py::module_& m)
{
  py::class_<CancelToken>(m, "CancelToken", "Ends what was started with it, from any thread, within some 10 ms.")
      .def(py::init<>())
      .def("cancel", [](CancelToken& t) { *t.flag = true; })
      .def_property_readonly("cancelled", [](const CancelToken& t) { return t.flag->load(); });
  py::class_<PlanRequest>(m, "_PlanRequest")
      .def(py::init<>())
      .def_readwrite("group", &PlanRequest::group)
      .def_readwrite("goals", &PlanRequest::goals)
      .def_readwrite("path", &PlanRequest::path)
      .def_readwrite("planner", &PlanRequest::planner)
      .def_readwrite("parameters", &PlanRequest::parameters)
      .def_readwrite("time", &PlanRequest::time)
      .def_readwrite("attempts", &PlanRequest::attempts)
      .def_readwrite("seed", &PlanRequest::seed)
      .def_readwrite("simplify", &PlanRequest::simplify)
      .def_readwrite("interpolate", &PlanRequest::interpolate)
      .def_readwrite("hybridize", &PlanRequest::hybridize)
      .def_readwrite("segment_fraction", &PlanRequest::segment_fraction)
      .def_readwrite("maximum_waypoint_distance", &PlanRequest::maximum_waypoint_distance)
      .def_readwrite("minimum_waypoints", &PlanRequest::minimum_waypoints)
      .def_readwrite("projection", &PlanRequest::projection)
      .def_readwrite("goal_samples", &PlanRequest::goal_samples)
      .def_readwrite("threads", &PlanRequest::threads)
      .def("set_workspace", [](PlanRequest& r, const Vector3& low, const Vector3& high) {
        r.has_workspace = true;
        r.workspace_min = low;
        r.workspace_max = high;
      });
  m.def("_plan", [](const std::shared_ptr<PlanningScene>& scene, const RobotState& start, const PlanRequest& request,
                    const CancelToken* token) {
    const CancelFlag flag = token ? token->flag : nullptr;
    PlanResult result;
    {
      py::gil_scoped_release release;
      const PlanningScene own(*scene);  // whoever changes the scene meanwhile does not disturb
      result = planClosely(own, start, request, flag);
    }
    py::dict out;
    out["status"] = statusName(result.status);
    out["message"] = result.message;
    out["path"] = toArray(result.path, scene->model()->group(request.group).size());
    out["planning_time"] = result.planning_time;
    out["simplify_time"] = result.simplify_time;
    out["states"] = result.states_checked;
    out["attempts"] = result.attempts;
    out["goals"] = result.goals;
    out["planner"] = result.planner;
    out["warnings"] = result.warnings;
    if (result.hit >= 0)
      out["invalid"] = std::vector<int>{result.hit};
    return out;
  });
  m.def("planners", &plannerParameters, "Planner name -> its parameters and their defaults, as text.");
  m.def("_planner_problem", &plannerProblem);
}
}  // namespace motion

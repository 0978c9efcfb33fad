// The laws of execution for the Python half.
#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "laws/execution.hpp"
#include "laws/parameters.hpp"
#include "laws/state_stamps.hpp"
#include "message_bytes.hpp"

namespace py = pybind11;
using Message = moveit_msgs::RobotTrajectory;
using execution::StartTolerance;

namespace
{
std::vector<double> timesOf(const Message& message)
{
  std::vector<double> times;
  for (const auto& point : message.joint_trajectory.points)
    times.push_back(point.time_from_start.toSec());
  if (times.empty())
    for (const auto& point : message.multi_dof_joint_trajectory.points)
      times.push_back(point.time_from_start.toSec());
  return times;
}

void bindTrajectory(py::module_& m)
{
  py::class_<Message>(m, "Trajectory", "A moveit_msgs/RobotTrajectory, read from its bytes.")
      .def(py::init(&read<Message>), py::arg("bytes"))
      .def("bytes", [](const Message& self) { return py::bytes(written(self)); })
      .def_property_readonly("joint_names", [](const Message& self) { return self.joint_trajectory.joint_names; })
      .def_property_readonly("multi_dof_joint_names",
                             [](const Message& self) { return self.multi_dof_joint_trajectory.joint_names; })
      .def_property_readonly("times", &timesOf, "Of its way points, s after the start.")
      .def_property_readonly("duration", &execution::duration, "s.")
      .def_property_readonly("takes_no_time", &execution::takesNoTime, "It has no point, or ends as it starts, now.")
      .def("fault", &execution::fault, py::arg("robot"),
           "One line about the first point that cannot be executed; empty when there is none.")
      .def("share", &execution::share, py::arg("joints"), py::arg("scaling") = 1.0,
           "The part that moves `joints`, which come in alphabetical order; velocities times `scaling`.")
      .def(
          "allowed_duration",
          [](const Message& self, double now, double scaling, double margin) {
            return execution::allowedDuration(self, ros::Time(now), scaling, margin);
          },
          py::arg("now"), py::arg("scaling"), py::arg("margin"),
          "How long a controller may take (s): from now (s) to the last point, times `scaling`, and `margin` (s).")
      .def("start_deviation", &execution::startDeviation, py::arg("state"), py::arg("tolerance"),
           "One line about the first joint that is not where the trajectory starts; empty when there is none.");
}

void bindParameters(py::module_& m)
{
  using execution::Kind;
  using execution::Parameter;
  py::enum_<Kind>(m, "Kind", "Of a parameter's values.")
      .value("FLAG", Kind::FLAG, "true or false; its value is 1 or 0")
      .value("COUNT", Kind::COUNT, "a whole number")
      .value("NUMBER", Kind::NUMBER, "any");
  py::class_<Parameter>(m, "Parameter", "One of a dynamic_reconfigure server of MoveIt: its own value and its bounds.")
      .def_readonly("name", &Parameter::name)
      .def_readonly("description", &Parameter::description)
      .def_readonly("kind", &Parameter::kind)
      .def_readonly("value", &Parameter::value)
      .def_readonly("low", &Parameter::low)
      .def_readonly("high", &Parameter::high)
      .def_readonly("level", &Parameter::level)
      .def("within", &Parameter::within, py::arg("given"),
           "What is given, inside the bounds; the own value where that is not a number.");
  m.def("parameters", &execution::parameters, "Those of <ns>/trajectory_execution, in the order in which tools show them.");
  m.def("plan_parameters", &execution::planParameters, "Those of <ns>/plan_execution.");
  m.def("scene_parameters", &execution::sceneParameters, "Those of <ns>/planning_scene_monitor.");
}

void bindStamps(py::module_& m)
{
  using state_stamps::Order;
  py::enum_<Order>(m, "StampOrder", "What a joint state is beside what is known of the joint.")
      .value("NEWS", Order::NEWS)
      .value("REPEATED", Order::REPEATED, "older: another publisher has said it since")
      .value("JUMPED_BACK", Order::JUMPED_BACK, "time goes on from before: all that is known is forgotten");
  m.def(
      "stamp_order",
      [](double known, double stamp, double now) {
        return state_stamps::order(ros::Time(known), ros::Time(stamp), ros::Time(now));
      },
      py::arg("known"), py::arg("stamp"), py::arg("now"), "All in s.");
}
}  // namespace

PYBIND11_MODULE(_execution, m)
{
  m.doc() = "What execution holds of trajectories, controllers and plans: laws/execution.hpp.";
  py::module_::import("motion");
  bindTrajectory(m);
  py::class_<StartTolerance>(m, "StartTolerance", "How far joints may be from a first point: rad or m; 0 is not looked at.")
      .def(py::init([](double all, const std::map<std::string, double>& joints) {
             return StartTolerance{ all, joints };
           }),
           py::arg("all"), py::arg("joints") = std::map<std::string, double>())
      .def("of", &StartTolerance::of, py::arg("joint"))
      .def("any", &StartTolerance::any, "Is any joint looked at?");
  py::class_<execution::Controller>(m, "Controller",
                                    "A controller as it is chosen: active (takes trajectories now), preferred.")
      .def(py::init([](const std::string& name, const execution::Joints& joints, bool active, bool preferred) {
             return execution::Controller{ name, joints, active, preferred };
           }),
           py::arg("name"), py::arg("joints"), py::arg("active") = false, py::arg("preferred") = false);
  bindParameters(m);
  bindStamps(m);
  m.def("actuated", &execution::actuated, py::arg("joints"), py::arg("robot"),
        "Those of `joints` that need a controller: not fixed, passive or mimic.");
  m.def("choose", &execution::choose, py::arg("wanted"), py::arg("controllers"), py::arg("manage"),
        "Names of the controllers that together move the joints `wanted`; empty if none do.");
  m.def("moved", &execution::moved, py::arg("joints"), py::arg("before"), py::arg("now"), py::arg("tolerance"),
        py::arg("part") = 1.0, "Has a joint moved by more than `part` of its tolerance between two states?");
  m.def("may_plan_again", &execution::mayPlanAgain, py::arg("code"), "May another plan do better after this MoveItErrorCodes?");
  m.def("waits_before_planning", &execution::waitsBeforePlanning, py::arg("code"), "Does one wait before that plan?");
  m.def("goes_on_from", &execution::goesOnFrom, py::arg("groups"), py::arg("index"),
        "The trajectory from whose end the continuous joints of trajectory `index` go on; -1: from where the robot is.");
  m.def("first_invalid", &execution::firstInvalid, py::arg("way_points"), py::arg("expected"), py::arg("way_point"),
        py::arg("now"), py::arg("valid"),
        "The first way point, from the one before `expected` on, that is not valid with what is attached in `now`; -1: none.");
}

#include <algorithm>
#include <cmath>

#include "bindings.hpp"

namespace ode_sim {

namespace {

using T8 = std::tuple<double, double, double, double, double, double, double, double>;

void set_axis(Joint& j, int i, T3 xyz, double lower, double upper, double effort, double velocity, double damping,
              double friction, double reference, double stiffness) {
  Axis& a = axis_of(j, i);
  const Vec3 direction = in(xyz);
  for (double v : {lower, upper, effort, velocity})
    if (std::isnan(v)) throw std::invalid_argument("a limit of a joint must be a number, not NaN");
  if (!(lower <= upper) || lower == kInf || upper == -kInf)
    throw std::invalid_argument("no position is between " + shown(lower) + " and " + shown(upper));
  const double d = limited(damping, kStiffest, "damping"), c = limited(friction, kStiffest, "friction"),
               k = limited(stiffness, kStiffest, "spring stiffness"), zero = limited(reference, kFarthest, "spring reference");
  a.xyz = direction;
  a.lower = lower;
  a.upper = upper;
  a.effort = effort;
  a.velocity = velocity;
  a.damping = std::max(d, 0.0);
  a.friction = std::max(c, 0.0);
  a.spring_reference = zero;
  a.spring_stiffness = std::max(k, 0.0);
  j.model->dirty = true;
}

T8 get_axis(Joint& j, int i) {
  const Axis& a = axis_of(j, i);
  return {a.lower, a.upper, a.effort, a.velocity, a.damping, a.friction, a.spring_reference, a.spring_stiffness};
}

// The angles of a gearbox are zero as its links are now.
void see_from(Joint& j, Link* reference) {
  if (reference && reference->model != j.model)
    throw std::invalid_argument("the reference of a gearbox is a link of its model");
  j.reference = reference;
  j.q_RJ = reference ? conjugate(reference->X_WL.q) * j.child_frame_W().q : j.child_frame_W().q;
}

// Position drives, and where the joint is.
void bind_drive(py::class_<Joint, std::shared_ptr<Joint>>& joint) {
  joint.def("drive_to", [](Joint& j, double q) { world_of(j.model).set_drive(j, q); })
      .def("drive_off", [](Joint& j) { world_of(j.model).drive_off(j); })
      .def_property_readonly("drive_mode", [](Joint& j) { return static_cast<int>(j.drive); })
      .def_readonly("drive_target", &Joint::target)
      .def(
          "follow",
          [](Joint& j, const std::shared_ptr<Joint>& leader, double multiplier, double offset) {
            world_of(j.model).follow(j, leader, multiplier, offset);
          },
          py::arg("leader").none(true), py::arg("multiplier"), py::arg("offset"))
      .def(
          "set_position",
          [](Joint& j, double q, int i) {
            World& world = world_of(j.model);
            if (j.axis_count) axis_of(j, i);
            return world.set_joint_position(j, i, limited(q, kFarthest, "a joint position"));
          },
          py::arg("q"), py::arg("axis") = 0)
      .def("frame", [](Joint& j) { return out(j.child->X_WL * j.X_CJ); })
      .def("parent_frame", [](Joint& j) { return out(j.frame_W()); })
      .def("watch",
           [](Joint& j) {
             if (j.watched) return;
             j.watched = true;
             j.model->dirty = true;
           })
      .def("feedback", [](Joint& j) {
        const Feedback& f = j.feedback;
        return std::make_tuple(out(f.child_force), out(f.child_torque), out(f.parent_force), out(f.parent_torque));
      });
}

}  // namespace

void bind_joints(py::module_& m) {
  py::class_<Joint, std::shared_ptr<Joint>> joint(m, "Joint");
  bind_drive(joint);
  joint.def_readonly("id", &Joint::id)
      .def_property_readonly("address", [](const Joint& j) { return reinterpret_cast<uintptr_t>(&j); })  // for actuation.hpp
      .def_readonly("row", &Joint::row)
      .def_readonly("axis_count", &Joint::axis_count)
      .def_property(
          "stop_erp", [](Joint& j) { return j.stop_erp; },
          [](Joint& j, double v) { j.stop_erp = std::max(limited(v, 10, "stop_erp"), 0.0); })
      .def_property(
          "stop_cfm", [](Joint& j) { return j.stop_cfm; },
          [](Joint& j, double v) { j.stop_cfm = std::max(limited(v, kStiffest, "stop_cfm"), 0.0); })
      .def_readwrite("implicit_spring_damper", &Joint::implicit_spring_damper)
      .def("changed", [](Joint& j) { j.model->dirty = true; })
      .def_property(
          "thread_pitch", [](Joint& j) { return j.thread_pitch; }, &set_thread_pitch)
      .def_property(
          "gear_ratio", [](Joint& j) { return j.gear_ratio; }, &set_gear_ratio)
      .def("see_from", &see_from, py::arg("reference").none(true))
      .def("set_axis", &set_axis)
      .def("get", &get_axis)
      .def(
          "position", [](Joint& j, int i) { return axis_of(j, i).q; }, py::arg("axis") = 0)
      .def(
          "velocity", [](Joint& j, int i) { return axis_of(j, i).qd; }, py::arg("axis") = 0)
      .def(
          "effort", [](Joint& j, int i) { return axis_of(j, i).effort_now(); }, py::arg("axis") = 0)
      .def(
          "add_force", [](Joint& j, double f, int i) { add_force(axis_of(j, i), f); }, py::arg("force"), py::arg("axis") = 0)
      .def(
          "add_law", [](Joint& j, double f, double slope, double bound, int i) { add_law(axis_of(j, i), f, slope, bound); },
          py::arg("force"), py::arg("slope"), py::arg("bound"), py::arg("axis") = 0)
      .def(
          "set_motor", [](Joint& j, double velocity, double force, int i) { set_motor(axis_of(j, i), velocity, force); },
          py::arg("velocity"), py::arg("max_force"), py::arg("axis") = 0)
      .def(
          "motor", [](Joint& j, int i) { return std::make_pair(axis_of(j, i).motor_velocity, axis_of(j, i).motor_force); },
          py::arg("axis") = 0);
}

}  // namespace ode_sim

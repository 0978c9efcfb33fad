#include "bindings.hpp"

namespace ode_sim {

namespace {

void bind_properties(py::class_<Link, std::shared_ptr<Link>>& c) {
  c.def_readonly("id", &Link::id)
      .def_readonly("row", &Link::row)
      .def_readonly("mass", &Link::mass)
      .def_readwrite("gravity_flag", &Link::gravity)
      .def_readwrite("kinematic", &Link::kinematic)
      .def_readwrite("self_collide", &Link::self_collide)
      .def_property(
          "linear_decay", [](Link& l) { return l.linear_decay; },
          [](Link& l, double v) { l.linear_decay = std::max(limited(v, 1, "linear_decay"), 0.0); })
      .def_property(
          "angular_decay", [](Link& l) { return l.angular_decay; },
          [](Link& l, double v) { l.angular_decay = std::max(limited(v, 1, "angular_decay"), 0.0); })
      .def_property_readonly("inertia",
                             [](Link& l) {
                               const Sym3& i = l.inertia;
                               return std::make_tuple(i.xx, i.yy, i.zz, i.xy, i.xz, i.yz);
                             })
      .def("changed", [](Link& l) { l.model->dirty = true; })
      .def("set_inertial", [](Link& l, double mass, T3 com, T6 inertia) {
        world_of(l.model).set_inertial(l, in_mass(mass), checked_place(in(com), "a centre of mass"), in(inertia));
      });
}

void bind_motion(py::class_<Link, std::shared_ptr<Link>>& c) {
  c.def("pose", [](Link& l) { return out(l.X_WL); })
      .def("set_pose", [](Link& l, T7 X) { world_of(l.model).set_link_pose(l, in(X)); })
      .def("linear_velocity", [](Link& l) { return out(l.v); })
      .def("angular_velocity", [](Link& l) { return out(l.w); })
      .def("com", [](Link& l) { return out(l.com_W()); })
      .def("com_velocity", [](Link& l) { return out(l.velocity_at(l.com_W())); })
      .def("velocity_at", [](Link& l, T3 p) { return out(l.velocity_at(in(p))); })
      .def("set_twist", [](Link& l, T3 v, T3 w) {
        world_of(l.model).set_link_twist(l, limited(in(v), kFastestSet, "a velocity"),
                                         limited(in(w), kFastestSet, "a velocity"));
      });
}

void bind_forces(py::class_<Link, std::shared_ptr<Link>>& c) {
  c.def("add_force", [](Link& l, T3 f) { push(l.force, in(f)); })
      .def("add_force_at",
           [](Link& l, T3 f, T3 p) {
             const Vec3 force = limited(in(f), kStrongest, "a force"),
                        arm = checked_place(in(p), "the point of a force") - l.com_W();
             push(l.force, force);
             push(l.torque, cross(arm, force));
           })
      .def("add_torque", [](Link& l, T3 t) { push(l.torque, in(t)); })
      .def("set_force", [](Link& l, T3 f) { l.force = limited(in(f), kStrongest, "a force"); })
      .def("set_torque", [](Link& l, T3 t) { l.torque = limited(in(t), kStrongest, "a torque"); })
      .def("run_belt",
           [](Link& l, double speed, T3 left, T3 v, T3 w) {
             const Vec3 axis = in(left);
             const double size = norm(axis);
             if (!(size > 0) || !std::isfinite(size)) throw std::invalid_argument("the axis across a belt has no direction");
             l.belt = {limited(speed, kFastestSet, "a belt's speed"),
                       axis * (1 / size),
                       true,
                       limited(in(v), kFastestSet, "a velocity"),
                       limited(in(w), kFastestSet, "a velocity"),
                       l.X_WL.p};
           })
      .def("force", [](Link& l) { return out(l.force); })
      .def("torque", [](Link& l) { return out(l.torque); })
      .def("applied_force", [](Link& l) { return out(l.applied_force); })
      .def("applied_torque", [](Link& l) { return out(l.applied_torque); });
}

}  // namespace

void bind_links(py::module_& m) {
  py::class_<Link, std::shared_ptr<Link>> c(m, "Link");
  bind_properties(c);
  bind_motion(c);
  bind_forces(c);
}

}  // namespace ode_sim

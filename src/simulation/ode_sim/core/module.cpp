// Python bindings of the physics core. Vectors go over as 3-tuples, poses as 7-tuples (x y z qx qy qz qw), SI units,
// world axes. Meant for ode_sim's own Python modules, which check what users give them.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#include "geometry.hpp"
#include "world.hpp"

namespace py = pybind11;
using namespace ode_sim;

using T3 = std::tuple<double, double, double>;
using T7 = std::tuple<double, double, double, double, double, double, double>;

static T3 out(const Vec3& v) { return {v.x, v.y, v.z}; }
static Vec3 in(const T3& t) { return checked(Vec3{std::get<0>(t), std::get<1>(t), std::get<2>(t)}, "a vector"); }
static T7 out(const Pose& X) { return {X.p.x, X.p.y, X.p.z, X.q.x, X.q.y, X.q.z, X.q.w}; }
static Pose in(const T7& t, double most = kFarthestPart) {
  return checked(Pose{{std::get<0>(t), std::get<1>(t), std::get<2>(t)}, {std::get<3>(t), std::get<4>(t), std::get<5>(t), std::get<6>(t)}},
                 "a pose", most);
}
using T6 = std::tuple<double, double, double, double, double, double>;
static Sym3 in(const T6& t) {  // ixx iyy izz ixy ixz iyz
  const Sym3 m{std::get<0>(t), std::get<1>(t), std::get<2>(t), std::get<3>(t), std::get<4>(t), std::get<5>(t)};
  for (double v : {m.xx, m.yy, m.zz, m.xy, m.xz, m.yz}) checked(v, "a moment of inertia");
  return m;
}
static double in_mass(double mass) {
  if (!(mass > 0)) throw std::invalid_argument("a mass must be positive, not " + shown(mass));
  return checked(mass, "a mass");
}
static Axis& axis_of(Joint& j, int i) {
  if (i >= 0 && i < std::max(j.axis_count, 1)) return j.axes[i];
  throw std::invalid_argument("a joint of " + std::to_string(j.axis_count) + " axes has no axis " + std::to_string(i));
}
static void push(Vec3& sum, const Vec3& f) { sum = limited(sum + f, kStrongest, "a force"); }
static World& world_of(Model* model) {
  if (!model || !model->world) throw std::runtime_error("this model is no longer in the world");
  return *model->world;
}

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

// A number of a surface: cut to its bounds, NaN refused.
template <double Surface::*field>
static void bounded(py::class_<Surface>& c, const char* name, double least, double most) {
  c.def_property(name, [](Surface& s) { return s.*field; }, [name, least, most](Surface& s, double v) {
    s.*field = std::max(limited(v, most, name), least);
  });
}

// A view, read-only, of memory that lives as long as anybody looks at it.
static py::array view(const World::Array& data, std::vector<py::ssize_t> shape) {
  auto* owner = new World::Array(data);
  py::array_t<double> a(std::move(shape), data->data(), py::capsule(owner, [](void* p) { delete static_cast<World::Array*>(p); }));
  a.attr("setflags")(py::arg("write") = false);
  return std::move(a);
}

PYBIND11_MODULE(_core, m) {
  m.doc() = "Rigid-body physics on ODE: the whole step, in C++.";
  m.attr("ode_configuration") = dGetConfiguration();
  m.attr("FARTHEST") = kFarthest;
  PYBIND11_NUMPY_DTYPE(ContactRecord, collision1, collision2, position, normal, depth, force, torque);

  py::class_<Surface> surface(m, "Surface");
  bounded<&Surface::mu>(surface, "mu", 0, kRoughest);
  bounded<&Surface::mu2>(surface, "mu2", 0, kRoughest);
  bounded<&Surface::slip1>(surface, "slip1", 0, kRoughest);
  bounded<&Surface::slip2>(surface, "slip2", 0, kRoughest);
  bounded<&Surface::kp>(surface, "kp", 0, kStiffest);
  bounded<&Surface::kd>(surface, "kd", 0, kStiffest);
  bounded<&Surface::max_vel>(surface, "max_vel", -1, kFastestSet);
  bounded<&Surface::min_depth>(surface, "min_depth", 0, kFarthest);
  bounded<&Surface::restitution>(surface, "restitution", 0, 10);
  bounded<&Surface::bounce_threshold>(surface, "bounce_threshold", 0, kFastestSet);
  surface.def_readwrite("collide_bitmask", &Surface::collide_bitmask)
      .def_readwrite("collide_without_contact", &Surface::collide_without_contact)
      .def_property("fdir1", [](Surface& s) { return out(s.fdir1); }, [](Surface& s, T3 v) { s.fdir1 = limited(in(v), kFarthest, "fdir1"); });

  py::class_<MeshData, std::shared_ptr<MeshData>>(m, "MeshData")
      .def(py::init([](Doubles vertices, py::array_t<uint32_t, py::array::c_style | py::array::forcecast> triangles) {
        std::vector<double> v(vertices.data(), vertices.data() + vertices.size());
        std::vector<dTriIndex> t(triangles.data(), triangles.data() + triangles.size());
        py::gil_scoped_release release;
        return std::make_shared<MeshData>(std::move(v), std::move(t));
      }), py::arg("vertices"), py::arg("triangles"));

  py::class_<Shape, std::shared_ptr<Shape>>(m, "Shape")
      .def_readonly("id", &Shape::id)
      .def_readwrite("max_contacts", &Shape::max_contacts)
      .def_readwrite("watched", &Shape::watched)
      .def_property_readonly("surface", [](Shape& s) -> Surface& { return s.surface; }, py::return_value_policy::reference_internal)
      .def_property_readonly("pose", [](Shape& s) { return out(s.link->X_WL * s.X_LC); })
      .def("aabb", [](Shape& s) {
        if (!s.geom) throw std::runtime_error("this collision is no longer in the world");
        std::array<double, 6> box;
        dGeomGetAABB(s.geom, box.data());
        return box;
      });

  py::class_<Link, std::shared_ptr<Link>>(m, "Link")
      .def_readonly("row", &Link::row)
      .def_readonly("mass", &Link::mass)
      .def_readwrite("gravity_flag", &Link::gravity)
      .def_readwrite("kinematic", &Link::kinematic)
      .def_readwrite("self_collide", &Link::self_collide)
      .def_property("linear_decay", [](Link& l) { return l.linear_decay; }, [](Link& l, double v) { l.linear_decay = std::max(limited(v, 1, "linear_decay"), 0.0); })
      .def_property("angular_decay", [](Link& l) { return l.angular_decay; }, [](Link& l, double v) { l.angular_decay = std::max(limited(v, 1, "angular_decay"), 0.0); })
      .def_property_readonly("inertia", [](Link& l) {
        const Sym3& i = l.inertia;
        return std::make_tuple(i.xx, i.yy, i.zz, i.xy, i.xz, i.yz);
      })
      .def("changed", [](Link& l) { l.model->dirty = true; })
      .def("pose", [](Link& l) { return out(l.X_WL); })
      .def("set_pose", [](Link& l, T7 X) { world_of(l.model).set_link_pose(l, in(X)); })
      .def("linear_velocity", [](Link& l) { return out(l.v); })
      .def("angular_velocity", [](Link& l) { return out(l.w); })
      .def("com", [](Link& l) { return out(l.com_W()); })
      .def("com_velocity", [](Link& l) { return out(l.velocity_at(l.com_W())); })
      .def("velocity_at", [](Link& l, T3 p) { return out(l.velocity_at(in(p))); })
      .def("set_twist", [](Link& l, T3 v, T3 w) {
        world_of(l.model).set_link_twist(l, limited(in(v), kFastestSet, "a velocity"), limited(in(w), kFastestSet, "a velocity"));
      })
      .def("add_force", [](Link& l, T3 f) { push(l.force, in(f)); })
      .def("add_force_at", [](Link& l, T3 f, T3 p) {
        const Vec3 force = limited(in(f), kStrongest, "a force"), arm = checked_place(in(p), "the point of a force") - l.com_W();
        push(l.force, force);
        push(l.torque, cross(arm, force));
      })
      .def("add_torque", [](Link& l, T3 t) { push(l.torque, in(t)); })
      .def("set_force", [](Link& l, T3 f) { l.force = limited(in(f), kStrongest, "a force"); })
      .def("set_torque", [](Link& l, T3 t) { l.torque = limited(in(t), kStrongest, "a torque"); })
      .def("force", [](Link& l) { return out(l.force); })
      .def("torque", [](Link& l) { return out(l.torque); })
      .def("applied_force", [](Link& l) { return out(l.applied_force); })
      .def("applied_torque", [](Link& l) { return out(l.applied_torque); })
      .def("set_inertial", [](Link& l, double mass, T3 com, T6 inertia) {
        world_of(l.model).set_inertial(l, in_mass(mass), checked_place(in(com), "a centre of mass"), in(inertia));
      });

  py::class_<Joint, std::shared_ptr<Joint>>(m, "Joint")
      .def_readonly("row", &Joint::row)
      .def_readonly("axis_count", &Joint::axis_count)
      .def_property("stop_erp", [](Joint& j) { return j.stop_erp; }, [](Joint& j, double v) { j.stop_erp = std::max(limited(v, 10, "stop_erp"), 0.0); })
      .def_property("stop_cfm", [](Joint& j) { return j.stop_cfm; }, [](Joint& j, double v) { j.stop_cfm = std::max(limited(v, kStiffest, "stop_cfm"), 0.0); })
      .def_readwrite("implicit_spring_damper", &Joint::implicit_spring_damper)
      .def("changed", [](Joint& j) { j.model->dirty = true; })
      .def("set_axis", [](Joint& j, int i, T3 xyz, double lower, double upper, double effort, double velocity,
                          double damping, double friction, double reference, double stiffness) {
        Axis& a = axis_of(j, i);
        const Vec3 direction = in(xyz);
        for (double v : {lower, upper, effort, velocity}) if (std::isnan(v)) throw std::invalid_argument("a limit of a joint must be a number, not NaN");
        if (!(lower <= upper) || lower == kInf || upper == -kInf) throw std::invalid_argument("no position is between " + shown(lower) + " and " + shown(upper));
        const double d = limited(damping, kStiffest, "damping"), c = limited(friction, kStiffest, "friction"),
                     k = limited(stiffness, kStiffest, "spring stiffness"), zero = limited(reference, kFarthest, "spring reference");
        a.xyz = direction;
        a.lower = lower; a.upper = upper; a.effort = effort; a.velocity = velocity;
        a.damping = std::max(d, 0.0); a.friction = std::max(c, 0.0); a.spring_reference = zero; a.spring_stiffness = std::max(k, 0.0);
        j.model->dirty = true;
      })
      .def("get", [](Joint& j, int i) {
        const Axis& a = axis_of(j, i);
        return std::make_tuple(a.lower, a.upper, a.effort, a.velocity, a.damping, a.friction, a.spring_reference, a.spring_stiffness);
      })
      .def("position", [](Joint& j, int i) { return axis_of(j, i).q; }, py::arg("axis") = 0)
      .def("velocity", [](Joint& j, int i) { return axis_of(j, i).qd; }, py::arg("axis") = 0)
      .def("effort", [](Joint& j, int i) { return axis_of(j, i).effort_now(); }, py::arg("axis") = 0)
      .def("add_force", [](Joint& j, double f, int i) {
        Axis& a = axis_of(j, i);
        a.force += a.admitted(limited(f, kStrongest, "a force"));
        a.commanded = true;
      }, py::arg("force"), py::arg("axis") = 0)
      .def("add_law", [](Joint& j, double f, double slope, double bound, int i) {
        Axis& a = axis_of(j, i);
        a.law = limited(f, kStrongest, "a force");
        a.slope = std::max(limited(slope, kStrongest, "a controller's slope"), 0.0);
        a.law_bound = std::max(limited(bound, kInf, "the bound of a force"), 0.0);
        a.force += a.lawful();
        a.commanded = true;
      }, py::arg("force"), py::arg("slope"), py::arg("bound"), py::arg("axis") = 0)
      .def("set_motor", [](Joint& j, double velocity, double force, int i) {
        Axis& a = axis_of(j, i);
        const double v = limited(velocity, kFastestSet, "a motor's velocity"), f = limited(force, kInf, "a motor's force");
        a.motor_velocity = v;
        a.motor_force = f;
      }, py::arg("velocity"), py::arg("max_force"), py::arg("axis") = 0)
      .def("motor", [](Joint& j, int i) { return std::make_pair(axis_of(j, i).motor_velocity, axis_of(j, i).motor_force); }, py::arg("axis") = 0)
      .def("servo", [](Joint& j, double q) { world_of(j.model).set_servo(j, q); })
      .def("servo_off", [](Joint& j) { world_of(j.model).servo_off(j); })
      .def_property_readonly("servo_mode", [](Joint& j) { return static_cast<int>(j.servo); })
      .def_readonly("servo_target", &Joint::target)
      .def("follow", [](Joint& j, std::shared_ptr<Joint> leader, double multiplier, double offset) {
        world_of(j.model).follow(j, leader, multiplier, offset);
      }, py::arg("leader").none(true), py::arg("multiplier"), py::arg("offset"))
      .def("set_position", [](Joint& j, double q, int i) {
        World& world = world_of(j.model);
        if (j.axis_count) axis_of(j, i);
        return world.set_joint_position(j, i, limited(q, kFarthest, "a joint position"));
      }, py::arg("q"), py::arg("axis") = 0)
      .def("frame", [](Joint& j) { return out(j.child->X_WL * j.X_CJ); })
      .def("parent_frame", [](Joint& j) { return out(j.frame_W()); })
      .def("watch", [](Joint& j) {
        if (j.watched) return;
        j.watched = true;
        j.model->dirty = true;
      })
      .def("feedback", [](Joint& j) {
        return std::make_tuple(out(j.feedback.child_force), out(j.feedback.child_torque), out(j.feedback.parent_force), out(j.feedback.parent_torque));
      });

  py::class_<Model, std::shared_ptr<Model>>(m, "Model")
      .def_readonly("id", &Model::id)
      .def_readonly("is_static", &Model::is_static)
      .def_property_readonly("asleep", [](Model& m) {
        bool all = !m.clusters.empty();
        for (auto& c : m.clusters) all &= c.asleep;
        return all;
      })
      // What is handed out keeps the model, and so all that it points at.
      .def("add_link", [](Model& model, T7 X, double mass, T3 com, T6 inertia) {
        return world_of(&model).add_link(model, in(X), in_mass(mass), checked_place(in(com), "a centre of mass"), in(inertia));
      }, py::keep_alive<0, 1>())
      .def("add_joint", [](Model& model, const std::string& type, Link* parent, Link& child, T7 X_CJ) {
        static const std::map<std::string, JointType> types = {
            {"revolute", JointType::Revolute}, {"prismatic", JointType::Prismatic}, {"fixed", JointType::Fixed},
            {"universal", JointType::Universal}, {"ball", JointType::Ball}};
        if (&child == parent || child.model != &model || (parent && parent->model != &model))
          throw std::invalid_argument("a joint takes two links of its model");
        return world_of(&model).add_joint(model, types.at(type), parent, child, in(X_CJ));
      }, py::keep_alive<0, 1>(), py::arg("type"), py::arg("parent").none(true), py::arg("child"), py::arg("X_CJ"))
      .def("add_box", [](Model& model, Link& l, T7 X, T3 size) {
        const Pose X_LC = in(X);
        const Vec3 s = in(size);
        for (double v : {s.x, s.y, s.z}) checked_size(v, "a side of a box");
        return world_of(&model).add_shape(l, X_LC, dCreateBox(nullptr, s.x, s.y, s.z), std::make_shared<Shape>());
      }, py::keep_alive<0, 1>())
      .def("add_sphere", [](Model& model, Link& l, T7 X, double radius) {
        const Pose X_LC = in(X);
        return world_of(&model).add_shape(l, X_LC, dCreateSphere(nullptr, checked_size(radius, "a radius")), std::make_shared<Shape>());
      }, py::keep_alive<0, 1>())
      .def("add_cylinder", [](Model& model, Link& l, T7 X, double radius, double length) {
        const Pose X_LC = in(X);
        auto shape = std::make_shared<Shape>();
        const dGeomID geom = make_cylinder(*shape, checked_size(radius, "a radius"), checked_size(length, "a length"));
        return world_of(&model).add_shape(l, X_LC, geom, shape);
      }, py::keep_alive<0, 1>())
      .def("add_capsule", [](Model& model, Link& l, T7 X, double radius, double length) {
        const Pose X_LC = in(X);
        const dGeomID geom = dCreateCapsule(nullptr, checked_size(radius, "a radius"), checked_size(length, "a length"));
        return world_of(&model).add_shape(l, X_LC, geom, std::make_shared<Shape>());
      }, py::keep_alive<0, 1>())
      .def("add_plane", [](Model& model, Link& l, T7 X, T3 normal) {
        const Pose X_LC = in(X);
        auto shape = std::make_shared<Shape>();
        shape->infinite = true;
        shape->plane_normal = in(normal);
        if (!(std::abs(norm(shape->plane_normal) - 1) < 1e-6)) throw std::invalid_argument("the normal of a plane must be a unit vector");
        // Upstream's rule: the normal is one of the world whatever the model's pose, through the height (not the place) at which
        // the collision is made; nothing moves the plane after that. A wall sticker that lies on the floor is floor.
        const Vec3 n = shape->plane_normal;
        return world_of(&model).add_shape(l, X_LC, dCreatePlane(nullptr, n.x, n.y, n.z, (l.X_WL * X_LC).p.z), shape);
      }, py::keep_alive<0, 1>())
      .def("add_mesh", [](Model& model, Link& l, T7 X, std::shared_ptr<MeshData> data) {
        const Pose X_LC = in(X);
        auto shape = std::make_shared<Shape>();
        const dGeomID geom = make_mesh(*shape, std::move(data));
        return world_of(&model).add_shape(l, X_LC, geom, shape);
      }, py::keep_alive<0, 1>())
      .def("add_heightmap", [](Model& model, Link& l, T7 X, Doubles heights, double size_x, double size_y) {
        const Pose X_LC = in(X);
        if (heights.ndim() != 2) throw std::invalid_argument("heights must be rows of columns");
        auto shape = std::make_shared<Shape>();
        std::vector<double> h(heights.data(), heights.data() + heights.size());
        const dGeomID geom = make_heightmap(*shape, std::move(h), static_cast<int>(heights.shape(1)), static_cast<int>(heights.shape(0)), size_x, size_y);
        return world_of(&model).add_shape(l, X_LC, geom, shape);
      }, py::keep_alive<0, 1>())
      .def("finish", [](Model& model) { world_of(&model).finish(model); })
      .def("set_pose", [](Model& model, T7 from, T7 to) { world_of(&model).set_model_pose(model, in(from, kInf), in(to)); })
      .def("add_twist", [](Model& m, T3 v, T3 w, T3 at) {
        world_of(&m).add_model_twist(m, limited(in(v), kFastestSet, "a velocity"), limited(in(w), kFastestSet, "a velocity"), in(at));
      })
      .def("zero_velocities", [](Model& model) { world_of(&model).zero_velocities(model); });

  py::class_<World::Counters>(m, "Counters")
      .def_readonly("direct", &World::Counters::direct)
      .def_readonly("quick", &World::Counters::quick)
      .def_readonly("fallbacks", &World::Counters::fallbacks)
      .def_readonly("promotions", &World::Counters::promotions)
      .def_readonly("contacts", &World::Counters::contacts);
  py::class_<World, std::shared_ptr<World>>(m, "World")
      .def(py::init<>())
      .def_readwrite("dt", &World::dt)
      .def_property("gravity", [](World& w) { return out(w.gravity); }, [](World& w, T3 g) { w.gravity = in(g); })
      .def_readwrite("erp", &World::erp)
      .def_readwrite("cfm", &World::cfm)
      .def_readwrite("sor", &World::sor)
      .def_readwrite("iters", &World::iters)
      .def_readwrite("max_contacts", &World::max_contacts)
      .def_readwrite("like_gazebo", &World::like_gazebo)
      .def_readwrite("contact_max_vel", &World::contact_max_vel)
      .def_readwrite("surface_layer", &World::surface_layer)
      .def_readwrite("contact_softness", &World::contact_softness)
      .def_readwrite("friction_softness", &World::friction_softness)
      .def_readwrite("direct_rows", &World::direct_rows)
      .def_readwrite("heap_rows", &World::heap_rows)
      .def_readwrite("seed", &World::seed)
      .def_readwrite("iterations", &World::iterations)
      .def_readwrite("time_ns", &World::time_ns)
      .def_readonly("counters", &World::counters)
      .def("add_model", &World::add_model)
      .def("remove_model", &World::remove_model)
      .def("attach", &World::attach, py::arg("parent").none(true), py::arg("child").none(false))
      .def("detach", &World::detach)
      .def("detach_all", &World::detach_all)
      .def("ties", &World::ties)
      .def("attached", [](World& w, int tie) { return w.find_tie(tie) != nullptr; })
      .def("tie_pose", [](World& w, int tie) {
        const Tie* t = w.find_tie(tie);
        if (!t) throw std::runtime_error("these links are no longer attached");
        return out(t->X_PC);
      })
      .def("set_tie_pose", [](World& w, int tie, T7 X) {
        Tie* t = w.find_tie(tie);
        if (!t) throw std::runtime_error("these links are no longer attached");
        t->X_PC = in(X);
      })
      .def("refresh", &World::refresh)
      .def("step", &World::step, py::call_guard<py::gil_scoped_release>())
      .def("take_messages", &World::take_messages)
      .def("save", [](World& w) { return py::bytes(w.save()); })
      .def("restore", [](World& w, py::bytes data, const std::vector<int>& ties) { w.restore(data, ties); })
      .def_property_readonly("link_poses", [](World& w) {
        return view(w.link_poses, {static_cast<py::ssize_t>(w.link_poses->size() / 7), 7});
      })
      .def_property_readonly("joint_positions", [](World& w) {
        return view(w.joint_positions, {static_cast<py::ssize_t>(w.joint_positions->size())});
      })
      .def_property_readonly("joint_velocities", [](World& w) {
        return view(w.joint_velocities, {static_cast<py::ssize_t>(w.joint_velocities->size())});
      })
      .def("contacts", [](World& w) {
        auto records = w.contact_records();
        py::array_t<ContactRecord> a(static_cast<py::ssize_t>(records.size()));
        if (!records.empty()) std::memcpy(a.mutable_data(), records.data(), records.size() * sizeof(ContactRecord));
        return a;
      })
      .def("cast_rays", [](World& w, Doubles origins, Doubles directions, double max_range, std::vector<int> ignore) {
        if (origins.size() != directions.size() || origins.size() % 3) throw std::invalid_argument("rays take as many origins as directions, of three numbers each");
        const auto n = origins.size() / 3;
        py::array_t<double> ranges(n);
        py::array_t<int32_t> hits(n);
        const double *o = origins.data(), *d = directions.data();
        double* r = ranges.mutable_data();
        int32_t* h = hits.mutable_data();
        {
          py::gil_scoped_release release;
          w.cast_rays(o, d, static_cast<int>(n), max_range, ignore, r, h);
        }
        return std::make_pair(ranges, hits);
      });
}

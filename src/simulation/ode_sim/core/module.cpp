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
static Vec3 in(const T3& t) { return {std::get<0>(t), std::get<1>(t), std::get<2>(t)}; }
static T7 out(const Pose& X) { return {X.p.x, X.p.y, X.p.z, X.q.x, X.q.y, X.q.z, X.q.w}; }
static Pose in(const T7& t) {
  return {{std::get<0>(t), std::get<1>(t), std::get<2>(t)},
          normalized(Quat{std::get<3>(t), std::get<4>(t), std::get<5>(t), std::get<6>(t)})};
}
using T6 = std::tuple<double, double, double, double, double, double>;
static Sym3 in(const T6& t) {  // ixx iyy izz ixy ixz iyz
  return {std::get<0>(t), std::get<1>(t), std::get<2>(t), std::get<3>(t), std::get<4>(t), std::get<5>(t)};
}
static World& world_of(Model* model) {
  if (!model || !model->world) throw std::runtime_error("this model is no longer in the world");
  return *model->world;
}

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

PYBIND11_MODULE(_core, m) {
  m.doc() = "Rigid-body physics on ODE: the whole step, in C++.";
  m.attr("ode_configuration") = dGetConfiguration();
  PYBIND11_NUMPY_DTYPE(ContactRecord, collision1, collision2, position, normal, depth, force, torque);

  py::class_<Surface>(m, "Surface")
      .def_readwrite("mu", &Surface::mu)
      .def_readwrite("mu2", &Surface::mu2)
      .def_readwrite("slip1", &Surface::slip1)
      .def_readwrite("slip2", &Surface::slip2)
      .def_readwrite("kp", &Surface::kp)
      .def_readwrite("kd", &Surface::kd)
      .def_readwrite("max_vel", &Surface::max_vel)
      .def_readwrite("min_depth", &Surface::min_depth)
      .def_readwrite("restitution", &Surface::restitution)
      .def_readwrite("bounce_threshold", &Surface::bounce_threshold)
      .def_readwrite("collide_bitmask", &Surface::collide_bitmask)
      .def_readwrite("collide_without_contact", &Surface::collide_without_contact)
      .def_property("fdir1", [](Surface& s) { return out(s.fdir1); }, [](Surface& s, T3 v) { s.fdir1 = in(v); });

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
      .def_readwrite("linear_decay", &Link::linear_decay)
      .def_readwrite("angular_decay", &Link::angular_decay)
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
      .def("set_twist", [](Link& l, T3 v, T3 w) { world_of(l.model).set_link_twist(l, in(v), in(w)); })
      .def("add_force", [](Link& l, T3 f) { l.force += in(f); })
      .def("add_force_at", [](Link& l, T3 f, T3 p) {
        l.force += in(f);
        l.torque += cross(in(p) - l.com_W(), in(f));
      })
      .def("add_torque", [](Link& l, T3 t) { l.torque += in(t); })
      .def("set_force", [](Link& l, T3 f) { l.force = in(f); })
      .def("set_torque", [](Link& l, T3 t) { l.torque = in(t); })
      .def("force", [](Link& l) { return out(l.force); })
      .def("torque", [](Link& l) { return out(l.torque); })
      .def("applied_force", [](Link& l) { return out(l.applied_force); })
      .def("applied_torque", [](Link& l) { return out(l.applied_torque); })
      .def("set_inertial", [](Link& l, double mass, T3 com, T6 inertia) {
        world_of(l.model).set_inertial(l, mass, in(com), in(inertia));
      });

  py::class_<Joint, std::shared_ptr<Joint>>(m, "Joint")
      .def_readonly("row", &Joint::row)
      .def_readonly("axis_count", &Joint::axis_count)
      .def_readwrite("stop_erp", &Joint::stop_erp)
      .def_readwrite("stop_cfm", &Joint::stop_cfm)
      .def_readwrite("implicit_spring_damper", &Joint::implicit_spring_damper)
      .def("changed", [](Joint& j) { j.model->dirty = true; })
      .def("set_axis", [](Joint& j, int i, T3 xyz, double lower, double upper, double effort, double velocity,
                          double damping, double friction, double reference, double stiffness) {
        Axis& a = j.axes[i];
        a.xyz = in(xyz);
        a.lower = lower; a.upper = upper; a.effort = effort; a.velocity = velocity; a.damping = damping;
        a.friction = friction; a.spring_reference = reference; a.spring_stiffness = stiffness;
        j.model->dirty = true;
      })
      .def("get", [](Joint& j, int i) {
        const Axis& a = j.axes[i];
        return std::make_tuple(a.lower, a.upper, a.effort, a.velocity, a.damping, a.friction, a.spring_reference, a.spring_stiffness);
      })
      .def("position", [](Joint& j, int i) { return j.axes[i].q; }, py::arg("axis") = 0)
      .def("velocity", [](Joint& j, int i) { return j.axes[i].qd; }, py::arg("axis") = 0)
      .def("effort", [](Joint& j, int i) { return j.axes[i].force; }, py::arg("axis") = 0)
      .def("applied_effort", [](Joint& j, int i) { return j.axes[i].applied; }, py::arg("axis") = 0)
      .def("add_force", [](Joint& j, double f, int i) {
        Axis& a = j.axes[i];
        if (a.velocity >= 0 && ((a.qd > a.velocity && f > 0) || (a.qd < -a.velocity && f < 0))) f = 0;
        if (a.effort >= 0) f = std::min(std::max(f, -a.effort), a.effort);
        a.force += f;
      }, py::arg("force"), py::arg("axis") = 0)
      .def("set_motor", [](Joint& j, double velocity, double force, int i) {
        j.axes[i].motor_velocity = velocity;
        j.axes[i].motor_force = force;
      }, py::arg("velocity"), py::arg("max_force"), py::arg("axis") = 0)
      .def("motor", [](Joint& j, int i) { return std::make_pair(j.axes[i].motor_velocity, j.axes[i].motor_force); }, py::arg("axis") = 0)
      .def("servo", [](Joint& j, double q) { world_of(j.model).set_servo(j, q); })
      .def("servo_off", [](Joint& j) { world_of(j.model).servo_off(j); })
      .def_property_readonly("servo_mode", [](Joint& j) { return static_cast<int>(j.servo); })
      .def_readonly("servo_target", &Joint::target)
      .def("follow", [](Joint& j, Joint* leader, double multiplier, double offset) {
        j.leader = leader;
        j.multiplier = multiplier;
        j.offset = offset;
        if (leader) world_of(j.model).set_servo(j, multiplier * leader->axes[0].q + offset);
        else world_of(j.model).servo_off(j);
      })
      .def("set_position", [](Joint& j, double q, int i) { return world_of(j.model).set_joint_position(j, i, q); }, py::arg("q"), py::arg("axis") = 0)
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
      .def("add_link", [](Model& model, T7 X, double mass, T3 com, T6 inertia) {
        return world_of(&model).add_link(model, in(X), mass, in(com), in(inertia));
      })
      .def("add_joint", [](Model& model, const std::string& type, Link* parent, Link& child, T7 X_CJ) {
        static const std::map<std::string, JointType> types = {
            {"revolute", JointType::Revolute}, {"prismatic", JointType::Prismatic}, {"fixed", JointType::Fixed},
            {"universal", JointType::Universal}, {"ball", JointType::Ball}};
        return world_of(&model).add_joint(model, types.at(type), parent, child, in(X_CJ));
      }, py::arg("type"), py::arg("parent").none(true), py::arg("child"), py::arg("X_CJ"))
      .def("add_box", [](Model& model, Link& l, T7 X, T3 size) {
        const Vec3 s = in(size);
        return world_of(&model).add_shape(l, in(X), dCreateBox(nullptr, s.x, s.y, s.z), std::make_shared<Shape>());
      })
      .def("add_sphere", [](Model& model, Link& l, T7 X, double radius) {
        return world_of(&model).add_shape(l, in(X), dCreateSphere(nullptr, radius), std::make_shared<Shape>());
      })
      .def("add_cylinder", [](Model& model, Link& l, T7 X, double radius, double length) {
        auto shape = std::make_shared<Shape>();
        return world_of(&model).add_shape(l, in(X), make_cylinder(*shape, radius, length), shape);
      })
      .def("add_capsule", [](Model& model, Link& l, T7 X, double radius, double length) {
        return world_of(&model).add_shape(l, in(X), dCreateCapsule(nullptr, radius, length), std::make_shared<Shape>());
      })
      .def("add_plane", [](Model& model, Link& l, T7 X, T3 normal) {
        auto shape = std::make_shared<Shape>();
        shape->infinite = true;
        shape->plane_normal = in(normal);
        return world_of(&model).add_shape(l, in(X), dCreatePlane(nullptr, 0, 0, 1, 0), shape);
      })
      .def("add_mesh", [](Model& model, Link& l, T7 X, std::shared_ptr<MeshData> data) {
        auto shape = std::make_shared<Shape>();
        return world_of(&model).add_shape(l, in(X), make_mesh(*shape, std::move(data)), shape);
      })
      .def("add_heightmap", [](Model& model, Link& l, T7 X, Doubles heights, double size_x, double size_y) {
        auto shape = std::make_shared<Shape>();
        std::vector<double> h(heights.data(), heights.data() + heights.size());
        return world_of(&model).add_shape(l, in(X), make_heightmap(*shape, h, static_cast<int>(heights.shape(1)), static_cast<int>(heights.shape(0)), size_x, size_y), shape);
      })
      .def("finish", [](Model& model) { world_of(&model).finish(model); })
      .def("set_pose", [](Model& model, T7 from, T7 to) { world_of(&model).set_model_pose(model, in(from), in(to)); })
      .def("zero_velocities", [](Model& model) { world_of(&model).zero_velocities(model); });

  auto view = [](std::vector<double>& data, std::vector<py::ssize_t> shape, py::handle owner) {
    return py::array_t<double>(shape, data.data(), owner);
  };
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
      .def("attach", [](World& w, Link* parent, Link& child) { return w.attach(parent, child); }, py::arg("parent").none(true), py::arg("child"))
      .def("detach", &World::detach)
      .def("detach_all", &World::detach_all)
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
      .def("restore", [](World& w, const std::string& data) { w.restore(data); })
      .def_property_readonly("link_poses", [view](py::object self) {
        auto& w = self.cast<World&>();
        return view(w.link_poses, {static_cast<py::ssize_t>(w.link_poses.size() / 7), 7}, self);
      })
      .def_property_readonly("joint_positions", [view](py::object self) {
        auto& w = self.cast<World&>();
        return view(w.joint_positions, {static_cast<py::ssize_t>(w.joint_positions.size())}, self);
      })
      .def_property_readonly("joint_velocities", [view](py::object self) {
        auto& w = self.cast<World&>();
        return view(w.joint_velocities, {static_cast<py::ssize_t>(w.joint_velocities.size())}, self);
      })
      .def("contacts", [](World& w) {
        auto records = w.contact_records();
        py::array_t<ContactRecord> a(static_cast<py::ssize_t>(records.size()));
        if (!records.empty()) std::memcpy(a.mutable_data(), records.data(), records.size() * sizeof(ContactRecord));
        return a;
      })
      .def("cast_rays", [](World& w, Doubles origins, Doubles directions, double max_range, std::vector<int> ignore) {
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

#include <cmath>
#include <map>

#include "bindings.hpp"
#include "geometry.hpp"

namespace ode_sim {

namespace {

using ModelClass = py::class_<Model, std::shared_ptr<Model>>;

// make(shape) -> OwnedGeom
template <class Make>
std::shared_ptr<Shape> add_shape(Model& model, Link& link, const T7& X, Make make) {
  const OdeScope scope;
  const Pose X_LC = in(X);
  World& world = world_of(&model);
  auto shape = std::make_shared<Shape>();
  OwnedGeom geom = make(*shape);
  return world.add_shape(link, X_LC, std::move(geom), shape);
}

std::shared_ptr<Joint> add_joint(Model& model, const std::string& type, Link* parent, Link& child, T7 X_CJ) {
  static const std::map<std::string, JointType> types = {{"revolute", JointType::Revolute}, {"prismatic", JointType::Prismatic},
                                                         {"fixed", JointType::Fixed},       {"universal", JointType::Universal},
                                                         {"ball", JointType::Ball},         {"screw", JointType::Screw},
                                                         {"gearbox", JointType::Gearbox}};
  if (&child == parent || child.model != &model || (parent && parent->model != &model))
    throw std::invalid_argument("a joint takes two links of its model");
  return world_of(&model).add_joint(model, types.at(type), parent, child, in(X_CJ));
}

// Upstream's rule: the normal is one of the world whatever the model's pose, through the height (not the place) at which
// the collision is made; nothing moves the plane after that. A wall sticker that lies on the floor is floor.
OwnedGeom make_plane(Shape& shape, const Vec3& normal, double height) {
  shape.infinite = true;
  shape.plane_normal = normal;
  if (!(std::abs(norm(normal) - 1) < 1e-6)) throw std::invalid_argument("the normal of a plane must be a unit vector");
  return OwnedGeom(dCreatePlane(nullptr, normal.x, normal.y, normal.z, height));
}

// Links of a static model, in order: `poses` (n, 7) of each in the frame of the link that `parents` (n) names, which comes before it; -1: the
// world. See World::lead_links.
void lead(Model& model, const Doubles& poses, const std::vector<int>& parents, double seconds) {
  if (poses.ndim() != 2 || poses.shape(1) != 7 || poses.shape(0) != static_cast<py::ssize_t>(parents.size()))
    throw std::invalid_argument("poses of links are rows of seven numbers, with a parent for each");
  std::vector<Pose> X_WL;
  for (int i = 0; i < static_cast<int>(parents.size()); ++i) {
    const double* p = poses.data(i, 0);
    const Pose X = in(T7{p[0], p[1], p[2], p[3], p[4], p[5], p[6]});
    if (parents[i] >= i) throw std::invalid_argument("a link is told after the one that it hangs on");
    X_WL.push_back(parents[i] < 0 ? X : X_WL[parents[i]] * X);
  }
  world_of(&model).lead_links(model, X_WL, seconds);
}

// What is handed out keeps the model, and so all that it points at.
void bind_solids(ModelClass& model) {
  model
      .def(
          "add_box",
          [](Model& model, Link& l, T7 X, T3 size) {
            const Vec3 s = in(size);
            for (double v : {s.x, s.y, s.z}) checked_size(v, "a side of a box");
            return add_shape(model, l, X, [&](Shape&) { return OwnedGeom(dCreateBox(nullptr, s.x, s.y, s.z)); });
          },
          py::keep_alive<0, 1>())
      .def(
          "add_sphere",
          [](Model& model, Link& l, T7 X, double radius) {
            checked_size(radius, "a radius");
            return add_shape(model, l, X, [&](Shape&) { return OwnedGeom(dCreateSphere(nullptr, radius)); });
          },
          py::keep_alive<0, 1>())
      .def(
          "add_cylinder",
          [](Model& model, Link& l, T7 X, double radius, double length) {
            checked_size(radius, "a radius"), checked_size(length, "a length");
            return add_shape(model, l, X, [&](Shape& shape) { return make_cylinder(shape, radius, length); });
          },
          py::keep_alive<0, 1>())
      .def(
          "add_capsule",
          [](Model& model, Link& l, T7 X, double radius, double length) {
            checked_size(radius, "a radius"), checked_size(length, "a length");
            return add_shape(model, l, X, [&](Shape&) { return OwnedGeom(dCreateCapsule(nullptr, radius, length)); });
          },
          py::keep_alive<0, 1>())
      .def(
          "add_plane",
          [](Model& model, Link& l, T7 X, T3 normal) {
            return add_shape(model, l, X, [&](Shape& shape) { return make_plane(shape, in(normal), (l.X_WL * in(X)).p.z); });
          },
          py::keep_alive<0, 1>())
      .def(
          "add_mesh",
          [](Model& model, Link& l, T7 X, std::shared_ptr<MeshData> data) {
            return add_shape(model, l, X, [&](Shape& shape) { return make_mesh(shape, std::move(data)); });
          },
          py::keep_alive<0, 1>())
      .def(
          "add_heightmap",
          [](Model& model, Link& l, T7 X, const Doubles& heights, double size_x, double size_y) {
            if (heights.ndim() != 2) throw std::invalid_argument("heights must be rows of columns");
            const int columns = static_cast<int>(heights.shape(1)), rows = static_cast<int>(heights.shape(0));
            std::vector<double> h(heights.data(), heights.data() + heights.size());
            return add_shape(model, l, X,
                             [&](Shape& shape) { return make_heightmap(shape, std::move(h), columns, rows, size_x, size_y); });
          },
          py::keep_alive<0, 1>());
}

}  // namespace

void bind_models(py::module_& m) {
  ModelClass model(m, "Model");
  bind_solids(model);
  model.def_readonly("id", &Model::id)
      .def_readonly("is_static", &Model::is_static)
      .def_property_readonly("asleep",
                             [](Model& m) {
                               bool all = !m.clusters.empty();
                               for (auto& c : m.clusters) all &= c.asleep;
                               return all;
                             })
      .def(
          "add_link",
          [](Model& model, T7 X, double mass, T3 com, T6 inertia) {
            return world_of(&model).add_link(model, in(X), in_mass(mass), checked_place(in(com), "a centre of mass"),
                                             in(inertia));
          },
          py::keep_alive<0, 1>())
      .def("add_joint", &add_joint, py::keep_alive<0, 1>(), py::arg("type"), py::arg("parent").none(true), py::arg("child"),
           py::arg("X_CJ"))
      .def("finish", [](Model& model) { world_of(&model).finish(model); })
      .def("set_pose", [](Model& model, T7 from, T7 to) { world_of(&model).set_model_pose(model, in(from, kInf), in(to)); })
      .def("lead", &lead)
      .def("add_twist",
           [](Model& m, T3 v, T3 w, T3 at) {
             world_of(&m).add_model_twist(m, limited(in(v), kFastestSet, "a velocity"),
                                          limited(in(w), kFastestSet, "a velocity"), in(at));
           })
      .def("zero_velocities", [](Model& model) { world_of(&model).zero_velocities(model); });
}

}  // namespace ode_sim

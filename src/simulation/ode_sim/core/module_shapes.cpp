#include <array>

#include "bindings.hpp"
#include "geometry.hpp"

namespace ode_sim {

// What rests on the surface is to feel the change.
template <class Value>
static void change(Surface& s, Value Surface::*field, Value v) {
  s.*field = v;
  if (s.model) s.model->changed = true;
}

// A number of a surface: cut to its bounds, NaN refused.
template <double Surface::*field>
static void bounded(py::class_<Surface>& c, const char* name, double least, double most) {
  c.def_property(
      name, [](Surface& s) { return s.*field; },
      [name, least, most](Surface& s, double v) { change(s, field, std::max(limited(v, most, name), least)); });
}

void bind_shapes(py::module_& m) {
  py::class_<Surface> surface(m, "Surface");
  bounded<&Surface::mu>(surface, "mu", 0, kRoughest);
  bounded<&Surface::mu2>(surface, "mu2", 0, kRoughest);
  bounded<&Surface::slip1>(surface, "slip1", 0, kRoughest);
  bounded<&Surface::slip2>(surface, "slip2", 0, kRoughest);
  bounded<&Surface::torsional_mu>(surface, "torsional_mu", 0, kRoughest);
  bounded<&Surface::torsional_slip>(surface, "torsional_slip", 0, kRoughest);
  bounded<&Surface::patch_radius>(surface, "patch_radius", 0, kFarthest);
  bounded<&Surface::surface_radius>(surface, "surface_radius", 0, kRoughest);
  bounded<&Surface::kp>(surface, "kp", 0, kStiffest);
  bounded<&Surface::kd>(surface, "kd", 0, kStiffest);
  bounded<&Surface::max_vel>(surface, "max_vel", -1, kFastestSet);
  bounded<&Surface::min_depth>(surface, "min_depth", 0, kFarthest);
  bounded<&Surface::restitution>(surface, "restitution", 0, 10);
  bounded<&Surface::bounce_threshold>(surface, "bounce_threshold", 0, kFastestSet);
  surface
      .def_property(
          "collide_bitmask", [](Surface& s) { return s.collide_bitmask; },
          [](Surface& s, unsigned v) { change(s, &Surface::collide_bitmask, v); })
      .def_property(
          "use_patch_radius", [](Surface& s) { return s.use_patch_radius; },
          [](Surface& s, bool v) { change(s, &Surface::use_patch_radius, v); })
      .def_property(
          "collide_without_contact", [](Surface& s) { return s.collide_without_contact; },
          [](Surface& s, bool v) { change(s, &Surface::collide_without_contact, v); })
      .def_property(
          "fdir1", [](Surface& s) { return out(s.fdir1); },
          [](Surface& s, T3 v) { change(s, &Surface::fdir1, limited(in(v), kFarthest, "fdir1")); });

  py::class_<MeshData, std::shared_ptr<MeshData>>(m, "MeshData")
      .def(py::init(
               [](const Doubles& vertices, const py::array_t<uint32_t, py::array::c_style | py::array::forcecast>& triangles) {
                 std::vector<double> v(vertices.data(), vertices.data() + vertices.size());
                 std::vector<dTriIndex> t(triangles.data(), triangles.data() + triangles.size());
                 py::gil_scoped_release release;
                 return std::make_shared<MeshData>(std::move(v), std::move(t));
               }),
           py::arg("vertices"), py::arg("triangles"));

  py::class_<Shape, std::shared_ptr<Shape>>(m, "Shape")
      .def_readonly("id", &Shape::id)
      .def_property(
          "max_contacts", [](Shape& s) { return s.max_contacts; },
          [](Shape& s, int most) { s.max_contacts = most, s.link->model->changed = true; })
      .def_readwrite("watched", &Shape::watched)
      .def_property_readonly(
          "surface", [](Shape& s) -> Surface& { return s.surface; }, py::return_value_policy::reference_internal)
      .def_property_readonly("pose", [](Shape& s) { return out(s.link->X_WL * s.X_LC); })
      .def("aabb", [](Shape& s) {
        const OdeScope scope;
        if (!s.geom) throw std::runtime_error("this collision is no longer in the world");
        std::array<double, 6> box;
        bounds(s, box.data());
        return box;
      });
}

}  // namespace ode_sim

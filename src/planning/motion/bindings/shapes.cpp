#include "motion/shapes.hpp"

#include "casters.hpp"

namespace motion
{
namespace
{
std::vector<Vector3> vectors(const Array& array, const std::string& what)
{
  std::vector<Vector3> out;
  for (const auto& row : rowsFromArray(array, 3, what))
    out.emplace_back(row[0], row[1], row[2]);
  return out;
}

template <typename Row>
py::array_t<double> table(const std::vector<Row>& rows)
{
  py::array_t<double> out({rows.size(), std::size_t(3)});
  auto cells = out.mutable_unchecked<2>();
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (int j = 0; j < 3; ++j)
      cells(i, j) = rows[i][j];
  return out;
}

void bindMesh(py::module_& m)
{
  py::class_<Mesh, Shape, std::shared_ptr<Mesh>>(m, "Mesh", "A triangle surface: vertices (n, 3) in m, triangles (k, 3).")
      .def(py::init([](const Array& vertices, const py::array_t<int, py::array::c_style | py::array::forcecast>& triangles) {
             if (triangles.ndim() != 2 || triangles.shape(1) != 3)
               throw InvalidInput("mesh triangles: an array of 3 columns is needed");
             std::vector<Eigen::Vector3i> faces;
             for (py::ssize_t i = 0; i < triangles.shape(0); ++i)
               faces.emplace_back(*triangles.data(i, 0), *triangles.data(i, 1), *triangles.data(i, 2));
             return std::make_shared<Mesh>(vectors(vertices, "mesh vertices"), std::move(faces));
           }),
           py::arg("vertices"), py::arg("triangles"))
      .def_static(
          "_load",
          [](const std::string& path, const Vector3& scale) { return std::const_pointer_cast<Mesh>(loadMesh(path, scale)); },
          py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("vertices", [](const Mesh& s) { return table(s.vertices); })
      .def_property_readonly("triangles",
                             [](const Mesh& s) {
                               py::array_t<int> out({s.triangles.size(), std::size_t(3)});
                               auto cells = out.mutable_unchecked<2>();
                               for (std::size_t i = 0; i < s.triangles.size(); ++i)
                                 for (int j = 0; j < 3; ++j)
                                   cells(i, j) = s.triangles[i][j];
                               return out;
                             })
      .def("__repr__", [](const Mesh& s) {
        return py::str("Mesh({} vertices, {} triangles)").format(s.vertices.size(), s.triangles.size());
      });
}

void bindOcTree(py::module_& m)
{
  py::class_<OcTreeShape, Shape, std::shared_ptr<OcTreeShape>>(m, "OcTree", "Occupied space on a grid.")
      .def_static(
          "from_message_data",
          [](const std::string& data, double resolution, bool binary, const std::string& type_name) {
            return std::const_pointer_cast<OcTreeShape>(OcTreeShape::fromMessage(data, resolution, binary, type_name));
          },
          py::arg("data"), py::arg("resolution"), py::arg("binary") = true, py::arg("type_name") = "OcTree",
          "`data`: the bytes of an octomap_msgs/Octomap; resolution in m.")
      .def_static(
          "from_points",
          [](const Array& points, double resolution, const std::optional<Vector3>& origin) {
            const auto list = vectors(points, "points");
            py::gil_scoped_release release;
            return std::const_pointer_cast<OcTreeShape>(OcTreeShape::fromPoints(list, resolution, origin ? &*origin : nullptr));
          },
          py::arg("points"), py::arg("resolution"), py::arg("origin") = py::none(),
          "Points (n, 3) in m; with the sensor's `origin` the rays between are made free.")
      .def_static("load", [](const std::string& path) { return std::const_pointer_cast<OcTreeShape>(OcTreeShape::load(path)); })
      .def("save", &OcTreeShape::save, py::arg("path"))
      .def(
          "message_data", [](const OcTreeShape& t, bool binary) { return py::bytes(t.message(binary)); },
          py::arg("binary") = true)
      .def_property_readonly("resolution", &OcTreeShape::resolution)
      .def("__len__", &OcTreeShape::nodes);
}
}  // namespace

void bindShapes(py::module_& m)
{
  py::class_<Shape, std::shared_ptr<Shape>>(m, "Shape", "A shape in its own frame. Never changes.")
      .def_property_readonly("kind", &Shape::describe)
      .def(
          "contains", [](const Shape& s, const Vector3& point) { return contains(s, point); }, py::arg("point"),
          "Whether a (3,) point in the shape's frame is inside.")
      .def(
          "grown",
          [](std::shared_ptr<Shape> s, double scale, double padding) {
            return std::const_pointer_cast<Shape>(grown(s, scale, padding));
          },
          py::arg("scale") = 1.0, py::arg("padding") = 0.0)
      .def(
          "bounds",
          [](const Shape& s) -> py::object {
            Vector3 centre, half;
            if (!localBounds(s, centre, half))
              return py::none();
            return py::make_tuple(Vector3(centre - half), Vector3(centre + half));
          },
          "(lower (3,), upper (3,)) corner of the box around it in its own frame, m; None for a plane.");
  py::class_<Box, Shape, std::shared_ptr<Box>>(m, "Box", "Edges along x, y, z in m, centred.")
      .def(py::init([](double x, double y, double z) { return std::make_shared<Box>(Vector3(x, y, z)); }), py::arg("x"),
           py::arg("y"), py::arg("z"))
      .def_property_readonly("size", [](const Box& b) { return b.size; })
      .def("__repr__", [](const Box& b) { return py::str("Box({}, {}, {})").format(b.size.x(), b.size.y(), b.size.z()); });
  py::class_<Sphere, Shape, std::shared_ptr<Sphere>>(m, "Sphere", "Radius in m.")
      .def(py::init<double>(), py::arg("radius"))
      .def_readonly("radius", &Sphere::radius)
      .def("__repr__", [](const Sphere& s) { return py::str("Sphere({})").format(s.radius); });
  py::class_<Cylinder, Shape, std::shared_ptr<Cylinder>>(m, "Cylinder", "Along z, centred; m.")
      .def(py::init<double, double>(), py::arg("radius"), py::arg("length"))
      .def_readonly("radius", &Cylinder::radius)
      .def_readonly("length", &Cylinder::length)
      .def("__repr__", [](const Cylinder& c) { return py::str("Cylinder({}, {})").format(c.radius, c.length); });
  py::class_<Cone, Shape, std::shared_ptr<Cone>>(m, "Cone", "Along z, centred, tip up; m.")
      .def(py::init<double, double>(), py::arg("radius"), py::arg("length"))
      .def_readonly("radius", &Cone::radius)
      .def_readonly("length", &Cone::length)
      .def("__repr__", [](const Cone& c) { return py::str("Cone({}, {})").format(c.radius, c.length); });
  py::class_<Plane, Shape, std::shared_ptr<Plane>>(m, "Plane", "a x + b y + c z + d = 0, infinitely thin.")
      .def(py::init<double, double, double, double>(), py::arg("a"), py::arg("b"), py::arg("c"), py::arg("d"))
      .def_property_readonly("coefficients",
                             [](const Plane& p) { return py::make_tuple(p.normal.x(), p.normal.y(), p.normal.z(), p.d); })
      .def("__repr__", [](const Plane& p) {
        return py::str("Plane({}, {}, {}, {})").format(p.normal.x(), p.normal.y(), p.normal.z(), p.d);
      });
  bindMesh(m);
  bindOcTree(m);
}
}  // namespace motion

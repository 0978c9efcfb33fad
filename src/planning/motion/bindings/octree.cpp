#include "motion/occupancy_map.hpp"

#include "casters.hpp"

namespace motion
{
namespace
{
// Points (n, 3); what is not finite may stay, the core leaves it out.
std::vector<Vector3> points(const Array& array)
{
  if (array.size() == 0)
    return {};
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw InvalidInput("points: an array of three columns is needed");
  std::vector<Vector3> out(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = Eigen::Map<const Vector3>(array.data(static_cast<py::ssize_t>(i), 0));
  return out;
}
}  // namespace

void bindOctree(py::module_& m)
{
  py::class_<OccupancyMap>(m, "OccupancyMap", "Occupied space that grows and shrinks with what sensors see; resolution in m.")
      .def(py::init<double>(), py::arg("resolution"))
      .def(
          "insert",
          [](OccupancyMap& map, const Vector3& origin, const Array& occupied, const Array& known, const Array& beyond) {
            const auto on = points(occupied), mine = points(known), past = points(beyond);
            py::gil_scoped_release release;
            map.insert(origin, on, mine, past);
          },
          py::arg("origin"), py::arg("occupied"), py::arg("known"), py::arg("beyond"),
          "Ends (n, 3) of rays from a sensor at `origin`, m: on something new, on known things, on nothing.")
      .def("clear", &OccupancyMap::clear)
      .def("assign", &OccupancyMap::assign, py::arg("tree"))
      .def(
          "tree", [](const OccupancyMap& map) { return std::const_pointer_cast<OcTreeShape>(map.shape()); },
          py::call_guard<py::gil_scoped_release>(), "All cells as a shape for scenes.")
      .def_property_readonly("resolution", &OccupancyMap::resolution)
      .def("__len__", &OccupancyMap::cells);
  m.def(
      "label_points",
      [](const std::vector<std::tuple<std::shared_ptr<Shape>, Transform, double>>& shapes, const Array& array,
         const Vector3& origin, double scale, double shadow) {
        const auto list = points(array);
        std::vector<PlacedShape> placed;
        for (const auto& [shape, pose, padding] : shapes)
          placed.push_back({shape, pose, padding});
        std::vector<std::uint8_t> labels;
        {
          py::gil_scoped_release release;
          labels = labelPoints(placed, list, origin, scale, shadow);
        }
        return py::array_t<std::uint8_t>(static_cast<py::ssize_t>(labels.size()), labels.data());
      },
      py::arg("shapes"), py::arg("points"), py::arg("origin"), py::arg("scale") = 1.0, py::arg("shadow") = 0.0,
      "(n,) of points (n, 3): 1 inside one of the shapes (shape, pose, padding in m), which are scaled first; 2 up to `shadow`\n"
      "m behind one, seen from `origin`; else 0.");
}
}  // namespace motion

#include "bindings.hpp"
#include "ray_fan.hpp"

namespace ode_sim {

namespace {

using Numbers = py::array_t<double>;

Numbers told_directions(const RayFan& fan) {
  const std::vector<Vec3> all = fan.told_directions();
  Numbers out({static_cast<py::ssize_t>(all.size()), static_cast<py::ssize_t>(3)});
  double* to = out.mutable_data();
  for (const Vec3& d : all) *to++ = d.x, *to++ = d.y, *to++ = d.z;
  return out;
}

std::pair<Numbers, py::array_t<int32_t>> cast(const RayFan& fan, World& w, const T7& X_WS, const std::vector<int>& housing) {
  const auto [x, y, z, qx, qy, qz, qw] = X_WS;
  const Pose pose{{x, y, z}, {qx, qy, qz, qw}};  // out of reach nothing is met
  Numbers ranges(static_cast<py::ssize_t>(fan.rays()));
  py::array_t<int32_t> hits(static_cast<py::ssize_t>(fan.rays()));
  double* r = ranges.mutable_data();
  int32_t* h = hits.mutable_data();
  {
    py::gil_scoped_release release;
    fan.cast(w.scene(), pose, housing, r, h);
  }
  return {ranges, hits};
}

// A function from one number for each ray to one for each value told.
template <void (RayFan::*blended)(const double*, double*) const>
Numbers told(const RayFan& fan, const Doubles& rays) {
  if (static_cast<size_t>(rays.size()) != fan.rays())
    throw std::invalid_argument("the fan has " + std::to_string(fan.rays()) + " rays, not " + std::to_string(rays.size()));
  Numbers out(static_cast<py::ssize_t>(fan.values()));
  (fan.*blended)(rays.data(), out.mutable_data());
  return out;
}

}  // namespace

void bind_rays(py::module_& m) {
  py::class_<RayScan>(m, "RayScan")
      .def(py::init([](int samples, double resolution, double min_angle, double max_angle) {
             return RayScan{samples, resolution, min_angle, max_angle};
           }),
           py::arg("samples"), py::arg("resolution"), py::arg("min_angle"), py::arg("max_angle"))
      .def_readonly("samples", &RayScan::samples)
      .def_readonly("resolution", &RayScan::resolution)
      .def_readonly("min_angle", &RayScan::min_angle)
      .def_readonly("max_angle", &RayScan::max_angle)
      .def_property_readonly("count", &RayScan::count)
      .def_property_readonly("step", &RayScan::step);
  py::class_<RayFan>(m, "RayFan")
      .def(py::init<const RayScan&, const RayScan&, double, double>(), py::arg("horizontal"), py::arg("vertical"),
           py::arg("min"), py::arg("max"))
      .def_property_readonly("horizontal", &RayFan::horizontal)
      .def_property_readonly("vertical", &RayFan::vertical)
      .def_property_readonly("min", &RayFan::min)
      .def_property_readonly("max", &RayFan::max)
      .def_property_readonly("told_directions", &told_directions)
      .def("cast", &cast, py::arg("world"), py::arg("pose"), py::arg("housing"))
      .def("between", &told<&RayFan::between>, py::arg("ranges"))
      .def("mean", &told<&RayFan::mean>, py::arg("intensities"))
      .def(
          "told",
          [](const RayFan& fan, Doubles ranges) {
            return py::vectorize([&fan](double range) { return fan.told(range); })(std::move(ranges));
          },
          py::arg("ranges"));
}

}  // namespace ode_sim

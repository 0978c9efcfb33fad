#include "bindings.hpp"
#include "sensor_noise.hpp"

namespace ode_sim {

void bind_noise(py::module_& m) {
  m.def("drawn_bias", &noise::drawn_bias, py::arg("mean"), py::arg("stddev"), py::arg("normal"), py::arg("uniform"));
  m.def("wanders", &noise::wanders, py::arg("stddev"), py::arg("time"), py::arg("dt"));
  m.def("wandered_bias", &noise::wandered_bias, py::arg("bias"), py::arg("stddev"), py::arg("time"), py::arg("dt"),
        py::arg("normal"));
  // Numbers, or arrays of one shape.
  m.def("measured", py::vectorize(&noise::measured), py::arg("value"), py::arg("bias"), py::arg("mean"), py::arg("stddev"),
        py::arg("precision"), py::arg("normal"));
}

}  // namespace ode_sim

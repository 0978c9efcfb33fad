// The filter for Python: three numbers for each of acceleration, turn rates and field.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <stdexcept>

#include "imu_complementary_filter/complementary_filter.h"

namespace py = pybind11;
using imu_tools::ComplementaryFilter;
using Numbers = std::array<double, 3>;

namespace {

void checked(bool taken, const char* name) {
  if (!taken) throw std::invalid_argument(std::string(name) + " has to lie between 0 and 1");
}

std::array<double, 4> orientation(const ComplementaryFilter& f) {
  std::array<double, 4> q;
  f.getOrientation(q[0], q[1], q[2], q[3]);
  return q;
}

void update(ComplementaryFilter& f, const Numbers& a, const Numbers& w, const std::optional<Numbers>& m, double dt) {
  if (m) f.update(a[0], a[1], a[2], w[0], w[1], w[2], (*m)[0], (*m)[1], (*m)[2], dt);
  else f.update(a[0], a[1], a[2], w[0], w[1], w[2], dt);
}

}  // namespace

PYBIND11_MODULE(_filter, m) {
  py::class_<ComplementaryFilter>(m, "Complementary")
      .def(py::init([](double gain_acc, double gain_mag, bool adaptive, std::optional<double> bias_alpha) {
             auto f = std::make_unique<ComplementaryFilter>();
             checked(f->setGainAcc(gain_acc), "gain_acc");
             checked(f->setGainMag(gain_mag), "gain_mag");
             if (bias_alpha) checked(f->setBiasAlpha(*bias_alpha), "bias_alpha");
             f->setDoBiasEstimation(bias_alpha.has_value());
             f->setDoAdaptiveGain(adaptive);
             return f;
           }),
           py::arg("gain_acc") = 0.01, py::arg("gain_mag") = 0.01, py::arg("adaptive") = true, py::arg("bias_alpha") = 0.01)
      .def_property_readonly("orientation", &orientation)
      .def_property_readonly(
          "bias",
          [](const ComplementaryFilter& f) {
            return Numbers{f.getAngularVelocityBiasX(), f.getAngularVelocityBiasY(), f.getAngularVelocityBiasZ()};
          })
      .def_property_readonly("steady", &ComplementaryFilter::getSteadyState)
      .def("reset", &ComplementaryFilter::reset)
      .def("update", &update, py::arg("acceleration"), py::arg("rate"), py::arg("field"), py::arg("dt"));
}

// The law of the PID for Python, with the gains that it takes.
#include <pybind11/pybind11.h>

#include <control_toolbox/pid_law.h>

namespace py = pybind11;
using namespace control_toolbox;

namespace
{

struct Face
{
  PidLaw law;
  PidGains gains = { 0.0, 0.0, 0.0, 0.0, 0.0, false };
  bool counted = false;

  double compute_command(double error, double dt, const py::object& derivative)
  {
    counted = derivative.is_none() ? law.step(gains, error, dt) : law.step(gains, error, derivative.cast<double>(), dt);
    return counted ? law.command() : 0.0;
  }

  void reset(const py::object& derivative, double integral)
  {
    law.reset(derivative.is_none() ? 0.0 : derivative.cast<double>(), integral, derivative.is_none());
  }
};

void set_gains(Face& face, double p, double i, double d, double i_max, double i_min, bool antiwindup)
{
  face.gains = { p, i, d, i_max, i_min, antiwindup };
}

py::tuple gains(const Face& face)
{
  const PidGains& g = face.gains;
  return py::make_tuple(g.p, g.i, g.d, g.i_max, g.i_min, g.antiwindup);
}

}  // namespace

PYBIND11_MODULE(_pid, module)
{
  py::class_<Face>(module, "Law")
      .def(py::init<>())
      .def("_set_gains", &set_gains)
      .def("_gains", &gains)
      .def("compute_command", &Face::compute_command, py::arg("error"), py::arg("dt"), py::arg("error_dot") = py::none())
      .def("reset", &Face::reset, py::arg("d_error") = py::none(), py::arg("i_error") = 0.0)
      .def_readonly("counted", &Face::counted)
      .def_property_readonly("p_error", [](const Face& f) { return f.law.p_error(); })
      .def_property_readonly("i_error", [](const Face& f) { return f.law.i_error(); })
      .def_property_readonly("d_error", [](const Face& f) { return f.law.d_error(); })
      .def_property_readonly("i_term", [](const Face& f) { return f.law.i_term(); })
      .def_property_readonly("command", [](const Face& f) { return f.law.command(); });
}

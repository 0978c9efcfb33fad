// The law of transmissions for Python.
#include <optional>
#include <tuple>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <transmission_interface/transmission_law.h>

namespace py = pybind11;
using namespace transmission_interface;

namespace
{

using Values = TransmissionLaw::Values;

/// One value per actuator or joint in, as many out.
template <Values (TransmissionLaw::*Way)(const Values&) const>
py::tuple bring(const TransmissionLaw& law, const py::sequence& from)
{
  Values values{ { from[0].cast<double>(), law.size() > 1 ? from[1].cast<double>() : 0.0 } };
  values = (law.*Way)(values);
  return law.size() > 1 ? py::make_tuple(values[0], values[1]) : py::make_tuple(values[0]);
}

using Written = std::tuple<std::string, std::string, std::optional<std::string>, std::optional<std::string>, bool>;

std::vector<Part> parts(const std::vector<Written>& written)
{
  const auto text = [](const std::optional<std::string>& one) { return Text{ one.has_value(), one.value_or("") }; };
  std::vector<Part> result;
  for (const auto& [name, role, reduction, offset, ignores] : written)
    result.push_back(Part{ name, role, text(reduction), text(offset), ignores });
  return result;
}

py::tuple plan(Coupling coupling, const std::string& name, const std::string& type, const std::vector<Written>& actuators,
               const std::vector<Written>& joints)
{
  const Plan made = plan_transmission(coupling, name, type, parts(actuators), parts(joints));
  return py::make_tuple(made.law, made.actuators, made.joints);
}

}  // namespace

PYBIND11_MODULE(_law, module)
{
  static py::object error = py::module_::import("transmission_interface.errors").attr("TransmissionError");
  error.inc_ref();  // outlives the interpreter's end
  py::register_exception_translator([](std::exception_ptr thrown) {
    try
    {
      std::rethrow_exception(thrown);
    }
    catch (const TransmissionInterfaceException& e)
    {
      PyErr_SetString(error.ptr(), e.what());
    }
  });
  py::enum_<Coupling>(module, "Coupling")
      .value("SIMPLE", Coupling::Simple)
      .value("DIFFERENTIAL", Coupling::Differential)
      .value("FOUR_BAR", Coupling::FourBar);
  py::class_<TransmissionLaw>(module, "Law")
      .def(py::init<Coupling, const std::vector<double>&, const std::vector<double>&, const std::vector<double>&, bool>())
      .def(py::init<const TransmissionLaw&>())
      .def("position_to_joint", &bring<&TransmissionLaw::position_to_joint>)
      .def("velocity_to_joint", &bring<&TransmissionLaw::velocity_to_joint>)
      .def("effort_to_joint", &bring<&TransmissionLaw::effort_to_joint>)
      .def("absolute_to_joint", &bring<&TransmissionLaw::absolute_to_joint>)
      .def("position_to_actuator", &bring<&TransmissionLaw::position_to_actuator>)
      .def("velocity_to_actuator", &bring<&TransmissionLaw::velocity_to_actuator>)
      .def("effort_to_actuator", &bring<&TransmissionLaw::effort_to_actuator>);
  module.def("plan", &plan);
  module.def("asked_for", [](const std::string& written) {
    const Asked asked = asked_for(written);
    return py::make_tuple(asked.kind, asked.both_ways);
  });
  module.def("known_interfaces", &known_interfaces);
}

// The laws of joint limits for Python: where they come from, and what they leave of a command.
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include <pybind11/pybind11.h>

#include <joint_limits_interface/limit_law.h>
#include <joint_limits_interface/limit_sources.h>

namespace py = pybind11;
using namespace joint_limits_interface;

namespace
{

/// Calls \p each with the name of every field and the field.
template <class Limits, class Each>
void fields(Limits& limits, Each each)
{
  each("min_position", limits.min_position);
  each("max_position", limits.max_position);
  each("max_velocity", limits.max_velocity);
  each("max_acceleration", limits.max_acceleration);
  each("max_jerk", limits.max_jerk);
  each("max_effort", limits.max_effort);
  each("has_position_limits", limits.has_position_limits);
  each("has_velocity_limits", limits.has_velocity_limits);
  each("has_acceleration_limits", limits.has_acceleration_limits);
  each("has_jerk_limits", limits.has_jerk_limits);
  each("has_effort_limits", limits.has_effort_limits);
  each("angle_wraparound", limits.angle_wraparound);
}

/// Attributes of the same names.
JointLimits hard(const py::handle& from)
{
  JointLimits limits;
  fields(limits,
         [&from](const char* name, auto& value) { value = from.attr(name).cast<std::remove_reference_t<decltype(value)>>(); });
  return limits;
}

py::dict dict_of(const JointLimits& limits)
{
  py::dict values;
  fields(limits, [&values](const char* name, const auto& value) { values[name] = value; });
  return values;
}

/// A dict of parameters; Python's bool is no number.
struct Parameters
{
  py::dict map;

  py::object of(const std::string& name) const { return map.contains(name) ? py::object(map[name.c_str()]) : py::none(); }
  bool flag(const std::string& name, bool& value) const
  {
    const py::object found = of(name);
    if (!py::isinstance<py::bool_>(found))
      return false;
    value = found.cast<bool>();
    return true;
  }
  bool number(const std::string& name, double& value) const
  {
    const py::object found = of(name);
    if (py::isinstance<py::bool_>(found) || (!py::isinstance<py::float_>(found) && !py::isinstance<py::int_>(found)))
      return false;
    const double read = PyFloat_AsDouble(found.ptr());
    if (PyErr_Occurred())  // a whole number beyond any double
    {
      PyErr_Clear();
      return false;
    }
    value = read;
    return true;
  }
};

SoftJointLimits soft(const py::handle& from)
{
  SoftJointLimits limits;
  if (from.is_none())
    return limits;
  limits.min_position = from.attr("min_position").cast<double>();
  limits.max_position = from.attr("max_position").cast<double>();
  limits.k_position = from.attr("k_position").cast<double>();
  limits.k_velocity = from.attr("k_velocity").cast<double>();
  return limits;
}

LimitRule rule(const std::string& command, bool is_soft)
{
  if (command == "position")
    return is_soft ? LimitRule::PositionSoft : LimitRule::PositionSaturation;
  if (command == "velocity")
    return is_soft ? LimitRule::VelocitySoft : LimitRule::VelocitySaturation;
  if (command == "effort")
    return is_soft ? LimitRule::EffortSoft : LimitRule::EffortSaturation;
  throw std::invalid_argument("a command is a position, a velocity or an effort, not '" + command + "'");
}

}  // namespace

PYBIND11_MODULE(_limits, module)
{
  module.def(
      "apply_description",
      [](bool bounded, bool endless, double lower, double upper, double velocity, double effort, const py::object& limits) {
        JointLimits read = hard(limits);
        apply_description(bounded, endless, lower, upper, velocity, effort, read);
        return dict_of(read);
      },
      py::arg("bounded"), py::arg("endless"), py::arg("lower"), py::arg("upper"), py::arg("velocity"), py::arg("effort"),
      py::arg("limits"));
  module.def(
      "apply_parameters",
      [](const py::dict& values, const py::object& limits) {
        JointLimits read = hard(limits);
        apply_parameters(Parameters{ values }, read);
        return dict_of(read);
      },
      py::arg("values"), py::arg("limits"));
  module.def(
      "soft_limits",
      [](const py::dict& values) -> py::object {
        SoftJointLimits read;
        if (!apply_soft_parameters(Parameters{ values }, read))
          return py::none();
        return py::make_tuple(read.min_position, read.max_position, read.k_position, read.k_velocity);
      },
      py::arg("values"));
  py::class_<CommandLimiter, std::shared_ptr<CommandLimiter>>(module, "CommandLimiter")
      .def(py::init([](const std::string& command, const py::object& limits, const py::object& soft_limits) {
             return std::make_shared<CommandLimiter>(rule(command, !soft_limits.is_none()), hard(limits), soft(soft_limits));
           }),
           py::arg("command"), py::arg("limits"), py::arg("soft") = py::none())
      .def("reset", &CommandLimiter::reset)
      .def("enforce", [](CommandLimiter& law, double command, double position, double velocity, double dt) {
        const bool usable = law.enforce(command, position, velocity, dt);
        return std::make_pair(command, usable);
      });
}

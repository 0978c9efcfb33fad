// The law of joint limits for Python.
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>

#include <joint_limits_interface/limit_law.h>

namespace py = pybind11;
using namespace joint_limits_interface;

namespace
{

/// Attributes of the same names.
JointLimits hard(const py::handle& from)
{
  JointLimits limits;
  const auto number = [&from](const char* name) { return from.attr(name).cast<double>(); };
  const auto flag = [&from](const char* name) { return from.attr(name).cast<bool>(); };
  limits.min_position = number("min_position");
  limits.max_position = number("max_position");
  limits.max_velocity = number("max_velocity");
  limits.max_acceleration = number("max_acceleration");
  limits.max_effort = number("max_effort");
  limits.has_position_limits = flag("has_position_limits");
  limits.has_velocity_limits = flag("has_velocity_limits");
  limits.has_acceleration_limits = flag("has_acceleration_limits");
  limits.has_effort_limits = flag("has_effort_limits");
  return limits;
}

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

// The wiring for Python.
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>

#include <pybind11/pybind11.h>

#include "wiring.hpp"

namespace py = pybind11;
using gazebo_ros_control::Wiring;

namespace
{

// Handles give addresses as numbers.
double* place(std::uintptr_t address) { return reinterpret_cast<double*>(address); }  // NOLINT(performance-no-int-to-ptr)

int add_joint(Wiring& wiring, std::uintptr_t joint, std::uintptr_t position, std::uintptr_t velocity, std::uintptr_t effort)
{
  if (!joint)
    throw std::invalid_argument("a wired joint needs an address");
  Wiring::Places places;
  places.position = place(position);
  places.velocity = place(velocity);
  places.effort = place(effort);
  return wiring.add_joint(*reinterpret_cast<ode_sim::Joint*>(joint), places);  // NOLINT(performance-no-int-to-ptr)
}

int add_command(Wiring& wiring, int joint, std::uintptr_t command, std::uintptr_t slope,
                std::shared_ptr<joint_limits_interface::CommandLimiter> limiter, double effort_limit)
{
  Wiring::Command made;
  made.command = place(command);
  made.slope = place(slope);
  made.limiter = std::move(limiter);
  made.effort_limit = effort_limit;
  return wiring.add_command(joint, made);
}

// Most steps refuse nothing.
py::object write_commands(Wiring& wiring, double dt)
{
  const auto refused = wiring.write(dt);
  if (refused.empty())
    return py::none();
  py::list out;
  for (const auto& one : refused)
    out.append(py::make_tuple(one.command, one.wanted));
  return std::move(out);
}

}  // namespace

PYBIND11_MODULE(_wiring, module)
{
  py::module_::import("joint_limits_interface");
  py::class_<Wiring>(module, "Wiring")
      .def(py::init<>())
      .def("add_joint", &add_joint)
      .def("add_command", &add_command)
      .def("engage", &Wiring::engage)
      .def("report_load", &Wiring::report_load)
      .def("stop", &Wiring::stop)
      .def("read", &Wiring::read)
      .def("write", &write_commands);
}

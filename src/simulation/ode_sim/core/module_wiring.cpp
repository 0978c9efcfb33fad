#include "bindings.hpp"
#include "wiring.hpp"

namespace ode_sim {

namespace {

using Numbers = std::tuple<double, double, double, double, double, double, double, double, double>;

// NumPy gives an address as a number.
double* place(uintptr_t address) { return reinterpret_cast<double*>(address); }  // NOLINT(performance-no-int-to-ptr)

int add_command(Wiring& w, int joint, uintptr_t command, uintptr_t slope, double effort_limit, int rule, bool has_position,
                const Numbers& numbers) {
  if (rule < 0 || rule > CommandLimits::EffortSoft) throw std::invalid_argument("there is no such rule");
  Wiring::Command c{place(command), place(slope), {}, effort_limit};
  CommandLimits& l = c.limits;
  l.rule = static_cast<CommandLimits::Rule>(rule);
  l.has_position = has_position;
  std::tie(l.low, l.high, l.velocity, l.acceleration, l.effort, l.soft_low, l.soft_high, l.k_position, l.k_velocity) = numbers;
  return w.add_command(joint, c);
}

// Most steps refuse nothing.
py::object write(Wiring& w, double dt) {
  const auto refused = w.write(dt);
  if (refused.empty()) return py::none();
  py::list out;
  for (auto& r : refused) out.append(py::make_tuple(r.command, r.wanted, r.held));
  return std::move(out);
}

}  // namespace

void bind_wiring(py::module_& m) {
  py::class_<Wiring>(m, "Wiring")
      .def(py::init<>())
      .def("add_joint",
           [](Wiring& w, std::shared_ptr<Joint> joint, uintptr_t position, uintptr_t velocity, uintptr_t effort) {
             return w.add_joint(std::move(joint), {place(position), place(velocity), place(effort)});
           })
      .def("add_command", &add_command)
      .def("set_working", &Wiring::set_working)
      .def("report_load", &Wiring::report_load)
      .def("previous", &Wiring::previous)
      .def("set_previous", &Wiring::set_previous)
      .def("read", &Wiring::read)
      .def("write", &write);
}

}  // namespace ode_sim

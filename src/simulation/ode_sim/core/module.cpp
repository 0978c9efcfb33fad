// Python bindings of the physics core.
#include <ode/ode.h>
#include <pybind11/pybind11.h>

PYBIND11_MODULE(_core, m) { m.attr("ode_configuration") = dGetConfiguration(); }

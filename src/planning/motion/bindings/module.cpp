#include "casters.hpp"

namespace
{
// The class as a subclass of MotionError and of the Python error that fits best.
template <typename Exception>
py::exception<Exception> derived(py::module_& m, const char* name, const py::object& base, PyObject* builtin)
{
  py::tuple bases = builtin ? py::make_tuple(base, py::reinterpret_borrow<py::object>(builtin)) : py::make_tuple(base);
  return py::register_exception<Exception>(m, name, bases);
}
}  // namespace

PYBIND11_MODULE(_core, m)
{
  m.doc() = "The compiled core of motion.";
  auto error = py::register_exception<motion::Error>(m, "MotionError");
  derived<motion::ModelError>(m, "ModelError", error, nullptr);
  derived<motion::UnknownName>(m, "UnknownNameError", error, PyExc_LookupError);
  derived<motion::InvalidInput>(m, "InvalidInputError", error, PyExc_ValueError);
  motion::bindShapes(m);
  motion::bindModel(m);
  motion::bindState(m);
  motion::bindScene(m);
  motion::bindConstraints(m);
  motion::bindIk(m);
  motion::bindPlanning(m);
  motion::bindTiming(m);
  motion::bindOctree(m);
}

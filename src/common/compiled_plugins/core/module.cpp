#include <compiled_plugins/guard.h>
#include <compiled_plugins/ros.h>

#include <dlfcn.h>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace
{

/// Python loads its modules so that no other library sees what they bring. A plugin that was linked carelessly finds roscpp and
/// its like in the original's process, so they are shown to all here.
void show_to_all()
{
  Dl_info info;
  if (dladdr(reinterpret_cast<void*>(&compiled_plugins::watch), &info) && info.dli_fname)
    dlopen(info.dli_fname, RTLD_NOLOAD | RTLD_LAZY | RTLD_GLOBAL);
}

}  // namespace

PYBIND11_MODULE(_core, module)
{
  module.doc() = "roscpp beside rospy, and guards round compiled plugins.";
  show_to_all();
  module.def("start", &compiled_plugins::start, py::call_guard<py::gil_scoped_release>(), py::arg("name"),
             py::arg("remappings"), py::arg("time"));
  module.def("stop", &compiled_plugins::stop, py::call_guard<py::gil_scoped_release>());
  module.def("set_time", &compiled_plugins::set_time);
  module.def("watch", &compiled_plugins::watch);
  module.def("why_not", &compiled_plugins::why_not, py::call_guard<py::gil_scoped_release>());
}

// Compiled controllers for Python's controller manager: found by pluginlib, called under guard.

#include <cmath>
#include <cxxabi.h>
#include <memory>
#include <string>
#include <tuple>
#include <typeinfo>
#include <vector>

#include <compiled_plugins/guard.h>
#include <controller_interface/controller_base.h>
#include <hardware_interface/internal/demangle_symbol.h>
#include <hardware_interface/robot_hw.h>
#include <pluginlib/class_loader.hpp>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <ros/node_handle.h>

namespace py = pybind11;
using controller_interface::ControllerBase;

namespace
{

/// What a plugin threw, in words.
struct Failed : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// A controller that is not running any more after its own update().
struct Left : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// Call compiled code: named while it runs, and whatever it throws becomes Failed.
template <class F>
auto guarded(const std::string& who, const char* what, F call) -> decltype(call())
{
  const compiled_plugins::Call guard(who.c_str(), what);
  try
  {
    return call();
  }
  catch (const abi::__forced_unwind&)
  {
    throw;  // a thread that is being cancelled
  }
  catch (const std::exception& error)
  {
    throw Failed(hardware_interface::internal::demangledTypeName(error) + ": " + error.what());
  }
  catch (...)
  {
    const std::type_info* type = abi::__cxa_current_exception_type();
    throw Failed(type ? "an exception of type " + hardware_interface::internal::demangleSymbol(type->name())
                      : "something unknown");
  }
}

ros::Time stamp(double time) { return ros::Time().fromNSec(static_cast<std::uint64_t>(std::llround(time * 1e9))); }

bool pythonEnds()
{
#if PY_VERSION_HEX < 0x030d0000  // Debian 13's Python has it without the underscore
  return _Py_IsFinalizing();
#else
  return Py_IsFinalizing();
#endif
}

class Controller
{
public:
  Controller(std::shared_ptr<ControllerBase> base, const std::string& label) : base_(base), label_(label) {}

  ~Controller()
  {
    if (pythonEnds())
    {
      new std::shared_ptr<ControllerBase>(base_);  // kept for good: what it would unregister from has ended
      return;
    }
    try
    {
      destroy();
    }
    catch (const Failed& failed)
    {
      ROS_ERROR("%s: its destructor raised %s", label_.c_str(), failed.what());
    }
  }

  using Claims = std::vector<std::tuple<std::string, std::vector<std::string>>>;

  /// \throws Failed
  Claims init(std::uintptr_t robot, const std::string& root_namespace, const std::string& name)
  {
    ros::NodeHandle root(root_namespace);
    ros::NodeHandle own(root, name);
    ControllerBase::ClaimedResources claimed;
    const bool done = guarded(label_, "init()", [&] {
      return there().initRequest(reinterpret_cast<hardware_interface::RobotHW*>(robot), root, own, claimed);
    });
    if (!done)
      throw Failed("its init() returned false, or the robot lacks a hardware interface; the lines above say which");
    Claims result;
    for (const auto& entry : claimed)
      result.emplace_back(entry.hardware_interface, std::vector<std::string>(entry.resources.begin(), entry.resources.end()));
    return result;
  }

  void update(double time, double period)
  {
    ControllerBase& controller = there();
    guarded(label_, "update()", [&] { controller.updateRequest(stamp(time), ros::Duration(period)); });
    if (controller.state_ != ControllerBase::ControllerState::RUNNING)
      throw Left("it is not running any more");
  }

  bool start(double time)
  {
    return guarded(label_, "starting()", [&] { return there().startRequest(stamp(time)); });
  }
  bool stop(double time)
  {
    return guarded(label_, "stopping()", [&] { return there().stopRequest(stamp(time)); });
  }
  bool wait(double time)
  {
    return guarded(label_, "waiting()", [&] { return there().waitRequest(stamp(time)); });
  }
  bool abort(double time)
  {
    return guarded(label_, "aborting()", [&] { return there().abortRequest(stamp(time)); });
  }

  /// Its stopping() alone: it has failed, and is to brake.
  void brake(double time)
  {
    guarded(label_, "stopping()", [&] { there().stopping(stamp(time)); });
  }

  int state() const { return base_ ? static_cast<int>(base_->state_) : 0; }
  void set_state(int state) { there().state_ = static_cast<ControllerBase::ControllerState>(state); }
  std::uintptr_t address() const { return reinterpret_cast<std::uintptr_t>(base_.get()); }

  void destroy()
  {
    if (base_)
      guarded(label_, "destructor", [&] { base_.reset(); });
  }

private:
  ControllerBase& there()
  {
    if (!base_)
      throw Failed("it is unloaded");
    return *base_;
  }

  std::shared_ptr<ControllerBase> base_;
  std::string label_;
};

/// The classes of some plugin descriptions.
class Classes
{
public:
  // Not freed with this object: at the end of the process pluginlib cannot unload any more, and would end it by an exception.
  Classes(const std::vector<std::string>& descriptions)
    : loader_(new Loader("controller_interface", "controller_interface::ControllerBase", "plugin", descriptions))
  {
  }

  /// \return file, "" where there is none
  std::string library(const std::string& name)
  {
    try
    {
      return loader_->getClassLibraryPath(name);
    }
    catch (const pluginlib::PluginlibException&)
    {
      return "";
    }
  }

  /// Unload the libraries. No instance may be left.
  void unload()
  {
    delete loader_;
    loader_ = nullptr;
  }

  std::unique_ptr<Controller> create(const std::string& name, const std::string& label)
  {
    compiled_plugins::remember(library(name));
    return std::make_unique<Controller>(guarded(label, "constructor", [&] { return loader_->createSharedInstance(name); }),
                                        label);
  }

private:
  using Loader = pluginlib::ClassLoader<ControllerBase>;
  Loader* loader_;
};

/// A controller from the address of a shared pointer, which is freed.
std::unique_ptr<Controller> take(std::uintptr_t pointer, const std::string& label)
{
  const std::unique_ptr<std::shared_ptr<ControllerBase>> shared(reinterpret_cast<std::shared_ptr<ControllerBase>*>(pointer));
  if (!*shared)
    throw Failed("its loader made nothing");
  return std::make_unique<Controller>(*shared, label);
}

}  // namespace

PYBIND11_MODULE(_compiled, module)
{
  module.doc() = "Compiled controllers.";
  py::register_exception<Failed>(module, "Failed");
  py::register_exception<Left>(module, "Left");
  module.def("take", &take, py::arg("pointer"), py::arg("label"));
  using released = py::call_guard<py::gil_scoped_release>;
  // Calls of the control loop keep Python's lock: giving it up would cost the loop whole milliseconds when other threads want it.
  py::class_<Controller>(module, "Controller")
      .def("init", &Controller::init, py::arg("robot"), py::arg("root_namespace"), py::arg("name"), released())
      .def("update", &Controller::update)
      .def("start", &Controller::start)
      .def("stop", &Controller::stop)
      .def("wait", &Controller::wait)
      .def("abort", &Controller::abort)
      .def("brake", &Controller::brake)
      .def("destroy", &Controller::destroy, released())
      .def_property("state", &Controller::state, &Controller::set_state)
      .def_property_readonly("address", &Controller::address);
  py::class_<Classes>(module, "Classes")
      .def(py::init<std::vector<std::string>>(), py::arg("descriptions"))
      .def("library", &Classes::library, py::arg("name"))
      .def("unload", &Classes::unload, released())
      .def("create", &Classes::create, py::arg("name"), py::arg("label"), released());
}

// Simulated hardware in C++ for the Python half of this package.
#include <cstring>
#include <cxxabi.h>
#include <memory>
#include <stdexcept>
#include <string>

#include <class_loader/class_loader.hpp>
#include <compiled_plugins/guard.h>
#include <compiled_plugins/ros.h>
#include <gazebo/physics/physics.hh>
#include <gazebo_ros_control/robot_hw_sim.h>
#include <pybind11/pybind11.h>
#include <transmission_interface/transmission_parser.h>

namespace py = pybind11;

namespace
{

ros::Time stamp(double time) { return ros::Time().fromNSec(static_cast<std::uint64_t>(std::llround(time * 1e9))); }

bool python_ends()
{
#if PY_VERSION_HEX < 0x030d0000  // Debian 13's Python has it without the underscore
  return _Py_IsFinalizing();
#else
  return Py_IsFinalizing();
#endif
}

/// A RobotHWSim of a plugin library; what it throws comes out as a runtime_error that says in which call.
class Sim
{
public:
  /// \param clock roscpp's clock is to be moved by the steps
  Sim(const std::string& library, const std::string& type, const std::string& label, bool clock)
    : label_(strdup(label.c_str()))
    , clock_(clock)  // never freed: handlers of signals and threads of plugins read it
  {
    compiled_plugins::remember(library);
    call("constructor", [&] {
      // Never freed: at the end of the process nothing is left that could unload the library.
      auto* const loader = new class_loader::ClassLoader(library);
      hw_ = loader->createInstance<gazebo_ros_control::RobotHWSim>(type);
    });
  }

  ~Sim()
  {
    if (python_ends())
    {
      new std::shared_ptr<gazebo_ros_control::RobotHWSim>(hw_);  // what it would unregister from has ended
      return;
    }
    const py::gil_scoped_release others_go_on;
    try
    {
      call("destructor", [&] { hw_.reset(); });
    }
    catch (const std::exception& error)
    {
      ROS_ERROR("%s: %s", label_, error.what());
    }
  }

  std::uintptr_t address() const
  {
    return reinterpret_cast<std::uintptr_t>(static_cast<hardware_interface::RobotHW*>(hw_.get()));
  }

  /// \return false where the hardware refuses
  bool init(const std::string& robot_namespace, const std::string& model_name, const std::string& description)
  {
    const gazebo::physics::ModelPtr model = gazebo::physics::get_world()->ModelByName(model_name);
    if (!model)
      throw std::runtime_error("the model has gone");
    urdf_.reset(new urdf::Model);
    if (!urdf_->initString(description))
      throw std::runtime_error("the robot's description cannot be read");
    std::vector<transmission_interface::TransmissionInfo> transmissions;
    transmission_interface::TransmissionParser::parse(description, transmissions);
    bool done = false;
    call("initSim()",
         [&] { done = hw_->initSim(robot_namespace, ros::NodeHandle(robot_namespace), model, urdf_.get(), transmissions); });
    return done;
  }

  void read(double time, double period)
  {
    if (clock_)
      compiled_plugins::set_time(time);
    call("readSim()", [&] { hw_->readSim(stamp(time), ros::Duration(period)); });
  }
  void write(double time, double period)
  {
    if (clock_)
      compiled_plugins::set_time(time);
    call("writeSim()", [&] { hw_->writeSim(stamp(time), ros::Duration(period)); });
  }
  void stop(bool active)
  {
    call("eStopActive()", [&] { hw_->eStopActive(active); });
  }

private:
  template <class F>
  void call(const char* what, F f)
  {
    const compiled_plugins::Call guard(label_, what);
    try
    {
      f();
    }
    catch (const abi::__forced_unwind&)
    {
      throw;  // a thread that is being cancelled
    }
    catch (const std::exception& error)
    {
      throw std::runtime_error(std::string("its ") + what + " threw " + error.what());
    }
    catch (...)
    {
      throw std::runtime_error(std::string("its ") + what + " threw something that is no std::exception");
    }
  }

  const char* label_;
  bool clock_;
  std::unique_ptr<urdf::Model> urdf_;
  std::shared_ptr<gazebo_ros_control::RobotHWSim> hw_;  // ends before what it was given
};

}  // namespace

PYBIND11_MODULE(_compiled, module)
{
  module.doc() = "Simulated hardware in C++.";
  // A plugin waits for the step of others to end; whoever holds that up may need Python.
  using released = py::call_guard<py::gil_scoped_release>;
  py::class_<Sim>(module, "Sim")
      .def(py::init<const std::string&, const std::string&, const std::string&, bool>(), py::arg("library"), py::arg("type"),
           py::arg("label"), py::arg("clock"), released())
      .def_property_readonly("address", &Sim::address)
      .def("init", &Sim::init, py::arg("robot_namespace"), py::arg("model"), py::arg("description"), released())
      .def("read", &Sim::read, released())
      .def("write", &Sim::write, released())
      .def("stop", &Sim::stop, released());
}

// The controller manager of a process in C++: the one of Python in an interpreter of its own.
#include <controller_manager/controller_manager.h>

#include <cstdlib>
#include <mutex>
#include <stdexcept>
#include <string>

#include <pybind11/embed.h>
#include <pybind11/stl.h>
#include <ros/ros.h>

namespace py = pybind11;

namespace controller_manager
{
namespace
{

int managers = 0;  // under Python's lock

/// Python's node ends when no manager is left and the program ends, not before: a program may make another manager.
void end_node()
{
  const py::gil_scoped_acquire lock;
  if (managers > 0)
    return;
  try
  {
    py::module_::import("controller_manager.embedded").attr("end_node")();
  }
  catch (const py::error_already_set& error)
  {
    ROS_ERROR("the controller manager's node did not end well: %s", error.what());
  }
}

/// Begin Python, if nobody has. Its lock is free afterwards; nobody ends it: what threads of it do then cannot be known.
void begin_python()
{
  static std::once_flag once;
  std::call_once(once, [] {
    if (Py_IsInitialized())
      return;
    Py_InitializeEx(0);  // signals are roscpp's
    PyEval_SaveThread();
    std::atexit(end_node);
  });
}

}  // namespace

struct __attribute__((visibility("hidden"))) ControllerManager::Python
{
  py::object module, manager, update;
};

ControllerManager::ControllerManager(hardware_interface::RobotHW* robot_hw, const ros::NodeHandle& nh) : python_(new Python)
{
  begin_python();
  const py::gil_scoped_acquire lock;
  try
  {
    const std::string name = ros::this_node::getName();
    python_->module = py::module_::import("controller_manager.embedded");
    python_->manager = python_->module.attr("make")(reinterpret_cast<std::uintptr_t>(robot_hw), nh.getNamespace(),
                                                    name.substr(name.rfind('/') + 1), ros::this_node::getNamespace());
    python_->update = python_->manager.attr("update");
    ++managers;
  }
  catch (const py::error_already_set& error)
  {
    const std::string text = error.what();
    python_.release();  // its objects cannot be freed without the lock, and there are none worth it
    throw std::runtime_error("the controller manager cannot begin: " + text.substr(0, text.find('\n')) +
                             "; is the workspace sourced in this shell?");
  }
}

ControllerManager::~ControllerManager()
{
  const py::gil_scoped_acquire lock;
  try
  {
    --managers;
    python_->manager.attr("shutdown")();
  }
  catch (const py::error_already_set& error)
  {
    ROS_ERROR("the controller manager did not end well: %s", error.what());
  }
  python_.reset();
  if (!ros::ok())
    end_node();
}

void ControllerManager::update(const ros::Time& time, const ros::Duration& period, bool reset_controllers)
{
  const py::gil_scoped_acquire lock;
  try
  {
    python_->update(time.toSec(), period.toSec(), reset_controllers);
  }
  catch (const py::error_already_set& error)
  {
    ROS_ERROR_THROTTLE(1.0, "the controller manager failed: %s", error.what());
  }
}

bool ControllerManager::loadController(const std::string& name)
{
  const py::gil_scoped_acquire lock;
  return python_->manager.attr("load_controller")(name).cast<bool>();
}

bool ControllerManager::unloadController(const std::string& name)
{
  const py::gil_scoped_acquire lock;
  return python_->manager.attr("unload_controller")(name).cast<bool>();
}

bool ControllerManager::switchController(const std::vector<std::string>& start_controllers,
                                         const std::vector<std::string>& stop_controllers, const int strictness,
                                         bool start_asap, double timeout)
{
  const py::gil_scoped_acquire lock;
  return python_->manager.attr("switch_controller")(start_controllers, stop_controllers, strictness, start_asap, timeout)
      .cast<bool>();
}

controller_interface::ControllerBase* ControllerManager::getControllerByName(const std::string& name)
{
  const py::gil_scoped_acquire lock;
  return reinterpret_cast<controller_interface::ControllerBase*>(
      python_->module.attr("address_of")(python_->manager, name).cast<std::uintptr_t>());
}

void ControllerManager::registerControllerLoader(ControllerLoaderInterfaceSharedPtr controller_loader)
{
  const py::gil_scoped_acquire lock;
  // Python is given two functions; a controller goes through as the address of a pointer that shares it.
  const py::cpp_function names([controller_loader] { return controller_loader->getDeclaredClasses(); });
  const py::cpp_function create([controller_loader](const std::string& type) {
    return reinterpret_cast<std::uintptr_t>(
        new controller_interface::ControllerBaseSharedPtr(controller_loader->createInstance(type)));
  });
  python_->module.attr("add_loader")(python_->manager, controller_loader->getName(), names, create);
}

}  // namespace controller_manager

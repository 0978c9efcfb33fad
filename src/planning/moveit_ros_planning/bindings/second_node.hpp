// Compiled plugins read parameters through roscpp: a second node in the process of a Python one.
#pragma once

#include <moveit/kinematics_base/kinematics_base.h>
#include <pybind11/pybind11.h>
#include <ros/ros.h>

#include <string>

// Named after the first node, which has its name already.
inline void startSecondNode(const std::string& name, const std::string& master)
{
  namespace py = pybind11;
  if (ros::isInitialized())
    return;
  ros::init(ros::M_string{ { "__master", master } }, name.substr(name.rfind('/') + 1) + "_solvers",
            ros::init_options::NoSigintHandler | ros::init_options::AnonymousName | ros::init_options::NoRosout);
  kinematics::detail::setPrivateParameters(name);
  py::module_::import("atexit").attr("register")(py::cpp_function([]() {
    py::gil_scoped_release release;
    ros::shutdown();
  }));
  static ros::NodeHandle* const node = new ros::NodeHandle();  // lives until shutdown
  static ros::AsyncSpinner* const spinner = new ros::AsyncSpinner(1);
  (void)node;
  spinner->start();
}

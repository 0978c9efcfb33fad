// Compiled kinematics solvers for the robots of Python programs.
#include <moveit/kinematics_base/kinematics_base.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <ros/ros.h>

#include "plugin_solver.hpp"

namespace py = pybind11;

namespace
{
// Solvers read parameters through roscpp: a second node in the process, which must not have the name of the first.
void start(const std::string& name, const std::string& master)
{
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
  (void)node;
}
}  // namespace

PYBIND11_MODULE(_solvers, m)
{
  m.doc() = "Compiled kinematics solvers (kinematics::KinematicsBase) for robots of the motion library.";
  py::module_::import("motion");
  m.def(
      "install",
      [](const std::shared_ptr<motion::RobotModel>& robot, const std::string& urdf, const std::string& srdf,
         const std::string& group, const std::string& plugin, const std::string& description,
         const std::vector<std::string>& tips, double resolution, const std::string& node, const std::string& master) {
        start(node, master);
        kinematics_plugin_loader::SolverRequest request;
        request.plugin = plugin;
        request.robot_description = description;
        request.tips = tips;
        request.resolution = resolution;
        py::gil_scoped_release release;
        kinematics_plugin_loader::installSolver(robot, urdf, srdf, group, request);
      },
      py::arg("robot"), py::arg("urdf"), py::arg("srdf"), py::arg("group"), py::arg("plugin"), py::kw_only(),
      py::arg("description"), py::arg("tips"), py::arg("resolution"), py::arg("node"), py::arg("master"),
      "Let a plugin solve the group's inverse kinematics. RuntimeError, one line: it cannot.");
}

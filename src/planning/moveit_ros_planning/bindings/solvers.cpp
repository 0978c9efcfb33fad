// Compiled kinematics solvers for the robots of Python programs.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "plugin_solver.hpp"
#include "second_node.hpp"

namespace py = pybind11;

PYBIND11_MODULE(_solvers, m)
{
  m.doc() = "Compiled kinematics solvers (kinematics::KinematicsBase) for robots of the motion library.";
  py::module_::import("motion");
  m.def(
      "install",
      [](const std::shared_ptr<motion::RobotModel>& robot, const std::string& urdf, const std::string& srdf,
         const std::string& group, const std::string& plugin, const std::string& description,
         const std::vector<std::string>& tips, double resolution, double timeout, const std::string& node,
         const std::string& master) {
        startSecondNode(node, master);
        kinematics_plugin_loader::SolverRequest request;
        request.plugin = plugin;
        request.robot_description = description;
        request.tips = tips;
        request.resolution = resolution;
        request.timeout = timeout;
        py::gil_scoped_release release;
        kinematics_plugin_loader::installSolver(robot, urdf, srdf, group, request);
      },
      py::arg("robot"), py::arg("urdf"), py::arg("srdf"), py::arg("group"), py::arg("plugin"), py::kw_only(),
      py::arg("description"), py::arg("tips"), py::arg("resolution"), py::arg("timeout"), py::arg("node"), py::arg("master"),
      "Let a plugin solve the group's inverse kinematics. RuntimeError, one line: it cannot.");
}

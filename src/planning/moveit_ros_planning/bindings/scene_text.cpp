// Scenes' texts for the Python half; messages go as the bytes that ROS sends.
#include <pybind11/pybind11.h>

#include <stdexcept>

#include <moveit/planning_scene/scene_text.h>

#include "message_bytes.hpp"

namespace py = pybind11;

PYBIND11_MODULE(_scene_text, m)
{
  m.doc() = "moveit/planning_scene/scene_text.h";
  m.def(
      "write", [](const std::string& scene) { return planning_scene::writeScene(read<moveit_msgs::PlanningScene>(scene)); },
      py::arg("scene"), "The objects of a serialised moveit_msgs/PlanningScene as text.");
  m.def(
      "read",
      [](const std::string& text, const std::string& frame) {
        try
        {
          return py::bytes(written(planning_scene::readScene(text, frame)));
        }
        catch (const std::runtime_error& error)
        {
          throw py::value_error(error.what());
        }
      },
      py::arg("text"), py::arg("frame"), "A serialised moveit_msgs/PlanningScene.");
}

"""Sources that name every header, class and member of ros_control's C++ compile in the three standards that packages ask for."""

import importlib.util
import os
import subprocess

import pytest

API = os.path.join(os.path.dirname(os.path.abspath(__file__)), "api")
# As packages are written; whoever includes Gazebo's headers asks for C++11 as well, and gets what those need.
PROJECT = """cmake_minimum_required(VERSION 3.0.2)
project(api)
add_compile_options(-fsyntax-only -w)
set(CMAKE_CXX_FLAGS "${{CMAKE_CXX_FLAGS}} -std={standard}")
find_package(catkin REQUIRED COMPONENTS {components})
{find}
include_directories(${{catkin_INCLUDE_DIRS}} ${{GAZEBO_INCLUDE_DIRS}})
add_library(api OBJECT {sources})
"""
CONTROL = (
    "actionlib angles combined_robot_hw control_msgs control_toolbox controller_interface controller_manager dynamic_reconfigure "
    "effort_controllers forward_command_controller hardware_interface joint_limits_interface joint_trajectory_controller "
    "pluginlib position_controllers realtime_tools roscpp std_msgs transmission_interface urdf urdf_geometry_parser "
    "velocity_controllers"
)


def compile_all(folder, standard, components, find, sources):
    files = " ".join(os.path.join(API, name) for name in sources)
    text = PROJECT.format(standard=standard, components=components, find=find, sources=files)
    (folder / "CMakeLists.txt").write_text(text)
    for command in (["cmake", "-S", ".", "-B", "build"], ["make", "-C", "build", "--no-print-directory"]):
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
        assert done.returncode == 0, "\n".join(line for line in done.stderr.splitlines() if "rror" in line)[:2000]


@pytest.mark.slow
@pytest.mark.parametrize("standard", ["c++11", "c++14", "c++17"])
def test_control(tmp_path, standard):
    compile_all(tmp_path, standard, CONTROL, "", ["hardware.cpp", "control.cpp"])


@pytest.mark.slow
@pytest.mark.skipif(not importlib.util.find_spec("gazebo_cpp._core"), reason="this system lacks what Gazebo's headers need")
def test_simulated(tmp_path):
    compile_all(tmp_path, "c++11", "gazebo_ros_control pluginlib roscpp", "find_package(gazebo REQUIRED)", ["simulated.cpp"])

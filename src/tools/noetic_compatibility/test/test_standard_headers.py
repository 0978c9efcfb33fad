"""The compiler's own headers, as packages of Noetic's compiler take them for granted."""

import os
import re
import subprocess
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parents[1]
pytestmark = pytest.mark.slow

# What `g++ -H` of GCC 10, Debian 11's, shows of its own headers; GCC 12 needs the second include for the first twelve, 14 for all.
BESIDE = {
    "memory": "std::array<int, 2> f;",
    "functional": "std::array<int, 2> f;",
    "map": "std::array<int, 2> f;",
    "tuple": "std::array<int, 2> f;",
    "unordered_map": "int f = std::numeric_limits<int>::max();",
    "unordered_set": "int f = std::numeric_limits<int>::max();",
    "future": "std::shared_ptr<int> f = std::make_shared<int>(1); void g() { std::this_thread::yield(); }",
    "thread": "std::array<int, 2> f;",
    "mutex": "std::array<int, 2> f; std::chrono::milliseconds g(3);",
    "condition_variable": "std::array<int, 2> f;",
    "regex": "int f[2]; void g() { std::sort(f, f + 2); } std::map<int, int> h;",
    "iomanip": "std::tuple<int, int> f;",
    "string": "uint8_t f; std::int64_t g;",
    "iostream": "std::uint16_t f;",
    "stdexcept": "std::uint32_t f;",
    "array": "void f() { throw std::runtime_error(std::string()); }",
}


def test_headers_of_the_compiler_bring_what_noetics_bring(package, tmp_path):
    """In each standard that packages ask for; every case is a file of its own, so that none lives by another's header."""
    options = ""
    for standard in ("11", "14", "17"):
        files = []
        for number, (header, text) in enumerate(BESIDE.items()):
            files.append(f"s{standard}_{number}.cpp")
            (tmp_path / files[-1]).write_text(f"#include <{header}>\nnamespace s{standard}_{number} {{ {text} }}\n")
        later = f"s{standard}_later.cpp"
        (tmp_path / later).write_text("#include <functional>\nvoid f(int* a) { std::sort(a, a + 2); }\n" if standard == "17" else "")
        options += f"add_library(s{standard} SHARED {' '.join(files)} {later})\n"
        options += f"set_target_properties(s{standard} PROPERTIES CXX_STANDARD {standard})\n"
    ended = package("roscpp", "int p;", after=options)
    assert ended.returncode == 0, ended.stdout + ended.stderr


@pytest.mark.parametrize("standard", ["20", "23"])
def test_packages_may_be_written_in_cpp_20(package, standard):
    """-std=c++2a is in Noetic's compiler, and ROS's messages, controllers and plugins compile with it."""
    ended = package(
        "roscpp sensor_msgs trajectory_msgs controller_interface moveit_ros_planning_interface gazebo_ros",
        """
        #include <gazebo/gazebo.hh>
        #include <gazebo/physics/physics.hh>
        #include <controller_interface/controller.h>
        #include <moveit/move_group_interface/move_group_interface.h>
        #include <ros/ros.h>
        #include <sensor_msgs/JointState.h>
        #include <trajectory_msgs/JointTrajectory.h>
        static_assert(__cplusplus > 201703L);
        void heard(const sensor_msgs::JointState::ConstPtr& state) { ROS_INFO("%s", state->name[0].c_str()); }
        bool f(ros::NodeHandle& node, std::map<int, int> known) {
          auto subscriber = node.subscribe("a", 1, heard);
          auto publisher = node.advertise<trajectory_msgs::JointTrajectory>("b", 1);
          publisher.publish(trajectory_msgs::JointTrajectory());
          return known.contains(3);
        }
        """,
        f"set(CMAKE_CXX_STANDARD {standard})\nfind_package(gazebo REQUIRED)\ninclude_directories(${{GAZEBO_INCLUDE_DIRS}})",
    )
    assert ended.returncode == 0, ended.stdout + ended.stderr


def headers_of_the_compiler():
    said = subprocess.run(["g++", "-E", "-x", "c++", "-v", os.devnull], capture_output=True, text=True, check=True).stderr
    (folder,) = (place for line in said.splitlines() if (place := Path(line.strip() or "/")) and (place / "forward_list").exists())
    return sorted(path.name for path in folder.iterdir() if re.fullmatch("[a-z_]+", path.name) and path.is_file())


@pytest.mark.parametrize("standard", ["11", "14", "17", "20"])
def test_every_header_of_the_compiler_can_be_included_alone_and_with_all(package, tmp_path, standard):
    """Headers that bring one another must end, and what is within another one brings nothing before that is complete."""
    names = [name for name in headers_of_the_compiler() if name != "coroutine" or standard == "20"]  # which says so itself
    assert len(names) > 80 and {"forward_list", "memory_resource", "cmath"} < {*names}
    for name in names:
        (tmp_path / f"only_{name}.cpp").write_text(f"#include <{name}>\n")
    (tmp_path / "all.cpp").write_text("".join(f"#include <{name}>\n" for name in names))
    library = "file(GLOB only only_*.cpp)\nadd_library(o OBJECT ${only} all.cpp)\n"
    ended = package("roscpp", "int p;", after=f"{library}set_target_properties(o PROPERTIES CXX_STANDARD {standard})\n")
    assert ended.returncode == 0, ended.stdout + ended.stderr


def test_a_header_of_the_list_is_one_of_the_compilers():
    lines = re.findall(r'^  "([a-z_]+):', (HERE / "cmake/standard_headers.cmake").read_text(), re.M)
    assert len(lines) > 30 and {*lines} <= {*headers_of_the_compiler()}

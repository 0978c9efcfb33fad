"""A package in Noetic's style that binds C++ through pybind11_catkin is built, and Python imports what it made."""

import os
import subprocess
import sys

import pytest

CMAKE = """cmake_minimum_required(VERSION 3.0.2)
project(bound)
find_package(catkin REQUIRED COMPONENTS pybind11_catkin)
catkin_package()
include_directories(${catkin_INCLUDE_DIRS})
pybind_add_module(bound_by_catkin MODULE module.cpp)
pybind11_add_module(bound_by_pybind module.cpp)
add_executable(embedded embedded.cpp)  # Python's headers come with catkin_INCLUDE_DIRS
target_link_libraries(embedded ${PYTHON_LIBRARIES})
"""
MODULE = """#include <pybind11/eigen.h>
PYBIND11_MODULE(NAME, m) { m.def("twice", [](const Eigen::VectorXd& values) { return Eigen::VectorXd(2.0 * values); }); }
"""


@pytest.mark.slow
def test_a_package_binds_cpp_under_the_name_of_pybind11_catkin(tmp_path):
    source, build = tmp_path / "source", tmp_path / "build"
    source.mkdir()
    (source / "package.xml").write_text(
        '<package format="2"><name>bound</name><version>0.0.1</version><description>d</description>'
        '<maintainer email="a@example.org">a</maintainer><license>BSD</license><buildtool_depend>catkin</buildtool_depend>'
        "<depend>pybind11_catkin</depend></package>"
    )
    (source / "CMakeLists.txt").write_text(
        CMAKE
        + "target_include_directories(bound_by_catkin PRIVATE /usr/include/eigen3)\n"
        + "target_include_directories(bound_by_pybind PRIVATE /usr/include/eigen3)\n"
        + "target_compile_definitions(bound_by_catkin PRIVATE NAME=bound_by_catkin)\n"
        + "target_compile_definitions(bound_by_pybind PRIVATE NAME=bound_by_pybind)\n"
    )
    (source / "module.cpp").write_text(MODULE)
    (source / "embedded.cpp").write_text("#include <Python.h>\nint main() { Py_Initialize(); return Py_FinalizeEx(); }\n")
    for command in (["cmake", "-S", source, "-B", build, f"-DPYTHON_EXECUTABLE={sys.executable}"], ["cmake", "--build", build]):
        made = subprocess.run(command, capture_output=True, text=True)
        assert made.returncode == 0, made.stdout + made.stderr
    script = (
        f"import sys; sys.path[:0] = ['{build}/devel/lib', *__import__('glob').glob('{build}/devel/lib/python3*/*-packages')]\n"
        "import bound_by_catkin, bound_by_pybind\n"
        "assert '/devel/lib/' in bound_by_catkin.__file__\n"
        "print(bound_by_catkin.twice([1, 2]), bound_by_pybind.twice([3]))"
    )
    assert subprocess.run([next(build.rglob("embedded"))]).returncode == 0
    ran = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, env=os.environ)
    assert (ran.stdout, ran.stderr) == ("[2. 4.] [6.]\n", "")

"""Packages of MoveIt's family call moveit_build_options(), which comes with moveit_core."""

import subprocess
import sys

import pytest

CMAKE = """cmake_minimum_required(VERSION 3.1.3)
project(stages)
find_package(catkin REQUIRED COMPONENTS moveit_core)
%s
moveit_build_options()
catkin_package()
get_property(options DIRECTORY PROPERTY COMPILE_OPTIONS)
message(STATUS "made: ${CMAKE_CXX_STANDARD} ${CMAKE_BUILD_TYPE} [${options}]")
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    "before, standard, kind, warns",
    [
        ("", "17", "Release", True),
        ("set(CMAKE_CXX_STANDARD 20)\nset(CMAKE_BUILD_TYPE Debug)", "20", "Debug", True),
        ('option(MOVEIT_CI_WARNINGS "own" OFF)', "17", "Release", False),
    ],
)
def test_a_package_of_moveits_family_is_compiled_as_moveit_is(tmp_path, before, standard, kind, warns):
    (tmp_path / "package.xml").write_text(
        '<package format="2"><name>stages</name><version>0.0.1</version><description>d</description>'
        '<maintainer email="a@example.org">a</maintainer><license>BSD</license><buildtool_depend>catkin</buildtool_depend>'
        "<depend>moveit_core</depend></package>"
    )
    (tmp_path / "CMakeLists.txt").write_text(CMAKE % before)
    command = ["cmake", "-S", tmp_path, "-B", tmp_path / "build", f"-DPYTHON_EXECUTABLE={sys.executable}"]
    made = subprocess.run(command, capture_output=True, text=True)
    assert made.returncode == 0, made.stderr
    line = next(line for line in made.stdout.splitlines() if "made: " in line)
    assert f"made: {standard} {kind} [" in line and ("-Wextra" in line) == warns

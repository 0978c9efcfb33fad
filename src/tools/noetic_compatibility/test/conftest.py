"""A small package in Noetic's style."""

import os
import subprocess
from pathlib import Path

import pytest


@pytest.fixture(autouse=True)
def _workspace():
    """There is one whose catkin is this one's."""
    prefixes = os.environ.get("CMAKE_PREFIX_PATH", "").split(":")
    if not any((Path(prefix) / "share/catkin/cmake/absent_packages.cmake").is_file() for prefix in prefixes):
        pytest.skip("no sourced workspace has noetic_compatibility")


@pytest.fixture
def package(tmp_path):
    """Function that writes a package, configures it and builds it; its result has returncode and stdout."""

    def make(components, source=None, options="", build=True, after=""):
        depends = "".join(f"<depend>{name}</depend>" for name in components.split())
        (tmp_path / "package.xml").write_text(
            "<package format='2'><name>p</name><version>1.0.0</version><description>d</description>"
            f"<maintainer email='a@example.org'>m</maintainer><license>BSD</license>"
            f"<buildtool_depend>catkin</buildtool_depend>{depends}</package>"
        )
        lists = (
            f"cmake_minimum_required(VERSION 3.0.2)\nproject(p)\n{options}\n"
            f"find_package(catkin REQUIRED COMPONENTS {components})\ncatkin_package()\n"
            "include_directories(${catkin_INCLUDE_DIRS})\n"
        )
        if source:
            (tmp_path / "p.cpp").write_text(source)
            lists += "add_library(p SHARED p.cpp)\ntarget_link_libraries(p ${catkin_LIBRARIES})\n"
        (tmp_path / "CMakeLists.txt").write_text(lists + after)
        if not build:
            return None
        ended = subprocess.run(["cmake", "-S", tmp_path, "-B", tmp_path / "build", "-Wno-dev"], capture_output=True, text=True, timeout=200)
        if ended.returncode == 0 and source:
            ended = subprocess.run(["cmake", "--build", tmp_path / "build"], capture_output=True, text=True, timeout=280)
        return ended

    return make

"""sdformat and ignition-math of the folder stand_in give the numbers that Debian 12's gave, and Debian 12's still give them."""

import os
import pathlib
import subprocess

import gazebo_cpp
import pytest

PROGRAMS = pathlib.Path(gazebo_cpp.__file__).parents[4] / "lib" / "gazebo_cpp"
DEBIAN = pathlib.Path("/usr/include/ignition/math6").exists()


@pytest.mark.parametrize("whose", ["own", pytest.param("debian", marks=pytest.mark.skipif(not DEBIAN, reason="this Debian has neither"))])
def test_numbers(whose):
    program = PROGRAMS / f"test_sdformat_{whose}"
    assert program.exists(), f"{program} was not built; it needs Debian's libgtest-dev"
    run = subprocess.run([str(program), "--gtest_brief=1"], capture_output=True, text=True, timeout=120, check=False)
    assert run.returncode == 0, run.stdout[-3000:] + run.stderr[-1000:]


PROJECT = """cmake_minimum_required(VERSION 3.10)
project(stranger CXX)
find_package(ignition-math6 REQUIRED)
find_package(sdformat9 REQUIRED)
find_package(SDFormat REQUIRED)
include_directories(${SDFormat_INCLUDE_DIRS})
add_executable(by_variables main.cpp)
target_link_libraries(by_variables ${SDFormat_LIBRARIES})
add_executable(by_targets main.cpp)
target_link_libraries(by_targets sdformat9::sdformat9 ignition-math6::ignition-math6)
"""
SOURCE = """#include <sdf/sdf.hh>
int main()
{
  sdf::SDF document;
  document.SetFromString("<sdf version='1.9'><model name='m'><link name='l'/></model></sdf>");
  return document.Root()->GetElement("model")->Get<std::string>("name") == "m" ? 0 : 1;
}
"""


@pytest.mark.slow
def test_packages_of_others_find_both(tmp_path):
    (tmp_path / "CMakeLists.txt").write_text(PROJECT)
    (tmp_path / "main.cpp").write_text(SOURCE)
    for command in (["cmake", "-S", ".", "-B", "build"], ["cmake", "--build", "build"], ["build/by_variables"], ["build/by_targets"]):
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=600, check=False)
        assert done.returncode == 0, " ".join(command) + "\n" + done.stdout[-2000:] + done.stderr[-2000:]


CHOICE = """cmake_minimum_required(VERSION 3.10)
project(choice CXX)
find_package(PkgConfig REQUIRED)
include({cmake}/sdformat.cmake)
message(STATUS "own: [${{own_libraries}}] debian: [${{DEBIAN_SDFORMAT_INCLUDE_DIRS}}]")
"""
PC = "Name: {name}\nDescription: of this workspace\nVersion: 99\nCflags: -I/of/this/workspace\n"


@pytest.mark.parametrize("debian_has_them", [False, True])
def test_files_of_this_workspace_for_pkg_config_are_not_taken_for_debians(tmp_path, debian_has_them):
    """As when it is built a second time on Debian 13."""
    project = tmp_path / "project"
    system, workspace = tmp_path / "system", tmp_path / "workspace/lib/pkgconfig"
    for folder in (project, system, workspace):
        folder.mkdir(parents=True)
    for name in ("sdformat12", "ignition-math6"):
        (workspace / f"{name}.pc").write_text(PC.format(name=name))
        if debian_has_them:
            (system / f"{name}.pc").write_text(PC.format(name=name).replace("/of/this/workspace", "/of/debian"))
    (project / "CMakeLists.txt").write_text(CHOICE.format(cmake=pathlib.Path(__file__).resolve().parents[1] / "cmake"))
    environment = dict(
        os.environ, PKG_CONFIG_LIBDIR=str(system), PKG_CONFIG_PATH=str(workspace), CMAKE_PREFIX_PATH=str(tmp_path / "workspace")
    )
    done = subprocess.run(["cmake", "-S", project, "-B", tmp_path / "build"], env=environment, capture_output=True, text=True, check=False)
    expected = "own: [] debian: [/of/debian]" if debian_has_them else "own: [sdformat12;ignition-math6] debian: []"
    assert expected in done.stdout, done.stdout + done.stderr

"""What sourcing adds to a shell: our xacro, nobody's pip or python displaced, a python3 that knows rospy."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[1]
SETUP_FILE = next(
    (
        Path(prefix) / "setup.bash"
        for prefix in os.environ.get("CMAKE_PREFIX_PATH", "").split(":")
        if (Path(prefix) / "share/noetic_environment").is_dir()
    ),
    None,
)
pytestmark = pytest.mark.skipif(SETUP_FILE is None, reason="no sourced workspace has noetic_environment")


def shell(script, path="/usr/bin:/bin", **variables):
    """Output of a bash that starts with next to no environment."""
    ended = subprocess.run(
        ["/bin/bash", "-ec", script], capture_output=True, text=True, timeout=120, env={"HOME": "/nonexistent", "PATH": path, **variables}
    )
    assert ended.returncode == 0, ended.stderr
    return ended.stdout.split("\n")[:-1]


@pytest.fixture(scope="module")
def students_workspace(tmp_path_factory):
    """Setup file of an empty workspace that was built with ours sourced."""
    top = tmp_path_factory.mktemp("ws")
    (top / "src").mkdir()
    shell(f"source {SETUP_FILE}; cd {top}; catkin init >/dev/null; catkin build --no-notify --no-status >/dev/null")
    return top / "devel/setup.bash"


def test_with_two_workspaces_sourced_xacro_is_ours_as_command_and_as_module(students_workspace, tmp_path):
    robot = tmp_path / "r.xacro"
    robot.write_text(
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro"><macro name="m"><link name="l"/></macro>'
        '<m/><a b="$(find xacro)"/></robot>'
    )
    which, by_command, by_module = shell(
        f"source {SETUP_FILE}; source {students_workspace}; type -p xacro; xacro -q {robot} | grep -c '<link name=\"l\"/>';"
        f"python3 -c 'import xacro; print(xacro.process_file(\"{robot}\").toxml())' 2>/dev/null | grep -c '<link name=\"l\"/>'"
    )
    assert which == f"{SETUP_FILE.parent}/bin/xacro" and by_command == by_module == "1"


def test_sourcing_puts_nobody_elses_programs_before_the_shells_own(students_workspace):
    """Only what catkin packages install stands in the folders that sourcing puts on PATH."""
    before = "/usr/bin:/bin"
    (path,) = shell(f"source {SETUP_FILE}; source {students_workspace}; echo $PATH", path=before)
    programs = {
        program.name for folder in path[: -len(before)].split(":") if folder and os.path.isdir(folder) for program in Path(folder).iterdir()
    }
    assert path.endswith(before) and not {p for p in programs if p.startswith(("pip", "python", "trimesh", "activate"))}


def fake_python(folder, body):
    program = folder / "python3"
    program.write_text(f"#!/bin/sh\n{body}\n")
    program.chmod(0o755)
    for name in ("pip", "python"):
        shutil.copy(program, folder / name)


def test_a_python3_without_rospy_is_covered_by_debians_alone(tmp_path):
    fake_python(tmp_path, "exit 1")
    found = shell(
        f"source {SETUP_FILE}; source {SETUP_FILE}; type -p python3 python pip; python3 -c 'import rospy, trimesh; print(1)'",
        path=f"{tmp_path}:/usr/bin:/bin",
    )
    assert [Path(found[0]).resolve(), *found[1:]] == [Path("/usr/bin/python3").resolve(), f"{tmp_path}/python", f"{tmp_path}/pip", "1"]


def test_a_python3_that_knows_rospy_stays(tmp_path):
    fake_python(tmp_path, 'exec /usr/bin/python3 "$@"')
    assert shell(f"source {SETUP_FILE}; type -p python3", path=f"{tmp_path}:/usr/bin:/bin") == [f"{tmp_path}/python3"]


def test_the_distribution_is_called_noetic_without_a_word_however_often_one_sources(students_workspace):
    said = shell(f"source {SETUP_FILE}; source {students_workspace}; source {SETUP_FILE}; echo $ROS_DISTRO; rosversion -d")
    assert said == ["noetic", "noetic"]


def test_roswtf_takes_the_root_folder():
    said = shell(
        f"source {SETUP_FILE}; python3 -c 'from roswtf.environment import *; from roswtf.context import *\n"
        'print(isdir(os.environ["ROS_ROOT"]), ros_root_check(None, os.environ["ROS_ROOT"]))\''
    )
    assert said[-1] == "True None"


def test_add_ons_come_after_the_modules_of_all_workspaces(students_workspace):
    (path,) = shell(f"source {SETUP_FILE}; source {students_workspace}; echo $PYTHONPATH", PYTHONPATH="/mine")
    folders = path.split(":")
    add_ons = [folder for folder in folders if Path(folder).name.startswith(".python") or (Path(folder) / "trimesh").is_dir()]
    assert add_ons and folders[-len(add_ons) :] == add_ons and "/mine" in folders  # .python, and .python-teaching if it is there
    assert (Path(add_ons[0]) / "trimesh").is_dir()
    assert len(folders) == len(set(folders))


LABS = PACKAGE.parents[1] / "labs"
FIND = "python3 -c 'from roslaunch.substitution_args import resolve_args as r; print(r(\"$(find arm_gazebo)/worlds/arm.world\"))'"


@pytest.mark.slow
@pytest.mark.skipif(not LABS.is_dir(), reason="installed without the labs")
def test_the_labs_are_there_in_the_clones_own_shell_and_in_no_workspace_that_stands_on_it(tmp_path):
    package = tmp_path / "src/arm_gazebo"
    package.mkdir(parents=True)
    (package / "package.xml").write_text(
        '<package format="2"><name>arm_gazebo</name><version>0.0.1</version><description>d</description>'
        '<maintainer email="a@b.cd">a</maintainer><license>BSD</license>'
        "<buildtool_depend>catkin</buildtool_depend></package>"
    )
    (package / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.10)\nproject(arm_gazebo)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
    )
    said = shell(
        f"source {SETUP_FILE}; {FIND}; rospack find arm_controller; cd {tmp_path}; catkin init >/dev/null;"
        "catkin build --no-notify --no-status >/dev/null; source devel/setup.bash;"
        f"{FIND}; rospack find arm_controller 2>/dev/null || echo none; rospack find gazebo_ros;"
        "catkin build --no-notify --no-status | grep -c 'CMAKE_PREFIX_PATH is different' || true;"
        f"source {SETUP_FILE}; {FIND}; catkin build --no-notify --no-status | grep -c 'is different' || true"
    )
    lab = str(LABS / "arm/arm_gazebo/worlds/arm.world")
    assert said == [
        lab,
        str(LABS / "arm/arm_controller"),
        str(package / "worlds/arm.world"),
        "none",
        str(LABS.parent / "simulation/gazebo_ros"),
        "0",
        lab,
        "0",
    ]

"""Programs that rosrun finds: those of Debian's rosrun, and what is said where it finds none."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from node_signals import programs

BIN = Path(__file__).resolve().parents[1] / "bin"
MANIFEST = (
    "<package format='2'><name>my_arm</name><version>0.0.1</version><description>d</description>"
    "<maintainer email='a@b.cd'>a</maintainer><license>BSD</license></package>"
)


def script(path, says, mode=0o755):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f'#!/bin/sh\necho {says} "$0" "$#" "$@"\n')
    path.chmod(mode)


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    """A workspace that catkin built: my_arm with a relay in its development space."""
    source, devel = tmp_path / "src" / "my_arm", tmp_path / "devel"
    script(source / "scripts" / "node.py", "source")
    script(source / "build" / "left.py", "built")
    script(source / "scripts" / "left.py", "source")
    script(source / "scripts" / "plain.py", "source", 0o644)
    script(source / "scripts" / "twice.py", "first")
    script(source / "nodes" / "twice.py", "second")
    script(source / "scripts" / "relayed.py", "source")
    script(devel / "lib" / "my_arm" / "relayed.py", "relay")
    (source / "package.xml").write_text(MANIFEST)
    (devel / ".catkin").write_text(str(source))
    for name, value in (
        ("CMAKE_PREFIX_PATH", str(devel)),
        ("ROS_PACKAGE_PATH", str(source.parent)),
        ("ROS_HOME", str(tmp_path / "home")),
        ("PATH", f"{BIN}:/usr/bin:/bin"),
    ):
        monkeypatch.setenv(name, value)
    return source


def run(program, *words):
    ended = subprocess.run([*program, *words], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60)
    return ended.returncode, ended.stdout, ended.stderr


OWN, DEBIANS = [sys.executable, str(BIN / "rosrun")], ["/usr/bin/rosrun"]


@pytest.mark.slow
@pytest.mark.parametrize(
    "words",
    [
        ["my_arm", "node.py", "a b", "*"],
        ["--prefix", "nice -n 1", "my_arm", "relayed.py"],
        ["my_arm", "left.py"],
        ["my_arm", "nod*.py"],
        ["my_arm", "twice.py"],
        ["my_arm", "plain.py"],
        ["my_arm", "scripts/node.py", "a"],
        ["my_arm", "nowhere/node.py"],
    ],
)
def test_runs_what_debians_runs(workspace, words):
    code, printed, _ = run(OWN, *words)
    assert (code, printed) == run(DEBIANS, *words)[:2]


def test_a_launch_file_is_no_program_also_when_it_is_executable(workspace):
    for mode in (0o644, 0o755):
        (workspace / "arm.launch").write_text("<launch/>")
        (workspace / "arm.launch").chmod(mode)
        code, printed, said = run(OWN, "my_arm", "arm.launch")
        assert code != 0 and printed == "" and "That is a launch file: roslaunch my_arm arm.launch" in said and "chmod" not in said


def test_a_place_in_the_package_is_looked_at_as_a_name_is(workspace):
    (workspace / "launch").mkdir()
    (workspace / "launch" / "arm.launch").write_text("<launch/>")
    code, printed, said = run(OWN, "my_arm", "launch/arm.launch")
    assert code != 0 and printed == "" and "That is a launch file: roslaunch my_arm arm.launch" in said
    (workspace / "scripts" / "windows.py").write_bytes(b"#!/usr/bin/env python3\r\nprint(3)\r\n")
    assert "chmod +x" in run(OWN, "my_arm", "scripts/windows.py")[2]
    (workspace / "scripts" / "windows.py").chmod(0o755)
    code, printed, said = run(OWN, "my_arm", "scripts/windows.py")
    assert (code, printed) == (0, "3\n") and "dos2unix" in said


@pytest.mark.parametrize(
    "words, told",
    [
        (["my_arm", "node.py"], "rosrun my_arm node.py"),
        (["src/node.py"], "rosrun PACKAGE node.py"),
        (["my_arm", "arm.launch.py", "a:=b"], "of ROS 2"),
    ],
)
def test_a_program_is_no_launch_file(workspace, words, told):
    code, _, said = run([sys.executable, str(BIN / "roslaunch")], *words)
    assert code == 1 and said.startswith(f"roslaunch: {words[-1] if ':=' not in words[-1] else words[-2]} is no launch file. ")
    assert told in said and said.count("\n") == 1


def test_debians_need_not_be_asked(workspace):
    assert programs.find("my_arm", "relayed.py") == [os.environ["CMAKE_PREFIX_PATH"] + "/lib/my_arm/relayed.py"]


def test_why_there_is_nothing_to_run(workspace):
    assert (
        f"no program plain.py that can be run. Such a file is there and is not executable: chmod +x {workspace}"
        in run(OWN, "my_arm", "plain.py")[2]
    )
    assert run(OWN, "my_leg", "x")[2].startswith("rosrun: the package 'my_leg' is not here. Is it built in your workspace")


@pytest.mark.parametrize("words", [["rosrun"], ["rosrun", "my_arm"], ["rosrun", "--debug", "my_arm", "a"], ["rosrun", "-p"]])
def test_the_rest_is_debians(words):
    assert programs.command(words) is None

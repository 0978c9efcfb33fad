"""Nodes whose launch was killed."""

import os
import signal
import socket
import subprocess
import sys
import time

import pytest
from node_signals import orphans
from test_support import never

#: a node that says when it has begun, ends with its launch, and sleeps
NODE = """#!/usr/bin/env python3
import os, sys, time
sys.path[:0] = {path!r}
from node_signals import orphans
orphans._GONE_FOR, orphans._LOOK = 0.3, 0.05
orphans.end_with_launch()
found = orphans.launcher()
open({mark!r}, "a").write(f"{{os.getpid()}} {{found.name if found else 'nobody'}}\\n")
time.sleep(600)
"""


class Node:
    """``started`` by a command, in which NODE stands for the node's file; ended at the end of the test."""

    def __init__(self, tmp_path, *command, **environment):
        self.file, self.mark = tmp_path / "node.py", tmp_path / "mark"
        self.file.write_text(NODE.format(path=sys.path, mark=str(self.mark)))
        self.file.chmod(0o755)
        self.parent = subprocess.Popen(
            [word.replace("NODE", str(self.file)) for word in command], start_new_session=True, env={**os.environ, **environment}
        )
        until(lambda: self.mark.exists() and self.mark.read_text().endswith("\n"))
        pid, self.launcher = self.mark.read_text().split()
        self.pid = int(pid)

    def lives(self):
        return orphans._started(self.pid) is not None

    def end(self):
        for kill in (lambda: os.kill(self.pid, signal.SIGKILL), self.parent.kill):
            try:
                kill()
            except ProcessLookupError:
                pass
        self.parent.wait()


def until(condition, seconds=30.0):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it does not happen"
        time.sleep(0.01)


def launch_like(tmp_path, name, prefix=""):
    """A program of that name that starts the node as roslaunch does: in a session of its own."""
    program = tmp_path / name
    program.write_text("#!/usr/bin/env python3\nimport subprocess, sys\nsubprocess.Popen(sys.argv[1:], start_new_session=True).wait()\n")
    program.chmod(0o755)
    return [sys.executable, str(program), *prefix.split(), "NODE"]


@pytest.fixture
def started(tmp_path):
    made = []

    def start(*command, **environment):
        made.append(Node(tmp_path, *command, **environment))
        return made[-1]

    yield start
    for node in made:
        node.end()


@pytest.mark.parametrize("name", ["roslaunch", "rosmon", "rostest"])
def test_it_ends_when_its_launch_is_killed(started, tmp_path, name):
    node = started(*launch_like(tmp_path, name))
    assert node.launcher == name and node.lives()
    node.parent.kill()
    node.parent.wait()
    until(lambda: not node.lives())


def test_under_a_launch_prefix_too(started, tmp_path):
    node = started(*launch_like(tmp_path, "roslaunch", "nice -n 1 bash -c $0;true"))
    assert node.launcher == "roslaunch"
    node.parent.kill()
    node.parent.wait()
    until(lambda: not node.lives())


@pytest.mark.parametrize(
    "command, environment",
    [
        (["bash", "-c", "NODE; true"], {}),
        (["bash", "-c", "nohup NODE >/dev/null 2>&1; true"], {}),
        (["bash", "-c", "setsid -w NODE; true"], {}),
        (["bash", "-c", 'rosrun() { "$@"; true; }; rosrun NODE'], {}),
    ],
)
def test_started_by_hand_it_runs_on(started, command, environment):
    node = started(*command, **environment)
    assert node.launcher == "nobody"
    node.parent.kill()
    node.parent.wait()
    never(lambda: not node.lives(), "its end", 1.0)  # three times as long as it would take


def test_below_a_shell_of_a_launch_it_runs_on(started, tmp_path):
    """A terminal that a launch file opens is a place to start things by hand."""
    program = tmp_path / "terminal"
    program.write_text("#!/usr/bin/env python3\nimport subprocess, sys\nsubprocess.Popen(sys.argv[1:], start_new_session=True).wait()\n")
    program.chmod(0o755)
    command = launch_like(tmp_path, "roslaunch")
    node = started(*command[:-1], str(program), "bash", "-c", "NODE; true")
    assert node.launcher == "nobody"


def test_told_so_it_runs_on(started, tmp_path):
    node = started(*launch_like(tmp_path, "roslaunch"), OUTLIVE_LAUNCH="1")
    node.parent.kill()
    node.parent.wait()
    never(lambda: not node.lives(), "its end", 1.0)


def test_another_process_with_the_number_of_the_launch_is_not_it():
    own = orphans._started(os.getpid())
    assert orphans.Launcher(os.getpid(), "roslaunch", own).alive
    assert not orphans.Launcher(os.getpid(), "roslaunch", str(int(own) - 1)).alive
    child = subprocess.Popen(["true"])
    until(lambda: orphans._field(child.pid, 0) == "Z")
    assert orphans._started(child.pid) is None  # ended, though nobody has asked
    child.wait()


def test_process_one_of_a_container_has_no_launch(monkeypatch):
    monkeypatch.setattr(orphans.os, "getsid", lambda pid: 1)
    assert orphans.launcher() is None


@pytest.mark.slow
def test_roslaunch_itself(tmp_path):
    """Killed, it leaves a node behind, which ends by itself."""
    node = tmp_path / "node.py"
    mark = tmp_path / "mark"
    node.write_text(NODE.format(path=sys.path, mark=str(mark)))
    node.chmod(0o755)
    package = tmp_path / "orphan_pkg"
    package.mkdir()
    (package / "package.xml").write_text(
        "<package format='2'><name>orphan_pkg</name><version>0.0.1</version><description>d"
        "</description><maintainer email='a@b.c'>m</maintainer><license>BSD</license></package>"
    )
    node.rename(package / "node.py")
    (package / "one.launch").write_text('<launch><node name="one" pkg="orphan_pkg" type="node.py"/></launch>')
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        port = probe.getsockname()[1]
    process = subprocess.Popen(
        ["roslaunch", str(package / "one.launch")],
        start_new_session=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env={
            **os.environ,
            "ROS_MASTER_URI": f"http://localhost:{port}",
            "ROS_HOME": str(tmp_path),
            "ROS_PACKAGE_PATH": f"{tmp_path}:{os.environ.get('ROS_PACKAGE_PATH', '')}",
        },
    )
    try:
        until(lambda: mark.exists() and mark.read_text().endswith("\n"), 60)
        pid, name = mark.read_text().split()
        assert name == "roslaunch"
        process.kill()
        process.wait()
        until(lambda: orphans._started(int(pid)) is None)
    finally:
        for number in subprocess.run(["pgrep", "-f", "--", str(tmp_path)], capture_output=True, text=True).stdout.split():
            os.kill(int(number), signal.SIGKILL)  # master and rosout, which do not end by themselves

"""The command rqt as a process: options, signals, displays, masters that come and go."""

import os
import shutil
import signal
import socket
import subprocess
import sys
import time

import pytest
import rosgraph

RQT = shutil.which("rqt")
WATCHED = """
import rospy
from std_msgs.msg import String
from python_qt_binding.QtWidgets import QLabel
from rqt_gui_py.plugin import Plugin as Base
class Plugin(Base):
    def __init__(self, context):
        super().__init__(context)
        self.label = QLabel("x")
        context.add_widget(self.label)
        self.subscriber = rospy.Subscriber("/watched", String, lambda message: print("got", message.data, flush=True))
        print("loaded", flush=True)
    def shutdown_plugin(self):
        print("shut down", flush=True)
"""


@pytest.fixture
def environment(tmp_path):
    """A bare shell without display and master, and with settings of its own."""
    kept = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY", "DBUS_SESSION_BUS_ADDRESS")}
    return {
        **kept,
        "XDG_CONFIG_HOME": str(tmp_path),
        "XDG_RUNTIME_DIR": str(tmp_path),
        "QT_QPA_PLATFORM": "offscreen",
        "ROS_MASTER_URI": "http://localhost:1",
        "ROS_HOME": str(tmp_path / "ros"),
    }


def run(environment, *arguments, **variables):
    environment = {k: v for k, v in {**environment, **variables}.items() if v is not None}
    return subprocess.run([RQT, *arguments], env=environment, capture_output=True, text=True, timeout=60)


class Master:
    """A real one, as a process; on a port that is free, or the given one."""

    def __init__(self, port=None):
        if port is None:
            with socket.socket() as free:
                free.bind(("localhost", 0))
                port = free.getsockname()[1]
        self.port, self.uri = port, f"http://localhost:{port}"
        self._process = subprocess.Popen(["rosmaster", "--core", "-p", str(port)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait_for(lambda: rosgraph.is_master_online(self.uri))

    def stop(self):
        self._process.kill()
        self._process.wait()

    def subscribers(self, topic):
        return dict(rosgraph.Master("/test", master_uri=self.uri).getSystemState()[1]).get(topic, [])


class Started:
    """A running rqt whose lines can be waited for."""

    def __init__(self, environment, *arguments):
        self.process = subprocess.Popen(
            [RQT, *arguments], env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True
        )
        self.lines = []

    def line(self, part):
        """Read up to the line that has ``part`` in it."""
        for line in self.process.stdout:
            self.lines.append(line.rstrip())
            if part in line:
                return self.lines[-1]
        raise AssertionError(f"it ended without '{part}': {self.lines}")

    def end(self, number=signal.SIGINT):
        self.process.send_signal(number)
        self.lines += self.process.communicate(timeout=30)[0].splitlines()
        return self.process.returncode


@pytest.fixture
def start(environment):
    running = []

    def go(*arguments, **variables):
        running.append(Started({**environment, **variables}, *arguments))
        return running[-1]

    yield go
    for one in running:
        if one.process.poll() is None:
            one.process.kill()
            one.process.wait()


def wait_for(condition):
    end = time.monotonic() + 30
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


@pytest.mark.parametrize("display", [None, ":4321"])
def test_without_a_display_one_line_names_the_remedy(environment, display):
    ended = run(environment, DISPLAY=display, QT_QPA_PLATFORM=None)
    assert ended.returncode == 1 and ended.stdout == ""
    assert ended.stderr.startswith("rqt: no display" if display is None else "rqt: the display :4321")
    assert "scripts/offscreen" in ended.stderr and len(ended.stderr.splitlines()) == 1


def test_lists_need_no_display_and_no_master(environment):
    ended = run(environment, "--list-plugins", QT_QPA_PLATFORM=None)
    assert (ended.returncode, ended.stderr) == (0, "") and ended.stdout.splitlines() == sorted(ended.stdout.splitlines())
    assert run(environment, "--list-perspectives", QT_QPA_PLATFORM=None).stdout.strip() == ""


def test_a_wrong_option_is_one_line_and_exit_code_1(environment):
    ended = run(environment, "--command-start-plugin", "a")
    assert ended.returncode == 1 and "need a D-Bus session" in ended.stderr and len(ended.stderr.splitlines()) == 1


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_signals_end_it_in_order(start, number, tmp_path, workspace_of_files):
    workspace_of_files("rqt_watched", WATCHED)
    master = Master()
    try:
        rqt = start("--standalone", "rqt_watched", ROS_MASTER_URI=master.uri, ROS_PACKAGE_PATH=workspace_of_files.path)
        rqt.line("loaded")
        wait_for(lambda: master.subscribers("/watched"))
        assert rqt.end(number) == 0
        assert rqt.lines[-1] == "shut down" and master.subscribers("/watched") == []
    finally:
        master.stop()


def test_ctrl_c_while_it_starts_says_nothing(environment):
    process = subprocess.Popen(
        [sys.executable, "-X", "importtime", RQT, "--list-plugins"],
        env=environment,
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    for line in process.stderr:
        if "rospkg" in line:  # in the middle of the imports
            process.send_signal(signal.SIGINT)
            break
    rest = process.communicate(timeout=30)[1]
    assert process.returncode in (-signal.SIGINT, 0) and "Traceback" not in rest


@pytest.mark.slow
def test_waits_for_a_master_and_outlives_it(start, workspace_of_files):
    workspace_of_files("rqt_watched", WATCHED)
    first = Master()
    port, uri = first.port, first.uri
    first.stop()
    rqt = start("--standalone", "rqt_watched", ROS_MASTER_URI=uri, ROS_PACKAGE_PATH=workspace_of_files.path)
    assert rqt.line("waiting") == f"rqt: waiting for the ROS master at {uri}; start roscore, or press Abort"
    second = Master(port)
    rqt.line("loaded")
    wait_for(lambda: second.subscribers("/watched"))
    second.stop()
    third = Master(port)
    try:
        wait_for(lambda: third.subscribers("/watched"))
        assert rqt.end() == 0
    finally:
        third.stop()


def test_giving_up_the_wait_ends_a_standalone_plugin(start, workspace_of_files):
    workspace_of_files("rqt_watched", WATCHED)
    rqt = start("--standalone", "rqt_watched", ROS_PACKAGE_PATH=workspace_of_files.path)
    rqt.line("waiting")
    assert rqt.end() == 1
    assert rqt.lines[-1] == (
        "could not load plugin 'rqt_watched/Plugin': there is no ROS master at http://localhost:1; start roscore, or set ROS_MASTER_URI"
    )


@pytest.fixture
def workspace_of_files(tmp_path):
    from conftest import Workspace

    workspace = Workspace(tmp_path / "ws")

    def make(name, code):
        workspace.make(name, code)

    make.path = f"{workspace.folder}:{os.environ['ROS_PACKAGE_PATH']}"
    return make


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("dbus-run-session") is None, reason="no dbus-run-session")
def test_commands_over_dbus(environment, workspace_of_files):
    workspace_of_files("rqt_watched", WATCHED)
    master = Master()
    script = """rqt & window=$!
        for i in $(seq 300); do rqt --command-switch-perspective lab 2>/dev/null && break; sleep 0.1; done
        rqt --command-start-plugin WATCHED; rqt --command-start-plugin no_such; rqt --command-pid 1 --command-start-plugin x
        kill -INT $window; wait $window; echo ended $?; rqt --list-perspectives"""
    try:
        done = subprocess.run(
            ["dbus-run-session", "--", "bash", "-c", script],
            capture_output=True,
            text=True,
            timeout=120,
            env={**environment, "ROS_MASTER_URI": master.uri, "ROS_PACKAGE_PATH": workspace_of_files.path},
        )
    finally:
        master.stop()
    assert done.stdout.splitlines() == [
        "switched to perspective 'lab'",
        "loaded",
        "started plugin 'rqt_watched/Plugin'",
        "shut down",
        "ended 0",
        "Default",
        "lab",
    ]
    assert "found no plugin matching 'no_such'" in done.stderr and "no running rqt has been found with pid 1" in done.stderr

"""launch-prefix="xterm -e" where there is no display, no such terminal, or both."""

import os
import signal
import subprocess

import pytest
from node_signals import terminals
from test_support import free_port

LAUNCH = """<launch>
  <node name="asks" pkg="rosout" type="rosout" launch-prefix="lxterminal --title=asks -e"/>
  <node name="other" pkg="rosout" type="rosout"/>
</launch>"""


@pytest.mark.parametrize(
    "words, command",
    [
        (["xterm", "-e", "node", "-x"], ["node", "-x"]),
        (["/usr/bin/gnome-terminal", "--title", "a", "--", "node"], ["node"]),
        (["xfce4-terminal", "-x", "node"], ["node"]),
        (["xterm"], None),
        (["xterm", "-e"], None),
        (["node", "-e"], None),
        (["gdb", "-ex", "run", "--args", "node"], None),
        ([], None),
    ],
)
def test_the_command_in_a_terminal(words, command):
    assert terminals.command_in_terminal(words) == command


@pytest.mark.parametrize(
    "display, installed, run, said",
    [
        (False, {"xterm"}, ["node", "a"], "no display"),
        (False, set(), ["node", "a"], "no display"),
        (True, {"lxterminal", "xterm"}, ["lxterminal", "-e", "node", "a"], ""),
        (True, {"xterm"}, ["xterm", "-e", "node", "a"], "sudo apt install lxterminal): xterm takes its place"),
        (True, set(), ["node", "a"], "sudo apt install lxterminal): it runs without a window"),
    ],
)
def test_what_is_run(monkeypatch, display, installed, run, said):
    monkeypatch.setattr(terminals, "missing_display", lambda: None if display else "no display")
    monkeypatch.setattr(terminals.shutil, "which", lambda name: name if name in installed else None)
    words, line = terminals.with_what_is_there(["lxterminal", "-e", "node", "a"])
    assert words == run and said in line and bool(line) == bool(said) and "\n" not in line
    assert terminals.with_what_is_there(["node", "a"]) == (["node", "a"], "")


def test_all_nodes_of_the_launch_file_run(tmp_path):
    (tmp_path / "a.launch").write_text(LAUNCH)
    port = free_port()
    environment = {
        **os.environ,
        "ROS_MASTER_URI": f"http://localhost:{port}",
        "ROS_HOME": str(tmp_path),
        "PYTHONUNBUFFERED": "1",
        "DISPLAY": "",
        "WAYLAND_DISPLAY": "",
        "QT_QPA_PLATFORM": "",
    }
    process = subprocess.Popen(
        ["roslaunch", "-p", str(port), str(tmp_path / "a.launch")],
        env=environment,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        start_new_session=True,
    )
    said = ""
    for line in process.stdout:
        said += line
        if "process[other-" in line:
            break
    os.killpg(process.pid, signal.SIGINT)
    said += process.communicate(timeout=60)[0]
    assert "process[asks-2]: started" in said and "process[other-3]: started" in said and "RLException" not in said, said
    assert said.count("roslaunch: asks-2: lxterminal would open a window, and there is no display: it runs without") == 1, said

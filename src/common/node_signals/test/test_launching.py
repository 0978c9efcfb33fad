"""roslaunch, ended by Ctrl-C in its first moments, and where its logs go."""

import os
import signal
import socket
import subprocess
import sys
import time

import pytest

LAUNCH = """<launch>
  <param name="text" command="rosversion roslaunch"/>
  <node name="one" pkg="rosout" type="rosout"/>
  <node name="two" pkg="rosout" type="rosout"/>
</launch>"""
AT_ONCE = 5.0  # s; upstream takes 10 to 40 where it fails, a loaded machine about 2


def launch(tmp_path, text=LAUNCH, **changed):
    file = tmp_path / "two.launch"
    file.write_text(text)
    return started(tmp_path, ["roslaunch", str(file)], **changed)


def started(tmp_path, command, **changed):
    """It with a port of its own, whose master nobody else has."""
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        port = probe.getsockname()[1]
    environment = {
        **os.environ,
        "ROS_MASTER_URI": f"http://localhost:{port}",
        "ROS_HOME": str(tmp_path),
        "PYTHONUNBUFFERED": "1",
        **changed,
    }
    return subprocess.Popen(
        [*command, "-p", str(port)], env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True
    )


def interrupted(process, said):
    """Ctrl-C as a terminal sends it: to roslaunch and what still belongs to its group. (seconds, all that was printed)"""
    begin = time.monotonic()
    os.killpg(process.pid, signal.SIGINT)
    try:
        rest, _ = process.communicate(timeout=60)
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
    return time.monotonic() - begin, said + rest


def ended_at(process, moment):
    """Ctrl-C when it has printed that: it ends at once, and says nothing of its own insides."""
    said = ""
    for line in process.stdout:
        said += line
        if moment in line:
            break
    else:
        pytest.fail(f"it ended before it said '{moment}': {said}")
    seconds, text = interrupted(process, said)
    assert seconds < AT_ONCE, text
    assert "Traceback" not in text and "RLException" not in text, text


@pytest.mark.slow
@pytest.mark.parametrize(
    "moment",
    [
        "logging to",
        "auto-starting new master",
        "process[master]",
        "setting /run_id",
        "process[rosout-1]",
        "started core service",
        "process[one-2]",
        "process[two-3]",
    ],
)
def test_ctrl_c_at_any_line_of_the_start(tmp_path, moment):
    ended_at(launch(tmp_path), moment)


@pytest.mark.slow
@pytest.mark.parametrize("moment", ["logging to", "auto-starting new master", "process[master]", "started core service"])
def test_ctrl_c_at_any_line_of_roscore(tmp_path, moment):
    ended_at(started(tmp_path, ["roscore"]), moment)


@pytest.mark.parametrize("ending", [True, False])
def test_a_master_that_ctrl_c_has_ended_breaks_off_in_silence(tmp_path, ending):
    """It resets the connection if it goes in the midst of an answer; without a Ctrl-C that is a fault to be shown."""
    (tmp_path / "empty.launch").write_text("<launch/>")
    words = f"""
from node_signals import launching
launching._mend()
import roslaunch.parent
def start(parent):
    roslaunch.pmon._shutting_down = {ending}
    raise ConnectionResetError(104, "Connection reset by peer")
roslaunch.parent.ROSLaunchParent.start = start
roslaunch.main(["roslaunch", {str(tmp_path / "empty.launch")!r}])
"""
    done = subprocess.run([sys.executable, "-c", words], env={**os.environ, "ROS_HOME": str(tmp_path)}, capture_output=True, text=True)
    assert done.returncode == 1 and ("Connection reset by peer" in done.stderr) is not ending, done.stderr


def test_ctrl_c_while_files_are_read_is_silent(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    process = launch(tmp_path, LAUNCH.replace("rosversion roslaunch", f"cat {pipe}"))
    with open(pipe, "w"):  # waits for the reader, for whom roslaunch waits
        seconds, text = interrupted(process, "")
    assert seconds < AT_ONCE and "Traceback" not in text and "auto-starting" not in text, text


@pytest.mark.slow
@pytest.mark.parametrize("variable", ["ROS_HOME", "ROS_LOG_DIR"])
def test_a_home_that_takes_no_files_is_replaced(tmp_path, variable):
    """As with one that is read-only or full."""
    process = launch(tmp_path, TMPDIR=str(tmp_path), **{variable: "/dev/null/ros"})
    said = ""
    for line in process.stdout:
        said += line
        if "process[two-3]" in line:
            break
    _, text = interrupted(process, said)
    assert "process[two-3]" in text and "Traceback" not in text, text
    first = text.splitlines()[0]
    assert first.startswith("roslaunch: nothing can be written to /dev/null/ros (Not a directory); ") and str(tmp_path / "ros_") in first
    assert text.count("nothing can be written") == 1


@pytest.mark.slow
@pytest.mark.parametrize("display, platform, times", [("", "", 1), ("nowhere:77", "", 1), ("", "offscreen", 0)])
def test_a_window_without_a_display_is_one_line_that_names_the_remedy(tmp_path, display, platform, times):
    windows = "".join(f'<node name="w{i}" pkg="rviz" type="rviz" args="--help"/>' for i in range(2))
    process = launch(tmp_path, f"<launch>{windows}</launch>", DISPLAY=display, WAYLAND_DISPLAY="", QT_QPA_PLATFORM=platform)
    said = ""
    for line in process.stdout:
        said += line
        if "process[w1-" in line or "w1-" in line and "process" in line:
            break
    _, said = interrupted(process, said)
    lines = [line for line in said.splitlines() if "rviz opens a window" in line]
    assert len(lines) == times and all("scripts/offscreen" in line for line in lines), said

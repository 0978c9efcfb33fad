"""RViz's second start, seen from outside: a program of ours stands for it, since the real one dies when it likes."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

BIN = Path(__file__).resolve().parents[1] / "bin"
SOURCES = Path(__file__).resolve().parents[1] / "src"


def start(tmp_path, script, *arguments, **changed):
    """``rviz`` as PATH finds it, behind it ``script`` in its place, which notes each of its starts in ``starts``."""
    programs = tmp_path / "bin"
    programs.mkdir()
    (programs / "rviz").write_text(f"#!/bin/bash\necho start >> {tmp_path}/starts\nturn=$(wc -l < {tmp_path}/starts)\n{script}\n")
    (programs / "rviz").chmod(0o755)
    variables = {**os.environ, "QT_QPA_PLATFORM": "offscreen", "PATH": f"{BIN}:{programs}:/usr/bin:/bin", "PYTHONPATH": str(SOURCES)}
    return subprocess.Popen(
        [sys.executable, BIN / "rviz", *arguments], env={**variables, **changed}, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


def starts(tmp_path):
    return len((tmp_path / "starts").read_text().splitlines()) if (tmp_path / "starts").exists() else 0


@pytest.mark.parametrize("name", ["SEGV", "ABRT", "BUS"])
def test_a_crash_of_the_first_seconds_is_followed_by_a_second_start_and_one_line(tmp_path, name):
    running = start(tmp_path, f'[ $turn = 2 ] || kill -{name} $$; echo "$@"; exit 3', "-d", "a b.rviz")
    out, err = running.communicate(timeout=60)
    assert (running.returncode, out, starts(tmp_path)) == (3, "-d a b.rviz\n", 2)
    assert err.count("\n") == 1 and f"rviz: it died by SIG{name}" in err and "started once more" in err


def test_there_is_no_third_start(tmp_path):
    running = start(tmp_path, "kill -SEGV $$")
    assert running.wait(timeout=60) == -signal.SIGSEGV and starts(tmp_path) == 2


@pytest.mark.parametrize("script, code", [("exit 0", 0), ("exit 255", 255), ("kill -KILL $$", -signal.SIGKILL)])
def test_other_ends_are_passed_on(tmp_path, script, code):
    running = start(tmp_path, script)
    assert running.wait(timeout=60) == code and starts(tmp_path) == 1 and running.stderr.read() == ""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_who_asks_it_to_end_is_obeyed_even_when_it_dies_of_it(tmp_path, number):
    running = start(tmp_path, f"trap 'kill -SEGV $$' {number.name[3:]}; echo ready; while :; do sleep 0.05; done")
    assert running.stdout.readline() == "ready\n"
    running.send_signal(number)
    assert running.wait(timeout=60) == -signal.SIGSEGV and starts(tmp_path) == 1


def test_it_does_not_outlive_who_started_it(tmp_path):
    running = start(tmp_path, "echo $$; exec sleep 60")
    pid = int(running.stdout.readline())
    running.kill()
    running.wait(timeout=60)
    deadline = time.monotonic() + 30
    while Path(f"/proc/{pid}").exists() and Path(f"/proc/{pid}/stat").read_text().split()[2] != "Z":
        assert time.monotonic() < deadline
        time.sleep(0.01)


@pytest.mark.slow
def test_a_launch_file_that_requires_it_survives_the_crash(tmp_path):
    """As ``<node pkg="rviz" required="true">``: the package is one of ours whose name roslaunch takes for RViz's."""
    package, programs = tmp_path / "ws/share/rviz", tmp_path / "ws/lib/rviz"
    for folder in (package, programs):
        folder.mkdir(parents=True)
    (tmp_path / "ws/.catkin").write_text("")
    (package / "package.xml").write_text(
        "<package format='2'><name>rviz</name><version>1.0.0</version><description>d</description>"
        "<maintainer email='a@example.org'>m</maintainer><license>BSD</license></package>"
    )
    (programs / "rviz").write_text(
        f"#!/bin/bash\necho start >> {tmp_path}/starts\n[ $(wc -l < {tmp_path}/starts) = 2 ] || kill -SEGV $$\n"
        f"echo second >> {tmp_path}/second; exec sleep 600\n"
    )
    (programs / "rviz").chmod(0o755)
    launch = tmp_path / "a.launch"
    launch.write_text('<launch><node pkg="rviz" type="rviz" name="rviz" required="true"/></launch>')
    variables = {
        **os.environ,
        "QT_QPA_PLATFORM": "offscreen",
        "ROS_PACKAGE_PATH": str(tmp_path / "ws/share"),
        "CMAKE_PREFIX_PATH": str(tmp_path / "ws"),
        "ROS_HOME": str(tmp_path),
        "ROS_MASTER_URI": "http://localhost:11987",
        "PYTHONPATH": f"{SOURCES}:{os.environ.get('PYTHONPATH', '')}",
    }
    with subprocess.Popen(
        [sys.executable, BIN / "roslaunch", "--port", "11987", launch],
        env=variables,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    ) as running:
        deadline = time.monotonic() + 120
        while not (tmp_path / "second").exists() and time.monotonic() < deadline and running.poll() is None:
            time.sleep(0.05)
        seen = (tmp_path / "second").exists()
        running.send_signal(signal.SIGINT)
        out = running.communicate(timeout=60)[0]
    assert seen, out
    assert "REQUIRED process" not in out

"""Commands typed in a terminal where no ROS master runs, as people who know Gazebo do."""

import os
import shutil
import socket
import subprocess

import pytest
from test_support import wait_until


def free_port():
    with socket.socket() as place:
        place.bind(("localhost", 0))
        return place.getsockname()[1]


def listens(port):
    with socket.socket() as place:
        return place.connect_ex(("localhost", port)) == 0


@pytest.fixture
def port():
    return free_port()


def typed(port, *command):
    uris = {"ROS_MASTER_URI": f"http://localhost:{port}", "GAZEBO_MASTER_URI": f"http://localhost:{free_port()}"}
    command = [shutil.which(command[0]), *command[1:]]
    return subprocess.run(command, env={**os.environ, **uris}, capture_output=True, text=True, timeout=120)


@pytest.mark.slow
def test_gzserver_brings_its_own_master_which_ends_with_it(port):
    ended = typed(port, "gzserver", "--iters", "100", "worlds/empty.world")
    assert ended.returncode == 0 and "gzserver: no ROS master runs" in ended.stderr
    assert "100 iterations done" in ended.stdout
    wait_until(lambda: not listens(port), "the end of its master")


@pytest.mark.parametrize("command", ["gzserver", "gazebo"])
def test_its_version_needs_none(command, port):
    ended = typed(port, command, "--version")
    assert ended.returncode == 0 and ended.stdout.startswith("Gazebo multi-robot simulator, version 11.")
    assert "master" not in ended.stderr and not listens(port)

"""A ROS master for ``gazebo`` and ``gzserver`` typed alone: Gazebo runs without ROS, this simulator speaks nothing else."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path
from urllib.parse import urlparse

import rosgraph
from node_signals.bounded_calls import master_answers
from node_signals.children import end_with_parent

_START = 10.0  # s for the master to answer
_ANSWERS = {"-h", "--help", "-v", "--version"}  # options that start no simulator


def start_if_typed() -> None:
    """As :func:`start_if_missing`, where this process's command was typed: rosrun and roslaunch bring a master, or want theirs."""
    if Path(sys.argv[0]).parent.name == "bin" and _ANSWERS.isdisjoint(sys.argv):
        start_if_missing()


def start_if_missing() -> None:
    """Start a master at ROS_MASTER_URI, which ends with this process, unless one answers there or elsewhere is meant."""
    uri = rosgraph.get_master_uri()
    place = urlparse(uri)
    if master_answers("/gzserver") or not place.port or not rosgraph.network.is_local_address(place.hostname or ""):
        return
    subprocess.Popen(
        ["rosmaster", "--core", "-p", str(place.port)],
        start_new_session=True,
        preexec_fn=end_with_parent,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    print(
        f"{Path(sys.argv[0]).name}: no ROS master runs at {uri}: this simulator brings its own, which ends with it (process {os.getpid()})",
        file=sys.stderr,
        flush=True,
    )
    end = time.monotonic() + _START
    while not master_answers("/gzserver") and time.monotonic() < end:
        time.sleep(0.05)

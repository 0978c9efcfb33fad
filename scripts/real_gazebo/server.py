"""Runs a scene on this simulator's server, with the recorder compiled against gazebo_cpp's headers: the sensors of Gazebo's core."""

from __future__ import annotations

import contextlib
import functools
import os
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterator

from real_gazebo.chroot import HERE, ChrootError, free_port, write_scene
from real_gazebo.records import Record
from real_gazebo.scene import Scene

_MASTER = 30.0  # s for a master to answer
_CMAKE = """cmake_minimum_required(VERSION 3.13)
project(recorder)
set(CMAKE_CXX_STANDARD 17)
find_package(gazebo REQUIRED)
include_directories(${GAZEBO_INCLUDE_DIRS})
link_directories(${GAZEBO_LIBRARY_DIRS})
add_library(recorder SHARED %s/recorder.cc)
target_link_libraries(recorder ${GAZEBO_LIBRARIES})
"""


@functools.cache
def _built() -> tempfile.TemporaryDirectory:
    folder = tempfile.TemporaryDirectory(prefix="recorder")
    with open(os.path.join(folder.name, "CMakeLists.txt"), "w", encoding="utf-8") as file:
        file.write(_CMAKE % HERE)
    for command in (["cmake", "-B", "build", "-DCMAKE_BUILD_TYPE=Release"], ["cmake", "--build", "build"]):
        done = subprocess.run(command, cwd=folder.name, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode:
            said = [line for line in done.stdout.splitlines() if "rror" in line] or done.stdout.splitlines()
            raise ChrootError(f"the recorder does not build against gazebo_cpp: {said[0]}")
    return folder


def recorder() -> str:
    """Folder of librecorder.so, built once for this process; it goes when the process ends."""
    return os.path.join(_built().name, "build")


@contextlib.contextmanager
def master(home: str) -> Iterator[dict[str, str]]:
    """A ROS master of its own; gives the environment of a server that finds it and the recorder."""
    ros = free_port()
    environment = dict(os.environ, ROS_MASTER_URI=f"http://localhost:{ros}", ROS_HOME=home, GAZEBO_PLUGIN_PATH=recorder())
    environment["GAZEBO_MASTER_URI"] = f"http://localhost:{free_port()}"
    quiet = {"env": environment, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    process = subprocess.Popen(["rosmaster", "--core", "-p", str(ros)], start_new_session=True, **quiet)
    try:
        until = time.monotonic() + _MASTER
        while subprocess.run(["rosparam", "list"], **quiet).returncode and time.monotonic() < until:
            time.sleep(0.1)
        yield environment
    finally:
        process.terminate()
        process.wait()


def run(scene: Scene, solver: str, limit: float = 120.0) -> Record:
    """:raises ChrootError: the server did not come to the scene's end."""
    with tempfile.TemporaryDirectory(prefix="scene") as folder, master(folder) as environment:
        write_scene(scene, folder, folder, scene.plugin())
        out = os.path.join(folder, "out.csv")
        settings = {"GAZEBO_MODEL_PATH": folder, "TRUTH_OUT": out, "ODE_SIM_SOLVER": "gazebo" if solver == "gazebo" else ""}
        command = ["rosrun", "gazebo_ros", "gzserver", "-u", os.path.join(folder, "scene.world")]
        server = subprocess.Popen(
            command,
            env={**environment, **settings},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            start_new_session=True,
        )
        try:
            said = server.communicate(timeout=limit)[0]
        except subprocess.TimeoutExpired:
            os.killpg(server.pid, signal.SIGKILL)
            said = server.communicate()[0]
        if os.path.exists(out):
            with open(out, encoding="utf-8") as file:
                lines = file.read().splitlines()
            if lines and lines[-1].startswith("end,"):
                return Record(lines)
        raise ChrootError(f"{scene.name}: the server did not finish it; its last words: {' | '.join(said.strip().splitlines()[-4:])}")

"""Runs node scripts as a shell would, but in a fork of this process, whose imports are done; and what they talk to."""

from __future__ import annotations

import faulthandler
import os
import re
import runpy
import signal
import sys
import time
from pathlib import Path
from typing import NamedTuple

from fuzzing import ros
from fuzzing.worker import end_with_parent

_RUNS = 1.5  # wall s after which a program that goes on is ended by SIGINT
_ENDS = 45.0  # wall s that it then has
_SERVICES = {
    "spawn_urdf_model": "SpawnModel",
    "spawn_sdf_model": "SpawnModel",
    "delete_model": "DeleteModel",
    "get_world_properties": "GetWorldProperties",
    "get_model_state": "GetModelState",
    "get_model_properties": "GetModelProperties",
    "set_model_state": "SetModelState",
    "set_model_configuration": "SetModelConfiguration",
    "get_physics_properties": "GetPhysicsProperties",
    "set_physics_properties": "SetPhysicsProperties",
}


class Ended(NamedTuple):
    """``code``: exit code, negative for a signal; ``interrupted``: it had to be ended; ``hung``: it had to be killed."""

    code: int
    output: str
    errors: str
    interrupted: bool
    hung: bool


def run(script: Path, arguments: list[str], master: str) -> Ended:
    """:param master: URI of the ROS master that the program is to use, if it uses one."""
    sys.stdout.flush()
    pid = os.fork()
    if pid == 0:
        _become(script, arguments, master)
    code, interrupted, hung = _awaited(pid)
    return Ended(code, Path("out.txt").read_text(errors="replace"), Path("err.txt").read_text(errors="replace"), interrupted, hung)


def _become(script: Path, arguments: list[str], master: str) -> None:
    code = 1
    try:
        end_with_parent()
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, signal.default_int_handler if number == signal.SIGINT else signal.SIG_DFL)
        for name, number in (("out.txt", 1), ("err.txt", 2)):
            stream = os.open(name, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
            os.dup2(stream, number)
        faulthandler.enable(all_threads=False)
        faulthandler.register(signal.SIGUSR1, all_threads=True)
        if master:
            os.environ["ROS_MASTER_URI"] = master
        sys.argv = [str(script), *arguments]
        sys.path.insert(0, str(script.parent))  # as Python does for a script
        try:
            runpy.run_path(str(script), run_name="__main__")
            code = 0
        except SystemExit as end:
            code = end.code if isinstance(end.code, int) else 0 if end.code is None else 1
            if isinstance(end.code, str):
                print(end.code, file=sys.stderr)
        except BaseException:
            sys.excepthook(*sys.exc_info())
        sys.stdout.flush()
        sys.stderr.flush()
    finally:
        os._exit(code)


def _awaited(pid: int) -> tuple[int, bool, bool]:
    """(exit code, interrupted, hung)."""
    for patience, number in ((_RUNS, signal.SIGINT), (_ENDS, signal.SIGUSR1), (0.5, signal.SIGKILL), (60.0, signal.SIGKILL)):
        end = time.monotonic() + patience
        while time.monotonic() < end:
            ended, status = os.waitpid(pid, os.WNOHANG)
            if ended:
                return os.waitstatus_to_exitcode(status), number != signal.SIGINT, patience == 60.0
            time.sleep(0.002)
        os.kill(pid, number)
    raise RuntimeError(f"process {pid} cannot be killed")


# ---------------------------------------------------------------------------------------------- what they talk to


def start_masters(folder: Path, number: int) -> tuple[str, str]:
    """Two ROS masters in a process of their own: one alone, one with a double of the simulator and of a controller manager.

    :return: their URIs.
    """
    ports = ros.free_port(2 * number + 40), ros.free_port(2 * number + 41)
    uris = tuple(f"http://localhost:{port}" for port in ports)
    reading, writing = os.pipe()
    if os.fork() == 0:
        try:
            end_with_parent()
            os.close(reading)
            os.environ.update(ROS_MASTER_URI=uris[1], ROS_HOME=str(folder), ROS_LOG_DIR=str(folder / "log"))
            _serve(ports)
            os.write(writing, b".")
            while True:
                time.sleep(3600.0)
        finally:
            os._exit(1)
    os.close(writing)
    if os.read(reading, 1) != b".":
        raise RuntimeError("the ROS masters do not start")
    os.close(reading)
    os.environ.update(ROS_HOME=str(folder), ROS_LOG_DIR=str(folder / "log"))
    return uris


def _serve(ports: tuple[int, int]) -> None:
    import gazebo_msgs.srv
    import rospy
    from controller_manager_tests import ControllerManagerDummy
    from rosmaster.master import Master
    from std_srvs.srv import Empty, EmptyResponse

    for port in ports:
        master = Master(port, 3)
        master.start()
        ros.master_of_this_process.append(master)
    rospy.init_node("double", disable_signals=True)
    for name, kind in _SERVICES.items():
        service = getattr(gazebo_msgs.srv, kind)
        rospy.Service(f"/gazebo/{name}", service, lambda request, service=service: _answer(service))
    for name in ("pause_physics", "unpause_physics", "reset_world", "reset_simulation"):
        rospy.Service(f"/gazebo/{name}", Empty, lambda request: EmptyResponse())
    ControllerManagerDummy("/controller_manager")
    rospy.set_param("robot_description", "<robot name='r'><link name='l'/></robot>")


def _answer(service: type) -> object:
    answer = service._response_class()
    if hasattr(answer, "success"):
        answer.success = True
    if hasattr(answer, "model_names"):
        answer.model_names = ["arm"]
    return answer


def script_of(package: str, name: str, packages: dict[str, str]) -> Path:
    """A node script in its package's folder."""
    folder = Path(packages[package])
    return next(path for path in (folder / "scripts" / name, folder / name) if path.is_file())


def last_line(text: str) -> str:
    """The last line that says something, without colours."""
    lines = [line for line in re.sub(r"\x1b\[[\d;]*m", "", text).splitlines() if line.strip()]
    return lines[-1] if lines else ""

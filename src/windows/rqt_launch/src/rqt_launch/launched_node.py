"""Launch files and the processes of their nodes. Knows no Qt; loading and stopping take their time."""

import os
import shlex
import threading
import time
from typing import Any

import rosgraph
import roslaunch.config
import roslaunch.nodeprocess
import roslaunch.pmon
import roslaunch.substitution_args
import rospkg
import rospy
from qt_gui.errors import WindowError
from roslaunch import RLException
from roslaunch.core import Node
from rqt_py_common.rqt_roscomm_util import RqtRoscommUtil

roslaunch.pmon._sig_initialized = True  # a process must not take over the signals: they are the window's
PATIENCE = 5.0, 2.0  # s after SIGINT, after SIGTERM


class LaunchError(WindowError, RuntimeError):
    """A file that cannot be loaded or a node that cannot be started; one line says why."""


class LaunchedNode:
    """One <node> of a launch file, and its process while it has one."""

    def __init__(self, node: Node, run_id: str):
        self.node, self.name = node, rosgraph.names.ns_join(node.namespace, node.name)
        self._run_id, self._lock = run_id, threading.Lock()
        self._process: Any = None  # a Process of roslaunch
        self.starts, self._wanted = 0, False
        self._died_at: float | None = None

    @property
    def kind(self) -> str:
        return f"{self.node.package}/{self.node.type}"

    def state(self) -> str:
        """running, stopped, finished or "died (exit code N)"."""
        process = self._process
        if process is None:
            return "stopped"
        if process.is_alive():
            return "running"
        if not self._wanted:
            return "stopped"
        return "finished" if not process.exit_code else f"died (exit code {process.exit_code})"

    def start(self) -> None:
        """:raises LaunchError: if there is no such program"""
        with self._lock:
            if self._process is not None and self._process.is_alive():
                return
            self._wanted, self._died_at = True, None
            try:
                self._process = roslaunch.nodeprocess.create_node_process(self._run_id, self.node, rosgraph.get_master_uri(), *PATIENCE)
                self._process.start()
            except (RLException, roslaunch.nodeprocess.FatalProcessLaunch, roslaunch.node_args.NodeParamsException, OSError) as error:
                self._process, self._wanted = None, False
                raise LaunchError(f"{self.name}: {_one_line(error)}") from error
            self.starts += 1

    def stop(self) -> None:
        """Returns when the process has ended."""
        with self._lock:
            self._wanted = False
            if self._process is not None:
                self._process.stop([])

    def due(self, now: float) -> bool:
        """Whether a node with respawn has died and its delay (s) is over."""
        if not (self._wanted and self.node.respawn) or self.state() == "running":
            self._died_at = None
            return False
        self._died_at = self._died_at or now
        return now - self._died_at >= max(1.0, self.node.respawn_delay)


def packages() -> list[str]:
    """Those with launch files in a folder launch."""
    return sorted({name for name, _ in RqtRoscommUtil.iterate_packages("launch")})


def launch_files(package: str) -> list[str]:
    """Their names within the folder launch of a package."""
    try:
        return [name.split("/", 1)[1] for name in RqtRoscommUtil.list_files(package, "launch")]
    except rospkg.ResourceNotFound:
        return []


def load(package: str, file: str, arguments: str) -> list[LaunchedNode]:
    """The nodes of the launch file ``file`` in the folder launch of ``package``; its parameters are set on the master.

    :param arguments: as typed behind roslaunch: ``gui:=false speed:=2``
    :raises LaunchError: if it cannot be loaded
    """
    try:
        path = os.path.join(rospkg.RosPack().get_path(package), "launch", file)
        config = roslaunch.config.ROSLaunchConfig()
        loader = roslaunch.xmlloader.XmlLoader(resolve_anon=True)
        loader.load(path, config, argv=[path, *shlex.split(arguments)], verbose=False)
        config.assign_machines()
        RqtRoscommUtil.load_parameters(config, rospy.get_name())
    except (
        RLException,
        roslaunch.xmlloader.XmlParseException,
        roslaunch.loader.LoadException,
        rospkg.ResourceNotFound,
        roslaunch.substitution_args.SubstitutionException,
        ValueError,
        OSError,
    ) as error:
        raise LaunchError(f"{package} {file}: {_one_line(error)}") from error
    run_id = rospy.get_param("/run_id", "rqt_launch")
    return [LaunchedNode(node, str(run_id)) for node in config.nodes]


def stop_all(nodes: list[LaunchedNode], patience: float = sum(PATIENCE) + 1.0) -> None:
    """Stop all of ``nodes`` that run, at once; returns when they have ended, or after ``patience`` seconds."""
    threads = [threading.Thread(target=node.stop, name=f"stop {node.name}", daemon=True) for node in nodes if node.state() == "running"]
    for thread in threads:
        thread.start()
    end = time.monotonic() + patience
    for thread in threads:
        thread.join(max(0.0, end - time.monotonic()))


def _one_line(error) -> str:
    return " ".join(str(error).split())[:300]

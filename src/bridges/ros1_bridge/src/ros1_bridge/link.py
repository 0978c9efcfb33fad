"""The process of ROS 2 (:mod:`ros1_bridge.peer`), seen from ROS 1: it is started, given orders and listened to."""

from __future__ import annotations

import os
import socket
import subprocess
import threading
from collections.abc import Callable
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from ros1_bridge.errors import Ros2Missing
from ros1_bridge.line import Line

PATIENCE = 20.0  # s until ROS 2 must have started, or told what a type consists of
HINT = "ROS 2 is not installed: run scripts/setup --ros2"


def prefix() -> Path | None:
    """The folder into which ``scripts/setup --ros2`` installed, or ``ROS1_BRIDGE_ROS2``; None where there is none."""
    named = os.environ.get("ROS1_BRIDGE_ROS2")
    here = [Path(named)] if named else [folder / ".python-ros2" for folder in Path(__file__).resolve().parents]
    return next((folder for folder in here if (folder / "bin" / "python").exists() and (folder / "share" / "rclpy").exists()), None)


def environment(folder: Path) -> dict[str, str]:
    """That of a process of ROS 2: nothing of ROS 1's modules and libraries, of which many have the same names."""
    of_ros1 = ("PYTHONPATH", "PYTHONHOME", "CMAKE_PREFIX_PATH", "AMENT_PREFIX_PATH")
    kept = {name: value for name, value in os.environ.items() if name not in of_ros1}
    libraries = [str(folder / "lib"), *sorted(map(str, folder.glob("lib/python3*/site-packages/ros_*.libs")))]
    kept.update(
        LD_LIBRARY_PATH=":".join(libraries), AMENT_PREFIX_PATH=str(folder), _ROS_WHEELS_BOOTSTRAP_COMPLETE="1", PYTHONNOUSERSITE="1"
    )
    kept.setdefault("RMW_IMPLEMENTATION", "rmw_fastrtps_cpp")
    return kept


class Link(Line):
    """:param heard: called with each thing that the other side tells, in a thread of its own
    :param lost: called when the process has ended
    :raises Ros2Missing:
    """

    patience = 5.0  # s of wall time that a service of ROS 2 has, as upstream's

    def __init__(self, heard: Callable[..., None], lost: Callable[[], None], name: str = "ros_bridge") -> None:
        folder = prefix()
        if folder is None:
            raise Ros2Missing(HINT)
        ours, theirs = socket.socketpair()
        for end in (ours, theirs):  # rospy may have set a timeout for all new sockets, with which they do not block
            end.setblocking(True)
        peer = Path(__file__).with_name("peer.py")
        self._process = subprocess.Popen(
            [folder / "bin" / "python", peer, str(theirs.fileno()), name],
            pass_fds=[theirs.fileno()],
            env=environment(folder),
            start_new_session=True,  # Ctrl-C is for this process, which ends the other
        )
        theirs.close()
        super().__init__(Connection(ours.detach()))
        self._heard, self._lost = heard, lost
        self._ready, self._closing = threading.Event(), False
        threading.Thread(target=self._listen, daemon=True).start()
        if not self._ready.wait(PATIENCE) or self._process.poll() is not None:
            self.close()
            raise Ros2Missing(f"ROS 2 does not start; its own words are above. Run scripts/setup --ros2 again, which makes {folder} anew")

    def question(self, word: str, *words: Any) -> Any:
        """What the other side says to the question ``word`` and ``words``. :raises Ros2Missing: there is no answer"""
        try:
            return self.wait(PATIENCE, word, *words)[0]
        except TimeoutError:
            raise Ros2Missing(f"the process of ROS 2 does not answer ({word})") from None

    def close(self) -> None:
        self._closing = True
        self._process.terminate()
        try:
            self._process.wait(2.0)
        except subprocess.TimeoutExpired:
            self._process.kill()

    def _listen(self) -> None:
        self.listen(self._sort)
        self._ready.set()
        if not self._closing:
            self._lost()

    def _sort(self, word: str, *words: Any) -> None:
        if word == "ready":
            self._ready.set()
        elif word == "answer":
            self.answered(*words)
        else:
            self._heard(word, *words)

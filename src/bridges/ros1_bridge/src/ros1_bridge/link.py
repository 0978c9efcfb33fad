"""The process of ROS 2 (:mod:`ros1_bridge.peer`), seen from ROS 1: it is started, given orders and listened to."""

from __future__ import annotations

import itertools
import os
import socket
import subprocess
import threading
from collections.abc import Callable
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from ros1_bridge.errors import Ros2Missing

PATIENCE = 20.0  # s until ROS 2 must have started, or told what a type consists of
BULK = 65536  # bytes, as in peer.py
HINT = "ROS 2 is not installed: run scripts/setup --ros2"


def prefix() -> Path | None:
    """The folder into which ``scripts/setup --ros2`` installed, or ``ROS1_BRIDGE_ROS2``; None where there is none."""
    named = os.environ.get("ROS1_BRIDGE_ROS2")
    here = [Path(named)] if named else [folder / ".python-ros2" for folder in Path(__file__).resolve().parents]
    return next((folder for folder in here if (folder / "bin" / "python").exists() and (folder / "share" / "rclpy").exists()), None)


def environment(folder: Path) -> dict[str, str]:
    """That of a process of ROS 2: nothing of ROS 1's modules and libraries, of which many have the same names."""
    kept = {
        name: value
        for name, value in os.environ.items()
        if name not in ("PYTHONPATH", "PYTHONHOME", "CMAKE_PREFIX_PATH", "AMENT_PREFIX_PATH")
    }
    libraries = [str(folder / "lib"), *sorted(map(str, folder.glob("lib/python3*/site-packages/ros_*.libs")))]
    kept.update(
        LD_LIBRARY_PATH=":".join(libraries), AMENT_PREFIX_PATH=str(folder), _ROS_WHEELS_BOOTSTRAP_COMPLETE="1", PYTHONNOUSERSITE="1"
    )
    kept.setdefault("RMW_IMPLEMENTATION", "rmw_fastrtps_cpp")
    return kept


class Link:
    """:param heard: called with each thing that the other side tells, in a thread of its own
    :param lost: called when the process has ended
    :raises Ros2Missing:
    """

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
        self._connection, self._sending = Connection(ours.detach()), threading.Lock()
        self._numbers = itertools.count(1)
        self._replies: dict[int, list[Any]] = {}
        self._came = threading.Condition()
        self._heard, self._lost = heard, lost
        self._ready, self._closing = threading.Event(), False
        self._described: dict[Any, dict[str, dict[str, str]]] = {}
        threading.Thread(target=self._listen, daemon=True).start()
        if not self._ready.wait(PATIENCE) or self._process.poll() is not None:
            self.close()
            raise Ros2Missing(f"ROS 2 does not start; its own words are above. Run scripts/setup --ros2 again, which makes {folder} anew")

    def tell(self, *words: Any, data: Any = None) -> None:
        with self._sending:
            try:
                bulk = data is not None and len(data) > BULK
                self._connection.send((*words, None if bulk or data is None else bytes(data), bulk))
                if bulk:
                    self._connection.send_bytes(data)
            except OSError:  # it has ended; _listen says so
                pass

    def number(self) -> int:
        return next(self._numbers)

    def ask(self, word: str, *words: Any) -> Any:
        """:raises Ros2Missing: there is no answer"""
        number = self.number()
        self.tell(word, number, *words)
        with self._came:
            if not self._came.wait_for(lambda: number in self._replies, PATIENCE):
                raise Ros2Missing(f"the process of ROS 2 does not answer ({word})")
            return self._replies.pop(number)[0]

    def describe(self, name: str, form: str) -> dict[str, dict[str, str]]:
        """Fields of ``name``, ``package/Name``, and of all it consists of; {} where ROS 2 has no such type here.

        :param form: "msg", "srv" or "action"
        """
        if (name, form) not in self._described:
            self._described[name, form] = self.ask("describe", name, form)
        return self._described[name, form]

    def close(self) -> None:
        self._closing = True
        self._process.terminate()
        try:
            self._process.wait(2.0)
        except subprocess.TimeoutExpired:
            self._process.kill()

    def _listen(self) -> None:
        try:
            while True:
                *words, data, bulk = self._connection.recv()
                if bulk:
                    data = self._connection.recv_bytes()
                if words[0] == "ready":
                    self._ready.set()
                elif words[0] == "reply":
                    with self._came:
                        self._replies[words[1]] = [words[2]]
                        self._came.notify_all()
                else:
                    self._heard(*words, data)
        except (EOFError, OSError, TypeError):  # closed, by them or by us
            self._ready.set()
            if not self._closing:
                self._lost()

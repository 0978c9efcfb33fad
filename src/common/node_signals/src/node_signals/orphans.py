"""Nodes that end when the launch that started them has been killed.

A launcher that gets SIGKILL, as from a closed container or a job's time limit, cannot end its nodes; a simulator or a spawner would
run on for ever, and the next launch would find it. roslaunch and rosmon make each node the leader of a session of its own: a
process whose session leader is their child was started by them, under a launch prefix too. Whoever types ``rosrun``, ``nohup`` or
``setsid``, or is process 1 of a container, has another parent, and is left alone.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from collections.abc import Callable
from typing import NamedTuple

_LAUNCHERS = ("roslaunch", "rostest", "rosmon", "mon")
_GONE_FOR = 10.0  # s, after which a node ends
_LOOK = 1.0  # s between two looks
#: in the environment: "1" has nodes run on without their launch
KEEPING = "OUTLIVE_LAUNCH"


class Launcher(NamedTuple):
    """``started``: of the process, in the system's ticks, since its number may be another's later."""

    pid: int
    name: str
    started: str

    @property
    def alive(self) -> bool:
        return _started(self.pid) == self.started


def launcher() -> Launcher | None:
    """The process of roslaunch, rostest or rosmon that started this one, else None."""
    parent = _field(os.getsid(0), 1)
    if parent is None:
        return None
    pid = int(parent)
    try:
        with open(f"/proc/{pid}/cmdline", "rb") as file:
            words = file.read().decode(errors="replace").split("\0")[:3]  # an interpreter and its option may come first
    except OSError:
        return None
    name = next((base for base in map(os.path.basename, words) if base in _LAUNCHERS), None)
    started = _started(pid)
    return Launcher(pid, name, started) if name and started else None


def end_with_launch(end: Callable[[], None] = lambda: os.kill(os.getpid(), signal.SIGTERM)) -> None:
    """Have this process end when its launch has been gone for ten seconds; nothing where no launch started it, or where
    ``OUTLIVE_LAUNCH=1`` is in the environment.

    :param end: ends it; called in a thread of its own
    """
    if os.environ.get(KEEPING, "0") not in ("", "0"):
        return
    found = launcher()
    if found is not None:
        threading.Thread(target=_watch, args=(found, end), name="launch", daemon=True).start()


def _watch(found: Launcher, end: Callable[[], None]) -> None:
    while found.alive:
        time.sleep(_LOOK)
    time.sleep(_GONE_FOR)
    print(
        f"{os.path.basename(sys.argv[0])}: {found.name} (process {found.pid}), which started this process, has been gone for "
        f"{_GONE_FOR:g} s: it ends. With {KEEPING}=1 in the environment it runs on",
        file=sys.stderr,
        flush=True,
    )
    end()


def _field(pid: int, index: int) -> str | None:
    """Of what /proc/PID/stat has behind the name: 0 state, 1 parent, 19 when it was started."""
    try:
        with open(f"/proc/{pid}/stat", "rb") as file:
            return file.read().rpartition(b")")[2].split()[index].decode()
    except (OSError, IndexError):
        return None


def _started(pid: int) -> str | None:
    """None when it has ended, also if nobody has asked for its end yet."""
    return None if _field(pid, 0) in (None, "Z", "X") else _field(pid, 19)

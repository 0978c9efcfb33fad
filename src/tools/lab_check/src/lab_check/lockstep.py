"""When has everybody answered? Simulated time passes in quanta, in which the submission's nodes are stopped; between two quanta they run
until they rest. What they send thus arrives at the same simulated time in every run, however slow the machine is.

A node rests when none of its threads runs or waits for the disk, and no bytes lie unread in a connection. Nodes of roscpp that sleep in
simulated time look at the clock every wall millisecond: rest must last longer than that.
"""
from __future__ import annotations

import os
import signal
import time
from typing import Dict, Iterable, List, Optional, Set

_REST = 0.0016  # s of rest, longer than roscpp's look at the clock
_STEP = 0.0004  # s between two looks
_PATIENCE = 2.0  # s until a process that never rests is waited for no more


class Nodes:
    """The processes that are waited for: all in this process namespace, or all that carry a mark in their environment.

    :param mark: ``NAME=value``; None where the namespace holds nothing else
    :param own: processes of the checker, which are waited for but never stopped
    """

    def __init__(self, mark: Optional[str], own: Iterable[int]):
        self._mark = mark.encode() if mark else None
        self._own = set(own)
        self._known: Dict[int, bool] = {}
        self._restless: Set[int] = set()
        self._simulator: Optional[int] = None
        self.restless_names: List[str] = []
        self.pids: List[int] = []
        self.find()

    def find(self) -> None:
        """Looks for processes that came or went."""
        found = []
        for name in os.listdir("/proc"):
            if not name.isdigit():
                continue
            pid = int(name)
            if self._mark is None:
                found.append(pid)
            elif pid in self._own or self._marked(pid):
                found.append(pid)
        self.pids = found

    def _marked(self, pid: int) -> bool:
        if pid not in self._known:
            try:
                with open(f"/proc/{pid}/environ", "rb") as file:
                    self._known[pid] = self._mark in file.read().split(b"\0")
            except OSError:
                return False
        return self._known[pid]

    def strangers(self) -> List[int]:
        """All but the checker's and the simulator."""
        return [pid for pid in self.pids if pid not in self._own and pid != self._simulator]

    def simulator_is(self, pid: Optional[int]) -> None:
        self._simulator = pid

    def add_own(self, pid: int) -> None:
        self._own.add(pid)

    def stop(self) -> None:
        for pid in self.strangers():
            _signal(pid, signal.SIGSTOP)

    def go_on(self) -> None:
        for pid in self.strangers():
            _signal(pid, signal.SIGCONT)

    def busy(self) -> List[int]:
        """Who runs, or waits for the disk, now."""
        me = os.getpid()
        return [pid for pid in self.pids if pid not in self._restless and _runs(pid, skip_main=pid == me)]

    def settle(self, rest: float = _REST, patience: float = _PATIENCE) -> bool:
        """Waits until all rest, for ``rest`` seconds on end. False when somebody never did, who is waited for no more."""
        start = time.monotonic()
        quiet_since = None
        while True:
            busy = self.busy()
            now = time.monotonic()
            if busy or (self._mark is None and _unread()):  # a shared network carries other people's bytes
                quiet_since = None
                if now - start > patience:
                    self._give_up(busy)
                    return False
            elif quiet_since is None:
                quiet_since = now
            elif now - quiet_since >= rest:
                return True
            time.sleep(_STEP if rest < 0.05 else 0.01)
            if rest >= 0.05:
                self.find()

    def _give_up(self, busy: List[int]) -> None:
        for pid in busy:
            if pid in self._own or pid == self._simulator:
                continue
            self._restless.add(pid)
            try:
                with open(f"/proc/{pid}/cmdline", "rb") as file:
                    words = file.read().decode("utf-8", "replace").split("\0")
            except OSError:
                continue
            name = next((w.rsplit("/", 1)[-1] for w in words if w and not w.rsplit("/", 1)[-1].startswith("python")), "a process")
            if name not in self.restless_names:
                self.restless_names.append(name)


def _signal(pid: int, number: int) -> None:
    try:
        os.kill(pid, number)
    except OSError:
        pass


def _runs(pid: int, skip_main: bool) -> bool:
    try:
        threads = os.listdir(f"/proc/{pid}/task")
    except OSError:
        return False
    for thread in threads:
        if skip_main and int(thread) == pid:
            continue
        try:
            with open(f"/proc/{pid}/task/{thread}/stat", "rb") as file:
                state = file.read().rpartition(b")")[2].split(None, 1)[0]
        except (OSError, IndexError):
            continue
        if state in (b"R", b"D"):
            return True
    return False


def _unread() -> bool:
    """Bytes on their way in an open connection of this network."""
    for name in ("tcp", "tcp6"):
        try:
            with open(f"/proc/self/net/{name}", "rb") as file:
                lines = file.read().splitlines()[1:]
        except OSError:
            continue
        for line in lines:
            fields = line.split(None, 5)
            if fields[3] == b"01" and fields[4] != b"00000000:00000000":
                return True
    return False

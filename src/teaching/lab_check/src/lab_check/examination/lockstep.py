"""When has everybody answered? Simulated time passes in quanta, in which the submission's nodes are stopped; between two quanta they run
until they rest. What they send thus arrives at the same simulated time in every run, however slow the machine is.

A node rests when none of its threads runs or waits for the disk, and no bytes lie unread in a connection. Nodes of roscpp that sleep in
simulated time look at the clock every wall millisecond: rest must last longer than that.
"""

from __future__ import annotations

import os
import signal
import time
from collections import Counter, deque
from collections.abc import Iterable

from ..isolation.supervise import STRETCH, descendants, processor_time

_REST = 0.0016  # s of rest, longer than roscpp's look at the clock
_STEP = 0.0004  # s between two looks
_LONG_STEP = 0.01  # the same where rest is long: starts of programs
_LOOKS = 4  # looks that rest takes at least
_PART = 0.5  # part of the looks that a rest of that length would have on an idle machine: on a busy one, rest takes longer
_LONG = 0.5  # s without rest from which on it is looked at who works, and how much
_FLICKER = 0.008  # s after which those who are seldom at work are taken to rest
_SELDOM = 0.35  # part of the looks
_PATIENCE = 5.0  # s of work without rest after which a process is waited for no more: planners work for seconds


class Nodes:
    """The processes that are waited for: all in this process namespace, or all that carry a mark in their environment.

    :param mark: ``NAME=value``; None where the namespace holds nothing else
    :param own: processes of the checker, which are waited for but never stopped
    """

    def __init__(self, mark: str | None, own: Iterable[int]):
        self._mark = mark.encode() if mark else None
        self._own = set(own)
        self._known: dict[int, bool] = {}
        self._restless: set[int] = set()
        self._threads: dict[tuple[int, int], int] = {}  # -> descriptor of its state
        self._simulator: int | None = None
        self._simulators: set[int] = set()  # and what it started, such as encoders of images
        self.restless_names: list[str] = []
        self.pids: list[int] = []
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
        if self._simulator is not None and set(found) != set(self.pids):
            self._simulators = set(descendants(self._simulator))
        self.pids = found

    def _marked(self, pid: int) -> bool:
        if pid not in self._known:
            try:
                with open(f"/proc/{pid}/environ", "rb") as file:
                    self._known[pid] = self._mark in file.read().split(b"\0")
            except OSError:
                return False
        return self._known[pid]

    def strangers(self) -> list[int]:
        """All but the checker's and the simulator's."""
        return [pid for pid in self.pids if pid not in self._own and pid not in self._simulators]

    def simulator_is(self, pid: int | None) -> None:
        """``pid`` and what it started are the simulator; None: there is none."""
        self._simulator = pid
        self._simulators = set() if pid is None else set(descendants(pid))

    def add_own(self, pid: int) -> None:
        """``pid`` is a process of the checker's."""
        self._own.add(pid)

    def stop(self) -> None:
        for pid in self.strangers():
            _signal(pid, signal.SIGSTOP)

    def go_on(self) -> None:
        for pid in self.strangers():
            _signal(pid, signal.SIGCONT)

    def busy(self) -> set[tuple[int, int]]:
        """(process, thread) of all that run, or wait for the disk, now."""
        found = set()
        for key, file in list(self._threads.items()):
            try:
                state = os.pread(file, 128, 0).rpartition(b")")[2][1:2]
            except OSError:  # it ended
                os.close(self._threads.pop(key))
                continue
            if state in (b"R", b"D"):
                found.add(key)
        return found

    def _look_for_threads(self) -> None:
        """Opens the state of each thread once: opening costs more than reading."""
        me, there = (os.getpid(), os.getpid()), set()
        for pid in self.pids:
            if pid in self._restless:
                continue
            try:
                threads = os.listdir(f"/proc/{pid}/task")
            except OSError:
                continue
            for thread in threads:
                key = (pid, int(thread))
                there.add(key)
                if key != me and key not in self._threads:
                    try:
                        self._threads[key] = os.open(f"/proc/{pid}/task/{thread}/stat", os.O_RDONLY)
                    except OSError:
                        continue
        for key in set(self._threads) - there:
            os.close(self._threads.pop(key))

    def settle(self, rest: float = _REST, patience: float = _PATIENCE) -> bool:
        """Waits until all rest, for ``rest`` seconds on end. False when somebody never did, who is waited for no more.

        :param patience: s of processor time that one may take without rest; of wall time ``STRETCH`` times as much

        A thread that only looks at the clock, and sleeps again, is seen at work now and then for ever: it rests when most looks of
        a longer time see it asleep.
        """
        start = time.monotonic()
        pause = _STEP if rest < 0.05 else _LONG_STEP
        needed = max(_LOOKS, int(rest / pause))
        looks: deque[set[tuple[int, int]]] = deque(maxlen=max(2 * _LOOKS, needed))
        enough = max(_LOOKS, int(_PART * rest / pause))
        quiet_since, dry_since, quiet_looks = None, None, 0
        worked: dict[int, float] = {}  # process -> s of processor time, when it was first seen to be long at work
        self._look_for_threads()
        while True:
            time.sleep(pause)
            if pause == _LONG_STEP:
                self.find()
                self._look_for_threads()
            busy = self.busy()
            unread = self._mark is None and _unread()  # a shared network carries other people's bytes
            now = time.monotonic()
            looks.append(busy)
            dry_since = None if unread else dry_since or now
            quiet_since = None if busy or unread else quiet_since or now
            quiet_looks = 0 if quiet_since is None else quiet_looks + 1
            if quiet_since is not None and now - quiet_since >= rest and quiet_looks >= enough:
                return True
            if dry_since is not None and now - dry_since >= rest and len(looks) == looks.maxlen and now - start >= _FLICKER:
                seen = Counter(key for look in looks for key in look)
                if all(count <= _SELDOM * len(looks) for count in seen.values()):
                    return True
            if now - start > _LONG:
                for pid in {pid for pid, _ in busy} - set(worked) - self._own - self._simulators:
                    worked[pid] = processor_time(pid)[0]
                tireless = {pid for pid, before in worked.items() if processor_time(pid)[0] - before > patience}
                if tireless or now - start > STRETCH * patience:
                    self._give_up(tireless or {pid for pid, _ in busy})
                    return False

    def _give_up(self, busy: set[int]) -> None:
        for pid in busy:
            if pid in self._own or pid in self._simulators:
                continue
            self._restless.add(pid)
            try:
                with open(f"/proc/{pid}/cmdline", "rb") as file:
                    words = file.read().decode("utf-8", "replace").split("\0")
                with open(f"/proc/{pid}/comm", encoding="utf-8", errors="replace") as file:
                    short = file.read().strip()
            except OSError:
                continue
            names = [word.rsplit("/", 1)[-1] for word in words if word[:1] not in ("", "-")]
            name = next((name[:60] for name in names if not name.startswith("python")), short)
            if name not in self.restless_names:
                self.restless_names.append(name)


def _signal(pid: int, number: int) -> None:
    try:
        os.kill(pid, number)
    except OSError:
        pass


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

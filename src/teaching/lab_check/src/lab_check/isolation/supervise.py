"""Programs of a submission, watched: what they say is bounded, and so is what they take."""

from __future__ import annotations

import ctypes
import os
import resource
import signal
import subprocess
import threading
import time
from collections.abc import Callable, Sequence

from . import control_group, sockets

_HEAD, _TAIL = 400_000, 200_000  # bytes of output that are kept
_MOST_FILES = 4096  # that are open, of one process
_LOOK = 0.1  # s between two looks at memory and processes
Streams = tuple[int, int, int]  # descriptors of standard input, output and error
STRETCH = 10.0  # wall time, in limits of time, after which a submission is ended even on the busiest machine


class Output:
    """The beginning and the end of what was said, and how much it was."""

    def __init__(self) -> None:
        self.total = 0
        self._head, self._tail = bytearray(), bytearray()
        self._lock = threading.Lock()

    def add(self, data: bytes) -> None:
        """Take ``data``, which was said after what is there."""
        with self._lock:
            self.total += len(data)
            room = _HEAD - len(self._head)
            self._head += data[: max(room, 0)]
            self._tail += data[max(room, 0) :]
            if len(self._tail) > 2 * _TAIL:
                del self._tail[:-_TAIL]

    def text(self, since: int = 0) -> str:
        """:param since: how many bytes had been said before what is wanted."""
        with self._lock:
            begin = self.total - len(self._tail)  # of the tail
            left_out = begin - max(len(self._head), since)
            gap = f"\n... {left_out} bytes left out ...\n".encode() if left_out > 0 else b""
            return (bytes(self._head[since:]) + gap + bytes(self._tail[max(since - begin, 0) :])).decode("utf-8", "replace")


class Program:
    """A process with all that it starts, its output kept.

    :param limits: of the spec, in bytes and numbers: memory, processes, log
    :param place: the control group that it enters, see :mod:`lab_check.isolation.control_group`
    :param user: that it becomes, also its group; 0: as who starts it
    :param streams: its standard streams; by default what it says is kept, and what is written to it are its keys
    """

    def __init__(
        self,
        words: list[str],
        limits: dict[str, float],
        environment: dict[str, str] | None = None,
        cwd: str | None = None,
        place: str = "",
        user: int = 0,
        streams: Streams | None = None,
        pass_fds: Sequence[int] = (),
    ):
        self.output = Output()
        self.broke = ""  # the limit that it broke, in words
        self.words = words
        self._limits = limits
        self._place, self._user = place, user
        into, out, error = streams or (subprocess.PIPE, subprocess.PIPE, subprocess.STDOUT)
        self.process = subprocess.Popen(
            words,
            env=environment,
            cwd=cwd,
            stdin=into,
            stdout=out,
            stderr=error,
            start_new_session=True,
            preexec_fn=self._bound,
            pass_fds=pass_fds,
        )
        self._reader = threading.Thread(target=self._read if streams is None else lambda: None, daemon=True)
        self._reader.start()

    def _bound(self) -> None:
        control_group.enter(self._place)
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        for what, most in (
            (resource.RLIMIT_CORE, 0),
            (resource.RLIMIT_FSIZE, int(self._limits.get("disk", 1e9))),
            (resource.RLIMIT_NOFILE, _MOST_FILES),
        ):
            hard = resource.getrlimit(what)[1]
            most = most if hard == resource.RLIM_INFINITY else min(most, hard)
            resource.setrlimit(what, (most, most))
        if self._user:
            os.setgroups([])
            os.setresgid(self._user, self._user, self._user)
            os.setresuid(self._user, self._user, self._user)

    def _read(self) -> None:
        if self.process.stdout is None:
            return
        said = self.process.stdout.fileno()
        while True:
            try:
                data = os.read(said, 65536)
            except (OSError, ValueError):
                return
            if not data:
                return
            self.output.add(data)
            if self.output.total > self._limits.get("log", 5e7) and not self.broke:
                self.breaks(f"it printed more than {self._limits['log'] / 1e6:.0f} MB")

    def breaks(self, what: str) -> None:
        """End it for breaking a limit; ``what``: how, a sentence."""
        self.broke = self.broke or what
        self.kill()

    @property
    def running(self) -> bool:
        return self.process.poll() is None

    @property
    def code(self) -> int | None:
        return self.process.poll()

    def write(self, text: str) -> None:
        """``text`` to its standard input, as keys."""
        if self.process.stdin is None:
            return
        try:
            self.process.stdin.write(text.encode())
            self.process.stdin.flush()
        except (BrokenPipeError, ValueError):
            pass

    def wait(self, seconds: float, meanwhile: Callable[[], None] = lambda: None) -> bool:
        """True when it ended by itself within ``seconds`` (wall); otherwise it has been killed. ``meanwhile`` is called again and again."""
        end = time.monotonic() + seconds
        while self.running and time.monotonic() < end:
            meanwhile()
            time.sleep(0.02)
        ended = not self.running
        if not ended:
            self.breaks(f"it did not end within {seconds:g} s")
        self._reader.join(2.0)
        return ended

    def interrupt(self) -> None:
        """Ctrl-C for the program inside; bwrap itself would not pass it on."""
        for pid in descendants(self.process.pid):
            try:
                if os.readlink(f"/proc/{pid}/exe").endswith("/bwrap"):
                    continue
                os.kill(pid, signal.SIGINT)
            except OSError:
                continue

    def kill(self) -> None:
        """At once, with everything in its namespace."""
        pids = descendants(self.process.pid)
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except (ProcessLookupError, PermissionError):
            pass
        for pid in pids:
            try:
                os.kill(pid, signal.SIGKILL)
            except OSError:
                continue


_LIBC = ctypes.CDLL(None)
_TICKS = os.sysconf("SC_CLK_TCK")  # of processor time a second
_PR_SET_PDEATHSIG = 1


def die_with_parent() -> None:
    """For a ``preexec_fn``: whoever kills the driver ends its examinations, too."""
    _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


def bound(memory: float) -> None:
    """This process, which answers to nodes of a submission, takes no more than ``memory`` bytes for them, and keeps no more connections
    than one of their programs can.
    """
    for what, most in ((resource.RLIMIT_DATA, int(memory)), (resource.RLIMIT_NOFILE, _MOST_FILES)):
        soft, hard = resource.getrlimit(what)
        resource.setrlimit(what, (most if soft == resource.RLIM_INFINITY else min(most, soft), hard))


def _parents() -> dict[int, int]:
    found = {}
    for name in os.listdir("/proc"):
        if name.isdigit():
            try:
                with open(f"/proc/{name}/stat", "rb") as file:
                    found[int(name)] = int(file.read().rpartition(b")")[2].split()[1])
            except (OSError, IndexError, ValueError):
                continue
    return found


def descendants(*pids: int) -> list[int]:
    """``pids`` and all that they started and that still has a parent there."""
    children: dict[int, list[int]] = {}
    for child, parent in _parents().items():
        children.setdefault(parent, []).append(child)
    found, waiting = [], list(pids)
    while waiting:
        found.append(waiting.pop())
        waiting += children.get(found[-1], [])
    return found


class Guard(threading.Thread):
    """Looks at memory, processes and time of all programs together, and ends them when a limit is broken.

    Memory is what lies in RAM for them alone: as their control group counts it, or, where there is none, as :class:`Held` does. Time that
    they spend waiting for a processor does not count, up to ``STRETCH`` times the limit: a busy machine gives the same marks.

    :param place: the control group, see :mod:`lab_check.isolation.control_group`
    :param written: bytes that they have on their disk, which the kernel counts as memory, too
    :param own_network: nobody else's sockets are in this network
    """

    def __init__(
        self,
        programs: Callable[[], list[Program]],
        limits: dict[str, float],
        place: str = "",
        written: Callable[[], float] = lambda: 0.0,
        own_network: bool = False,
    ):
        super().__init__(daemon=True)
        self._programs, self._limits, self._place, self._written = programs, limits, place, written
        self._held, self._ended_before = Held(own_network), control_group.ended_for_memory(place)
        self._over = threading.Event()
        self.broke = ""
        self.peak_memory = 0.0
        self.peak_processes = 0
        self.spent = 0.0  # s as on a machine of its own
        self._used: dict[int, float] = {}

    def run(self) -> None:
        begin = last = time.monotonic()
        while not self._over.wait(_LOOK):
            programs = [p for p in self._programs() if p.running]
            pids = descendants(*(program.process.pid for program in programs))
            now = time.monotonic()
            self.spent = max(self.spent + self._worth(pids, now - last), (now - begin) / STRETCH)
            last = now
            memory = self._memory(pids)
            self.peak_memory = max(self.peak_memory, memory)
            self.peak_processes = max(self.peak_processes, len(pids))
            broke = self._broken(memory, len(pids))
            if broke:
                self.broke = self.broke or broke
                for program in programs:
                    program.breaks(broke)
        if self._ended_for_memory():  # since the last look
            self.broke = self.broke or self._too_much()
            for program in self._programs():
                if program.code in (-signal.SIGKILL, 128 + signal.SIGKILL):
                    program.broke = program.broke or self.broke

    def _ended_for_memory(self) -> bool:
        return control_group.ended_for_memory(self._place) > self._ended_before

    def _too_much(self) -> str:
        return f"it took more than {self._limits['memory'] / 1e9:g} GB of memory"

    def _memory(self, pids: list[int]) -> float:
        counted = control_group.memory(self._place) if self._place else None
        return self._held.bytes(pids) if counted is None else max(counted - self._written(), 0.0)

    def _broken(self, memory: float, processes: int) -> str:
        if processes > self._limits["processes"]:
            return f"it started more than {self._limits['processes']:g} processes"
        if memory > self._limits["memory"] or self._ended_for_memory():
            return self._too_much()
        return f"it was not done after {self._limits['time']:g} s" if self.spent > self._limits["time"] else ""

    def _worth(self, pids: list[int], wall: float) -> float:
        """What ``wall`` s would have been on a machine of their own: processor time, where they wanted a processor."""
        uses = {pid: processor_time(pid) for pid in pids}
        took = sum(max(seconds - self._used.get(pid, 0.0), 0.0) for pid, (seconds, _) in uses.items())
        self._used = {pid: seconds for pid, (seconds, _) in uses.items()}
        return min(wall, took) if any(waits for _, waits in uses.values()) else wall

    def stop(self) -> None:
        self._over.set()
        if self.is_alive():
            self.join(5.0)


def processor_time(pid: int) -> tuple[float, bool]:
    """(s of processor time so far, whether it wants a processor now) of the process ``pid``."""
    try:
        with open(f"/proc/{pid}/stat", "rb") as file:
            fields = file.read().rpartition(b")")[2].split()
        return (int(fields[11]) + int(fields[12])) / _TICKS, fields[0] == b"R"
    except (OSError, IndexError, ValueError):
        return 0.0, False


class Held:
    """What processes hold in RAM, counted from outside, where the kernel does not: their own pages at each look; pages that they share,
    files in memory and buffers of sockets, which take longer to count, once a second, and at once when the machine has more such pages."""

    _EVERY, _GROWN = 1.0, 50e6  # s, bytes

    def __init__(self, own_network: bool):
        self._own_network = own_network
        self._due, self._known, self._machine = 0.0, 0.0, 0.0

    def bytes(self, pids: list[int]) -> float:
        """What the processes ``pids`` hold in RAM."""
        now, machine = time.monotonic(), _shared_of_machine()
        if now >= self._due or machine - self._machine > self._GROWN:
            self._known = _shared(pids) + (sockets.queued() if self._own_network else 0.0)
            self._due, self._machine = now + self._EVERY, machine
        return self._known + sum(map(_resident, pids))


def _shared_of_machine() -> float:
    try:
        with open("/proc/meminfo", "rb") as file:
            return next(float(line.split()[1]) * 1024 for line in file if line.startswith(b"Shmem:"))
    except (OSError, StopIteration, IndexError, ValueError):
        return 0.0


def _shared(pids: list[int]) -> float:
    """Bytes of shared memory: what is mapped, and files that are in memory alone, mapped or not."""
    files: dict[tuple[int, int], float] = {}
    mapped = 0.0
    for pid in pids:
        mine: dict[tuple[int, int], float] = {}
        try:
            with open(f"/proc/{pid}/status", "rb") as status:
                rss = next((float(line.split()[1]) * 1024 for line in status if line.startswith(b"RssShmem:")), 0.0)
            for name in os.listdir(f"/proc/{pid}/fd"):
                path = f"/proc/{pid}/fd/{name}"
                if os.readlink(path).startswith("/memfd:"):
                    information = os.stat(path)
                    mine[information.st_dev, information.st_ino] = information.st_blocks * 512.0
        except OSError:  # it ended
            continue
        mapped += max(rss - sum(mine.values()), 0.0)
        files.update(mine)
    return mapped + sum(files.values())


def _resident(pid: int) -> float:
    """Bytes without shared pages: statm is cheap, and Python's shared libraries would count in each process."""
    try:
        with open(f"/proc/{pid}/statm", "rb") as file:
            fields = file.read().split()
        return (int(fields[1]) - int(fields[2])) * 4096.0
    except (OSError, IndexError, ValueError):
        return 0.0

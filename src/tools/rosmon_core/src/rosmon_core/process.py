"""One node: starting it on pseudo-terminals, reading what it says, stopping its whole process group."""

from __future__ import annotations

import asyncio
import enum
import os
import resource
import select
import shlex
import signal
import subprocess
import sys
import tty
from collections.abc import Callable
from dataclasses import dataclass

import rospkg
from node_signals.interpreter import as_it_can_run
from node_signals.terminals import with_what_is_there
from roslaunch.core import RLException, setup_env
from roslaunch.node_args import NodeParamsException, create_local_process_args

from rosmon_core.launch_file import NodeSpec

CONSOLE_FORMAT = "[${function}]: ${message}"
#: The function is the class and method in C++, and a bare name (``_call``, ``<module>``) in Python.
CONSOLE_FORMAT_OF_SCRIPTS = "${message}"
_RESPAWN_DELAY = 1.0  # s, at least: a node that dies at once must not be started a thousand times a second
_LONGEST_LINE = 1 << 16


class State(enum.IntEnum):
    """As in rosmon_msgs/NodeState."""

    IDLE = 0
    RUNNING = 1
    CRASHED = 2
    WAITING = 3


@dataclass
class _Stream:
    """What has been read of an unfinished line."""

    is_stderr: bool
    rest: bytes = b""


class NodeProcess:
    """A node and the process that runs it, if one does.

    All methods belong into the thread of the asyncio loop.

    :param emit: called with (process, line, is_stderr) for each line the node prints.
    :param event: called with (process, line, severity) for what happens to it; severity info, warn or error.
    :param on_exit: called with (process, exit code) after the process has ended.
    """

    def __init__(self, spec: NodeSpec, master_uri: str, log_dir: str | None, emit: Callable, event: Callable, on_exit: Callable) -> None:
        self.spec = spec
        self.state = State.IDLE
        self.muted = False
        self.restart_count = 0
        self.pid: int | None = None
        self.last_pid: int | None = None
        self._master_uri, self._log_dir = master_uri, log_dir
        self._emit, self._event, self._on_exit = emit, event, on_exit
        self._loop = asyncio.get_running_loop()
        self._process: subprocess.Popen | None = None
        self._readers: dict[int, _Stream] = {}
        self._timer: asyncio.TimerHandle | None = None
        self._wanted = False
        self._first = True
        self._restarting = False
        self._left_behind: list[int] = []
        self.executable = ""

    @property
    def name(self) -> str:
        return self.spec.node.name

    @property
    def namespace(self) -> str:
        return self.spec.node.namespace

    @property
    def running(self) -> bool:
        return self._process is not None

    def start(self) -> None:
        """Start the node, the first time after its spawn delay; nothing if it runs already."""
        self._start_after(self.spec.spawn_delay if self._first else 0.0)
        self._first = False

    def _start_after(self, delay: float) -> None:
        self._cancel_timer()
        self._wanted = True
        if self.running:
            return
        if delay > 0.0:
            self.state = State.WAITING
            self._timer = self._loop.call_later(delay, self._start_after, 0.0)
            return
        try:
            self._spawn()
        except (OSError, RLException, NodeParamsException, rospkg.ResourceNotFound, ValueError) as error:
            self._wanted = False
            self.state = State.CRASHED
            self._event(self, f"cannot be started: {' '.join(str(error).split())}", "error")
            self._on_exit(self, 127)

    def stop(self) -> None:
        """Ask the process group to end; kill it when ``stop_timeout`` has passed."""
        self._cancel_timer()
        self._wanted = self._restarting = False
        self._interrupt()

    def restart(self) -> None:
        """Stop, and start again when it has ended."""
        if not self.running:
            self.start()
            return
        self._cancel_timer()
        self._wanted = False
        self._restarting = True
        self._interrupt()

    def kill(self) -> None:
        """End the process group now, and what earlier groups left behind."""
        self._wanted = self._restarting = False
        self._cancel_timer()
        if self.pid:
            _signal_group(self.pid, signal.SIGKILL)
        self._kill_left_behind()

    def command(self) -> list[str]:
        """Arguments of the process. :raises NodeParamsException: no such executable."""
        arguments = create_local_process_args(self.spec.node, None)
        if self._log_dir:
            file_name = self.spec.full_name.strip("/").replace("/", "-")
            arguments.append(f"__log:={os.path.join(self._log_dir, file_name)}.log")
        return arguments

    def _interrupt(self) -> None:
        if self.pid is None:
            if self.state == State.WAITING:
                self.state = State.IDLE
            self._kill_left_behind()
            return
        _signal_group(self.pid, signal.SIGINT)
        self._timer = self._loop.call_later(self.spec.stop_timeout, self._give_up)

    def _give_up(self) -> None:
        self._event(self, f"does not stop within {self.spec.stop_timeout:g} s of SIGINT: killed", "warn")
        if self.pid is not None:
            _signal_group(self.pid, signal.SIGKILL)

    def _kill_left_behind(self) -> None:
        for group in self._left_behind:
            _signal_group(group, signal.SIGKILL)
        self._left_behind = []

    def _spawn(self) -> None:
        node = self.spec.node
        arguments = self.command()
        at = len(shlex.split(node.launch_prefix or ""))
        self.executable = arguments[at]
        program, difference = as_it_can_run(self.executable)
        if difference:
            self._event(self, difference, "warn")
        arguments[at : at + 1] = program
        arguments, difference = with_what_is_there(arguments)
        if difference:
            self._event(self, difference, "warn")
        if (node.package, node.type) == ("rviz", "rviz"):
            arguments = [sys.executable, "-m", "node_signals.rviz_start", *arguments]
        environment = setup_env(node, None, self._master_uri)
        environment.setdefault("ROSCONSOLE_FORMAT", console_format(self.executable))
        directory = {"node": os.path.dirname(self.executable), "ROS_HOME": rospkg.get_ros_home()}.get(node.cwd or "")
        terminals = [os.openpty(), os.openpty()]
        try:
            for _, slave in terminals:
                tty.setraw(slave)
            self._process = subprocess.Popen(
                arguments,
                env=environment,
                cwd=directory,
                stdin=terminals[0][1],
                stdout=terminals[0][1],
                stderr=terminals[1][1],
                start_new_session=True,
                preexec_fn=_allow_core if self.spec.coredumps else None,
            )
        except BaseException:
            for master, _ in terminals:
                os.close(master)
            raise
        finally:
            for _, slave in terminals:
                os.close(slave)
        self.pid = self.last_pid = self._process.pid
        self.state = State.RUNNING
        for (master, _), is_stderr in zip(terminals, (False, True)):
            os.set_blocking(master, False)
            self._readers[master] = _Stream(is_stderr)
            self._loop.add_reader(master, self._read, master)
        self._watch = os.pidfd_open(self.pid)
        self._loop.add_reader(self._watch, self._ended)

    def _read(self, master: int) -> None:
        stream = self._readers[master]
        try:
            data = os.read(master, 65536)
        except BlockingIOError:
            return
        except OSError:  # all of its processes have closed the terminal
            data = b""
        *lines, stream.rest = (stream.rest + data).split(b"\n")
        if stream.rest and (not data or len(stream.rest) > _LONGEST_LINE):
            lines.append(stream.rest)
            stream.rest = b""
        for line in lines:
            self._emit(self, line.decode(errors="replace").rstrip("\r"), stream.is_stderr)
        if not data:
            self._loop.remove_reader(master)
            os.close(master)
            del self._readers[master]

    def _ended(self) -> None:
        process, group = self._process, self.pid
        assert process is not None and group is not None  # what runs has ended
        code = process.wait()
        self._loop.remove_reader(self._watch)
        os.close(self._watch)
        self._cancel_timer()
        for master in list(self._readers):  # its last words
            while master in self._readers and select.select([master], [], [], 0)[0]:
                self._read(master)
        self.pid = self._process = None
        if _signal_group(group, 0):
            self._left_behind.append(group)
        self._after(code)
        self._on_exit(self, code)

    def _after(self, code: int) -> None:
        if self._restarting:
            self._restarting = False
            self.state = State.IDLE
            self._kill_left_behind()
            self.restart_count += 1
            self.start()
            return
        if not self._wanted:
            self.state = State.IDLE
            self._kill_left_behind()
            self._event(self, "stopped", "info")
            return
        self.state = State.IDLE if code == 0 else State.CRASHED
        self._event(self, *_describe(code))
        if code < 0 and self.spec.coredumps:
            self._event(self, f"if it left a core file, press its letter and d to look at it, or type: gdb {self.executable} core", "info")
        if self.spec.node.respawn:
            self.restart_count += 1
            delay = max(_RESPAWN_DELAY, self.spec.node.respawn_delay)
            self._event(self, f"is started again in {delay:g} s (respawn)", "info")
            self._start_after(delay)
        else:
            self._wanted = False

    def _cancel_timer(self) -> None:
        if self._timer:
            self._timer.cancel()
            self._timer = None


def console_format(executable: str) -> str:
    """The ROSCONSOLE_FORMAT of a program where the user has chosen none."""
    try:
        with open(executable, "rb") as file:
            first = file.read(128).split(b"\n")[0]
    except OSError:
        return CONSOLE_FORMAT
    return CONSOLE_FORMAT_OF_SCRIPTS if first.startswith(b"#!") and b"python" in first else CONSOLE_FORMAT


def _describe(code: int) -> tuple[str, str]:
    if code == 0:
        return "exited with status 0", "info"
    if code > 0:
        return f"exited with status {code}", "error"
    return f"died from signal {-code} ({signal.Signals(-code).name})", "error"


def _allow_core() -> None:
    _, hard = resource.getrlimit(resource.RLIMIT_CORE)
    resource.setrlimit(resource.RLIMIT_CORE, (hard, hard))


def _signal_group(group: int, number: int) -> bool:
    """Send a signal to a process group; False if there is none any more."""
    try:
        os.killpg(group, number)
    except (ProcessLookupError, PermissionError):
        return False
    return True

"""All nodes of a launch: start, stop, filters, loads, and the end."""

from __future__ import annotations

import asyncio
import re
from collections.abc import Callable
from dataclasses import dataclass

import psutil

from rosmon_core import severity
from rosmon_core.launch_file import LaunchFile
from rosmon_core.logs import Log
from rosmon_core.process import NodeProcess, State

OWN_LABEL = "rosmon"
_LAST_WORDS = 0.5  # s after SIGKILL in which a process group must be gone


@dataclass
class Usage:
    """Load of one node and everything it started: cores in user and kernel mode, bytes of resident memory."""

    user_load: float = 0.0
    system_load: float = 0.0
    memory: int = 0


class Monitor:
    """Runs the nodes of ``launch_file``. Everything happens in the asyncio loop's thread.

    :param show: called with (label, text, severity, node index or None) for each visible line.
    """

    def __init__(
        self, launch_file: LaunchFile, master_uri: str, log_dir: str | None, log: Log, show: Callable[[str, str, str, int | None], None]
    ) -> None:
        self.warnings_only = False
        self.failed = False
        self.done = asyncio.Event()
        self.changed: list[Callable[[], None]] = []
        self._show, self._log = show, log
        self._closing = False
        self._times: dict[int, tuple] = {}
        self._sampled: float | None = None
        self.usage: dict[NodeProcess, Usage] = {}
        self.nodes = [NodeProcess(spec, master_uri, log_dir, self._on_line, self._on_event, self._on_exit) for spec in launch_file.nodes]

    @property
    def closing(self) -> bool:
        return self._closing

    @staticmethod
    def label(node: NodeProcess) -> str:
        return node.spec.full_name.lstrip("/")

    def say(self, text: str, level: str = "info") -> None:
        """``text``, a line of rosmon itself, of ``level`` debug, info, warn or error."""
        self._log.write(OWN_LABEL, text, level)
        self._show(OWN_LABEL, text, level, None)

    def start_all(self) -> None:
        for node in self.nodes:
            node.start()
        self._tell()

    def stop_all(self) -> None:
        for node in self.nodes:
            node.stop()
        self._tell()

    def mute_all(self, muted: bool) -> None:
        for node in self.nodes:
            node.muted = muted
        self._tell()

    def matching(self, name: str, namespace: str) -> list[NodeProcess]:
        """Nodes whose full name matches the regular expression ``/namespace/name`` as a whole.

        :raises re.error: no regular expression.
        """
        pattern = re.compile(re.sub("/+", "/", f"/{namespace}/{name}"))
        return [node for node in self.nodes if pattern.fullmatch(node.spec.full_name)]

    def act(self, node: NodeProcess, action: str) -> None:
        """Do ``action`` with ``node``: ``start``, ``stop``, ``restart``, ``mute`` or ``unmute``."""
        if action in ("mute", "unmute"):
            node.muted = action == "mute"
        else:
            getattr(node, action)()
        self._tell()

    def shutdown(self) -> None:
        """Stop everything and set ``done``; asked a second time, kill at once."""
        if self._closing:
            for node in self.nodes:
                node.kill()
            return
        self._closing = True
        self.stop_all()
        self._check_done()

    async def wait(self) -> None:
        """Until everything has ended after :meth:`shutdown`; nothing is left running."""
        await self.done.wait()
        for node in self.nodes:
            node.kill()

    def sample(self) -> None:
        """Measure the load of all nodes since the last call."""
        now = asyncio.get_running_loop().time()
        elapsed = now - self._sampled if self._sampled is not None else 0.0
        self._sampled = now
        self.usage = {node: Usage() for node in self.nodes}
        times: dict[int, tuple] = {}
        for node, usage in self.usage.items():
            for process in _family(node.pid):
                try:
                    cpu, memory = process.cpu_times(), process.memory_info().rss
                except psutil.Error:
                    continue  # it ended in this moment
                times[process.pid] = (cpu.user, cpu.system)
                usage.memory += memory
                if elapsed > 0.0:
                    before = self._times.get(process.pid, (cpu.user, cpu.system))
                    usage.user_load += (cpu.user - before[0]) / elapsed
                    usage.system_load += (cpu.system - before[1]) / elapsed
        self._times = times

    def _on_line(self, node: NodeProcess, text: str, is_stderr: bool) -> None:
        level = severity.of_line(text, is_stderr)
        self._log.write(self.label(node), text, level)
        if node.muted or (not is_stderr and not node.spec.show_stdout):
            return
        if self.warnings_only and level in ("debug", "info"):
            return
        self._show(self.label(node), text, level if is_stderr else "info", self.nodes.index(node))

    def _on_event(self, node: NodeProcess, text: str, level: str) -> None:
        self._log.write(self.label(node), text, level)
        self._show(self.label(node), text, level, self.nodes.index(node))
        self._tell()

    def _on_exit(self, node: NodeProcess, code: int) -> None:
        if node.spec.node.required and not self._closing and not node.running and node.state != State.WAITING:
            self.failed = self.failed or node.state == State.CRASHED
            self.say(f"required node '{self.label(node)}' has ended: stopping everything", "error" if code else "info")
            self.shutdown()
        self._tell()
        self._check_done()

    def _check_done(self) -> None:
        if self._closing and not any(node.running for node in self.nodes):
            self.done.set()

    def _tell(self) -> None:
        for callback in self.changed:
            callback()


def _family(pid: int | None) -> list[psutil.Process]:
    """A process and all that it started; nothing for None."""
    try:
        root = psutil.Process(pid) if pid else None
        return [root, *root.children(recursive=True)] if root else []
    except psutil.Error:
        return []

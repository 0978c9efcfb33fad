"""``mon launch``: from the command line to the end of the last node."""

from __future__ import annotations

import asyncio
import signal
import sys
import time

from rosmon_core import RosmonError, cli, master
from rosmon_core.launch_file import LaunchFile, list_arguments, load
from rosmon_core.logs import Log
from rosmon_core.monitor import OWN_LABEL, Monitor
from rosmon_core.plain import Plain
from rosmon_core.terminal import Terminal

_LOG_FLUSH = 1.0  # s


class _Session:
    """One run of one launch file."""

    def __init__(self, options: cli.Options, launch_file: LaunchFile, log: Log) -> None:
        self._options, self._file, self._log = options, launch_file, log
        self._interactive = not options.disable_ui and sys.stdin.isatty() and sys.stdout.isatty()
        labels = [OWN_LABEL, *(spec.full_name.lstrip("/") for spec in launch_file.nodes)]
        self._display: Terminal | Plain = (
            Terminal(labels, launch_file.attributes.get("rosmon-window-title"))
            if self._interactive
            else Plain(labels, options.flush_stdout)
        )
        self._monitor: Monitor | None = None
        self._stopping = asyncio.Event()

    async def run(self) -> int:
        """Returns the exit code."""
        loop = asyncio.get_running_loop()
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            loop.add_signal_handler(number, self._stop)
        housekeeping = asyncio.ensure_future(self._flush())
        try:
            return await self._run()
        finally:
            housekeeping.cancel()
            self._display.flush()

    def _stop(self) -> None:
        self._stopping.set()
        if self._monitor:
            self._monitor.shutdown()

    async def _flush(self) -> None:
        while True:
            self._log.flush()
            if self._monitor is None or not self._interactive:
                self._display.flush()
            await asyncio.sleep(0.1 if self._monitor is None else _LOG_FLUSH)

    def _say(self, text: str, level: str = "info") -> None:
        self._log.write(OWN_LABEL, text, level)
        self._display.show(OWN_LABEL, text, level, None)

    async def _run(self) -> int:
        uri = master.master_uri()
        waiting = asyncio.ensure_future(master.wait(uri, self._say))
        stopping = asyncio.ensure_future(self._stopping.wait())
        await asyncio.wait((waiting, stopping), return_when=asyncio.FIRST_COMPLETED)
        stopping.cancel()
        if not waiting.done():
            waiting.cancel()
            self._say("given up waiting for a roscore", "warn")
            return 1
        loop = asyncio.get_running_loop()
        await loop.run_in_executor(None, master.set_parameters, uri, self._file)
        if not self._file.nodes:
            self._say(f"{len(self._file.params)} parameters are set; there are no nodes to launch. Exiting.")
            return 0
        return await self._monitor_nodes(uri, master.log_directory(waiting.result()))

    async def _monitor_nodes(self, uri: str, log_dir: str | None) -> int:
        loop = asyncio.get_running_loop()
        monitor = self._monitor = Monitor(self._file, uri, log_dir, self._log, self._display.show)
        interface = await loop.run_in_executor(None, self._connect, monitor, loop)
        monitor.say(f"Running as '{interface.name}'")
        publishing = asyncio.ensure_future(interface.run())
        if not self._options.no_start and not self._stopping.is_set():
            monitor.start_all()
        try:
            if isinstance(self._display, Terminal):
                await self._display.run(monitor)
            await monitor.wait()
        finally:
            for node in monitor.nodes:
                node.kill()
            publishing.cancel()
            await loop.run_in_executor(None, interface.shutdown)
        return 1 if monitor.failed else 0

    def _connect(self, monitor: Monitor, loop: asyncio.AbstractEventLoop):
        from rosmon_core.ros_interface import RosInterface

        name = self._options.name or self._file.attributes.get("rosmon-name")
        return RosInterface(monitor, self._options, name, loop)


def _launch(options: cli.Options) -> int:
    started = time.perf_counter()
    launch_file = load(options)
    loaded = f"Loaded launch file in {time.perf_counter() - started:.3f}s"
    if options.benchmark:
        print(loaded)
        return 0
    log = Log(options.log, options.flush_log)
    try:
        print(f"{loaded}; logging to {log.name}", flush=True)
        for problem in launch_file.problems:
            print(f"rosmon: {problem}", file=sys.stderr)
            log.write(OWN_LABEL, problem, "warn")
        return asyncio.run(_start(options, launch_file, log))
    finally:
        log.close()


async def _start(options: cli.Options, launch_file: LaunchFile, log: Log) -> int:
    return await _Session(options, launch_file, log).run()


def main(words: list[str] | None = None) -> int:
    """Run rosmon with the words behind ``mon launch``; returns the exit code."""
    words = sys.argv[1:] if words is None else words
    try:
        options = cli.parse(words)
        if options.help:
            print(cli.HELP, end="")
            return 0
        if options.list_args:
            print("\n".join(list_arguments(options)))
            return 0
        return _launch(options)
    except RosmonError as error:
        print(f"rosmon: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 1

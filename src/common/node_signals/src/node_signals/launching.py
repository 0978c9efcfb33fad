"""``roslaunch`` and ``roscore`` with a Ctrl-C that works at any moment and logs that find a place; everything else is Debian's.

Upstream ends its processes inside the signal's handler. A Ctrl-C that comes while roslaunch starts a process - its lock is
held then - or between fork and exec of a node waits there for 10 to 40 s, one that comes while it starts the master waits for
that master, and one that comes while it looks at the log folder is swallowed. Where nothing can be written to ~/.ros it says
that rosmaster is missing, or fills the terminal with tracebacks of the log.
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import traceback
from pathlib import Path

from node_signals import quick_start

quick_start.prepare()  # before roslaunch is imported
import roslaunch  # noqa: E402
import rospkg  # noqa: E402
from roslaunch import core, launch, node_args, nodeprocess, pmon  # noqa: E402

from node_signals.absent import in_one_line, no_program, of_program
from node_signals.children import end_with_parent
from node_signals.display import asked_for, choose_platform, missing_display
from node_signals.interpreter import as_it_can_run, supply_python
from node_signals.terminals import with_what_is_there

_PID = os.getpid()


def _on_signal(number, frame) -> None:
    """The shutdown runs beside the main thread, which so can finish what it holds a lock for."""
    if os.getpid() != _PID or pmon._shutting_down:  # a fork of this process that is about to become a node
        return
    pmon._shutting_down = True
    threading.Thread(target=pmon.pmon_shutdown, name="shutdown").start()


def _unless_ending(is_running):
    """Nobody waits for a master that Ctrl-C has ended."""

    def checked(master):
        if pmon._shutting_down:
            raise core.RLException("interrupted")
        return is_running(master)

    return checked


class _Clock:
    """Looks for the master it has started a hundred times a second, where upstream's does ten times."""

    time = staticmethod(time.time)

    @staticmethod
    def sleep(seconds: float) -> None:
        time.sleep(min(seconds, 0.01))


def _silent_when_ending(report):
    """What cannot be started any more needs no message."""

    def checked(*arguments):
        if not pmon._shutting_down:
            report(*arguments)

    return checked


class _Traceback:
    """Nor does a connection to a master that Ctrl-C has ended."""

    format_exc = staticmethod(traceback.format_exc)

    @staticmethod
    def print_exc() -> None:
        _silent_when_ending(traceback.print_exc)()


def _master_first_by_sigterm(stop):
    """SIGINT in the first moments of a Python program is a traceback on the terminal; the master has nothing to put in order."""

    def checked(process, errors):
        if process.name == "master" and process.popen.poll() is None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.popen.pid, signal.SIGTERM)
        stop(process, errors)

    return checked


def _alone() -> None:
    os.setsid()
    end_with_parent(signal.SIGKILL)


class _Popen(subprocess.Popen):
    """What roslaunch runs while it reads files (xacro, rosversion) ends with it, without a traceback of its own at Ctrl-C."""

    def __init__(self, *arguments, **options):
        if options.get("preexec_fn") is None:
            options["preexec_fn"] = _alone
        super().__init__(*arguments, **options)


def _trouble_with(folder: str) -> OSError | None:
    """Why no log of a few pages can be kept there."""
    try:
        os.makedirs(folder, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder) as file:
            file.write(bytes(1 << 16))
    except OSError as error:
        return error
    return None


def _find_place_for_logs() -> None:
    """Nodes run in ROS_HOME and log below it; with a home folder that is full or read-only, in a temporary one."""
    for variable, folder_of in (("ROS_HOME", rospkg.get_ros_home), ("ROS_LOG_DIR", rospkg.get_log_dir)):
        folder = folder_of()
        trouble = _trouble_with(folder)
        if trouble is None:
            continue
        try:
            os.environ[variable] = tempfile.mkdtemp(prefix="ros_")
        except OSError:  # roslaunch has words of its own for that
            return
        print(
            f"roslaunch: nothing can be written to {folder} ({trouble.strerror}); {os.environ[variable]} takes its place in this run",
            file=sys.stderr,
        )


def _naming_windows_without_display(start):
    """A window on a machine without a screen ends with a page of Qt's words; one line says what to do."""
    told: set[str] = set()

    def checked(process):
        process.args, difference = with_what_is_there(process.args or [])
        if difference:
            print(f"roslaunch: {process.name}: {difference}", file=sys.stderr, flush=True)
        window = asked_for(["rosrun", str(process.package), os.path.basename(process.args[0])] if process.args else [""])
        problem = missing_display(x11_only=window == "rviz") if window and window not in told else None
        if window and problem:
            told.add(window)
            print(f"roslaunch: {window} opens a window: {problem}", file=sys.stderr, flush=True)
        elif window == "rviz":
            process.args = [sys.executable, "-m", "node_signals.rviz_start", *process.args]
        return start(process)

    return checked


def arguments_of(make_arguments):
    """Upstream's line for a node that is not found, and why; scripts with the interpreter that they can run with."""

    def checked(node, machine, env=None):
        try:
            return _with_interpreter(node, make_arguments(node, machine, env))
        except node_args.NodeParamsException as error:
            why = of_program(node.package, node.type) if "Cannot locate node" in str(error) else ""
            raise node_args.NodeParamsException(f"{error}. {why}" if why else str(error)) from error

    return checked


def _with_interpreter(node, words):
    """The words of a node's process: what is before its program, the program, its arguments."""
    at = len(node_args._launch_prefix_args(node))
    if at and os.path.basename(words[at - 1]).startswith("python"):
        return words
    program, difference = as_it_can_run(words[at])
    if difference:
        print(f"roslaunch: {node.name}: {difference}", file=sys.stderr, flush=True)
    return [*words[:at], *program, *words[at + 1 :]]


def _mend() -> None:
    """Debian's roslaunch, from here on as this module says."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # nothing has been started yet; pmon takes over with its first process
    _find_place_for_logs()
    supply_python(os.environ)
    choose_platform(os.environ)
    subprocess.Popen = _Popen  # type: ignore[misc]
    pmon.rl_signal = _on_signal
    launch.time = _Clock  # nothing else of time is used there
    core.Master.is_running = _unless_ending(core.Master.is_running)
    nodeprocess.LocalProcess._stop_unix = _master_first_by_sigterm(nodeprocess.LocalProcess._stop_unix)
    nodeprocess.LocalProcess.start = _naming_windows_without_display(nodeprocess.LocalProcess.start)
    nodeprocess.create_local_process_args = arguments_of(nodeprocess.create_local_process_args)
    rospkg.ResourceNotFound.__str__ = in_one_line
    roslaunch.handle_exception = _silent_when_ending(roslaunch.handle_exception)
    roslaunch.traceback = _Traceback


def _refuse_programs(words) -> None:
    """What roslaunch would read as XML and is none."""
    files = [word for word in words if not word.startswith("-") and ":=" not in word]
    if files and files[-1].endswith((".py", ".sh")):
        package = files[0] if len(files) == 2 else "PACKAGE"
        of_ros_2 = no_program(Path(files[-1]), package)
        program = f"Programs are started by: rosrun {package} {os.path.basename(files[-1])}"
        sys.exit(f"roslaunch: {files[-1]} is no launch file. {of_ros_2 or program}")


def main() -> None:
    _refuse_programs(sys.argv[1:])
    _mend()
    roslaunch.main()


def roscore() -> None:
    _mend()
    quick_start.become(sys.argv[0])

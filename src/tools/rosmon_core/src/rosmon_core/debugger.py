"""gdb in a terminal of its own, on a running node or on the core file of one that has crashed."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess

from rosmon_core.process import NodeProcess


def debug(node: NodeProcess) -> str:
    """Open gdb for ``node``; returns the line that says so, or what is missing."""
    terminal = shlex.split(os.environ.get("ROSMON_DEBUGGER_TERMINAL", "xterm -e"))
    if node.pid:
        command = ["gdb", "-p", str(node.pid)]
    else:
        core = next((name for name in (f"core.{node.last_pid}", "core") if os.path.exists(name)), None)
        if core is None:
            return f"'{node.name}' is not running and has left no core file in {os.getcwd()}: there is nothing to debug"
        command = ["gdb", node.executable, core]
    missing = next((program for program in (terminal[0], "gdb") if shutil.which(program) is None), None)
    if missing:
        return (
            f"cannot open a debugger: {missing} is not installed (ROSMON_DEBUGGER_TERMINAL names the terminal); "
            f"by hand: {shlex.join(command)}"
        )
    subprocess.Popen([*terminal, *command], start_new_session=True, stdin=subprocess.DEVNULL)
    return f"debugging '{node.name}': {shlex.join(command)}"

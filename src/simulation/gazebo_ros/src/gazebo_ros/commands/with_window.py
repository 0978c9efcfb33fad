"""The command ``gazebo``: a window beside the server, which ends with it - and it with the window."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading

from node_signals.children import end_with_parent

_QUIET = ("-h", "--help", "-v", "--version")


def open_window(arguments: list[str]) -> None:
    """Start gzclient; once it ends, however, this process is told to end as by Ctrl-C.

    Main thread only: the window ends with the thread that starts it.

    :param arguments: of this command, with its own name first
    """
    if any(option in arguments for option in _QUIET):
        return
    script = os.path.join(os.path.dirname(os.path.abspath(arguments[0])), "gzclient")
    verbose = ["--verbose"] if "--verbose" in arguments else []
    window = subprocess.Popen([sys.executable, script, *verbose], stdin=subprocess.DEVNULL, preexec_fn=end_with_parent)

    def end() -> None:
        if window.wait() == 0:  # one that could not be opened leaves the server alone
            os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=end, name="window", daemon=True).start()

"""RViz, started once more when it dies in its first seconds, as it does at a few starts in a hundred with software OpenGL.

``python3 -m node_signals.rviz_start PROGRAM ARGUMENT...`` runs PROGRAM and ends as it ends: with its exit status, or by its signal.
Signals that ask this process to end are handed on.
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import time

from node_signals import rviz_displays
from node_signals.children import end_with_parent

#: s after its start in which a crash is one of starting
FIRST_SECONDS = 20.0
_CRASHES = {signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS, signal.SIGFPE, signal.SIGILL}
_ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class _Run:
    """One run of the program after another, and whether somebody asked for the end."""

    def __init__(self, command: list[str]) -> None:
        self.command, self.asked_to_end = command, False
        for number in _ENDING:
            signal.signal(number, self._hand_on)
        self.child = self._start()

    def _start(self) -> subprocess.Popen:
        self.began = time.monotonic()
        return subprocess.Popen(self.command, preexec_fn=end_with_parent)

    def _hand_on(self, number, frame) -> None:
        self.asked_to_end = True
        self.child.send_signal(number)

    def status(self) -> int:
        """The exit status, negative for a signal's number, of the first run or, where that died soon, of the second."""
        ended = self.child.wait()
        soon = time.monotonic() - self.began < FIRST_SECONDS
        if ended < 0 and -ended in _CRASHES and soon and not self.asked_to_end:
            print(
                f"rviz: it died by {signal.Signals(-ended).name} in its first seconds, as it does now and then with software OpenGL; "
                "it is started once more",
                file=sys.stderr,
                flush=True,
            )
            self.child = self._start()
            ended = self.child.wait()
        return ended


def run(command: list[str]) -> None:
    """
    Run ``command`` and end this process as it ends.

    :raises OSError: there is no such program
    """
    rviz_displays.start(command)
    ended = _Run(command).status()
    if ended < 0:
        with contextlib.suppress(OSError):  # SIGKILL cannot be handled, and so needs no reset
            signal.signal(-ended, signal.SIG_DFL)
        os.kill(os.getpid(), -ended)
    sys.exit(ended)


if __name__ == "__main__":
    try:
        run(sys.argv[1:])
    except OSError as error:
        sys.exit(f"{sys.argv[1]}: {error.strerror}; scripts/setup installs it")

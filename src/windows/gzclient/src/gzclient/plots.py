"""*Window > Plots and topics*: Lichtblick's page with a bridge of its own, begun when somebody asks for it."""

from __future__ import annotations

import http
import os
import select
import signal
import subprocess
import threading

from ode_sim_viewer.website import LOOPBACK

_COMMAND = ("rosrun", "foxglove_bridge", "lichtblick")
_PATIENCE = 20.0  # s until what was begun has spoken, or ended by itself


class Plots:
    """Answers the link of the page; one program at most, until :meth:`close`."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._process: subprocess.Popen | None = None
        self._address = ""

    def answer(self, host: str) -> tuple[http.HTTPStatus, dict[str, str], str]:
        """Status, headers and text for a browser that has asked ``host`` for it."""
        if host not in LOOPBACK:
            return _line("plots and topics are shown on the simulator's own machine; open this window there, or through ssh -L")
        with self._lock:
            if self._process is None or self._process.poll() is not None:
                failed = self._begin()
                if failed:
                    return _line(failed)
            return http.HTTPStatus.SEE_OTHER, {"Location": self._address}, ""

    def _begin(self) -> str:
        """'' when it runs; else why not."""
        try:
            self._process = subprocess.Popen(_COMMAND, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)
        except OSError as error:
            return f"{' '.join(_COMMAND)}: {error.strerror}"
        assert self._process.stdout is not None and self._process.stderr is not None
        if not select.select([self._process.stdout], [], [], _PATIENCE)[0]:
            self._end()
            return f"{' '.join(_COMMAND)} has said nothing for {_PATIENCE:.0f} s; is there a ROS master?"
        line = self._process.stdout.readline()
        if not line:
            said = self._process.stderr.read().strip().splitlines()
            return said[-1] if said else f"{' '.join(_COMMAND)} ended without a word"
        threading.Thread(target=self._process.stderr.read, daemon=True).start()  # nobody reads it: its pipe must not fill
        self._address = line.split()[-1]
        return ""

    def close(self) -> None:
        with self._lock:
            self._end()

    def _end(self) -> None:
        if self._process is None or self._process.poll() is not None:
            return
        os.killpg(self._process.pid, signal.SIGINT)
        try:
            self._process.wait(_PATIENCE)
        except subprocess.TimeoutExpired:
            os.killpg(self._process.pid, signal.SIGKILL)


def _line(text: str) -> tuple[http.HTTPStatus, dict[str, str], str]:
    return http.HTTPStatus.OK, {"Content-Type": "text/plain; charset=utf-8"}, text + "\n"

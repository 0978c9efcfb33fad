"""A launch file that runs alone, with a ROS master and a display of its own, and a process of ours that looks at it."""

from __future__ import annotations

import contextlib
import json
import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, field

from rviz_offscreen.display import private_display

# what roslaunch prints while it ends, whatever the reason
_FAREWELL = re.compile(r"shutting down|^done$|^log file:|killing on exit|^Initiating|^process has died|^The traceback")
_COLOURS = re.compile(r"\x1b\[[0-9;]*m|\x1b\].*?\x07")


def free_port() -> int:
    with socket.socket() as s:
        s.bind(("localhost", 0))
        return s.getsockname()[1]


@contextlib.contextmanager
def running(words: list[str], environment: dict[str, str], log: str | os.PathLike) -> Iterator[subprocess.Popen]:
    """roslaunch, ``words``, in a process group of its own, which gets Ctrl-C's signal at the end, and SIGKILL if that is in vain.

    :param environment: all of it. :param log: the file that takes what it says
    """
    with open(log, "w") as file:
        process = subprocess.Popen(
            words, env=environment, stdout=file, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, start_new_session=True
        )
        try:
            yield process
        finally:
            for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
                with contextlib.suppress(ProcessLookupError):
                    os.killpg(process.pid, number)
                with contextlib.suppress(subprocess.TimeoutExpired):
                    process.wait(20)
                    break


def lines(log: str) -> list[str]:
    """What roslaunch and its nodes printed so far, without colours and blank lines."""
    with open(log, errors="replace") as file:
        return [line for line in (_COLOURS.sub("", line).strip() for line in file) if line]


def last_words(log: str) -> str:
    """The last line of roslaunch's output that says why, as far as a line can."""
    said = [line.strip("=") for line in lines(log) if line.strip("=") and not _FAREWELL.search(line.strip("="))]
    return said[-1] if said else "nothing was printed"


@dataclass
class Outcome:
    """``answer``: what the looking process found, None when it found nothing; ``notes``: why, one line each."""

    answer: dict | None = None
    notes: list[str] = field(default_factory=list)


def look(module: str, words: list[str], log: str, job: dict, windows: bool = True, variables: dict[str, str] | None = None) -> Outcome:
    """Launch, have ``module`` look, stop.

    :param module: run as ``python3 -m`` with ``job`` as JSON on standard input; answers with a JSON line.
    :param words: files and arguments of roslaunch.
    :param windows: with a display, on which windows may open.
    :param variables: more of the environment.
    :param log: the file that takes what roslaunch says.
    """
    outcome = Outcome()
    port = free_port()
    with private_display() if windows else contextlib.nullcontext({"DISPLAY": ""}) as display, tempfile.TemporaryDirectory() as home:
        # the simulator leaves shadows out where no graphics card draws; a picture in a minute can afford them
        environment = {
            "ODE_SIM_SHADOWS": "on",
            **os.environ,
            **(variables or {}),
            **display,
            "ROS_HOME": home,
            "ROS_MASTER_URI": f"http://localhost:{port}",
            "PYTHONUNBUFFERED": "1",
        }
        with running(["roslaunch", "-p", str(port), *words], environment, log) as process:
            looker = subprocess.Popen(
                [sys.executable, "-m", module],
                env=environment,
                text=True,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
            )
            assert looker.stdin is not None  # a pipe, as asked for
            looker.stdin.write(json.dumps(job))
            looker.stdin.close()
            looker.stdin = None
            while True:
                with contextlib.suppress(subprocess.TimeoutExpired):
                    answer, complaints = looker.communicate(timeout=0.5)
                    break
                if process.poll() is not None:
                    looker.kill()
            if not answer:  # the master went away: roslaunch is ending
                with contextlib.suppress(subprocess.TimeoutExpired):
                    process.wait(10)
            if process.poll() is not None:
                outcome.notes.append(f"roslaunch ended by itself with code {process.returncode}: {last_words(log)}")
            if answer:
                outcome.answer = json.loads(answer)
            elif process.poll() is None:
                outcome.notes.append((complaints.strip() or "no reason given").splitlines()[-1])
    return outcome

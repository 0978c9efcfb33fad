"""Who examines: one interface for processes of this machine (here) and for a cluster (:mod:`lab_check.classroom.cluster`)."""

from __future__ import annotations

import abc
import json
import os
import pathlib
import signal
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..isolation import sandbox
from ..isolation.supervise import descendants, die_with_parent
from ..outcome import Result


@dataclass(frozen=True)
class How:
    """What ``check`` is told, the same for all submissions. ``port``: first to try for the ROS master, with ``unsafe``."""

    unsafe: bool = False
    films: bool = True
    port: int = 0

    def words(self, spec: str | pathlib.Path, submission: str | pathlib.Path, out: str | pathlib.Path, worker: int) -> list[str]:
        """The command that examines ``submission`` by ``spec`` and writes the reports into ``out``.

        :param worker: number of the worker on its machine
        """
        words = [
            *sandbox.isolated(),
            "-c",
            "import sys; from lab_check.cli import check; sys.exit(check())",
            str(spec),
            str(submission),
            "--out",
            str(out),
        ]
        words += ["--unsafe", "--port", str((self.port or 11400) + 20 * worker)] if self.unsafe else []
        return words + ([] if self.films else ["--no-films"])


def examine(words: list[str], out: pathlib.Path) -> subprocess.Popen:
    """Starts one examination by the command ``words``; what it says goes to ``check.txt`` in ``out``. It ends when this thread does."""
    out.mkdir(parents=True, exist_ok=True)
    (out / "report.json").unlink(missing_ok=True)
    with open(out / "check.txt", "w", encoding="utf-8") as log:
        return subprocess.Popen(
            words,
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=log,
            start_new_session=True,
            preexec_fn=die_with_parent,
            env=sandbox.own_environment(),
            cwd="/",
        )


def outcome(out: pathlib.Path, code: int) -> Result | str:
    """The result of an examination that ended with ``code``, or why there is none: one that died leaves no report in ``out``."""
    try:
        result = Result.from_data(json.loads((out / "report.json").read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError, KeyError):
        try:
            said = (out / "check.txt").read_text(encoding="utf-8", errors="replace").strip().splitlines()
        except OSError:
            said = []
        how = f"was killed by signal {-code}" if code < 0 else f"ended with code {code}"
        return f"its worker {how}" + (f": {said[-1]}" if said else "")
    return f"the checker itself failed: {result.fault}" if result.fault else result


class NotBegun(str):
    """Why there is no result, where the examination never began: that was no try."""


class Engine(abc.ABC):
    """``running``: names of what is under way; ``workers``: how many may be."""

    running: dict[str, Any]
    workers: int

    @abc.abstractmethod
    def start(self, name: str, path: pathlib.Path) -> None:
        """Begins the examination of the submission ``name`` at ``path``."""

    @abc.abstractmethod
    def ended(self) -> list[str]:
        """Names of ``running`` that can be taken; does not wait."""

    @abc.abstractmethod
    def take(self, name: str) -> Result | str:
        """The result of ``name``, which has ended, or in one line why there is none."""

    @abc.abstractmethod
    def end(self) -> None:
        """Kills what still runs, with all that it started."""


@dataclass
class Running:
    process: subprocess.Popen
    worker: int


class Pool(Engine):
    """Examinations in processes of this machine.

    :param spec_of: the spec's file for the submission of a name
    """

    def __init__(self, spec_of: Callable[[str], pathlib.Path], out: pathlib.Path, how: How, workers: int):
        self._spec_of, self._out, self._how, self.workers = spec_of, out, how, workers
        self.running: dict[str, Running] = {}

    def start(self, name: str, path: pathlib.Path) -> None:
        free = min(set(range(len(self.running) + 1)) - {r.worker for r in self.running.values()})
        words = self._how.words(self._spec_of(name), path, self._out / name, free)
        self.running[name] = Running(examine(words, self._out / name), free)

    def ended(self) -> list[str]:
        return [name for name, running in self.running.items() if running.process.poll() is not None]

    def take(self, name: str) -> Result | str:
        return outcome(self._out / name, self.running.pop(name).process.returncode)

    def end(self) -> None:
        for running in self.running.values():
            for pid in descendants(running.process.pid):
                try:
                    os.kill(pid, signal.SIGKILL)
                except OSError:
                    continue
            running.process.wait()
        self.running.clear()

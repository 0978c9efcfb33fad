"""An engine in a process of its own. Ray ends the process that uses it where the head or the own node of its cluster is gone, or keeps it
waiting; here that is not the process that holds the class's results."""

from __future__ import annotations

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable
from multiprocessing.connection import Connection, Pipe
from typing import Any

from ..errors import LabError
from ..isolation import sandbox
from ..isolation.supervise import die_with_parent
from ..outcome import Result
from . import cluster_access
from .engines import Engine

_ANSWER = 45.0  # s that a question may take
_WORK = 400.0  # s that it may take where a submission is sent, or its reports come
_FAREWELL = 20.0  # s


class Lost(LabError, RuntimeError):
    """The engine's process is gone, or does not answer; one line with what to do."""


class RemoteEngine(Engine):
    """
    :param make: makes the engine there, of ``arguments`` and a function like ``show``; pickled, as they are
    :param what: it is called in complaints
    :param show: is given each line that the engine shows
    :raises LabError: as ``make`` does
    """

    def __init__(self, make: Callable[..., Engine], arguments: tuple, what: str, show: Callable[[str], None]):
        self.running: dict = {}
        self._what, self._show, self._workers, self._asked = what, show, 1, 0
        self._said = tempfile.TemporaryFile()
        self._wire, far = Pipe()
        words = [*sandbox.isolated(), "-m", "lab_check.classroom.remote_engine", str(far.fileno())]
        self._process = subprocess.Popen(
            words,
            stdin=subprocess.DEVNULL,
            stdout=self._said,
            stderr=self._said,
            pass_fds=[far.fileno()],
            start_new_session=True,
            preexec_fn=die_with_parent,
            cwd="/",
            env=cluster_access.environment(),
        )
        far.close()
        try:
            self._ask((make, arguments), _WORK)
        except BaseException:
            self._kill()
            raise

    @property
    def workers(self) -> int:  # type: ignore[override]
        return self._workers

    def start(self, name: str, path: pathlib.Path) -> None:
        self._ask(("start", name, path), _WORK)
        self.running[name] = path

    def ended(self) -> list[str]:
        return self._ask(("ended",), _ANSWER)

    def take(self, name: str) -> Result | str:
        self.running.pop(name)
        return self._ask(("take", name), _WORK)

    def end(self) -> None:
        try:
            self._ask(("end",), _FAREWELL)
        except LabError:  # it is gone: so is all that it held
            pass
        finally:
            self._kill()
            self._wire.close()
            self.running.clear()

    def _ask(self, question: tuple, patience: float) -> Any:
        """
        :raises Lost: no answer comes
        """
        try:
            self._asked += 1
            self._wire.send((self._asked, question))
            while self._wire.poll(patience):
                number, kind, value, self._workers = self._wire.recv()
                if kind == "line":
                    self._show(value)
                elif number == self._asked and kind == "raised":
                    raise value
                elif number == self._asked:  # an earlier one was interrupted
                    return value
        except (EOFError, ConnectionError):
            self._kill()
            raise Lost(f"{self._what} is gone{self._last_words()}; the same command goes on from here") from None
        raise Lost(f"{self._what} does not answer any more; the same command goes on from here")

    def _last_words(self) -> str:
        self._said.seek(0)
        lines = self._said.read().decode("utf-8", "replace").strip().splitlines()
        return f" ({lines[-1].strip()[:200]})" if lines else ""

    def _kill(self) -> None:
        try:
            os.killpg(self._process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        self._process.wait()


def main() -> None:
    """Answers what the other end asks, until it is gone. Text that libraries print does not get in the way: the wire is its own."""
    wire = Connection(int(sys.argv[1]))

    def show(line: str) -> None:
        wire.send((0, "line", line, 1))

    engine = None
    while True:
        try:
            number, question = wire.recv()
        except EOFError:
            return
        try:
            if engine is None:
                make, arguments = question
                engine, value = make(*arguments, show), None
            else:
                value = getattr(engine, question[0])(*question[1:])
            answer: tuple[Any, ...] = (number, "answer", value, engine.workers)
        except (LabError, OSError) as error:
            answer = (number, "raised", error, 1)
        wire.send(answer)
        if question[0] == "end":
            return


if __name__ == "__main__":
    main()

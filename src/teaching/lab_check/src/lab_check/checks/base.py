"""What every expectation shares."""

from __future__ import annotations

import pathlib
import re
import signal
import threading
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from types import FrameType
from typing import Any

from ..examination.simulated_world import Bench, Sample


@dataclass
class Context:
    """What a check may look at. ``log()`` is what was printed since the task began."""

    spec_folder: pathlib.Path
    # Of the submission; below it, its programs may have put links in the place of anything: see isolation.untrusted_files.
    home: pathlib.Path
    source: pathlib.Path  # its packages
    packages: dict[str, pathlib.Path]
    log: Callable[[], str] = lambda: ""
    running: Bench | None = None  # the simulated world; None where nothing is launched
    actor: Any = None
    model: str = ""
    samples: list[Sample] = field(default_factory=list)
    simulator_seconds: Callable[[], float] = lambda: 0.0  # processor time of the simulator
    required: Sequence[str] = ()  # packages that a submission must hold

    @property
    def bench(self) -> Bench:
        """The simulated world.

        :raises RuntimeError: the task launches nothing
        """
        if self.running is None:
            raise RuntimeError("this task launches nothing: it has no simulated world to look at; give it a launch")
        return self.running


class Check:
    """One expectation: told of each sample, asked at the end.

    ``wanted`` is what the spec says. ``horizon`` is for how many simulated seconds after the commands it wants to watch;
    ``settled`` that more time cannot change the verdict. When all have watched for so long, those go on alone that wait for something
    that is not :meth:`there` yet, until ``patience`` s after the commands; ``in_wall_time``: for no fewer seconds of wall time, as
    programs start in that.
    """

    horizon = 0.0
    settled = False
    patience = 0.0
    in_wall_time = False

    def __init__(self, wanted: Any, context: Context):
        self.wanted, self.context = wanted, context
        self.series: dict[str, list[list[float]]] = {}
        self.doubts: set[str] = set()  # what makes it doubtful what was measured, a sentence each

    def start(self) -> None:
        """Before the commands."""

    def commanded(self) -> None:
        """After the commands."""

    def sample(self, sample: Sample) -> None:
        """Look at ``sample``, after each quantum."""

    def there(self) -> bool:
        """What is waited for has come."""
        return True

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        """(passed, sentence, figures); may be asked again"""
        raise NotImplementedError

    def end(self) -> None:
        """After the verdict."""


_PATIENCE = 5.0  # s that a pattern may be looked for


def search(pattern: str, text: str) -> re.Match | None:
    """``re.search`` of ``pattern`` in ``text`` that gives up: what a submission wrote may be made so that the teacher's pattern goes
    through it for ever. None then, too.
    """
    if threading.current_thread() is not threading.main_thread():
        return re.search(pattern, text)

    def over(number: int, frame: FrameType | None) -> None:
        raise TimeoutError

    before = signal.signal(signal.SIGALRM, over)
    signal.setitimer(signal.ITIMER_REAL, _PATIENCE)
    try:
        return re.search(pattern, text)
    except TimeoutError:
        return None
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


def names(found: Iterable[str], most: int = 8) -> str:
    """The first ``most`` of ``found`` for a message, and how many more there are."""
    found = list(found)
    return ", ".join(found[:most]) + (f" and {len(found) - most} more" if len(found) > most else "") if found else "none"

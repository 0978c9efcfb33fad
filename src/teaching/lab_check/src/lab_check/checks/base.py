"""What every expectation shares."""
from __future__ import annotations

import pathlib
from dataclasses import dataclass, field
from typing import Any, Callable, Dict, List, Optional, Tuple

from ..bench import Bench, Sample


@dataclass
class Context:
    """What a check may look at. ``log()`` is what was printed since the task began."""

    spec_folder: pathlib.Path
    source: pathlib.Path  # the submission's packages
    packages: Dict[str, pathlib.Path]
    log: Callable[[], str] = lambda: ""
    bench: Optional[Bench] = None
    actor: Any = None
    model: str = ""
    samples: List[Sample] = field(default_factory=list)
    simulator_seconds: Callable[[], float] = lambda: 0.0  # processor time of the simulator


class Check:
    """One expectation: told of each sample, asked at the end.

    ``wanted`` is what the spec says. ``horizon`` is for how many simulated seconds after the commands it wants to watch;
    ``settled`` that more time cannot change the verdict.
    """

    horizon = 0.0
    settled = False

    def __init__(self, wanted: Any, context: Context):
        self.wanted, self.context = wanted, context
        self.series: Dict[str, List[List[float]]] = {}

    def start(self) -> None:
        """Before the commands."""

    def commanded(self) -> None:
        """After the commands."""

    def sample(self, sample: Sample) -> None:
        """After each quantum."""

    def verdict(self) -> Tuple[bool, str, Dict[str, Any]]:
        """(passed, sentence, figures)"""
        raise NotImplementedError


def names(found, most: int = 8) -> str:
    found = list(found)
    return ", ".join(found[:most]) + (f" and {len(found) - most} more" if len(found) > most else "") if found else "none"

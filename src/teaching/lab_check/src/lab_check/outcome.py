"""What came of a submission: plain data that travels as JSON between the processes and into the reports."""

from __future__ import annotations

import hashlib
import math
from dataclasses import asdict, dataclass, field
from typing import Any


@dataclass
class Verdict:
    """One expectation: ``reason`` is a sentence for the student, ``figures`` what was measured."""

    kind: str
    passed: bool
    reason: str
    points: float = 0.0
    of: float = 0.0
    figures: dict[str, Any] = field(default_factory=dict)


@dataclass
class TaskResult:
    name: str
    points: float
    of: float
    verdicts: list[Verdict] = field(default_factory=list)
    commands: list[str] = field(default_factory=list)  # to repeat it by hand
    pictures: list[str] = field(default_factory=list)
    film: str = ""
    log: list[str] = field(default_factory=list)  # excerpt, first cause first
    hint: str = ""
    series: dict[str, list[list[float]]] = field(default_factory=dict)  # name -> [[time, value], ...]


@dataclass
class Result:
    """``fault``: the checker itself failed, which says nothing about the submission."""

    title: str
    submission: str
    points: float = 0.0
    of: float = 0.0
    tasks: list[TaskResult] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)  # of the sandbox and of staging
    fault: str = ""
    seconds: float = 0.0
    sandbox: str = ""

    def add(self, task: TaskResult) -> None:
        """Take ``task`` in, with its points."""
        self.tasks.append(task)
        self.points = rounded(sum(t.points for t in self.tasks))
        self.of = rounded(sum(t.of for t in self.tasks))

    def data(self) -> dict[str, Any]:
        return asdict(self)

    @classmethod
    def from_data(cls, data: dict[str, Any]) -> Result:
        """The result that ``data`` of a report says, see :meth:`data`."""
        tasks = [task_from(task) for task in data["tasks"]]
        return cls(**{**data, "tasks": tasks})


def task_from(data: dict[str, Any]) -> TaskResult:
    """The result of a task that ``data`` of a report says."""
    return TaskResult(**{**data, "verdicts": [Verdict(**verdict) for verdict in data["verdicts"]]})


def readable(name: str) -> str:
    """A file's name as it can be shown and stored: bytes that are no UTF-8 become the sign for that."""
    return "".join("\ufffd" if "\ud800" <= c <= "\udfff" else c for c in name)


_LONGEST_NAME = 200  # bytes: a folder is called so, and others are made beside it


def name_for(name: str) -> str:
    """What a submission is called in tables, on the terminal and as a folder: its file's name without what moves a terminal's cursor, and
    not longer than names of files can be."""
    shown = "".join(c if c.isprintable() else "\ufffd" for c in readable(name))
    if len(shown.encode()) <= _LONGEST_NAME:
        return shown
    digest = hashlib.sha256(name.encode("utf-8", "surrogateescape")).hexdigest()[:8]
    return shown.encode()[: _LONGEST_NAME - 20].decode("utf-8", "ignore") + f"... {digest}"


def rounded(points: float) -> float:
    """``points`` to a millionth: sums of thirds come out the same in any order."""
    return round(points + 0.0, 6)


_LONGEST_SENTENCE, _MOST_FIGURES = 2000, 20_000  # characters of a reason or note; of all figures of a verdict


def sentence(text: str) -> str:
    """``text``, cut: names of nodes, topics and files stand in it, which a submission makes as long as it likes."""
    return text if len(text) <= _LONGEST_SENTENCE else f"{text[:_LONGEST_SENTENCE]} ..."


def share(task: dict[str, Any], verdicts: list[Verdict]) -> TaskResult:
    """Deals a task's points out to its verdicts.

    Expectations with ``points`` of their own weigh that much, the others equally; the sum is the task's points.
    """
    weights = [float(expectation.get("points", 1.0)) for expectation in task["expect"]]
    total = sum(weights) or 1.0
    for weight, verdict in zip(weights, verdicts):
        verdict.reason = sentence(verdict.reason)
        verdict.figures = _told(verdict.figures) if len(repr(verdict.figures)) <= _MOST_FIGURES else {}
        verdict.of = rounded(task["points"] * weight / total)
        verdict.points = verdict.of if verdict.passed else 0.0
    met = all(verdict.passed for verdict in verdicts)
    points = sum(task["points"] * weight / total for weight, verdict in zip(weights, verdicts) if verdict.passed)
    if task["all"] and not met:
        points = 0.0
        for verdict in verdicts:
            verdict.points = 0.0
    return TaskResult(task["name"], rounded(points), rounded(task["points"]), verdicts, hint=task.get("hint", ""))


def _told(figures: dict[str, Any]) -> dict[str, Any]:
    """Those that JSON has numbers for."""

    def finite(value: Any) -> bool:
        return all(map(finite, value)) if isinstance(value, (list, tuple)) else not isinstance(value, float) or math.isfinite(value)

    return {name: value for name, value in figures.items() if finite(value)}


def failed_task(task: dict[str, Any], reason: str) -> TaskResult:
    """No marks for any expectation of ``task``, for one ``reason``."""
    kinds = [next(k for k in e if k not in ("points", "say")) for e in task["expect"]]
    return share(task, [Verdict(kind, False, reason) for kind in kinds])

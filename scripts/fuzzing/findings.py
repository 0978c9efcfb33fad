"""What counts as found: a :class:`Finding` says what happened and where, and equal places are one finding."""

from __future__ import annotations

import re
import traceback
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
_LONGEST_MESSAGE = 1500  # characters: the reason, a path, and at most one shortened line of the input


@dataclass(frozen=True)
class Finding:
    """``what`` (abort, hang, exception ...) and ``place`` are its identity; ``detail`` is for the reader."""

    what: str
    place: str
    detail: str = ""

    @property
    def key(self) -> tuple[str, str]:
        """Without line numbers, so that the same fault keeps its name while the file around it is edited."""
        return self.what, re.sub(r":\d+", "", self.place)

    @property
    def slug(self) -> str:
        """For a file name."""
        return re.sub(r"[^A-Za-z0-9_]+", "_", "_".join(self.key)).strip("_")[:80]

    def __str__(self) -> str:
        return f"{self.what} at {self.place}" + (f": {self.detail}" if self.detail else "")


class Found(Exception):
    """Raised by a check of a kind; carries the :class:`Finding`."""

    def __init__(self, what: str, place: str, detail: str = ""):
        super().__init__(what, place, detail)
        self.finding = Finding(what, place, shortened(detail))

    @classmethod
    def of(cls, finding: Finding) -> Found:
        return cls(finding.what, finding.place, finding.detail)


def shortened(text: str, length: int = 200) -> str:
    text = " ".join(text.split())
    return text if len(text) <= length else text[:length] + " ..."


def of_exception(error: BaseException) -> Finding:
    """An exception that nobody declared: the innermost frame of ours is its place."""
    frames = [frame for frame in traceback.extract_tb(error.__traceback__) if _ours(frame.filename)]
    place = f"{_short(frames[-1].filename)}:{frames[-1].lineno} {frames[-1].name}" if frames else "outside the workspace"
    return Finding(f"undeclared {type(error).__name__}", place, shortened(" ".join(str(error).split())))


def of_stack(what: str, output: str) -> Finding:
    """An abort, a signal or a hang: the innermost frame of ours in what faulthandler wrote."""
    place = next(
        (f"{_short(file)}:{line} {name}" for file, line, name in re.findall(r'File "([^"]+)", line (\d+) in (\S+)', output) if _ours(file)),
        "unknown place",
    )
    if place == "unknown place" and "Traceback" in output:  # outside the case: the making of it, or this program
        place = output.strip().splitlines()[-1][:100]
    said = [
        line
        for line in output.splitlines()
        if "assertion" in line or "what():" in line or "terminate called" in line or line.startswith("Fatal Python")
    ]
    return Finding(what, place, shortened("; ".join(said)))


def of_output(output: str) -> Finding:
    """Something on the terminal where a library must be silent."""
    lines = [line for line in output.splitlines() if line.strip()]
    trace = re.findall(r'File "([^"]+)", line (\d+), in (\S+)', output)
    if "Traceback" in output and trace:
        ours = [frame for frame in trace if _ours(frame[0])] or trace
        return Finding("traceback on the terminal", f"{_short(ours[-1][0])}:{ours[-1][1]} {ours[-1][2]}", shortened(lines[-1]))
    first = re.sub(r"[-+]?\d[\d.e+-]*", "N", lines[0])[:80]
    return Finding("output on the terminal", first, shortened(" | ".join(lines)))


def refused(call: Callable, *declared: type[BaseException]) -> tuple[object, BaseException | None]:
    """``call()``'s value, or the declared error that it refused with, whose message must be one short line."""
    try:
        return call(), None
    except declared as error:
        check_message(str(error), of_exception(error).place)
        return None, replace_traceback(error)


def replace_traceback(error: BaseException) -> BaseException:
    """Frames keep worlds alive; they are not wanted any longer."""
    return error.with_traceback(None)


def check_message(message: str, place: str) -> None:
    """Messages are for a student: one line, not a copy of the input."""
    if "\n" in message.strip() or not message.strip():
        raise Found("message is not one line", place, repr(message))
    if len(message) > _LONGEST_MESSAGE:
        raise Found("message is too long", place, f"{len(message)} characters: {message}")


def at(finding: Finding, place: str) -> Finding:
    return replace(finding, place=place)


def _ours(file: str) -> bool:
    return ("/src/" in file or "/devel/" in file) and "/fuzzing/" not in file and "site-packages" not in file and "/usr/" not in file


def _short(file: str) -> str:
    parts = Path(file).parts
    return "/".join(parts[-2:])

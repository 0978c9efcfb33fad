"""How serious a line of a node's output is."""

from __future__ import annotations

import re

# rosconsole and rospy colour a line by its level; with a format that shows the level it is in the text
_COLOUR = re.compile(r"\x1b\[(?:0;|1;)?3([1-7])m")
_LEVEL = {"1": "error", "3": "warn", "2": "debug"}
_TEXT = re.compile(r"^\s*(?:\x1b\[[0-9;]*m)*\[\s*(DEBUG|INFO|WARN|WARNING|ERROR|FATAL)\]")
_NAMES = {"DEBUG": "debug", "INFO": "info", "WARN": "warn", "WARNING": "warn", "ERROR": "error", "FATAL": "error"}
_ESCAPES = re.compile(
    r"\x1b(?:\[[0-9;?]*[ -/]*[@-~]|\][^\x07\x1b]*(?:\x07|\x1b\\)|[@-Z\\-_])"
    r"|[\x00-\x08\x0b-\x1a\x1c-\x1f]"
)


def of_line(line: str, is_stderr: bool) -> str:
    """``debug``, ``info``, ``warn`` or ``error`` of ``line``; rosconsole writes warnings and errors to standard error (``is_stderr``)."""
    match = _TEXT.match(line)
    if match:
        return _NAMES[match.group(1)]
    match = _COLOUR.match(line.lstrip())
    level = _LEVEL.get(match.group(1), "info") if match else "info"
    return "warn" if is_stderr and level in ("debug", "info") else level


def without_escapes(line: str) -> str:
    """The text alone, without colours and control characters."""
    return _ESCAPES.sub("", line)


def only_colours(line: str) -> str:
    """The text with its colours, without anything that moves the cursor or changes the terminal."""
    return _ESCAPES.sub(lambda match: match.group() if match.group().endswith("m") else "", line)

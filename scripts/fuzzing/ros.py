"""What kinds need that talk ROS: a master of their own, and what is logged."""

from __future__ import annotations

import logging
import os
import re
import socket
from pathlib import Path

from fuzzing.findings import Found, check_message

_FIRST_PORT = 11850
_BUILTIN_ERROR = re.compile(
    r"\b((?:Type|Value|Key|Index|Attribute|Overflow|ZeroDivision|Recursion|Assertion|Runtime|struct\.e|"
    r"UnicodeEncode|UnicodeDecode|Memory|Name|FloatingPoint)(?:Error|rror)): "
)


def free_port(number: int) -> int:
    """:param number: of the worker: each looks in a range of its own."""
    for port in range(_FIRST_PORT + 10 * number, _FIRST_PORT + 10 * number + 400):
        with socket.socket() as probe:
            try:
                probe.bind(("127.0.0.1", port))
                return port
            except OSError:
                continue
    raise RuntimeError("no free port for a ROS master")


def start_master(folder: Path, number: int) -> None:
    """A ROS master in this process; this process and those that it starts use it."""
    from rosmaster.master import Master

    port = free_port(number)
    os.environ.update(ROS_MASTER_URI=f"http://localhost:{port}", ROS_HOME=str(folder), ROS_LOG_DIR=str(folder / "log"))
    master = Master(port, 3)
    master.start()
    master_of_this_process.append(master)


master_of_this_process: list[object] = []  # its threads end with it


class Log(logging.Handler):
    """What rospy says. A line that shows an error of Python itself is one that nobody has thought of."""

    def __init__(self):
        super().__init__(logging.WARNING)
        self.lines: list[str] = []
        logging.getLogger("rosout").addHandler(self)

    def emit(self, record: logging.LogRecord) -> None:
        self.lines.append(record.getMessage())

    def check(self) -> None:
        """:raises Found: what was said since the last time is not for a student."""
        lines, self.lines = self.lines, []
        for line in lines:
            check_line(line)


def check_line(line: str) -> None:
    """One line of a log."""
    found = _BUILTIN_ERROR.search(line)
    if found:
        place = re.search(r"\(([^()]*?([^/()]+/[^/()]+\.py):(\d+))\)", line)
        raise Found(f"undeclared {found[1]}", f"{place[2]}:{place[3]}" if place else re.sub(r"'[^']*'|[\d.]+", "N", line)[:100], line)
    check_message(line, re.sub(r"'[^']*'|\d[\d.]*", "N", line)[:60])

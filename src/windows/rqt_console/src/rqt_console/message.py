"""One log message."""

import time
from collections.abc import Sequence
from dataclasses import dataclass

from rosgraph_msgs.msg import Log

SEVERITIES = {Log.DEBUG: "Debug", Log.INFO: "Info", Log.WARN: "Warn", Log.ERROR: "Error", Log.FATAL: "Fatal"}


@dataclass(eq=False)
class Message:
    """A log message; ``id`` counts from 1 in the order of arrival. ``stamp`` is (s, ns)."""

    message: str = ""
    severity: int = Log.INFO
    node: str = ""
    stamp: tuple[int, int] = (0, 0)
    topics: Sequence[str] = ()
    location: str = ""
    id: int = 0

    SEVERITY_LABELS = SEVERITIES

    @classmethod
    def from_log(cls, log: Log) -> "Message":
        return cls(
            log.msg,
            log.level,
            log.name,
            (log.header.stamp.secs, log.header.stamp.nsecs),
            sorted(log.topics),
            f"{log.file}:{log.function}:{log.line}",
        )

    def severity_text(self) -> str:
        return SEVERITIES.get(self.severity, str(self.severity))

    def stamp_text(self) -> str:
        """Local time of day with all digits, and the date."""
        return time.strftime(f"%H:%M:%S.{self.stamp[1]:09d} (%Y-%m-%d)", time.localtime(self.stamp[0]))

    def topics_text(self) -> str:
        return ", ".join(self.topics)

    def pretty_print(self) -> str:
        return (
            f"Node: {self.node}\nTime: {self.stamp_text()}\nSeverity: {self.severity_text()}\n"
            f"Published Topics: {self.topics_text()}\n\n{self.message}\n\nLocation:\n{self.location}\n\n{'-' * 100}\n\n"
        )

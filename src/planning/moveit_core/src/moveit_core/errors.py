"""Error codes, and the exception that carries one."""
from __future__ import annotations

from moveit_msgs.msg import MoveItErrorCodes

#: value -> name, as upstream's clients print it
CODES = {value: name for name, value in vars(MoveItErrorCodes).items() if name.isupper() and isinstance(value, int)}


def code_name(value: int) -> str:
    """Name of a MoveItErrorCodes value, for example ``START_STATE_IN_COLLISION``."""
    return CODES.get(int(value), f"error code {value}")


class PlanningError(Exception):
    """A request that cannot be served: ``code`` (MoveItErrorCodes value) and one line saying what to do about it."""

    def __init__(self, code: int, message: str):
        super().__init__(message)
        self.code = int(code)


def one_line(text: object, limit: int = 200) -> str:
    """``text`` without line ends, shortened to ``limit`` characters: what a message may quote of an input."""
    line = " ".join(str(text).split())
    return line if len(line) <= limit else line[:limit - 3] + "..."

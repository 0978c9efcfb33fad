"""Waiting in wall time."""

import time
from collections.abc import Callable
from typing import TypeVar

T = TypeVar("T")


def wait_until(condition: Callable[[], T], what: str = "", timeout: float = 60.0, interval: float = 0.01) -> T:
    """Ask ``condition()`` every ``interval`` s until it gives something true, and return that.

    :raises AssertionError: it does not within ``timeout`` s; the message says ``what`` was waited for, and the last answer.
    """
    end = time.monotonic() + timeout
    while True:
        answer = condition()
        if answer:
            return answer
        if time.monotonic() >= end:
            raise AssertionError(
                f"waited {timeout:g} s in vain for {what or getattr(condition, '__name__', 'a condition')}; the last answer was {answer!r}"
            )
        time.sleep(interval)


def never(condition: Callable[[], object], what: str, seconds: float, interval: float = 0.01) -> None:
    """Ask ``condition()`` every ``interval`` s for ``seconds`` of wall time: it must not come true. What is wrong would do so by then.

    :raises AssertionError: it does; the message says ``what`` came
    """
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        answer = condition()
        if answer:
            raise AssertionError(f"{what} came: {answer!r}")
        time.sleep(interval)

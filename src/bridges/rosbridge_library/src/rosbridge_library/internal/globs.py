"""Names that clients may use, as patterns of the shell."""

from __future__ import annotations

import fnmatch
from typing import Any

from rosbridge_library.internal.exceptions import InvalidArgumentException


def globs(name: str, value: Any) -> tuple[str, ...]:
    """Patterns of ``value``, "[/a, '/b*']", as launch files have them, or a list; none: all is allowed.

    :param name: of the parameter, for the error
    :raises InvalidArgumentException: it is something else
    """
    if value is None or value == "None":
        return ()
    words = value.strip().strip("[]").split(",") if isinstance(value, str) else value
    if not isinstance(words, (list, tuple)) or not all(isinstance(word, str) for word in words):
        raise InvalidArgumentException(f"{name} should be a list of patterns as [/camera/*, /odom], not {value!r}")
    return tuple(word for word in (word.strip().strip("'\"") for word in words) if word)


def allowed(name: str, patterns: tuple[str, ...]) -> bool:
    """Whether ``name`` fits one of ``patterns``, or there are none."""
    return not patterns or any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)

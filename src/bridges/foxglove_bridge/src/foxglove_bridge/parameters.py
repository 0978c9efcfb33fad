"""Parameters of the master, read and set by clients."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import rospy
from foxglove.websocket import Parameter


class Parameters:
    """
    :param allowed: of a name
    :param changed: is told those that a client follows and that have another value now
    """

    def __init__(self, allowed: Callable[[str], bool], changed: Callable[[list[Parameter]], None], complain: Callable[[str], None]) -> None:
        self._allowed, self._changed, self._complain = allowed, changed, complain
        self._lock = threading.Lock()
        self._followed: dict[str, Any] = {}  # name -> value that was told last

    def get(self, names: list[str]) -> list[Parameter]:
        """The parameters ``names``; all of them, where no name is given."""
        wanted = names or sorted(rospy.get_param_names())
        return [made for name in wanted if self._allowed(name) for made in _made(name, rospy.get_param(name, None))]

    def set(self, parameters: list[Parameter]) -> list[Parameter]:
        """Set ``parameters``, as far as that is allowed. :return: what they are then"""
        for parameter in parameters:
            if not self._allowed(parameter.name):
                self._complain(f"{parameter.name}: ~param_whitelist does not allow to set it")
            elif parameter.value is None:
                if rospy.has_param(parameter.name):
                    rospy.delete_param(parameter.name)
            else:
                rospy.set_param(parameter.name, parameter.get_value())
        return self.get([parameter.name for parameter in parameters])

    def follow(self, names: list[str]) -> None:
        """Tell of changes of ``names``."""
        with self._lock:
            self._followed.update({name: rospy.get_param(name, None) for name in names if self._allowed(name)})

    def unfollow(self, names: list[str]) -> None:
        """Tell of changes of ``names`` no more."""
        with self._lock:
            for name in names:
                self._followed.pop(name, None)

    def look(self) -> None:
        with self._lock:
            names: set[str] = set(self._followed)
        new: list[tuple[str, Any]] = [(name, rospy.get_param(name, None)) for name in sorted(names)]
        told = []
        with self._lock:
            for name, value in new:
                if name in self._followed and self._followed[name] != value:
                    self._followed[name] = value
                    told += _made(name, value)
        if told:
            self._changed(told)


def _made(name: str, value: Any) -> list[Parameter]:
    """Dates and whatever else the protocol has no word for go as text."""
    if value is None:
        return []
    try:
        return [Parameter(name, value=value)]
    except (TypeError, ValueError, OverflowError):
        return [Parameter(name, value=str(value))]

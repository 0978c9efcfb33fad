"""What a filter is, and the table of their parameters."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from node_signals.parameters import is_number

BEYOND = 1.0  # m above range_max: how upstream writes "nothing here" where it does not write NaN


@dataclass
class Scan:
    """A scan: ``ranges`` and ``intensities`` float32 (N,) (these may be empty), angles in rad, ``stamp`` in s."""

    ranges: np.ndarray
    intensities: np.ndarray
    angle_min: float
    angle_increment: float
    range_min: float
    range_max: float
    frame: str = ""
    stamp: float = 0.0
    time_increment: float = 0.0

    @property
    def angles(self) -> np.ndarray:
        return self.angle_min + np.arange(len(self.ranges)) * self.angle_increment

    def points(self) -> np.ndarray:
        """(N, 3) in the scan's frame; NaN where a ray met nothing."""
        r = np.where((self.ranges >= self.range_min) & (self.ranges <= self.range_max), self.ranges, np.nan)
        return np.column_stack((r * np.cos(self.angles), r * np.sin(self.angles), np.zeros(len(r))))


class FilterError(ValueError):
    """A filter cannot be made of these parameters, or cannot work on this scan; one line."""


#: Points (N, 3) of one frame at a time, in another: (points, to, whence, stamp) -> points.
Transform = Callable[[np.ndarray, str, str, float], np.ndarray]


@dataclass(frozen=True)
class Setting:
    """One parameter. Without a default it is needed. ``live``: dynamic_reconfigure can change it, within the bounds."""

    name: str
    kind: type
    default: Any = None
    low: Any = None
    high: Any = None
    live: bool = True


class Filter:
    """``values``: parameters by name, of which ``given`` are those that the chain has. ``apply`` changes a scan of its own in place."""

    settings: Sequence[Setting] = ()
    remembers = True  # what the chain does not give is what dynamic_reconfigure left on the parameter server

    def __init__(self, name: str, given: dict[str, Any], transform: Transform | None = None):
        self.name = name
        self.transform = transform
        self.given = frozenset(given)
        self.values: dict[str, Any] = {}
        for setting in self.settings:
            value = given.get(setting.name, setting.default)
            if value is None:
                raise FilterError(f"filter '{name}' needs the parameter {setting.name}")
            self.values[setting.name] = self._checked(setting, value)
        self.prepare(given)

    def _checked(self, setting: Setting, value: Any) -> Any:
        wrong = FilterError(f"parameter {setting.name} of filter '{self.name}' is {value!r}, which is no {setting.kind.__name__}")
        if setting.kind is float and isinstance(value, (int, float, str)) and not isinstance(value, bool):
            try:
                return float(value)
            except ValueError:
                raise wrong from None
        if setting.kind in (int, bool) and isinstance(value, (int, float)) and value == int(value):
            return setting.kind(value)
        if not isinstance(value, setting.kind):
            raise wrong
        return value

    def prepare(self, given: dict[str, Any]) -> None:
        """What follows from the values; also after they were changed. ``given``: all parameters as they are written, {} after a change."""

    def change(self, values: dict[str, Any]) -> None:
        """Take new ``values``, of ``settings``."""
        self.values.update(values)
        self.prepare({})

    def apply(self, scan: Scan) -> None:
        """:raises FilterError: this scan cannot be filtered."""
        raise NotImplementedError


def number(value: Any, what: str) -> float:
    """``value`` as a number; ``what`` it is, for the error. :raises FilterError: it is none"""
    if not is_number(value):
        raise FilterError(f"{what} has to be a number, not {value!r}")
    return float(value)

"""Which collision of a touching pair Gazebo names first, as its collision space has it.

Gazebo sorts models, and links that collide with their own model, into classes by the largest side of the box round all that
they collide with: doubling the side is the next class, infinite planes and what is beyond 256 m are the last. Of a pair the one of
the smaller class is the first; of equals the one that stands still, else the one that was made last.
``contacts.cpp`` of gazebo_cpp has the same rule for plugins in C++.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np

_LEAST, _MOST = -2, 8  # the exponents of two between which Gazebo tells sizes apart
_BEYOND = 99


def size_class(low: Iterable[float], high: Iterable[float]) -> int:
    """The class of a box between the corners ``low`` and ``high``, m.

    >>> size_class((0, 0, 0), (0.2, 0.2, 0.3)), size_class((0, 0, 0), (1.5, 1, 1)), size_class((0, 0, -math.inf), (1, 1, 0))
    (-1, 1, 99)
    """
    side = max(b - a for a, b in zip(low, high))
    if not math.isfinite(side):
        return _BEYOND
    exponent = max(math.frexp(side)[1], _LEAST)
    return exponent if exponent <= _MOST else _BEYOND


def _box(collision: Any) -> list[Any]:
    """What it fills, in a list; none of one that is no longer in the world."""
    try:
        return [collision.bounding_box()]
    except RuntimeError:
        return []


class PairOrder:
    """Asked in the physics thread; knows the classes until :meth:`forget` is called, which whoever asks does once a step."""

    def __init__(self) -> None:
        self._moving: dict[Any, int] = {}
        self._static: dict[Any, int] = {}

    def forget(self) -> None:
        self._moving.clear()

    def in_order(self, one: Any, other: Any) -> bool:
        """Whether Gazebo names the collision ``one`` before ``other`` (:class:`ode_sim.CollisionHandle`)."""
        classes = self._class(one.link), self._class(other.link)
        if classes[0] != classes[1]:
            return classes[0] < classes[1]
        if one.link.model.static != other.link.model.static:
            return one.link.model.static
        return one.id > other.id

    def _class(self, link: Any) -> int:
        model = link.model
        unit = link if link.core.self_collide else model
        known = self._static if model.static else self._moving
        key = (unit, model.pose) if model.static else unit
        if key not in known:
            links = (link,) if unit is link else [each for each in model.links.values() if not each.core.self_collide]
            boxes = np.array([box for each in links for collision in each.collisions.values() for box in _box(collision)])
            known[key] = size_class(boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0))
        return known[key]

"""The controls that say where the picked part of a plan is, to the millimetre, as Gazebo's inspectors do."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any

from ode_sim_viewer.simulation import Refused

from gzclient.building.plan import Element, Plan

_FARTHEST = 1000.0  # m


class PlaceControls:
    """A folder that is there while something is picked.

    Which walls come along with an end is settled when the wall is picked: while a number is typed its beginnings are
    places as well, and may be the ends of others.

    :param on_update: ``on_update(control, f)``: ``f(value)`` when a hand has set it
    :param told: is given what to do then
    """

    def __init__(self, gui: Any, on_update: Callable[[Any, Callable[[Any], None]], None], told: Callable[[Callable[[], None]], None]):
        self._plan: Plan | None = None
        self._which: Element | None = None
        self._ends: dict[str, list[tuple[int, str]]] = {}
        self._folder = gui.add_folder("Its place", visible=False)
        with self._folder:
            self._from = gui.add_vector2("Start (m)", (0.0, 0.0), step=0.001)
            self._to = gui.add_vector2("End (m)", (0.0, 0.0), step=0.001, hint="walls that end there come along")
            self._length = gui.add_number(
                "Wall's length (m)",
                1.0,
                min=0.0,
                max=_FARTHEST,
                step=0.001,
                hint="from end to end; the wall itself reaches half its thickness farther at a corner",
            )
            self._at = gui.add_number("From the wall's start (m)", 0.0, min=0.0, max=_FARTHEST, step=0.001, hint="to its middle")
        for control, change in (
            (self._from, lambda: self._put("from", self._from.value)),
            (self._to, lambda: self._put("to", self._to.value)),
            (self._length, self._stretch),
            (self._at, lambda: self._change(at=float(self._at.value))),
        ):
            on_update(control, partial(self._changed, told, change))

    @staticmethod
    def _changed(told: Callable[[Callable[[], None]], None], change: Callable[[], None], _value: Any) -> None:
        told(change)

    @property
    def _shown(self) -> tuple[Plan, Element]:
        """The plan, and what is picked in it."""
        assert self._plan is not None and self._which is not None  # the folder is not seen without them
        return self._plan, self._which

    def show(self, plan: Plan, which: Element | None) -> None:
        """Other things than numbers have changed, or what is picked.

        :param plan: what the controls change
        :param which: what is picked; None hides the folder
        """
        self._plan, self._which, self._ends = plan, which, {}
        self._folder.visible = which is not None
        if which is None:
            return
        for control, kinds in (
            (self._from, ("walls", "stairs")),
            (self._to, ("walls",)),
            (self._length, ("walls",)),
            (self._at, ("doors", "windows")),
        ):
            control.visible = which.kind in kinds
        if which.kind == "walls":
            self._ends = {end: plan.ends_at(which, end) for end in ("from", "to")}
        self._fill()

    def _fill(self, but: Any = None) -> None:
        """The numbers as they are, but for the one that a hand is in."""
        plan, which = self._shown
        element = plan.element(which)
        values: tuple[tuple[Any, Any], ...]
        if which.kind == "walls":
            values = (
                (self._from, tuple(element["from"])),
                (self._to, tuple(element["to"])),
                (self._length, round(math.dist(element["from"], element["to"]), 6)),
            )
        elif which.kind == "stairs":
            values = ((self._from, tuple(element["at"][:2])),)
        else:
            values = ((self._at, float(element["at"])),)
        for control, value in values:
            if control is not but and control.value != value:  # what is set anew takes the selection of a hand away
                control.value = value

    def _put(self, end: str, point: Any) -> None:
        plan, which = self._shown
        place = float(point[0]), float(point[1])
        if max(map(abs, place)) > _FARTHEST:
            raise Refused(f"That is more than {_FARTHEST:g} m away.")
        if which.kind == "stairs":
            self._change(at=place)
            return
        plan.put_ends(which.level, self._ends[end], place)
        self._fill(self._from if end == "from" else self._to)

    def _stretch(self) -> None:
        plan, which = self._shown
        wall, length = plan.element(which), float(self._length.value)
        start, end = wall["from"], wall["to"]
        part = length / math.dist(start, end)
        x, y = (round(a + part * (b - a), 6) for a, b in zip(start, end))
        plan.put_ends(which.level, self._ends["to"], (x, y))
        self._fill(self._length)

    def _change(self, **settings: Any) -> None:
        plan, which = self._shown
        plan.change(which, **settings)

"""A plan that is being drawn: what a hand does to it, step by step, and back.

The document is the mapping that :func:`building_editor.building.building_of` reads, with each wall on its own (``from``,
``to``). Elements are named ``(level, kind, index)``, openings in a wall ``(level, kind, index, wall)``.
"""

from __future__ import annotations

import copy
import math
from typing import Any, NamedTuple

from building_editor.building import Building, PlanError, building_of
from ode_sim_viewer.simulation import Refused

Point = tuple[float, float]

SNAP = 0.25  # m
SNAP_ANGLE = math.radians(15.0)
_CATCH = 0.3  # m: a wall that ends nearer to another one's end ends there
_MOST_STEPS = 200  # that can be undone
_SHORTEST = 0.05  # m, of a wall
_NEAR = 1e-6  # m: the same place


class Element(NamedTuple):
    """``kind``: walls, stairs, doors or windows; ``wall``: of a door or window, else -1."""

    level: int
    kind: str
    index: int  # type: ignore[assignment]  # nobody looks for a value in an Element as in a tuple
    wall: int = -1


def snapped(value: float, step: float) -> float:
    """``value`` on a grid; as it is where ``step`` is 0."""
    return round(round(value / step) * step, 9) if step > 0.0 else round(value, 4)


class Plan:
    """:ivar document: as written to the file. :ivar level: that is drawn on. :ivar snap: m. :ivar snap_angle: rad."""

    def __init__(self, document: dict[str, Any] | None = None):
        self.document: dict[str, Any] = _of_single_walls(document) if document else {"name": "building", "walls": []}
        self.level = 0
        self.snap = SNAP
        self.snap_angle = SNAP_ANGLE
        self._past: list[dict] = []
        self._future: list[dict] = []

    # ------------------------------------------------------------------------------------------ what is there

    def building(self) -> Building | None:
        """None while nothing is drawn.

        :raises PlanError: the document was changed to something that cannot be built
        """
        if not any(self.part(level).get("walls") or self.part(level).get("stairs") for level in range(self.levels)):
            return None
        return building_of(self.document)

    @property
    def levels(self) -> int:
        return 1 + len(self.document.get("levels") or [])

    def part(self, level: int) -> dict[str, Any]:
        """The mapping that holds the walls and stairs of a level."""
        return self.document if level == 0 else self.document["levels"][level - 1]

    def base(self, level: int) -> float:
        """m, the height of a level's floor."""
        return sum(self._height(below) for below in range(level))

    def _height(self, level: int) -> float:
        part, usual = self.part(level), (self.document.get("wall") or {}).get("height", 2.5)
        heights = [wall.get("height", usual) for wall in part.get("walls") or []]
        return float(part.get("height", max(heights, default=2.5)))

    def element(self, which: Element) -> dict[str, Any]:
        """:raises Refused: it has gone."""
        try:
            part = self.part(which.level)
            return (part["walls"][which.wall] if which.wall >= 0 else part)[which.kind][which.index]
        except (LookupError, TypeError):
            raise Refused("That part of the building is not there any more.") from None

    def has(self, which: Element) -> bool:
        try:
            return bool(self.element(which))
        except Refused:
            return False

    # ------------------------------------------------------------------------------------------ history

    def _change(self) -> None:
        self._past = self._past[1 - _MOST_STEPS :] + [copy.deepcopy(self.document)]
        self._future.clear()

    def undo(self) -> None:
        self._turn(self._past, self._future, "undo")

    def redo(self) -> None:
        self._turn(self._future, self._past, "do again")

    def _turn(self, source: list[dict], target: list[dict], verb: str) -> None:
        if not source:
            raise Refused(f"There is nothing to {verb}.")
        target.append(self.document)
        self.document = source.pop()
        self.level = min(self.level, self.levels - 1)

    def attempt(self, change) -> Any:
        """Do ``change()``; what cannot be built is taken back.

        :raises Refused: the line that says why
        """
        self._change()
        try:
            result = change()
            self.building()
            return result
        except (PlanError, Refused) as error:
            self.document = self._past.pop()
            raise Refused(str(error)) from error

    # ------------------------------------------------------------------------------------------ snapping

    def snap_point(self, point: Point) -> Point:
        """The end of a wall of this level nearby, else the nearest place of the grid."""
        ends = [tuple(wall[end]) for wall in self.part(self.level).get("walls") or [] for end in ("from", "to")]
        near = min(ends, key=lambda end: math.dist(end, point), default=None)
        if near is not None and math.dist(near, point) < _CATCH:
            return near
        return snapped(point[0], self.snap), snapped(point[1], self.snap)

    def snap_end(self, start: Point, point: Point) -> Point:
        """The other end of a wall from ``start`` (m): another wall's end near ``point``, else on a ray of the snap angle with a
        length on the grid.
        """
        near = self.snap_point(point)
        ends = [tuple(wall[end]) for wall in self.part(self.level).get("walls") or [] for end in ("from", "to")]
        if near in ends and math.dist(near, start) > _SHORTEST:
            return near
        angle = math.atan2(point[1] - start[1], point[0] - start[0])
        if self.snap_angle > 0.0:
            angle = snapped(angle, self.snap_angle)
        length = math.dist(start, point)
        if self.snap > 0.0:
            length = max(self.snap, snapped(length, self.snap))
        return round(start[0] + length * math.cos(angle), 6), round(start[1] + length * math.sin(angle), 6)

    # ------------------------------------------------------------------------------------------ drawing

    def add_wall(self, start: Point, end: Point, **settings: Any) -> Element:
        """A wall from ``start`` to ``end`` (m) on the level that is drawn on.

        :param settings: thickness, height m; material, or color (r, g, b) 0 to 1
        :raises Refused: it has no length
        """
        if math.dist(start, end) < _SHORTEST:
            raise Refused("A wall needs two different ends: press at one, drag to the other.")

        def change() -> Element:
            walls = self.part(self.level).setdefault("walls", [])
            walls.append({"from": list(map(float, start)), "to": list(map(float, end)), **_plain(settings)})
            return Element(self.level, "walls", len(walls) - 1)

        return self.attempt(change)

    def add_opening(self, kind: str, wall: int, point: Point, **settings: float) -> Element:
        """A hole in a wall of this level, nearest to ``point``.

        :param kind: doors or windows. :param settings: width, height, sill m
        """

        def change() -> Element:
            whole = self.element(Element(self.level, "walls", wall))
            openings = whole.setdefault(kind, [])
            openings.append({"at": self._along(whole, point, settings.get("width", 0.8)), **_plain(settings)})
            return Element(self.level, kind, len(openings) - 1, wall)

        return self.attempt(change)

    def _along(self, wall: dict[str, Any], point: Point, width: float) -> float:
        """m from the wall's start to the middle of an opening at ``point``, on the grid, inside the wall."""
        (x0, y0), (x1, y1) = wall["from"], wall["to"]
        length = math.dist((x0, y0), (x1, y1))
        if width > length:
            raise Refused(f"It is {width:g} m wide, the wall is {length:g} m long.")
        along = ((point[0] - x0) * (x1 - x0) + (point[1] - y0) * (y1 - y0)) / length
        return min(max(snapped(along, self.snap), width / 2), length - width / 2)

    def add_stairs(self, point: Point, yaw: float = 0.0, **settings: Any) -> Element:
        """They begin at ``point`` and climb along ``yaw`` to the next level."""

        def change() -> Element:
            stairs = self.part(self.level).setdefault("stairs", [])
            stairs.append({"at": list(self.snap_point(point)), "yaw": snapped(yaw, self.snap_angle), **_plain(settings)})
            return Element(self.level, "stairs", len(stairs) - 1)

        return self.attempt(change)

    def add_level(self) -> None:
        """One more on top, with the outer walls of the one below, as in Gazebo's editor; it is drawn on from now on."""

        def change() -> None:
            walls = [
                {key: copy.deepcopy(value) for key, value in wall.items() if key not in ("doors", "windows")}
                for wall in self.part(self.levels - 1).get("walls") or []
            ]
            if not walls:
                raise Refused("Draw walls first; the next level stands on them.")
            self.document.setdefault("levels", []).append({"walls": walls})
            self.level = self.levels - 1

        level = self.level
        try:
            self.attempt(change)
        except Refused:
            self.level = level
            raise

    def remove_level(self) -> None:
        """The level that is drawn on; the lowest stays."""
        if self.level == 0:
            raise Refused("The lowest level stays; delete its walls.")
        self.attempt(lambda: self.document["levels"].pop(self.level - 1))
        self.level -= 1

    # ------------------------------------------------------------------------------------------ changing

    def delete(self, which: Element) -> None:
        self.element(which)
        part = self.part(which.level)
        self.attempt(lambda: (part["walls"][which.wall] if which.wall >= 0 else part)[which.kind].pop(which.index))

    def change(self, which: Element, **settings: Any) -> None:
        """Other measures or looks; None takes a setting away. A colour takes the place of a material, and the other way
        round."""

        def change() -> None:
            whole = self.element(which)
            for key, other in (("color", "material"), ("material", "color")):
                if settings.get(key) is not None:
                    whole.pop(other, None)
            whole.update(_plain(settings))
            for key in [key for key, value in settings.items() if value is None]:
                whole.pop(key, None)

        self.attempt(change)

    def grip(self, wall: int, point: Point) -> str:
        """What of a wall is taken hold of at ``point``: from, to, or '' for the whole."""
        whole = self.element(Element(self.level, "walls", wall))
        reach = min(0.5, 0.3 * math.dist(whole["from"], whole["to"]))
        return next((end for end in ("from", "to") if math.dist(whole[end], point) < reach), "")

    def move(self, which: Element, grip: str, start: Point, point: Point) -> None:
        """Drag the element ``which`` from ``start`` to ``point``, m.

        An end of a wall takes the walls along that end there too; a door or window stays in its wall.

        :param grip: of :meth:`grip`
        """
        whole = self.element(which)
        if which.kind in ("doors", "windows"):
            wall = self.part(which.level)["walls"][which.wall]
            at = self._along(wall, point, whole.get("width", 0.9 if which.kind == "doors" else 0.8))
            self.attempt(lambda: whole.update(at=at))
            return
        shift = [snapped(b, self.snap) - snapped(a, self.snap) for a, b in zip(start, point)]
        if which.kind == "stairs":
            self.attempt(lambda: whole.update(at=[round(v + s, 6) for v, s in zip(whole["at"], shift)]))
        elif grip:
            self.attempt(lambda: self._move_end(whole, grip, point))
        else:
            self.attempt(lambda: whole.update({end: [round(v + s, 6) for v, s in zip(whole[end], shift)] for end in ("from", "to")}))

    def _move_end(self, whole: dict[str, Any], grip: str, point: Point) -> None:
        before = tuple(whole[grip])
        other = whole["to" if grip == "from" else "from"]
        joined = [(wall, end) for wall in self.part(self.level)["walls"] for end in ("from", "to") if math.dist(wall[end], before) < _NEAR]
        place = snapped(point[0], self.snap), snapped(point[1], self.snap)
        if len(joined) == 1:
            place = self.snap_end(tuple(other), point)
        for wall, end in joined:
            wall[end] = list(place)

    def ends_at(self, which: Element, end: str) -> list[tuple[int, str]]:
        """(wall, from or to) of each end of its level that is where the ``end`` (from or to) of the wall ``which`` is, its own first."""
        place = self.element(which)[end]
        return [(which.index, end)] + [
            (number, other)
            for number, wall in enumerate(self.part(which.level)["walls"])
            for other in ("from", "to")
            if (number, other) != (which.index, end) and math.dist(wall[other], place) < _NEAR
        ]

    def put_ends(self, level: int, ends: list[tuple[int, str]], point: Point) -> None:
        """To that very place, whatever the grid.

        :param level: of the walls, from 0
        :param ends: as of :meth:`ends_at`
        :param point: m
        :raises Refused: a wall would have no length
        """

        def change() -> None:
            walls = self.part(level)["walls"]
            for number, end in ends:
                walls[number][end] = [float(part) for part in point]
                if math.dist(walls[number]["from"], walls[number]["to"]) < _SHORTEST:
                    raise Refused("A wall needs two different ends.")

        self.attempt(change)

    def turn(self, which: Element, angle: float) -> None:
        """Turn the stairs ``which`` about their lowest step by ``angle``, rad."""
        whole = self.element(which)
        self.attempt(lambda: whole.update(yaw=round((whole.get("yaw", 0.0) + angle) % (2 * math.pi), 9)))


def _plain(settings: dict[str, Any]) -> dict[str, Any]:
    """For the file: lists in place of tuples, floats rounded; what is None left out."""
    made = {}
    for key, value in settings.items():
        if value is not None:
            made[key] = (
                [round(float(part), 4) for part in value]
                if isinstance(value, (tuple, list))
                else round(value, 6)
                if isinstance(value, float)
                else value
            )
    return made


def _of_single_walls(document: dict[str, Any]) -> dict[str, Any]:
    """The same building with every piece of a wall's path as a wall of its own, so that a hand can take it.

    :raises PlanError: it is no plan, or one of a picture, which is not drawn by hand
    """
    if isinstance(document, dict) and "image" in document:
        raise PlanError("a plan of a picture is built as it is; draw over the picture with 'Floor plan' instead")
    building = building_of(document)
    made = {key: copy.deepcopy(value) for key, value in document.items() if key not in ("walls", "levels")}
    for number, level in enumerate(building.levels):
        part = (
            made if number == 0 else {key: copy.deepcopy(value) for key, value in document["levels"][number - 1].items() if key != "walls"}
        )
        part["walls"] = [_wall_entry(wall) for wall in level.walls]
        if number:
            made.setdefault("levels", []).append(part)
    return made


def _wall_entry(wall: Any) -> dict[str, Any]:
    look = {"color": list(wall.look.color)} if wall.look.color is not None else {"material": wall.look.material}
    entry: dict[str, Any] = {"from": list(wall.start), "to": list(wall.end), "thickness": wall.thickness, "height": wall.height, **look}
    for opening in wall.openings:
        hole = {"at": opening.at, "width": opening.width, "height": opening.height}
        if opening.kind == "window" or opening.sill:
            hole["sill"] = opening.sill
        entry.setdefault(opening.kind + "s", []).append(hole)
    return entry

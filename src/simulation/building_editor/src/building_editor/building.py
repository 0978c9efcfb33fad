"""Buildings from a short plan: walls with doors and windows, stairs, levels. The simulator's building editor.

A plan is YAML; metres, radians. What is not given takes the defaults of Gazebo's building editor::

    name: flat
    wall: {thickness: 0.15, height: 2.5, material: Gazebo/CeilingTiled}   # for all walls
    walls:
      - path: [[0, 0], [6, 0], [6, 4], [0, 4], [0, 0]]
        doors:   [{at: 1.5}]                 # metres along the path to the middle of the door
        windows: [{at: 8.0, width: 1.2}]
      - {from: [3, 0], to: [3, 2.5], color: [0.8, 0.7, 0.6]}
    stairs: [{at: [5, 2], yaw: 1.57}]        # middle of the lowest step's front edge, climbing along yaw
    levels:                                  # the floors above, each with walls, stairs, floor
      - walls: [...]
    models: [{model: table, at: [1, 2], yaw: 0.3}]

or a floor plan drawn dark on light, also one that map_server wrote: ``image: plan.png``, ``resolution: 0.05`` (m per
pixel), ``origin: [x, y, 0]``, ``occupied_thresh``, ``negate``.
"""

from __future__ import annotations

import math
import os
import reprlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from ode_sim.description.model import quoted

from building_editor.plan_file import PlanError, load_plan
from building_editor.plan_image import wall_rectangles

Point = tuple[float, float]


#: m: no wall lies farther out or is longer; what is smaller than the other one is nothing
FARTHEST, SMALLEST = 1e5, 1e-6
_MOST = 5000  # walls of a floor, models
_MOST_LEVELS = 200
_MOST_STAIRS, _MOST_STEPS = 200, 1000  # of a level; of stairs


@dataclass(frozen=True)
class Look:
    """A Gazebo material, or a plain colour (0..1) in its place."""

    material: str = "Gazebo/Grey"
    color: tuple[float, float, float] | None = None


@dataclass(frozen=True)
class Opening:
    """A hole in a wall: ``at`` is the distance of its middle from the wall's start, ``sill`` its lower edge; m."""

    kind: str  # "door" | "window"
    at: float
    width: float
    height: float
    sill: float


@dataclass(frozen=True)
class Wall:
    """A straight piece between two points (m).

    It reaches half its thickness beyond both, so that corners close; where it ends inside another wall, not at all.
    """

    start: Point
    end: Point
    thickness: float
    height: float
    look: Look
    openings: tuple[Opening, ...] = ()
    butts: tuple[bool, bool] = (False, False)  # start, end: ends inside another wall

    @property
    def reach(self) -> tuple[float, float]:
        """m beyond start and end."""
        start, end = (0.0 if butts else 0.5 * self.thickness for butts in self.butts)
        return start, end

    @property
    def length(self) -> float:
        return math.dist(self.start, self.end)

    @property
    def yaw(self) -> float:
        return math.atan2(self.end[1] - self.start[1], self.end[0] - self.start[0])


@dataclass(frozen=True)
class Stairs:
    """``at`` is the middle of the front edge of the lowest step; they climb along ``yaw``."""

    at: Point
    yaw: float
    width: float
    depth: float
    height: float
    steps: int
    look: Look


@dataclass(frozen=True)
class Level:
    base: float  # m, height of its floor
    walls: tuple[Wall, ...]
    stairs: tuple[Stairs, ...]
    floor: Look | None = None  # None: the ground


@dataclass(frozen=True)
class Placed:
    """A model of the model path that stands in the building."""

    model: str
    name: str
    at: tuple[float, float, float]
    yaw: float


@dataclass(frozen=True)
class Building:
    name: str
    levels: tuple[Level, ...]
    models: tuple[Placed, ...] = ()


# ---------------------------------------------------------------------------------------------- reading


class _Entry:
    """One mapping of the plan; knows its place (``walls[2].doors[0]``) for messages."""

    def __init__(self, value: Any, place: str, known: Sequence[str]):
        if not isinstance(value, dict):
            raise PlanError(f"{place}: must be a mapping such as {{{known[0]}: ...}}, not {_shown(value)}")
        for key in value:
            if key not in known:
                raise PlanError(f"{place}: there is no {_shown(key)} here; known are {', '.join(known)}")
        self.value, self.place = value, place

    def number(self, key: str, default: float | None = None, positive: bool = True, most: float = FARTHEST) -> float:
        """:param positive: it is a length, at least :data:`SMALLEST`. :param most: of either sign."""
        value = self.value.get(key, default)
        if value is None:
            raise PlanError(f"{self.place}: '{key}' is missing")
        if not _is_number(value):
            raise PlanError(f"{self.place}.{key}: {_shown(value)} is not a number")
        if positive and value < SMALLEST:
            raise PlanError(f"{self.place}.{key}: {value:g} must be positive" + (f", at least {SMALLEST:g}" if value > 0 else ""))
        if abs(value) > most:
            raise PlanError(f"{self.place}.{key}: {_shown(value)} is too much; at most {most:g}")
        return float(value)

    def text(self, key: str, default: str, most: int = 200) -> str:
        value = self.value.get(key)
        if value is None or value == "":
            return default
        if (
            not isinstance(value, (str, int, float))
            or (isinstance(value, int) and abs(value) > 10**18)
            or not str(value).isprintable()
            or len(str(value)) > most
        ):
            raise PlanError(f"{self.place}.{key}: {_shown(value)} is no name")
        return str(value)

    def numbers(self, key: str, sizes: tuple[int, ...]) -> tuple[float, ...]:
        if key not in self.value:
            raise PlanError(f"{self.place}: '{key}' is missing")
        return _numbers(self.value[key], f"{self.place}.{key}", sizes)

    def point(self, key: str) -> Point:
        x, y = self.numbers(key, (2,))
        return x, y

    def entries(self, key: str, most: int = _MOST) -> list[tuple[Any, str]]:
        value = self.value.get(key) or []
        prefix = self.place + "." if self.place != "plan" else ""
        if not isinstance(value, list):
            raise PlanError(f"{prefix}{key}: must be a list")
        if len(value) > most:
            raise PlanError(f"{prefix}{key}: {len(value)} entries; at most {most} are built")
        return [(item, f"{prefix}{key}[{i}]") for i, item in enumerate(value)]

    def look(self, default: Look) -> Look:
        color = self.value.get("color")
        if color is not None:
            r, g, b = _numbers(color, self.place + ".color", (3,))
            if not all(0.0 <= c <= 1.0 for c in (r, g, b)):
                raise PlanError(f"{self.place}.color: {_shown(color)} must be three numbers from 0 to 1")
            return Look(color=(r, g, b))
        return Look(self.text("material", default.material)) if "material" in self.value else default


class _Short(reprlib.Repr):
    maxlevel = 3

    def repr_int(self, x: int, level: int) -> str:  # repr of one of thousands of digits is an error
        return str(x) if abs(x) < 10**18 else f"{'-' * (x < 0)}1e{int(x.bit_length() * math.log10(2.0))}"


def _shown(value: Any) -> str:
    """A value of the plan for a message: short, however much hangs on it."""
    return f"'{quoted(value)}'" if isinstance(value, str) else quoted(_Short().repr(value))


def _is_number(value: Any) -> bool:
    try:
        return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
    except OverflowError:  # a whole number of hundreds of digits
        return False


def _numbers(value: Any, place: str, sizes: tuple[int, ...]) -> tuple[float, ...]:
    if not isinstance(value, (list, tuple)) or len(value) not in sizes or not all(map(_is_number, value)):
        raise PlanError(f"{place}: {_shown(value)} is not {' or '.join(str(size) for size in sizes)} numbers, [x, y]")
    if max(map(abs, value)) > FARTHEST:
        raise PlanError(f"{place}: {_shown(value)} is too far away; at most {FARTHEST:g} m")
    return tuple(float(v) for v in value)


_LOOK = ("material", "color")
_LEVEL = ("walls", "stairs", "height", "floor")


def read_plan(path: str, resolution: float | None = None) -> Building:
    """A :class:`Building` from ``path``, a YAML plan or an image (then ``resolution``, m per pixel, is needed).

    :raises PlanError: one line that names file and entry.
    """
    if os.path.splitext(path)[1].lower() in (".yaml", ".yml"):
        try:
            plan = load_plan(path)
        except ValueError as error:
            raise PlanError(error) from None
    else:
        plan = {"image": os.path.abspath(path), "name": os.path.splitext(os.path.basename(path))[0]}
    if isinstance(plan, dict) and "image" in plan:
        plan = dict(plan)
        plan.setdefault("name", os.path.splitext(os.path.basename(path))[0])
        if resolution is not None:
            plan["resolution"] = resolution
    try:
        return building_of(plan, os.path.dirname(os.path.abspath(path)))
    except PlanError as error:
        raise PlanError(f"{path}: {error}") from None


def building_of(plan: Any, folder: str = ".") -> Building:
    """As :func:`read_plan`, of a plan already read; ``folder`` is where its image is looked for."""
    top = _Entry(
        plan,
        "plan",
        (
            "walls",
            "name",
            "wall",
            "stairs",
            "levels",
            "models",
            "height",
            "image",
            "resolution",
            "origin",
            "negate",
            "occupied_thresh",
            "free_thresh",
            "mode",
        ),
    )
    defaults = _Entry(top.value.get("wall") or {}, "wall", ("thickness", "height") + _LOOK)
    look = defaults.look(Look())
    if "image" in top.value:
        walls = _walls_of_image(top, defaults, look, folder)
    else:
        walls = _walls(top, defaults, look)
    levels = [Level(0.0, tuple(walls), tuple(_stairs(top, look)))]
    base = top.number("height", max([wall.height for wall in walls], default=2.5))
    for value, place in top.entries("levels", _MOST_LEVELS):
        entry = _Entry(value, place, _LEVEL)
        floor = _Entry(entry.value.get("floor") or {}, place + ".floor", _LOOK).look(Look("Gazebo/Grey"))
        walls = _walls(entry, defaults, look)
        levels.append(Level(base, tuple(walls), tuple(_stairs(entry, look)), floor))
        if base > FARTHEST:
            raise PlanError(f"{place}: its floor is {base:g} m high; at most {FARTHEST:g} m")
        base += entry.number("height", max([wall.height for wall in walls], default=2.5))
    if not any(level.walls or level.stairs for level in levels):
        raise PlanError("walls: there are none; give at least one {from: [x, y], to: [x, y]}")
    return Building(top.text("name", "building"), tuple(levels), tuple(_models(top)))


def _walls(parent: _Entry, defaults: _Entry, default_look: Look) -> list[Wall]:
    walls: list[Wall] = []
    for value, place in parent.entries("walls"):
        entry = _Entry(value, place, ("from", "to", "path", "thickness", "height", "doors", "windows") + _LOOK)
        if "path" in entry.value:
            path = [(x, y) for x, y in (_numbers(point, at, (2,)) for point, at in entry.entries("path"))]
        else:
            path = [entry.point("from"), entry.point("to")]
        if len(path) < 2 or any(math.dist(a, b) < 1e-6 for a, b in zip(path, path[1:])):
            raise PlanError(f"{place}: a wall needs two different ends")
        thickness = entry.number("thickness", defaults.number("thickness", 0.15))
        height = entry.number("height", defaults.number("height", 2.5))
        openings = _openings(entry, height)
        look, done = entry.look(default_look), 0.0
        total = sum(math.dist(a, b) for a, b in zip(path, path[1:]))
        pieces: list[Wall] = []
        for start, end in zip(path, path[1:]):
            length = math.dist(start, end)
            mine = [(o, at) for o, at in openings if done <= o.at < done + length or (o.at == total and end == path[-1])]
            for opening, at in mine:
                if min(opening.at - done, done + length - opening.at) < 0.5 * opening.width - 1e-9:
                    raise PlanError(
                        f"{at}: {opening.width:g} m wide at {opening.at:g} m does not fit; this piece of "
                        f"wall runs from {done:g} to {done + length:g} m"
                    )
            pieces.append(
                Wall(start, end, thickness, height, look, tuple(Opening(o.kind, o.at - done, o.width, o.height, o.sill) for o, _ in mine))
            )
            done += length
        for opening, at in openings:
            if not 0.0 <= opening.at <= total:
                raise PlanError(f"{at}: {opening.at:g} m is beyond the wall, which is {total:g} m long")
        walls += pieces
        if len(walls) > _MOST:
            raise PlanError(f"{place}: more than {_MOST} pieces of wall on one floor")
    return _with_butts(walls)


def _with_butts(walls: list[Wall]) -> list[Wall]:
    """The walls, each knowing whether its ends lie in the body of another one, away from that one's ends."""
    if not walls:
        return walls
    starts, yaws = np.array([wall.start for wall in walls]), np.array([wall.yaw for wall in walls])
    along_x, along_y = np.cos(yaws), np.sin(yaws)
    halves = 0.5 * np.array([wall.thickness for wall in walls])
    lengths = np.array([wall.length for wall in walls])

    def inside(point: Point, own: int) -> bool:
        dx, dy = (np.array(point) - starts).T
        along = dx * along_x + dy * along_y
        aside = np.abs(dy * along_x - dx * along_y)
        hit = (aside < halves) & (halves < along) & (along < lengths - halves)
        hit[own] = False
        return bool(hit.any())

    return [replace(wall, butts=(inside(wall.start, i), inside(wall.end, i))) for i, wall in enumerate(walls)]


def _openings(wall: _Entry, wall_height: float) -> list[tuple[Opening, str]]:
    found = []
    for key, kind, width, height, sill in (("doors", "door", 0.9, 2.0, 0.0), ("windows", "window", 0.8, 0.8, 0.5)):
        for value, place in wall.entries(key):
            entry = _Entry(value, place, ("at", "width", "height", "sill"))
            opening = Opening(
                kind,
                entry.number("at", positive=False),
                entry.number("width", width),
                entry.number("height", height),
                entry.number("sill", sill, positive=False),
            )
            if opening.sill < 0.0 or opening.sill + opening.height > wall_height + 1e-9:
                raise PlanError(
                    f"{place}: reaches from {opening.sill:g} to {opening.sill + opening.height:g} m; the wall is {wall_height:g} m high"
                )
            found.append((opening, place))
    return found


def _stairs(parent: _Entry, default_look: Look) -> list[Stairs]:
    stairs = []
    for value, place in parent.entries("stairs", _MOST_STAIRS):
        entry = _Entry(value, place, ("at", "yaw", "width", "depth", "height", "steps") + _LOOK)
        steps = entry.number("steps", 15, most=_MOST_STEPS)
        if steps != int(steps):
            raise PlanError(f"{place}.steps: {steps:g} is no whole number")
        stairs.append(
            Stairs(
                entry.point("at"),
                entry.number("yaw", 0.0, positive=False),
                entry.number("width", 1.0),
                entry.number("depth", 3.5),
                entry.number("height", 2.5),
                int(steps),
                entry.look(default_look),
            )
        )
    return stairs


def _models(top: _Entry) -> list[Placed]:
    models: list[Placed] = []
    names: dict[str, int] = {}
    for value, place in top.entries("models"):
        entry = _Entry(value, place, ("model", "at", "yaw", "name"))
        model = entry.value.get("model")
        if not model or not isinstance(model, str) or not model.isprintable():
            raise PlanError(f"{place}: 'model' is missing, the name of a model directory such as table")
        count = names[model] = names.get(model, -1) + 1
        name = entry.text("name", f"{model}_{count}" if count else model)
        x, y, *z = entry.numbers("at", (2, 3))
        models.append(Placed(model, name, (x, y, z[0] if z else 0.0), entry.number("yaw", 0.0, positive=False)))
    return models


def _walls_of_image(top: _Entry, defaults: _Entry, look: Look, folder: str) -> list[Wall]:
    if "walls" in top.value:
        raise PlanError("image: takes the place of 'walls'; give one of the two")
    resolution = top.number("resolution", None, most=100.0)
    x, y = top.numbers("origin", (2, 3))[:2] if "origin" in top.value else (0.0, 0.0)
    height = defaults.number("height", 2.5)
    rectangles = wall_rectangles(
        os.path.join(folder, top.text("image", "", most=4096)),
        resolution,
        (x, y),
        top.number("occupied_thresh", 0.5),
        bool(top.value.get("negate", 0)),
    )
    if max(abs(value) for rectangle in rectangles for value in rectangle) > FARTHEST:
        raise PlanError(f"resolution: with {resolution:g} m per pixel the picture reaches farther than {FARTHEST:g} m")
    walls = []
    for x0, y0, x1, y1 in rectangles:  # a wall reaches half its thickness beyond its ends
        half = 0.5 * min(x1 - x0, y1 - y0)
        if x1 - x0 >= y1 - y0:
            middle, ends = 0.5 * (y0 + y1), (x0 + half, x1 - half)
            start, end = (ends[0], middle), (ends[1], middle)
        else:
            middle, ends = 0.5 * (x0 + x1), (y0 + half, y1 - half)
            start, end = (middle, ends[0]), (middle, ends[1])
        walls.append(Wall(start, end, 2.0 * half, height, look))
    return walls

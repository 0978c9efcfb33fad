"""A plan of a building that is known as a model only, as Gazebo's own editor leaves it: links Wall_n, Stairs_n and Floor_n of boxes.

A wall is what its boxes cover together; what they leave open inside is a door where it reaches the floor, else a window.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from ode_sim.description import model as d
from ode_sim.description.materials import NAMES, gazebo_material
from ode_sim.math3 import Pose, compose, to_rpy, transform

_KIND = re.compile(r"(Wall|Stairs|Floor)_\d+")
_SAME = 2e-3  # m: Gazebo writes six digits, and ends of walls that meet differ by what they round
_LEANS = 1e-3  # rad
_STOREY = 0.3  # m: what stands nearer above each other is on one level: a wall on its floor, or in it
Span = tuple[float, float]
Hole = tuple[Span, Span]  # x, z


class _Strange(Exception):
    """What a link is in place of a part of a building; a few words."""


@dataclass(frozen=True)
class _Box:
    """In the frame of its link, m."""

    x: Span
    y: Span
    z: Span


@dataclass(frozen=True)
class _Part:
    kind: str
    name: str
    pose: Pose  # X_WL
    boxes: tuple[_Box, ...]
    look: dict[str, Any]

    @property
    def bottom(self) -> float:
        return self.pose.p[2] + min(box.z[0] for box in self.boxes)

    def at(self, x: float, y: float) -> list[float]:
        """A place of the link's frame on the plan."""
        return [round(v, 4) + 0.0 for v in transform(self.pose, (x, y, 0.0))[:2]]


def plan_of(model: d.Model) -> tuple[dict[str, Any], list[str]]:
    """The document of a plan, and what of the model it does not hold: a few words for each.

    Floors are laid anew by a plan; of those here only the look is kept.
    """
    parts, left = [], []
    for link in model.links:
        try:
            parts.append(_part(model, link))
        except _Strange as error:
            left.append(f"{link.name} ({error})")
    document: dict[str, Any] = {"name": model.name, "walls": []}
    bases = _bases(part.bottom for part in parts if part.kind != "Floor")
    ends: list[list[float]] = []
    for number, base in enumerate(bases):
        here = [part for part in parts if part.kind != "Floor" and base <= part.bottom < base + _STOREY]
        level: dict[str, Any] = document if number == 0 else {"walls": []}
        for part in here:
            try:
                kind, entry = ("walls", _wall(part)) if part.kind == "Wall" else ("stairs", _stairs(part))
            except _Strange as error:
                left.append(f"{part.name} ({error})")
                continue
            level.setdefault(kind, []).append(entry)
        for wall in level["walls"]:
            _join(wall, ends)
        if number + 1 < len(bases):
            level["height"] = round(bases[number + 1] - base, 4)
        if number:
            floor = next((part.look for part in parts if part.kind == "Floor" and abs(part.pose.p[2] - base) < _STOREY), {})
            document.setdefault("levels", []).append({**level, **({"floor": floor} if floor else {})})
    if bases and abs(bases[0]) > _SAME:
        left.append(f"its height of {bases[0]:.3g} m (a plan begins on the ground)")
    return document, left


def _part(model: d.Model, link: d.Link) -> _Part:
    match = _KIND.fullmatch(link.name)
    if match is None:
        raise _Strange("no wall, stairs or floor")
    pose = compose(model.pose, link.pose)
    if max(map(abs, to_rpy(pose)[:2])) > _LEANS:
        raise _Strange("it leans")
    shapes: Sequence[Any] = link.collisions or link.visuals
    if not shapes:
        raise _Strange("it is empty")
    return _Part(match.group(1), link.name, pose, tuple(map(_box, shapes)), _look(link.visuals))


def _box(shape: Any) -> _Box:
    if not isinstance(shape.geometry, d.Box):
        raise _Strange("not of boxes")
    if max(map(abs, to_rpy(shape.pose))) > _LEANS:
        raise _Strange("a box of it is turned")
    x, y, z = ((p - size / 2, p + size / 2) for p, size in zip(shape.pose.p, shape.geometry.size))
    return _Box(x, y, z)


def _look(visuals: Sequence[d.Visual]) -> dict[str, Any]:
    """Gazebo's editor gives a colour as another ambient light of a material, white where there is none."""
    material = visuals[0].material if visuals else None
    if material is None:
        return {}
    named = gazebo_material(material.name) if material.name in NAMES else None
    if named is not None and material.ambient in (None, named.ambient, (1.0, 1.0, 1.0, 1.0)):
        return {"material": material.name}
    colour = material.ambient or material.diffuse
    return {"color": [round(min(1.0, max(0.0, part)), 4) for part in colour[:3]]} if colour else {}


def _bases(heights: Iterator[float]) -> list[float]:
    """Of the levels, m, from below."""
    bases: list[float] = []
    for height in sorted(heights):
        if not bases or height >= bases[-1] + _STOREY:
            bases.append(height)
    return bases


# ---------------------------------------------------------------------------------------------- walls


def _wall(part: _Part) -> dict[str, Any]:
    boxes = part.boxes
    (x0, x1), (y0, y1), (z0, z1) = (_around([getattr(box, axis) for box in boxes]) for axis in "xyz")
    if any(abs(box.y[0] - y0) > _SAME or abs(box.y[1] - y1) > _SAME for box in boxes):
        raise _Strange("not of one thickness")
    thickness, y = y1 - y0, (y0 + y1) / 2
    start, end = x0 + thickness / 2, x1 - thickness / 2  # a wall reaches half its thickness beyond its ends
    if end - start < _SAME:
        raise _Strange("shorter than it is thick")
    entry: dict[str, Any] = {
        "from": part.at(start, y),
        "to": part.at(end, y),
        "thickness": round(thickness, 4),
        "height": round(z1 - z0, 4),
        **part.look,
    }
    length = math.dist(entry["from"], entry["to"])
    for (left, right), (low, high) in _holes(boxes):
        left, right = max(left - start, 0.0), min(right - start, length)
        sill, top = round(low - z0, 4), min(round(high - z0, 4), entry["height"])
        if right - left < _SAME:
            continue
        kind = "doors" if sill < _SAME else "windows"
        hole = {"at": round((left + right) / 2, 6), "width": round(right - left, 6) - 1e-6, "height": round(top - sill, 4)}
        entry.setdefault(kind, []).append(hole if kind == "doors" else {**hole, "sill": sill})
    return entry


def _around(spans: Sequence[Span]) -> Span:
    return min(low for low, _ in spans), max(high for _, high in spans)


def _holes(boxes: Sequence[_Box]) -> list[Hole]:
    """What the boxes leave open of the rectangle around them, in rectangles."""
    xs, zs = _cuts([box.x for box in boxes]), _cuts([box.z for box in boxes])
    holes: list[Hole] = []
    growing: dict[Span, float] = {}  # open from here on: z -> x
    for x0, x1 in [*zip(xs, xs[1:]), (xs[-1], math.inf)]:
        open_here = set() if math.isinf(x1) else set(_gaps(boxes, (x0 + x1) / 2, zs))
        holes += [((growing.pop(z), x0), z) for z in sorted(set(growing) - open_here)]
        for z in open_here - set(growing):
            growing[z] = x0
    return sorted(holes)


def _gaps(boxes: Sequence[_Box], x: float, zs: Sequence[float]) -> list[Span]:
    """What is open above one place of the wall."""
    gaps: list[Span] = []
    for z0, z1 in zip(zs, zs[1:]):
        middle = (z0 + z1) / 2
        if any(box.x[0] <= x <= box.x[1] and box.z[0] <= middle <= box.z[1] for box in boxes):
            continue
        if gaps and gaps[-1][1] == z0:
            gaps[-1] = (gaps[-1][0], z1)
        else:
            gaps.append((z0, z1))
    return gaps


def _cuts(spans: Sequence[Span]) -> list[float]:
    """Where boxes begin and end; what is nearly the same is the same."""
    cuts: list[float] = []
    for value in sorted(value for span in spans for value in span):
        if not cuts or value > cuts[-1] + _SAME:
            cuts.append(value)
    return cuts


def _join(wall: dict[str, Any], ends: list[list[float]]) -> None:
    """Ends that meet but for what was rounded are the same, so that a hand takes them along."""
    for end in ("from", "to"):
        place = next((other for other in ends if math.dist(other, wall[end]) < _SAME), None)
        if place is None:
            ends.append(wall[end])
        else:
            wall[end] = list(place)


# ---------------------------------------------------------------------------------------------- stairs


def _stairs(part: _Part) -> dict[str, Any]:
    """Steps are boxes one behind and above the other."""
    steps = sorted(part.boxes, key=lambda box: box.z[1])
    lowest, highest = (((box.x[0] + box.x[1]) / 2, (box.y[0] + box.y[1]) / 2) for box in (steps[0], steps[-1]))
    run = math.dist(lowest, highest)
    if len(steps) < 2 or run < _SAME:
        raise _Strange("its steps do not climb")
    ahead = ((highest[0] - lowest[0]) / run, (highest[1] - lowest[1]) / run)
    if min(map(abs, ahead)) > _LEANS:
        raise _Strange("its steps climb askew")
    across = steps[0].y if abs(ahead[0]) > 0.5 else steps[0].x
    tread = run / (len(steps) - 1)
    yaw = to_rpy(part.pose)[2] + math.atan2(ahead[1], ahead[0])
    return {
        "at": part.at(lowest[0] - ahead[0] * tread / 2, lowest[1] - ahead[1] * tread / 2),
        "yaw": round(yaw % (2 * math.pi), 6),
        "width": round(across[1] - across[0], 4),
        "depth": round(tread * len(steps), 4),
        "height": round(steps[-1].z[1] - min(box.z[0] for box in steps), 4),
        "steps": len(steps),
        **part.look,
    }

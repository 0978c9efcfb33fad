"""A building as SDF 1.6, laid out as Gazebo's building editor lays it out: links Wall_n, Stairs_n, Floor_n of boxes."""

from __future__ import annotations

import math
import os
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence

from ode_sim.whole_files import write_whole

from building_editor.building import Building, Level, Look, PlanError, Stairs, Wall

FLOOR_THICKNESS = 0.1
_INSET = 0.01  # m: the edge of a floor stays inside the walls, else both faces flicker
_MATERIALS = "file://media/materials/scripts/gazebo.material"
Box = tuple[tuple[float, float, float], tuple[float, float, float]]  # middle, size; m, in the link frame
Rectangle = tuple[float, float, float, float]  # x0, y0, x1, y1


def wall_boxes(wall: Wall) -> list[Box]:
    """The wall without its openings, in its link frame: origin on the floor at the wall's middle, x along it."""
    ends = (-0.5 * wall.length - wall.reach[0], 0.5 * wall.length + wall.reach[1])
    holes = [
        (o.at - 0.5 * o.width - 0.5 * wall.length, o.at + 0.5 * o.width - 0.5 * wall.length, o.sill, o.sill + o.height)
        for o in wall.openings
    ]
    cuts = sorted(set(ends) | {x for hole in holes for x in hole[:2]})
    columns: list[tuple[float, float, list[tuple[float, float]]]] = []
    for x0, x1 in zip(cuts, cuts[1:]):
        solid, z = [], 0.0
        for low, high in sorted((a, b) for left, right, a, b in holes if left < x1 and right > x0):
            if low > z + 1e-9:
                solid.append((z, low))
            z = max(z, high)
        if z < wall.height - 1e-9:
            solid.append((z, wall.height))
        if columns and columns[-1][2] == solid:
            columns[-1] = (columns[-1][0], x1, solid)
        else:
            columns.append((x0, x1, solid))
    return [((0.5 * (x0 + x1), 0.0, 0.5 * (z0 + z1)), (x1 - x0, wall.thickness, z1 - z0)) for x0, x1, solid in columns for z0, z1 in solid]


def stair_boxes(stairs: Stairs) -> list[Box]:
    """Solid steps of ``stairs``, in the frame at the front edge of the lowest, x in the direction of climbing."""
    tread, rise = stairs.depth / stairs.steps, stairs.height / stairs.steps
    return [(((i + 0.5) * tread, 0.0, 0.5 * (i + 1) * rise), (tread, stairs.width, (i + 1) * rise)) for i in range(stairs.steps)]


def outline(levels: Sequence[Level]) -> Rectangle:
    """What the walls and stairs of ``levels`` cover, seen from above."""
    xs, ys = [], []
    for level in levels:
        for wall in level.walls:
            half = 0.5 * wall.thickness
            xs += [p[0] + s * half for p in (wall.start, wall.end) for s in (-1, 1)]
            ys += [p[1] + s * half for p in (wall.start, wall.end) for s in (-1, 1)]
        for stairs in level.stairs:
            x0, y0, x1, y1 = stairwell(stairs)
            xs += [x0, x1]
            ys += [y0, y1]
    return min(xs), min(ys), max(xs), max(ys)


def stairwell(stairs: Stairs) -> Rectangle:
    """The upright rectangle around the stairs."""
    c, s = math.cos(stairs.yaw), math.sin(stairs.yaw)
    corners = [
        (stairs.at[0] + c * x - s * y, stairs.at[1] + s * x + c * y)
        for x in (0.0, stairs.depth)
        for y in (-0.5 * stairs.width, 0.5 * stairs.width)
    ]
    return (min(x for x, _ in corners), min(y for _, y in corners), max(x for x, _ in corners), max(y for _, y in corners))


def floor_pieces(area: Rectangle, holes: Sequence[Rectangle]) -> list[Rectangle]:
    """``area`` without ``holes``, in upright rectangles."""
    pieces = [area]
    for hx0, hy0, hx1, hy1 in holes:
        rest: list[Rectangle] = []
        for x0, y0, x1, y1 in pieces:
            if hx0 >= x1 or hx1 <= x0 or hy0 >= y1 or hy1 <= y0:
                rest.append((x0, y0, x1, y1))
                continue
            left, right = max(x0, hx0), min(x1, hx1)
            rest += [
                piece
                for piece in ((x0, y0, left, y1), (right, y0, x1, y1), (left, y0, right, max(y0, hy0)), (left, min(y1, hy1), right, y1))
                if piece[2] - piece[0] > 1e-9 and piece[3] - piece[1] > 1e-9
            ]
        pieces = rest
    return pieces


# ---------------------------------------------------------------------------------------------- SDF


def model_element(building: Building) -> ET.Element:
    """The ``<model>``, static; its origin is the middle of the building on the ground."""
    x0, y0, x1, y1 = outline(building.levels)
    middle = (0.5 * (x0 + x1), 0.5 * (y0 + y1))
    model = ET.Element("model", name=building.name)
    _text(model, "pose", _pose(*middle, 0.0))
    for name, x, y, z, yaw, boxes, look in _links(building):
        link = ET.SubElement(model, "link", name=name)
        _text(link, "pose", _pose(x - middle[0], y - middle[1], z, yaw))
        for i, (position, size) in enumerate(boxes):
            suffix = f"_{i}" if len(boxes) > 1 else ""
            for kind in ("Collision", "Visual"):
                shape = ET.SubElement(link, kind.lower(), name=f"{name}_{kind}{suffix}")
                _text(shape, "pose", _pose(*position))
                _text(ET.SubElement(ET.SubElement(shape, "geometry"), "box"), "size", _numbers(size))
                if kind == "Visual":
                    shape.append(_material(look))
    _text(model, "static", "1")
    return model


def _links(building: Building) -> Iterator[tuple[str, float, float, float, float, list[Box], Look]]:
    """name, x, y, z, yaw, boxes, look"""
    wall_number = stairs_number = 0
    for number, level in enumerate(building.levels):
        for wall in level.walls:
            boxes = wall_boxes(wall)
            if boxes:
                yield (
                    f"Wall_{wall_number}",
                    0.5 * (wall.start[0] + wall.end[0]),
                    0.5 * (wall.start[1] + wall.end[1]),
                    level.base,
                    wall.yaw,
                    boxes,
                    wall.look,
                )
            wall_number += 1
        for stairs in level.stairs:
            yield (f"Stairs_{stairs_number}", *stairs.at, level.base, stairs.yaw, stair_boxes(stairs), stairs.look)
            stairs_number += 1
        if level.floor is not None:
            below = building.levels[number - 1]
            x0, y0, x1, y1 = outline([near for near in (below, level) if near.walls or near.stairs])
            area = (x0 + _INSET, y0 + _INSET, x1 - _INSET, y1 - _INSET)
            pieces = floor_pieces(area, [stairwell(stairs) for stairs in below.stairs])
            yield (
                f"Floor_{number}",
                0.0,
                0.0,
                level.base,
                0.0,
                [((0.5 * (a + c), 0.5 * (b + d), -0.5 * FLOOR_THICKNESS), (c - a, d - b, FLOOR_THICKNESS)) for a, b, c, d in pieces],
                level.floor,
            )


def _material(look: Look) -> ET.Element:
    material = ET.Element("material")
    if look.color is not None:
        for tag in ("ambient", "diffuse"):
            _text(material, tag, _numbers(look.color + (1.0,)))
    else:
        script = ET.SubElement(material, "script")
        _text(script, "uri", _MATERIALS)
        _text(script, "name", look.material)
    return material


def world_text(building: Building) -> str:
    """A world with sun, floor, the building, and the models placed in it."""
    sdf = ET.Element("sdf", version="1.6")
    world = ET.SubElement(sdf, "world", name="default")
    for uri in ("model://sun", "model://ground_plane"):
        _text(ET.SubElement(world, "include"), "uri", uri)
    world.append(model_element(building))
    for placed in building.models:
        include = ET.SubElement(world, "include")
        _text(include, "uri", "model://" + placed.model)
        _text(include, "name", placed.name)
        _text(include, "pose", _pose(*placed.at, placed.yaw))
    return _document(sdf)


def model_text(building: Building) -> str:
    """``building`` as the text of model.sdf."""
    sdf = ET.Element("sdf", version="1.6")
    sdf.append(model_element(building))
    return _document(sdf)


def config_text(building: Building) -> str:
    """The text of model.config for ``building``."""
    config = ET.Element("model")
    _text(config, "name", building.name)
    _text(config, "version", "1.0")
    _text(config, "sdf", "model.sdf").set("version", "1.6")
    _text(config, "description", "A building made by build_world.")
    return _document(config)


def write(building: Building, output: str) -> None:
    """Write ``building`` by the name of ``output``: a world, a model, or a model directory (ends with ``/``, or is one).

    :raises PlanError: the name tells none of these.
    """
    suffix = os.path.splitext(output)[1].lower()
    if output.endswith("/") or os.path.isdir(output):
        os.makedirs(output, exist_ok=True)
        files = {os.path.join(output, "model.sdf"): model_text(building), os.path.join(output, "model.config"): config_text(building)}
    elif suffix == ".world":
        files = {output: world_text(building)}
    elif suffix == ".sdf":
        files = {output: model_text(building)}
    else:
        raise PlanError(f"output '{output}': give it the ending .world or .sdf, or a / for a model directory")
    for name, text in files.items():
        write_whole(name, text)


def _document(root: ET.Element) -> str:
    ET.indent(root)
    return '<?xml version="1.0"?>\n' + ET.tostring(root, encoding="unicode") + "\n"


def _text(parent: ET.Element, tag: str, text: str) -> ET.Element:
    element = ET.SubElement(parent, tag)
    element.text = text
    return element


def _numbers(values) -> str:
    return " ".join(f"{round(value, 6) + 0.0:g}" if abs(value) < 1e4 else f"{value:.10g}" for value in values)


def _pose(x: float, y: float, z: float, yaw: float = 0.0) -> str:
    return " ".join(f"{round(value, 9) + 0.0:.10g}" for value in (x, y, z, 0.0, 0.0, yaw))

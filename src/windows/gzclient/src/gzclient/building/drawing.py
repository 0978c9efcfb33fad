"""The plan in the page: a sheet to draw on, and the building that stands on it."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from building_editor.building import Building, Look, Stairs, Wall
from building_editor.sdf_model import FLOOR_THICKNESS, floor_pieces, outline, stair_boxes, stairwell, wall_boxes
from ode_sim.description.materials import gazebo_material
from ode_sim.math3 import quat_from_rpy
from ode_sim_viewer.drawing import rgb255, wxyz

from gzclient.building.plan import Element, Plan, Point

_SHEET = 60.0  # m along a side
_OPENINGS = {"door": (150, 90, 40), "window": (110, 180, 230)}
_GHOST = (30, 110, 230)
_PICKED = (255, 170, 0)
_CUBE = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
_SIDES = np.array(
    [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)],
    np.uint32,
)

Hook = Callable[[Any, Element | None], None]  # mesh, the element it is (None: the sheet)


def boxes_mesh(boxes: list[tuple]) -> tuple[np.ndarray, np.ndarray]:
    """((N, 3) float32, (M, 3) uint32) of boxes (middle, size)."""
    vertices = [np.asarray(middle) + _CUBE * np.asarray(size) for middle, size in boxes]
    triangles = [_SIDES + np.uint32(8 * number) for number in range(len(boxes))]
    return np.concatenate(vertices).astype(np.float32), np.concatenate(triangles)


def colour_of(look: Look) -> tuple[int, int, int]:
    if look.color is not None:
        return rgb255(look.color)
    material = gazebo_material(look.material)
    return rgb255((material and material.diffuse) or (0.8, 0.8, 0.8))


class PlanDrawing:
    """Drawing thread. ``hook`` is given every new mesh, to listen to clicks and drags on it."""

    def __init__(self, scene: Any, hook: Hook):
        self._scene = scene
        self._hook = hook
        self._nodes: dict[str, tuple[Any, Any]] = {}  # name -> (what it shows, handle)
        self._ghost: Any | None = None
        self._sheet: Any | None = None
        self._grid: Any | None = None
        self._picture: Any | None = None

    def close(self) -> None:
        for _, handle in self._nodes.values():
            handle.remove()
        self._nodes.clear()
        self.ghost(None)
        for name in ("_sheet", "_grid", "_picture"):
            if getattr(self, name) is not None:
                getattr(self, name).remove()
                setattr(self, name, None)

    # ------------------------------------------------------------------------------------------ the sheet

    def sheet(self, height: float, snap: float) -> None:
        """Show the sheet to draw on at ``height``, that of a level's floor, with a grid of ``snap`` (both m; cells of 0.05 m at least)."""
        if self._sheet is None or self._grid is None:
            vertices, triangles = boxes_mesh([((0.0, 0.0, -0.005), (_SHEET, _SHEET, 0.01))])
            self._sheet = self._scene.add_mesh_simple("/plan/sheet", vertices, triangles, color=(236, 240, 246), cast_shadow=False)
            self._hook(self._sheet, None)
            self._grid = self._scene.add_grid(
                "/plan/grid",
                width=_SHEET,
                height=_SHEET,
                cell_size=max(snap, 0.05),
                section_size=1.0,
                cell_thickness=0.5,
                section_thickness=1.0,
                cell_color=(205, 212, 224),
                section_color=(160, 172, 190),
                shadow_opacity=0.0,
            )
        self._sheet.position, self._grid.position = (0.0, 0.0, height), (0.0, 0.0, height + 0.004)
        self._grid.cell_size = max(snap, 0.05)

    def picture(self, pixels: np.ndarray | None, resolution: float) -> None:
        """A floor plan to draw over, its lower left corner at the origin; None takes it away.

        :param pixels: (rows, columns, 3) uint8
        :param resolution: m per pixel
        """
        if self._picture is not None:
            self._picture.remove()
            self._picture = None
        if pixels is not None:
            height, width = pixels.shape[:2]
            # viser's images look along -z of their frame, their first row at +y of it after half a turn about x
            self._picture = self._scene.add_image(
                "/plan/picture",
                pixels,
                width * resolution,
                height * resolution,
                format="jpeg",
                cast_shadow=False,
                receive_shadow=False,
                wxyz=(0.0, 1.0, 0.0, 0.0),
                position=(width * resolution / 2, height * resolution / 2, 0.003),
            )

    # ------------------------------------------------------------------------------------------ the building

    def show(self, plan: Plan, building: Building | None, picked: Element | None, whole: bool) -> None:
        """What has changed since the last call.

        :param plan: says which level is drawn on
        :param building: what ``plan`` makes; None: nothing is drawn
        :param picked: it is drawn in another colour
        :param whole: all levels; else those up to the one that is drawn on
        """
        wanted: dict[str, tuple] = {}
        for number, level in enumerate(building.levels if building is not None else ()):
            if not whole and number > plan.level:
                continue
            for at, wall in enumerate(level.walls):
                self._want_wall(wanted, number, at, wall, level.base, picked)
            for at, stairs in enumerate(level.stairs):
                element = Element(number, "stairs", at)
                wanted[f"s{number}_{at}"] = (element, stairs, level.base, _paint(stairs.look, element == picked))
            if building is not None and level.floor is not None and (whole or number < plan.level):
                wanted[f"f{number}"] = (None, tuple(_floor(building, number)), level.base, colour_of(level.floor))
        for name in [name for name, (content, _) in self._nodes.items() if wanted.get(name) != content]:
            self._nodes.pop(name)[1].remove()
        for name, content in wanted.items():
            if name not in self._nodes:
                self._nodes[name] = (content, self._make(f"/plan/{name}", *content))

    @staticmethod
    def _want_wall(wanted: dict, number: int, at: int, wall: Wall, base: float, picked: Element | None) -> None:
        element = Element(number, "walls", at)
        wanted[f"w{number}_{at}"] = (element, wall, base, _paint(wall.look, element == picked))
        counts = {"door": 0, "window": 0}
        for opening in wall.openings:
            hole = Element(number, opening.kind + "s", counts[opening.kind], at)
            counts[opening.kind] += 1
            colour = _PICKED if hole == picked else _OPENINGS[opening.kind]
            wanted[f"{hole.kind}{number}_{at}_{hole.index}"] = (hole, (wall, opening), base, colour)

    def _make(self, node: str, element: Element | None, content: Any, base: float, colour: tuple) -> Any:
        opacity, yaw, place = None, 0.0, (0.0, 0.0, base)
        if isinstance(content, Wall):
            boxes, yaw, place = wall_boxes(content), content.yaw, _middle(content, base)
        elif isinstance(content, Stairs):
            boxes, yaw, place = stair_boxes(content), content.yaw, (*content.at, base)
        elif element is None:
            boxes = list(content)
        else:
            wall, opening = content
            boxes = [
                (
                    (opening.at - wall.length / 2, 0.0, opening.sill + opening.height / 2),
                    (opening.width, wall.thickness + 0.02, opening.height),
                )
            ]
            opacity, yaw, place = 0.5, wall.yaw, _middle(wall, base)
        vertices, triangles = boxes_mesh(boxes or [((0.0, 0.0, 0.0), (0.01, 0.01, 0.01))])
        mesh = self._scene.add_mesh_simple(
            node,
            vertices,
            triangles,
            color=colour,
            opacity=opacity,
            flat_shading=True,
            position=place,
            wxyz=wxyz(quat_from_rpy(0.0, 0.0, yaw)),
        )
        if element is not None:
            self._hook(mesh, element)
        return mesh

    def ghost(self, line: tuple[Point, Point] | None, base: float = 0.0, thickness: float = 0.15) -> None:
        """What a hand is about to draw.

        :param line: both ends, m, in the world; None: nothing
        :param base: height of the floor, m
        :param thickness: of a wall, m
        """
        if line is None:
            if self._ghost is not None:
                self._ghost.remove()
                self._ghost = None
            return
        start, end = line
        length = max(math.dist(start, end), 0.02)
        if self._ghost is None:
            vertices, triangles = boxes_mesh([((0.5, 0.0, 0.5), (1.0, 1.0, 1.0))])
            self._ghost = self._scene.add_mesh_simple("/plan_ghost", vertices, triangles, color=_GHOST, opacity=0.6, cast_shadow=False)
        self._ghost.scale = (length, thickness, 0.3)
        self._ghost.position = (*start, base)
        self._ghost.wxyz = wxyz(quat_from_rpy(0.0, 0.0, math.atan2(end[1] - start[1], end[0] - start[0])))


def _paint(look: Look, picked: bool) -> tuple[int, int, int]:
    return _PICKED if picked else colour_of(look)


def _middle(wall: Wall, base: float) -> tuple[float, float, float]:
    return (wall.start[0] + wall.end[0]) / 2, (wall.start[1] + wall.end[1]) / 2, base


def _floor(building: Building, number: int) -> list[tuple]:
    """Boxes of the floor of a level, as :mod:`building_editor.sdf_model` builds it."""
    below, level = building.levels[number - 1], building.levels[number]
    near = [part for part in (below, level) if part.walls or part.stairs]
    if not near:
        return []
    return [
        (((x0 + x1) / 2, (y0 + y1) / 2, -FLOOR_THICKNESS / 2), (x1 - x0, y1 - y0, FLOOR_THICKNESS))
        for x0, y0, x1, y1 in floor_pieces(outline(near), [stairwell(stairs) for stairs in below.stairs])
    ]

"""Markers of visualization_msgs, drawn as RViz draws them."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from ode_sim.errors import SimulationError
from ode_sim.math3 import Pose
from ode_sim_rendering import geometry
from ode_sim_viewer.drawing import rgb255, take_away, wxyz
from visualization_msgs.msg import Marker

_MOST = 2000  # markers of one topic
_MOST_POINTS = 100_000  # of one marker
_SHAPES = {
    Marker.CUBE: geometry.box,
    Marker.SPHERE: geometry.sphere,
    Marker.CYLINDER: geometry.cylinder,
    Marker.CUBE_LIST: geometry.box,
    Marker.SPHERE_LIST: geometry.sphere,
}
_MESHES = ("package://", "model://")  # a topic cannot have other files shown


class Unfit(SimulationError, ValueError):
    """A marker that cannot be drawn; one line that says why."""


class _Kept(NamedTuple):
    content: tuple
    node: Any
    frame: str
    until: float  # s of sim time


class Markers:
    """Those of one topic. Drawing thread.

    :param root: name that its scene nodes begin with. :param find: URI of a mesh -> file or None
    """

    def __init__(self, scene: Any, root: str, find: Callable[[str], str | None] = lambda uri: None):
        self._scene = scene
        self._root = root
        self._find = find
        self._kept: dict[tuple[str, int], _Kept] = {}
        self._frames: dict[str, Any] = {}  # frame_id -> the node that carries its markers
        self._serial = 0

    def __len__(self) -> int:
        return len(self._kept)

    def take(self, marker: Any, now: float) -> None:
        """Add, change or delete.

        :param marker: a visualization_msgs/Marker
        :param now: s of sim time, for its lifetime
        :raises Unfit: it cannot be drawn; what was drawn of that name before has gone
        """
        key = (marker.ns, marker.id)
        if marker.action == 3:  # DELETEALL
            self.clear()
            return
        if marker.action == Marker.DELETE:
            self._drop(key)
            return
        if marker.action != Marker.ADD:
            raise Unfit(f"marker {marker.ns}/{marker.id}: there is no action {marker.action}")
        before = self._kept.get(key)
        try:
            pose, content = _pose(marker), _content(marker)
        except Unfit:
            self._drop(key)
            raise
        lifetime = marker.lifetime.to_sec()
        until = now + lifetime if lifetime > 0.0 else math.inf
        frame = marker.header.frame_id.strip("/")
        if before is None or before.content != content or before.frame != frame:
            self._drop(key)
            if len(self._kept) >= _MOST:
                raise Unfit(f"more than {_MOST} markers: the others are left out")
            node = self._draw(marker, self._carrier(frame))
        else:
            node = before.node
        node.position, node.wxyz = pose.p, wxyz(pose.q)
        self._kept[key] = _Kept(content, node, frame, until)

    def place(self, places: dict[str, Pose], now: float) -> list[str]:
        """Put every frame where it is and drop what has outlived itself; the frames that are not known.

        :param places: frame -> X_WF
        :param now: s of sim time
        """
        for key in [key for key, kept in self._kept.items() if kept.until <= now]:
            self._drop(key)
        for frame, node in self._frames.items():
            pose = places.get(frame)
            node.visible = pose is not None
            if pose is not None:
                node.position, node.wxyz = pose.p, wxyz(pose.q)
        return sorted(frame for frame in self._frames if frame not in places)

    def clear(self) -> None:
        for key in list(self._kept):
            self._drop(key)
        for node in self._frames.values():
            take_away(node)
        self._frames.clear()

    def _drop(self, key: tuple[str, int]) -> None:
        if key in self._kept:
            take_away(self._kept.pop(key).node)

    def _carrier(self, frame: str) -> str:
        if frame not in self._frames:
            self._frames[frame] = self._scene.add_frame(f"{self._root}_f{len(self._frames)}", show_axes=False, visible=False)
        return self._frames[frame].name

    # ------------------------------------------------------------------------------------------ how they are drawn

    def _draw(self, marker: Any, parent: str) -> Any:
        self._serial += 1
        node, kind = f"{parent}/{self._serial}", marker.type
        colour, opacity = rgb255(_rgba(marker)), (_rgba(marker)[3] if _rgba(marker)[3] < 0.995 else None)
        size = (marker.scale.x, marker.scale.y, marker.scale.z)
        if kind in (Marker.CUBE, Marker.SPHERE, Marker.CYLINDER):
            mesh = _SHAPES[kind]()
            return self._mesh(node, mesh.vertices, mesh.triangles, colour, opacity, _extent(kind, size))
        if kind == Marker.ARROW:
            points, shaft, head, length = _arrow(marker)
            return self._scene.add_arrows(node, points, colour, shaft_radius=shaft, head_radius=head, head_length=length)
        if kind == Marker.TEXT_VIEW_FACING:
            return self._scene.add_label(
                node, marker.text[:1000], font_size_mode="scene", font_scene_height=max(size[2], 0.01), anchor="center-center"
            )
        if kind == Marker.MESH_RESOURCE:
            return self._file(node, marker, colour, opacity, size)
        points, colours = _points(marker), _colours(marker)
        if kind in (Marker.CUBE_LIST, Marker.SPHERE_LIST):
            mesh = _SHAPES[kind]()
            turns = np.tile(np.array((1.0, 0.0, 0.0, 0.0), np.float32), (len(points), 1))
            scales = np.tile(np.array(_extent(kind - 5, size), np.float32), (len(points), 1))
            return self._scene.add_batched_meshes_simple(
                node,
                np.asarray(mesh.vertices, np.float32),
                np.asarray(mesh.triangles, np.uint32),
                turns,
                points,
                batched_scales=scales,
                batched_colors=colours,
                opacity=opacity,
                lod="off",
                cast_shadow=False,
            )
        if kind == Marker.POINTS:
            return self._scene.add_point_cloud(node, points, colours, point_size=max(size[0], 1e-3), precision="float32")
        if kind in (Marker.LINE_STRIP, Marker.LINE_LIST):
            rows = _rows(kind, len(points))
            return self._scene.add_line_segments(node, points[rows], colours[rows], thickness=max(size[0], 1e-3))
        triangles = np.arange(len(points) // 3 * 3, dtype=np.uint32).reshape(-1, 3)  # TRIANGLE_LIST
        mean = tuple(int(v) for v in colours.mean(axis=0)) if len(marker.colors) else colour
        return self._mesh(node, points, triangles, mean, opacity, size)

    def _mesh(self, node: str, vertices: np.ndarray, triangles: np.ndarray, colour: tuple, opacity: float | None, size: tuple) -> Any:
        return self._scene.add_mesh_simple(
            node,
            np.asarray(vertices, np.float32),
            np.asarray(triangles, np.uint32),
            color=colour,
            opacity=opacity,
            side="double",
            scale=tuple(map(float, size)),
            cast_shadow=False,
        )

    def _file(self, node: str, marker: Any, colour: tuple, opacity: float | None, size: tuple) -> Any:
        from ode_sim.mesh import load_visual

        uri = marker.mesh_resource
        path = self._find(uri) if uri.startswith(_MESHES) else None
        if path is None:
            raise Unfit(f"marker {marker.ns}/{marker.id}: there is no mesh {uri[:200]}; package:// and model:// are looked up")
        try:
            parts = load_visual(path, (1.0, 1.0, 1.0), "", False)
        except Exception as error:  # whatever a broken file makes a parser raise
            raise Unfit(f"marker {marker.ns}/{marker.id}: {uri}: {error}") from error
        root = self._scene.add_frame(node, show_axes=False)
        for number, (vertices, triangles, _, _, material) in enumerate(parts):
            own = rgb255(material.diffuse) if marker.mesh_use_embedded_materials and material and material.diffuse else colour
            self._mesh(f"{node}/{number}", vertices, triangles, own, opacity, size)
        return root


def _content(marker: Any) -> tuple:
    """What it looks like, without where it is.

    :raises Unfit: nobody could draw it
    """
    name = f"marker {marker.ns}/{marker.id}"
    size, rgba = (marker.scale.x, marker.scale.y, marker.scale.z), _rgba(marker)
    points = _points(marker)
    if not 0 <= marker.type <= Marker.TRIANGLE_LIST:
        raise Unfit(f"{name}: there is no type {marker.type}")
    if not np.isfinite((*size, *rgba)).all() or not np.isfinite(points).all():
        raise Unfit(f"{name}: has numbers that are none (nan or inf)")
    if len(marker.points) > _MOST_POINTS:
        raise Unfit(f"{name}: {len(marker.points)} points; at most {_MOST_POINTS} are drawn")
    least = {
        Marker.LINE_STRIP: 2,
        Marker.LINE_LIST: 2,
        Marker.CUBE_LIST: 1,
        Marker.SPHERE_LIST: 1,
        Marker.POINTS: 1,
        Marker.TRIANGLE_LIST: 3,
    }.get(marker.type, 0)
    if len(marker.points) < least:
        raise Unfit(f"{name}: {len(marker.points)} points; {least} are the least of its type")
    if marker.colors and len(marker.colors) != len(marker.points):
        raise Unfit(f"{name}: {len(marker.colors)} colours for {len(marker.points)} points")
    return (
        marker.type,
        size,
        rgba,
        points.tobytes(),
        _colours(marker).tobytes(),
        marker.text,
        marker.mesh_resource,
        marker.mesh_use_embedded_materials,
    )


def _pose(marker: Any) -> Pose:
    p, q = marker.pose.position, marker.pose.orientation
    turn = np.array((q.x, q.y, q.z, q.w), float)
    length = float(np.linalg.norm(turn))
    if not np.isfinite((p.x, p.y, p.z)).all() or not math.isfinite(length):
        raise Unfit(f"marker {marker.ns}/{marker.id}: its pose has numbers that are none (nan or inf)")
    return Pose((p.x, p.y, p.z), tuple(turn / length) if length > 1e-9 else (0.0, 0.0, 0.0, 1.0))  # as RViz takes zeros


def _rgba(marker: Any) -> tuple[float, float, float, float]:
    return marker.color.r, marker.color.g, marker.color.b, marker.color.a


def _points(marker: Any) -> np.ndarray:
    return np.array([(p.x, p.y, p.z) for p in marker.points[:_MOST_POINTS]], np.float32).reshape(-1, 3)


def _colours(marker: Any) -> np.ndarray:
    """(N, 3) uint8, one for each point."""
    if marker.colors:
        each = np.array([(c.r, c.g, c.b) for c in marker.colors[:_MOST_POINTS]], float)
        return (255 * np.clip(np.nan_to_num(each), 0.0, 1.0)).round().astype(np.uint8)
    return np.tile(np.array(rgb255(_rgba(marker)), np.uint8), (min(len(marker.points), _MOST_POINTS), 1))


def _rows(kind: int, count: int) -> np.ndarray:
    """(M, 2): which points the lines join."""
    if kind == Marker.LINE_STRIP:
        return np.stack([np.arange(count - 1), np.arange(1, count)], axis=1)
    return np.arange(count // 2 * 2).reshape(-1, 2)


def _extent(kind: int, size: tuple) -> tuple[float, float, float]:
    """What the unit mesh of a shape is stretched by: a marker's scale is a diameter."""
    x, y, z = size
    return {Marker.CUBE: (x, y, z), Marker.SPHERE: (x / 2, y / 2, z / 2), Marker.CYLINDER: (x / 2, y / 2, z)}[kind]


def _arrow(marker: Any) -> tuple[np.ndarray, float, float, float]:
    """Points (1, 2, 3), radii of shaft and head, length of the head: of a pose, or of two points."""
    x, y, z = marker.scale.x, marker.scale.y, marker.scale.z
    if len(marker.points) >= 2:
        points = _points(marker)[:2]
        length = float(np.linalg.norm(points[1] - points[0]))
        return points[None], max(x / 2, 1e-4), max(y / 2, 1e-4), (z if z > 0.0 else 0.23 * length) or 1e-4
    return (np.array([[(0.0, 0.0, 0.0), (x, 0.0, 0.0)]], np.float32), max(y / 4, 1e-4), max(y / 2, 1e-4), max(0.23 * abs(x), 1e-4))

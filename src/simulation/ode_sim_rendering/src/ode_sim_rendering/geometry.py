"""Triangle meshes for drawing: primitives, extrusions, height maps. Outward faces are counter-clockwise."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from ode_sim.description.model import TextureUnit
from ode_sim.heightmap import thinned
from ode_sim.math3 import Vec3

_SEGMENTS = 32  # round shapes; Gazebo draws cylinders and spheres with 32
_SHARPEST = 0.12  # cosine of half of the sharpest turn of a road that is mitred, as in Gazebo
_MOST_DRAWN = 513  # rows of a height map; more than half a million triangles only slows the picture


@dataclass(frozen=True)
class TriMesh:
    """``vertices`` (N,3) m, ``normals`` (N,3) unit, ``uv`` (N,2) from the image's lower left, or None, ``triangles`` (T,3) uint32."""

    vertices: np.ndarray
    normals: np.ndarray
    triangles: np.ndarray
    uv: np.ndarray | None = None


def bounding_sphere(mesh: TriMesh) -> tuple[np.ndarray, float]:
    """(centre (3,), radius) of a sphere around the mesh."""
    if not len(mesh.vertices):
        return np.zeros(3), 0.0
    centre = (mesh.vertices.min(axis=0) + mesh.vertices.max(axis=0)) / 2
    return centre, float(np.linalg.norm(mesh.vertices - centre, axis=1).max())


def _unit(vectors: np.ndarray) -> np.ndarray:
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(length > 0, length, 1.0)


def _grid(points: np.ndarray, normals: np.ndarray, uv: np.ndarray) -> TriMesh:
    """Mesh of a (rows, columns, 3) grid of points; outside is where column direction x row direction points."""
    rows, columns = points.shape[:2]
    index = np.arange(rows * columns, dtype=np.uint32).reshape(rows, columns)
    a, b, c, d = index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]
    triangles = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
    return TriMesh(points.reshape(-1, 3), normals.reshape(-1, 3), triangles, uv.reshape(-1, 2))


def _join(*meshes: TriMesh) -> TriMesh:
    offsets = np.cumsum([0] + [len(m.vertices) for m in meshes[:-1]]).astype(np.uint32)
    return TriMesh(
        np.concatenate([m.vertices for m in meshes]),
        np.concatenate([m.normals for m in meshes]),
        np.concatenate([m.triangles + o for m, o in zip(meshes, offsets)]),
        np.concatenate([m.uv for m in meshes]),
    )


def texture_coordinates(mesh: TriMesh, unit: TextureUnit) -> np.ndarray:
    """(N,2) places in the image, from its lower left, where ``unit`` puts it on ``mesh``. A mesh without coordinates shows the upper left
    corner, as in Gazebo."""
    u, v = mesh.uv.T if mesh.uv is not None else (np.zeros(len(mesh.vertices)), np.ones(len(mesh.vertices)))
    a, b, c, d, e, f = unit.matrix
    return np.stack([a * u + b * (1 - v) + c, 1 - (d * u + e * (1 - v) + f)], -1)


def box() -> TriMesh:
    """Unit cube about the origin, each face textured once: upright on the walls, seen with x upwards on the top, as in Gazebo."""
    faces = []
    for axis in range(3):
        for sign in (1.0, -1.0):
            normal = np.zeros(3)
            normal[axis] = sign
            v = np.array([sign, 0.0, 0.0]) if axis == 2 else np.array([0.0, 0.0, 1.0])
            u = np.cross(v, normal)
            points = np.array([[normal - u - v, normal + u - v], [normal - u + v, normal + u + v]]) / 2
            uv = np.array([[[0, 0], [1, 0]], [[0, 1], [1, 1]]], float)
            faces.append(_grid(points, np.broadcast_to(normal, (2, 2, 3)), uv))
    return _join(*faces)


def plane() -> TriMesh:
    """Unit square in z = 0, visible from above only (as Gazebo's)."""
    points = np.array([[[-0.5, -0.5, 0], [0.5, -0.5, 0]], [[-0.5, 0.5, 0], [0.5, 0.5, 0]]])
    uv = np.array([[[0, 0], [1, 0]], [[0, 1], [1, 1]]], float)
    return _grid(points, np.broadcast_to([0.0, 0.0, 1.0], (2, 2, 3)), uv)


def _revolve(radius: np.ndarray, z: np.ndarray, normal_r: np.ndarray, normal_z: np.ndarray) -> TriMesh:
    """Surface of revolution about z of a profile that runs upwards (or inwards on a top cap)."""
    angle = np.linspace(0, 2 * np.pi, _SEGMENTS + 1)
    cos, sin = np.cos(angle), np.sin(angle)
    points = np.stack([np.outer(radius, cos), np.outer(radius, sin), np.outer(z, np.ones_like(angle))], -1)
    normals = np.stack([np.outer(normal_r, cos), np.outer(normal_r, sin), np.outer(normal_z, np.ones_like(angle))], -1)
    u, v = np.meshgrid(np.linspace(0, 1, _SEGMENTS + 1), np.linspace(0, 1, len(radius)))
    return _grid(points, normals, np.stack([u, v], -1))


def sphere() -> TriMesh:
    """Unit-radius sphere. As in Gazebo, its poles are on the y axis and its image begins where z is greatest, and goes to +x."""
    latitude = np.linspace(-np.pi / 2, np.pi / 2, _SEGMENTS + 1)
    cos, sin = np.cos(latitude), np.sin(latitude)
    made = _revolve(cos, sin, cos, sin)
    return replace(made, vertices=made.vertices[:, [1, 2, 0]], normals=made.normals[:, [1, 2, 0]])


def cylinder() -> TriMesh:
    """Radius 1, height 1, about the origin, axis z. As in Gazebo, its image stands on its head, begins at +y and goes to +x; on the ends
    the corners of all of it meet in the middle."""
    one, zero = np.ones(2), np.zeros(2)
    side = _revolve(one, np.array([-0.5, 0.5]), one, zero)
    top = _revolve(np.array([1.0, 0.0]), np.full(2, 0.5), zero, one)
    bottom = _revolve(np.array([0.0, 1.0]), np.full(2, -0.5), zero, -one)
    u = np.linspace(1, 0, _SEGMENTS + 1)
    middle, above, below = (np.stack([along, np.full(len(u), v)], -1) for along, v in ((0 * u, 1.0), (u, 0.0), (u, 1.0)))
    places = [np.concatenate(ends) for ends in ((below, above), (above, middle), (middle, below))]
    made = _join(*(replace(part, uv=uv) for part, uv in zip((side, top, bottom), places)))
    return replace(made, vertices=made.vertices[:, [1, 0, 2]] * [-1, 1, 1], normals=made.normals[:, [1, 0, 2]] * [-1, 1, 1])


def capsule(radius: float, length: float) -> TriMesh:
    """Two half spheres of ``radius`` (m), ``length`` (m) apart along z, and the cylinder between them."""
    lower = np.linspace(-np.pi / 2, 0, _SEGMENTS // 4 + 1)
    latitude = np.concatenate([lower, lower + np.pi / 2])
    offset = np.concatenate([np.full(len(lower), -length / 2), np.full(len(lower), length / 2)])
    cos, sin = np.cos(latitude), np.sin(latitude)
    return _revolve(radius * cos, radius * sin + offset, cos, sin)


def ribbon(points: np.ndarray, width: float) -> TriMesh:
    """A strip along the way over ``points`` (N,3), no two of which that follow each other lie above one another. Bends are mitred, so
    that it is ``width`` wide all along. Its picture goes across once, from left to right, and repeats every ``width`` along the way."""
    points = np.asarray(points, float)
    ways = _unit(np.diff(points[:, :2], axis=0))
    before, after = np.concatenate([ways[:1], ways]), np.concatenate([ways, ways[-1:]])
    along = _unit(before + after)
    narrowing = np.sum(along * after, axis=1)  # cosine of half the turn
    hairpin = narrowing < _SHARPEST
    along[hairpin], narrowing[hairpin] = before[hairpin], 1.0
    left = np.column_stack([-along[:, 1], along[:, 0], np.zeros(len(points))]) * (width / 2 / narrowing)[:, None]
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]) / (width or 1.0)
    uv = np.stack([np.column_stack([np.zeros(len(points)), length]), np.column_stack([np.ones(len(points)), length])], 1)
    sides = np.stack([points + left, points - left], 1)
    return _grid(sides, np.broadcast_to([0.0, 0.0, 1.0], sides.shape), uv)


def extrusion(points: np.ndarray, height: float) -> TriMesh:
    """A closed polygon, ``points`` (N,2), extruded from z = 0 to ``height``, m; caps are triangulated by ear clipping.

    :raises ValueError: fewer than three points.
    """
    ring = np.asarray(points, float)
    if len(ring) > 1 and np.allclose(ring[0], ring[-1]):
        ring = ring[:-1]
    if len(ring) < 3:
        raise ValueError("a polyline needs at least three points")
    following = np.roll(ring, -1, axis=0)
    if np.sum(ring[:, 0] * following[:, 1] - following[:, 0] * ring[:, 1]) < 0:
        ring = ring[::-1]
        following = np.roll(ring, -1, axis=0)
    count = len(ring)
    edge = following - ring
    wall_normal = _unit(np.stack([edge[:, 1], -edge[:, 0], np.zeros(count)], -1))

    def at(xy: np.ndarray, z: float) -> np.ndarray:
        return np.column_stack([xy, np.full(count, z)])

    walls = np.stack([at(ring, 0), at(following, 0), at(following, height), at(ring, height)], 1).reshape(-1, 3)
    quads = np.arange(4 * count, dtype=np.uint32).reshape(-1, 4)
    caps = _ear_clip(ring)
    vertices = np.concatenate([walls, at(ring, height), at(ring, 0)])
    normals = np.concatenate([np.repeat(wall_normal, 4, axis=0), np.tile([0.0, 0, 1], (count, 1)), np.tile([0.0, 0, -1], (count, 1))])
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]], caps + 4 * count, caps[:, ::-1] + 5 * count]).astype(np.uint32)
    return TriMesh(vertices, normals, triangles, vertices[:, :2].copy())


def _ear_clip(ring: np.ndarray) -> np.ndarray:
    """Triangles (N-2,3) of a simple counter-clockwise polygon."""
    left = list(range(len(ring)))
    triangles = []

    def cross(o: np.ndarray, a: np.ndarray, b: np.ndarray) -> float:
        return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])

    while len(left) > 3:
        for position in range(len(left)):
            i, j, k = left[position - 1], left[position], left[(position + 1) % len(left)]
            a, b, c = ring[i], ring[j], ring[k]
            if cross(a, b, c) <= 0:
                continue
            inside = any(
                cross(a, b, ring[m]) >= 0 and cross(b, c, ring[m]) >= 0 and cross(c, a, ring[m]) >= 0 for m in left if m not in (i, j, k)
            )
            if not inside:
                break
        else:
            position, (i, j, k) = 1, left[:3]  # self-crossing outline: cut anyway rather than loop for ever
        triangles.append((i, j, k))
        del left[position]
    triangles.append((left[0], left[1], left[2]))
    return np.array(triangles, np.uint32)


def height_grid(heights: np.ndarray, size: Vec3, pos: Vec3) -> TriMesh:
    """Terrain from ``heights`` (rows, columns) in m, first row at +y; ``size`` (x, y, _) m, ``pos`` its centre.

    Of a large map no more is drawn than what can be seen.
    """
    heights = thinned(heights, _MOST_DRAWN)
    rows, columns = heights.shape
    x, y = np.meshgrid(np.linspace(-0.5, 0.5, columns) * size[0], np.linspace(0.5, -0.5, rows) * size[1])
    dz_row, dz_column = np.gradient(heights)
    normals = np.stack([-dz_column * (columns - 1) / size[0], dz_row * (rows - 1) / size[1], np.ones_like(heights)], -1)
    u, v = np.meshgrid(np.linspace(0, 1, columns), np.linspace(1, 0, rows))
    points = np.stack([x, y, heights], -1) + np.asarray(pos, float)
    return _grid(points[::-1], _unit(normals)[::-1], np.stack([u, v], -1)[::-1])

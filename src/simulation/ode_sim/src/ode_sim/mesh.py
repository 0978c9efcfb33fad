"""Mesh files (STL, DAE, OBJ) as arrays: one welded surface for collisions, coloured parts for drawing.

Units and axes follow Gazebo Classic: a Collada file is brought to metres by its own ``<unit>``; its ``<up_axis>`` is
ignored there and in RViz, robot files count on that, and so it is here. Other files are taken as they are; then the
scale applies.
"""

from __future__ import annotations

import functools
import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ode_sim.description.model import FARTHEST, DescriptionError, Material, Mesh, Vec3
from ode_sim.mesh_files import MeshPart, read_parts, weld

if TYPE_CHECKING:
    from numpy.typing import DTypeLike

UNIT_SCALE: Vec3 = (1.0, 1.0, 1.0)
#: Before the name of a bone: the submesh of a file with a skin that is this bone's piece, in the bone's frame.
SKIN_PIECE = "skin of "


@dataclass(frozen=True)
class Surface:
    """``vertices`` (V, 3) float64 m, welded; ``triangles`` (T, 3) int32, counter-clockwise from outside."""

    vertices: np.ndarray
    triangles: np.ndarray


@dataclass(frozen=True)
class VisualPart:
    """``vertices``, ``normals`` (V, 3) float32; ``triangles`` (T, 3) int32; ``uv`` (V, 2) float32 or None."""

    vertices: np.ndarray
    triangles: np.ndarray
    normals: np.ndarray
    uv: np.ndarray | None
    material: Material

    def __iter__(self) -> Iterator[Any]:
        return iter((self.vertices, self.triangles, self.normals, self.uv, self.material))


@dataclass(frozen=True)
class MassProperties:
    """Of a closed surface at density 1: ``volume`` m^3, ``centroid`` m, ``inertia`` (3, 3) kg m^2 about it."""

    volume: float
    centroid: np.ndarray
    inertia: np.ndarray


# ---------------------------------------------------------------------------------------------- public


def load(mesh: Mesh) -> Surface:
    """The surface of ``mesh`` to collide with, scaled.

    :raises DescriptionError: one line that names the file; the caller goes on without this shape.
    """
    return load_surface(mesh.path or mesh.uri, mesh.scale, mesh.submesh, mesh.center)


def load_surface(path: str, scale: Vec3 = UNIT_SCALE, submesh: str = "", center: bool = False) -> Surface:
    """As :func:`load` of the file ``path``. The arrays are shared between callers and read-only.

    :param scale: by axis. :param submesh: of which alone is asked, "" for all. :param center: put the submesh's middle at the origin.
    """
    return _surface(path, _usable_scale(scale, path), submesh, center, file_stamp(path))


def load_visual(path: str, scale: Vec3 = UNIT_SCALE, submesh: str = "", center: bool = False) -> list[VisualPart]:
    """The parts to draw, one for each material: tuples (vertices, triangles, normals, uv or None, Material).

    Normals are those of the file; where it has none, faces that meet at less than 40 degrees are smoothed together.
    ``path``, ``scale``, ``submesh``, ``center``: as for :func:`load_surface`.

    :raises DescriptionError: one line that names the file.
    """
    return list(_visual(path, _usable_scale(scale, path), submesh, center, file_stamp(path)))


def mass_properties(surface: Surface) -> MassProperties:
    """Volume integrals of a closed surface.

    :raises DescriptionError: the surface encloses no volume.
    """
    a, b, c = (surface.vertices[surface.triangles[:, k]] for k in range(3))
    six_volumes = np.einsum("ij,ij->i", a, np.cross(b, c))
    volume = six_volumes.sum() / 6.0
    if abs(volume) < 1e-18:
        raise DescriptionError("the surface encloses no volume")
    centroid = (six_volumes[:, None] * (a + b + c)).sum(axis=0) / (24.0 * volume)
    a, b, c = a - centroid, b - centroid, c - centroid
    six_volumes = np.einsum("ij,ij->i", a, np.cross(b, c))
    total = a + b + c
    second = sum(np.einsum("i,ij,ik->jk", six_volumes, v, v) for v in (a, b, c, total)) / 120.0
    inertia = np.trace(second) * np.eye(3) - second
    return MassProperties(float(abs(volume)), centroid, inertia * np.sign(volume))


# ---------------------------------------------------------------------------------------------- caches


def file_stamp(path: str) -> tuple[int, int]:
    """Size and time of the file ``path``: an edited mesh is read again. :raises DescriptionError: there is none."""
    try:
        status = os.stat(path)
    except OSError as error:
        raise DescriptionError(f"mesh {path or '(no file)'}: {error.strerror}") from None
    return status.st_size, status.st_mtime_ns


def _usable_scale(scale: Vec3, path: str) -> Vec3:
    scale = float(scale[0]), float(scale[1]), float(scale[2])
    if not all(abs(s) <= FARTHEST for s in scale):
        raise DescriptionError(f"mesh {path}: scale {' '.join(f'{s:g}' for s in scale)}; at most {FARTHEST:g} makes sense")
    return scale


@functools.lru_cache(maxsize=256)
def _surface(path: str, scale: Vec3, submesh: str, center: bool, stamp: tuple[int, int]) -> Surface:
    parts = _selected(path, submesh, center, stamp)
    offsets = np.cumsum([0] + [len(part.vertices) for part in parts])
    vertices = np.concatenate([part.vertices for part in parts]) * scale
    triangles = np.concatenate([part.triangles + offset for part, offset in zip(parts, offsets)])
    vertices, triangles = weld(vertices, triangles)
    if len(triangles) == 0:
        raise DescriptionError(f"mesh {path}: all its triangles have no area")
    if np.prod(scale) < 0.0:
        triangles = triangles[:, ::-1]
    return Surface(_frozen(vertices, np.float64), _frozen(triangles, np.int32))


@functools.lru_cache(maxsize=256)
def _visual(path: str, scale: Vec3, submesh: str, center: bool, stamp: tuple[int, int]) -> tuple[VisualPart, ...]:
    with np.errstate(over="ignore", invalid="ignore"):  # what is scaled to nothing has no normals worth a warning
        return tuple(_drawn(part, np.asarray(scale)) for part in _selected(path, submesh, center, stamp))


def _selected(path: str, submesh: str, center: bool, stamp: tuple[int, int]) -> list[MeshPart]:
    if submesh.startswith(SKIN_PIECE):
        from ode_sim.actors.skin import load_piece  # which needs this module

        return load_piece(path, submesh)
    parts = read_parts(path, stamp, groups=bool(submesh))
    if submesh:
        chosen = [part for part in parts if part.node == submesh] or [part for part in parts if part.name == submesh]
        if not chosen:
            names = ", ".join(sorted({part.node or part.name for part in parts}))
            raise DescriptionError(f"mesh {path}: has no submesh '{submesh}', only {names}")
        parts = chosen
        if center:
            points = np.concatenate([part.vertices for part in parts])
            middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
            parts = [replace(part, vertices=part.vertices - middle) for part in parts]
    return parts


# ---------------------------------------------------------------------------------------------- surfaces


def _drawn(part: MeshPart, scale: np.ndarray) -> VisualPart:
    vertices, triangles, normals, uv = part.vertices, part.triangles, part.normals, part.uv
    if normals is None:
        vertices, triangles, normals, uv = with_normals(vertices, triangles, uv)
    normals = normals / np.where(scale == 0.0, 1.0, scale)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.divide(normals, length, out=np.zeros_like(normals), where=length > 0.0)
    if np.prod(scale) < 0.0:
        triangles = triangles[:, ::-1]
    return VisualPart(
        _frozen(vertices * scale, np.float32),
        _frozen(triangles, np.int32),
        _frozen(normals, np.float32),
        None if uv is None else _frozen(uv, np.float32),
        part.material,
    )


def with_normals(
    vertices: np.ndarray, triangles: np.ndarray, uv: np.ndarray | None, crease: float = np.radians(40.0)
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray | None]:
    """Vertices split where faces meet at a sharp edge; normals weighted by area within a smooth patch.

    :param vertices: (V, 3) m. :param triangles: (T, 3) their corners. :param uv: (V, 2) or None.
    :param crease: rad, of an edge that is sharp.
    """
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    weighted = np.cross(b - a, c - a)
    length = np.linalg.norm(weighted, axis=1, keepdims=True)
    flat = np.divide(weighted, length, out=np.zeros_like(weighted), where=length > 0.0)
    corner_vertex = triangles.ravel()
    corner_face = np.repeat(np.arange(len(triangles)), 3)
    order = np.argsort(corner_vertex, kind="stable")
    count = np.bincount(corner_vertex, minlength=len(vertices))[corner_vertex[order]]
    start = np.searchsorted(corner_vertex[order], corner_vertex[order])
    normals = np.empty((len(order), 3))
    ends = np.cumsum(count)
    first = 0
    while first < len(order):  # every corner with all corners at its vertex, some millions of pairs at a time
        last = max(first + 1, int(np.searchsorted(ends, (ends[first - 1] if first else 0) + 2_000_000)))
        n = count[first:last]
        one = np.repeat(np.arange(first, last), n)
        within = np.arange(n.sum()) - np.repeat(np.cumsum(n) - n, n)
        other = corner_face[order[np.repeat(start[first:last], n) + within]]
        smooth = np.einsum("ij,ij->i", flat[corner_face[order[one]]], flat[other]) > np.cos(crease)
        one, other = one[smooth] - first, other[smooth]
        normals[order[first:last]] = np.column_stack([np.bincount(one, weighted[other, k], minlength=last - first) for k in range(3)])
        first = last
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.divide(normals, length, out=np.zeros_like(normals), where=length > 0.0)
    coarse = np.round((normals + 1.0) * 1e5).astype(np.int64)
    keys = (corner_vertex * 200003 + coarse[:, 0]) * 200003 + coarse[:, 1]  # z follows but for its sign
    keys = 2 * keys + (normals[:, 2] < 0.0)
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    chosen = corner_vertex[first]
    return vertices[chosen], inverse.reshape(-1, 3), normals[first], None if uv is None else uv[chosen]


def _frozen(array: np.ndarray, dtype: DTypeLike) -> np.ndarray:
    array = np.ascontiguousarray(array, dtype=dtype)
    array.setflags(write=False)
    return array

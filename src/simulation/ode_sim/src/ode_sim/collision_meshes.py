"""Meshes, height maps and polylines as the core collides with them: triangles with their search tree, heights.

Reading a large mesh and building its tree takes longer than many steps (half a second for 300 000 triangles). It needs no
world, so a simulation that must not stand still has :func:`prepare` called in another thread before it spawns the model.
"""

from __future__ import annotations

import functools
import weakref
from typing import Any

import numpy as np

from ode_sim import _core
from ode_sim.description.model import DescriptionError, Heightmap, Mesh, Model, Polyline, Vec3
from ode_sim.heightmap import load_heights
from ode_sim.mesh import file_stamp, load_surface
from ode_sim.polyline import extrude

Made = Mesh | Heightmap | Polyline  # shapes that something has to be made for first


def mesh_data(vertices: np.ndarray, triangles: np.ndarray) -> _core.MeshData:
    """Of any surface: ``vertices`` (V, 3) m, ``triangles`` (T, 3) indices.

    :raises DescriptionError: nothing to collide with.
    """
    if len(triangles) == 0:
        raise DescriptionError("its mesh has no triangles")
    if not np.isfinite(vertices).all():
        raise DescriptionError("its mesh holds NaN or infinity")
    try:
        return _core.MeshData(vertices, triangles)
    except ValueError as error:
        raise DescriptionError(str(error)) from None


def load(mesh: Mesh) -> _core.MeshData:
    """Of a mesh file, shared by all shapes that ask for it.

    :raises DescriptionError: one line that names the file.
    """
    path = mesh.path or mesh.uri
    return _load(path, tuple(float(s) for s in mesh.scale), mesh.submesh, mesh.center, file_stamp(path))


@functools.lru_cache(maxsize=64)
def _load(path: str, scale: Vec3, submesh: str, center: bool, stamp: tuple[int, int]) -> _core.MeshData:
    surface = load_surface(path, scale, submesh, center)
    return mesh_data(surface.vertices, surface.triangles)


# By id of the shape of a description, as long as that lives: however many others were made in the meantime, it is there.
_ready: dict[int, Any] = {}


def prepare(model: Model) -> None:
    """Have the meshes of a model ready, so that spawning it takes a moment. Any thread."""
    for link in model.links:
        for collision in link.collisions:
            shape = collision.geometry
            if not isinstance(shape, (Mesh, Heightmap, Polyline)) or not getattr(shape, "path", True) or id(shape) in _ready:
                continue
            try:
                made: Any = _make(shape)
            except DescriptionError as error:
                made = error  # spawning leaves the shape out and says why
            _ready[id(shape)] = made
            weakref.finalize(shape, _ready.pop, id(shape), None).atexit = False


def ready(shape: Made) -> Any:
    """What :func:`prepare` has made of a shape, else made now: a ``MeshData``, for a height map heights as :func:`load_heights`.

    :raises DescriptionError: one line that says why there is none.
    """
    made = _ready.get(id(shape))
    if isinstance(made, DescriptionError):
        raise DescriptionError(str(made))
    return _make(shape) if made is None else made


def _make(shape: Made) -> Any:
    if isinstance(shape, Mesh):
        return load(shape)
    return load_heights(shape) if isinstance(shape, Heightmap) else mesh_data(*extrude(shape))

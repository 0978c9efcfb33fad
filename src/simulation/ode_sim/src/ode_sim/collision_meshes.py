"""Meshes as the core collides with them: triangles with their search tree.

Building the tree of a large mesh takes longer than many steps (half a second for 300 000 triangles). It needs no world, so
a simulation that must not stand still has :func:`prepare` called in another thread before it spawns the model.
"""
from __future__ import annotations

import functools
from typing import Tuple

import numpy as np

from ode_sim import _core
from ode_sim.description.model import DescriptionError, Mesh, Model, Vec3
from ode_sim.mesh import file_stamp, load_surface


def mesh_data(vertices: np.ndarray, triangles: np.ndarray) -> _core.MeshData:
    """Of any surface: ``vertices`` (V, 3) m, ``triangles`` (T, 3) indices.

    :raises DescriptionError: nothing to collide with.
    """
    if len(triangles) == 0 or not np.isfinite(vertices).all():
        raise DescriptionError("its mesh has no triangles" if len(triangles) == 0 else "its mesh holds NaN or infinity")
    return _core.MeshData(vertices, triangles)


def load(mesh: Mesh) -> _core.MeshData:
    """Of a mesh file, shared by all shapes that ask for it.

    :raises DescriptionError: one line that names the file.
    """
    path = mesh.path or mesh.uri
    return _load(path, tuple(float(s) for s in mesh.scale), mesh.submesh, mesh.center, file_stamp(path))


@functools.lru_cache(maxsize=64)
def _load(path: str, scale: Vec3, submesh: str, center: bool, stamp: Tuple[int, int]) -> _core.MeshData:
    surface = load_surface(path, scale, submesh, center)
    return mesh_data(surface.vertices, surface.triangles)


def prepare(model: Model) -> None:
    """Have the meshes of a model ready, so that spawning it takes a moment. Any thread."""
    for link in model.links:
        for collision in link.collisions:
            if isinstance(collision.geometry, Mesh) and collision.geometry.path:
                try:
                    load(collision.geometry)
                except DescriptionError:
                    continue  # spawning leaves the shape out and says why

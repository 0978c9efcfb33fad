"""Meshes of a model that is being made: uploaded, weighed, and kept in the model's own folder, so that it can be moved."""

from __future__ import annotations

import filecmp
import os
import shutil
import tempfile
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from ode_sim.description import model as d
from ode_sim.math3 import Pose, vec3
from ode_sim.mesh import load_surface, load_visual, mass_properties
from ode_sim_viewer.simulation import Refused

MESHES = (".stl", ".obj", ".dae")
#: Below the folder of the model, as in every model of Gazebo.
FOLDER = "meshes"
_THINNEST = 1e-3  # m, of the box of a mesh


def keep(folder: str, base: str, content: bytes) -> d.Mesh:
    """Write an uploaded mesh below the model's ``folder`` and read it once. Another file of that name stays as it is.

    :param base: name of the uploaded file
    :raises Refused: ``content`` is no mesh, or cannot be written
    """
    if not base.lower().endswith(MESHES):
        raise Refused(f"{base}: a mesh is one of {', '.join(MESHES)}")
    with tempfile.TemporaryDirectory() as place:
        tried = os.path.join(place, base)
        try:
            with open(tried, "wb") as stream:
                stream.write(content)
            load_visual(tried)
        except Exception as error:  # whatever a broken file makes a parser raise
            raise Refused(f"{base} cannot be read: {error}".replace(place + os.sep, "")) from error
        try:
            target = os.path.join(folder, FOLDER, _free(os.path.join(folder, FOLDER), base, tried))
            _copy(tried, target)
        except OSError as error:
            raise Refused(f"{error.filename or folder}: {error.strerror or error}") from error
    return d.Mesh(target, "file://" + target)


def inertial(mesh: d.Mesh, mass: float) -> d.Inertial:
    """Of the solid inside the closed surface of ``mesh``; else of the box around it.

    :param mass: kg
    :raises DescriptionError: the file cannot be read any more
    """
    surface = load_surface(mesh.path, mesh.scale, mesh.submesh, mesh.center)
    if _closed(surface.triangles):
        solid = mass_properties(surface)
        tensor = solid.inertia * mass / solid.volume
        if np.all(np.linalg.eigvalsh(tensor) > 0.0):
            return _inertial(mass, solid.centroid, tensor)
    low, high = surface.vertices.min(axis=0), surface.vertices.max(axis=0)
    x, y, z = np.maximum(high - low, _THINNEST) ** 2 * mass / 12
    return _inertial(mass, (low + high) / 2, np.diag((y + z, x + z, x + y)))


def _inertial(mass: float, centre: np.ndarray, tensor: np.ndarray) -> d.Inertial:
    ixx, ixy, ixz, iyy, iyz, izz = (float(v) for v in tensor[np.triu_indices(3)])
    return d.Inertial(mass, Pose(vec3(centre)), ixx=ixx, ixy=ixy, ixz=ixz, iyy=iyy, iyz=iyz, izz=izz)


def _closed(triangles: np.ndarray) -> bool:
    """Whether each edge of a triangle is one of another triangle, run through the other way."""
    edges = np.concatenate([triangles[:, pair] for pair in ((0, 1), (1, 2), (2, 0))]).astype(np.int64)
    there, back = (np.sort(edges[:, a] << 32 | edges[:, b]) for a, b in ((0, 1), (1, 0)))
    return bool(np.array_equal(there, back)) and len(np.unique(there)) == len(there)


# ---------------------------------------------------------------------------------------------- in the folder


def gather(model: d.Model, folder: str, name: str, editors: str) -> d.Model:
    """Copy the meshes of a model, and what they name, into its ``folder``; the model with them as ``model://NAME/meshes/...``.

    Those that a package or another model has are left where they are, under the names that they have there.

    :param editors: folder of the models that this editor keeps: what is below it has no name that others know
    :raises OSError: a file cannot be copied
    """
    files: dict[str, str] = {}  # -> base name in the folder

    def mend(shape: d.Geometry) -> d.Geometry:
        if not isinstance(shape, d.Mesh) or not shape.path or not _own(shape, editors):
            return shape
        if shape.path not in files:
            base = _free(os.path.join(folder, FOLDER), os.path.basename(shape.path), shape.path)
            files[shape.path] = base
            for file, below in _parts(shape.path, base):
                _copy(file, os.path.join(folder, below))
        base = files[shape.path]
        return replace(shape, path=os.path.join(folder, FOLDER, base), uri=f"model://{name}/{FOLDER}/{base}")

    links = tuple(
        replace(
            link,
            collisions=tuple(replace(part, geometry=mend(part.geometry)) for part in link.collisions),
            visuals=tuple(replace(part, geometry=mend(part.geometry)) for part in link.visuals),
        )
        for link in model.links
    )
    return replace(model, links=links)


def _own(shape: d.Mesh, editors: str) -> bool:
    scheme = shape.uri.partition("://")[0] if "://" in shape.uri else "file"
    return scheme == "file" or os.path.realpath(shape.path).startswith(os.path.realpath(editors) + os.sep)


def _parts(path: str, base: str) -> Iterator[tuple[str, str]]:
    """(file, where it goes below the model's folder) of a mesh and of what it names; not of what lies outside of a model's folder."""
    yield path, os.path.join(FOLDER, base)
    for file in _named(path):
        below = os.path.normpath(os.path.join(FOLDER, os.path.relpath(file, os.path.dirname(path))))
        if below.split(os.sep)[0] != os.pardir:
            yield file, below


def _named(path: str) -> list[str]:
    """Material files and pictures."""
    found = [part.material.texture for part in load_visual(path) if part.material.texture]
    if path.lower().endswith(".obj"):
        with open(path, encoding="utf-8", errors="replace") as stream:
            found += [
                os.path.join(os.path.dirname(path), line.split(None, 1)[1].strip())
                for line in stream
                if line.startswith("mtllib ") and len(line.split()) > 1
            ]
    return [file for file in dict.fromkeys(found) if os.path.isfile(file)]


def _free(folder: str, base: str, file: str) -> str:
    """``base``, or with a number where another file has that name."""
    stem, ending = os.path.splitext(base)
    number, name = 0, base
    while os.path.exists(os.path.join(folder, name)) and not filecmp.cmp(os.path.join(folder, name), file, shallow=False):
        name, number = f"{stem}_{number}{ending}", number + 1
    return name


def _copy(source: str, target: str) -> None:
    if not os.path.exists(target) or not filecmp.cmp(source, target, shallow=False):
        os.makedirs(os.path.dirname(target), exist_ok=True)
        shutil.copyfile(source, target)

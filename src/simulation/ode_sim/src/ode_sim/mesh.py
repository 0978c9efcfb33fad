"""Mesh files (STL, DAE, OBJ) as arrays: one welded surface for collisions, coloured parts for drawing.

Units and axes follow Gazebo: a Collada file is brought to metres and to z up by its own ``<unit>`` and ``<up_axis>``,
the others are taken as they are; then the scale applies.
"""
from __future__ import annotations

import functools
import logging
import os
import struct
from dataclasses import dataclass
from typing import Dict, List, Optional, Tuple

import numpy as np

from ode_sim.description.model import DescriptionError, Material, Mesh, Vec3

logging.getLogger("trimesh").setLevel(logging.ERROR)
logging.getLogger("collada").setLevel(logging.ERROR)

UNIT_SCALE: Vec3 = (1.0, 1.0, 1.0)


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
    uv: Optional[np.ndarray]
    material: Material

    def __iter__(self):
        return iter((self.vertices, self.triangles, self.normals, self.uv, self.material))


@dataclass(frozen=True)
class MassProperties:
    """Of a closed surface at density 1: ``volume`` m^3, ``centroid`` m, ``inertia`` (3, 3) kg m^2 about it."""

    volume: float
    centroid: np.ndarray
    inertia: np.ndarray


@dataclass(frozen=True)
class _Part:
    """A piece of a file with one material, unscaled."""

    name: str
    vertices: np.ndarray  # (V, 3) float64, metres, z up
    triangles: np.ndarray  # (T, 3) int64
    normals: Optional[np.ndarray]  # (V, 3)
    uv: Optional[np.ndarray]  # (V, 2)
    material: Material


# ---------------------------------------------------------------------------------------------- public

def load(mesh: Mesh) -> Surface:
    """The surface to collide with, scaled.

    :raises DescriptionError: one line that names the file; the caller goes on without this shape.
    """
    return load_surface(mesh.path or mesh.uri, mesh.scale, mesh.submesh, mesh.center)


def load_surface(path: str, scale: Vec3 = UNIT_SCALE, submesh: str = "", center: bool = False) -> Surface:
    """As :func:`load`. The arrays are shared between callers and read-only."""
    return _surface(path, tuple(float(s) for s in scale), submesh, center, _stamp(path))


def load_visual(path: str, scale: Vec3 = UNIT_SCALE, submesh: str = "", center: bool = False) -> List[VisualPart]:
    """The parts to draw, one for each material: tuples (vertices, triangles, normals, uv or None, Material).

    Normals are those of the file; where it has none, faces that meet at less than 40 degrees are smoothed together.

    :raises DescriptionError: one line that names the file.
    """
    return list(_visual(path, tuple(float(s) for s in scale), submesh, center, _stamp(path)))


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

def _stamp(path: str) -> Tuple[int, int]:
    """Size and time of the file: an edited mesh is read again."""
    try:
        status = os.stat(path)
    except OSError as error:
        raise DescriptionError(f"mesh {path or '(no file)'}: {error.strerror}") from None
    return status.st_size, status.st_mtime_ns


@functools.lru_cache(maxsize=256)
def _surface(path: str, scale: Vec3, submesh: str, center: bool, stamp) -> Surface:
    parts = _selected(path, submesh, center, stamp)
    offsets = np.cumsum([0] + [len(part.vertices) for part in parts])
    vertices = np.concatenate([part.vertices for part in parts]) * scale
    triangles = np.concatenate([part.triangles + offset for part, offset in zip(parts, offsets)])
    vertices, triangles = _weld(vertices, triangles)
    if len(triangles) == 0:
        raise DescriptionError(f"mesh {path}: all its triangles have no area")
    if np.prod(scale) < 0.0:
        triangles = triangles[:, ::-1]
    return Surface(_frozen(vertices, np.float64), _frozen(triangles, np.int32))


@functools.lru_cache(maxsize=256)
def _visual(path: str, scale: Vec3, submesh: str, center: bool, stamp) -> Tuple[VisualPart, ...]:
    return tuple(_drawn(part, np.asarray(scale)) for part in _selected(path, submesh, center, stamp))


def _selected(path: str, submesh: str, center: bool, stamp) -> List[_Part]:
    parts = _parts(path, stamp)
    if submesh:
        chosen = [part for part in parts if part.name == submesh]
        if not chosen:
            names = ", ".join(sorted({part.name for part in parts}))
            raise DescriptionError(f"mesh {path}: has no submesh '{submesh}', only {names}")
        parts = chosen
        if center:
            points = np.concatenate([part.vertices for part in parts])
            middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
            parts = [_Part(p.name, p.vertices - middle, p.triangles, p.normals, p.uv, p.material) for p in parts]
    return parts


@functools.lru_cache(maxsize=64)
def _parts(path: str, stamp) -> List[_Part]:
    readers = {".stl": _read_stl, ".stlb": _read_stl, ".stla": _read_stl, ".dae": _read_dae, ".obj": _read_obj}
    suffix = os.path.splitext(path)[1].lower()
    if suffix not in readers:
        raise DescriptionError(f"mesh {path}: '{suffix}' files cannot be read; use .stl, .dae or .obj")
    try:
        parts = readers[suffix](path)
    except DescriptionError:
        raise
    except Exception as error:  # a parser fed with a broken file may raise anything
        reason = " ".join(str(error).split())[:150] or type(error).__name__
        raise DescriptionError(f"mesh {path}: is broken, {reason}") from None
    parts = [part for part in parts if len(part.triangles)]
    if not parts:
        raise DescriptionError(f"mesh {path}: holds no triangles")
    if not all(np.isfinite(part.vertices).all() for part in parts):
        raise DescriptionError(f"mesh {path}: holds coordinates that are not finite")
    return parts


# ---------------------------------------------------------------------------------------------- files

def _read_stl(path: str) -> List[_Part]:
    with open(path, "rb") as stream:
        data = stream.read()
    count = struct.unpack_from("<I", data, 80)[0] if len(data) >= 84 else -1
    # the length decides: many binary files start with the word 'solid' as well
    if len(data) == 84 + 50 * count or (count > 0 and len(data) > 84 + 50 * count and not data[:5] == b"solid"):
        record = np.dtype([("normal", "<f4", 3), ("points", "<f4", (3, 3)), ("attribute", "<u2")])
        points = np.frombuffer(data, record, count, 84)["points"].reshape(-1, 3).astype(float)
    elif data.lstrip()[:5].lower() == b"solid" or b"vertex" in data[:2000]:
        points = np.array([line.split()[1:4] for line in data.decode("latin-1").splitlines()
                           if line.split()[:1] == ["vertex"]], dtype=float)
        if len(points) % 3:
            raise DescriptionError(f"mesh {path}: is cut off, {len(points)} vertices are no whole triangles")
    else:
        raise DescriptionError(f"mesh {path}: is no STL file, or cut off ({len(data)} bytes)")
    points = points.reshape(-1, 3)
    vertices, triangles = _weld(points, np.arange(len(points)).reshape(-1, 3))
    return [_Part(os.path.basename(path), vertices, triangles, None, None, Material())]


def _read_obj(path: str) -> List[_Part]:
    """Polygons with v, vt, vn; one part for each object and material."""
    points, texture_points, normals = [], [], []
    materials: Dict[str, Material] = {}
    corners: Dict[Tuple[str, str], List[Tuple[int, int, int]]] = {}
    name, material = os.path.basename(path), ""
    rows = {"v": points, "vt": texture_points, "vn": normals}
    with open(path, "rb") as stream:
        lines = stream.read().decode("utf-8", "replace").replace("\\\n", " ").splitlines()
    for number, line in enumerate(lines, 1):
        words = line.split()
        if not words:
            continue
        key = words[0]
        if key in rows:
            rows[key].append([float(word) for word in words[1:4]])
        elif key == "f":
            polygon = [_obj_corner(word, len(points), len(texture_points), len(normals)) for word in words[1:]]
            if any(not 0 <= corner[0] < len(points) for corner in polygon):
                raise DescriptionError(f"mesh {path}:{number}: a face refers to a vertex that is not there")
            fan = corners.setdefault((name, material), [])
            for i in range(1, len(polygon) - 1):
                fan += [polygon[0], polygon[i], polygon[i + 1]]
        elif key == "mtllib":
            materials.update(_read_mtl(os.path.join(os.path.dirname(path), line.split(None, 1)[1].strip())))
        elif key == "usemtl":
            material = line.split(None, 1)[1].strip() if len(words) > 1 else ""
        elif key == "o" and len(words) > 1:
            name = words[1]
    parts = []
    for (name, material), used in corners.items():
        unique, inverse = np.unique(np.array(used), axis=0, return_inverse=True)
        parts.append(_Part(
            name, np.array(points)[unique[:, 0]], inverse.reshape(-1, 3),
            np.array(normals)[unique[:, 2]] if normals and (unique[:, 2] >= 0).all() else None,
            np.array([row[:2] for row in texture_points])[unique[:, 1]]
            if texture_points and (unique[:, 1] >= 0).all() else None,
            materials.get(material, Material(name=material))))
    return parts


def _obj_corner(word: str, points: int, texture_points: int, normals: int) -> Tuple[int, int, int]:
    """``v/vt/vn``, from 1 or, negative, from the end; -1 for what is not given."""
    fields = (word.split("/") + ["", ""])[:3]
    counts = (points, texture_points, normals)
    return tuple(-1 if not text else int(text) - 1 if int(text) > 0 else count + int(text)
                 for text, count in zip(fields, counts))


def _read_mtl(path: str) -> Dict[str, Material]:
    if not os.path.isfile(path):
        return {}  # the shape is there all the same, drawn white
    materials: Dict[str, Dict[str, object]] = {}
    current: Dict[str, object] = {}
    with open(path, encoding="utf-8", errors="replace") as stream:
        for line in stream:
            words = line.split()
            if not words:
                continue
            key = words[0]
            if key == "newmtl":
                current = materials.setdefault(line.split(None, 1)[1].strip(), {})
            elif key in ("Ka", "Kd", "Ks", "Ke"):
                current[key] = tuple(float(word) for word in words[1:4])
            elif key == "d":
                current[key] = float(words[-1])
            elif key == "map_Kd":
                texture = os.path.join(os.path.dirname(path), words[-1])
                current[key] = os.path.abspath(texture) if os.path.isfile(texture) else ""

    def material(name: str, given: Dict[str, object]) -> Material:
        alpha = (given.get("d", 1.0),)
        colour = {key: given[key] + alpha if key in given else None for key in ("Ka", "Kd", "Ks", "Ke")}
        texture = given.get("map_Kd", "")
        diffuse = (1.0, 1.0, 1.0) + alpha if texture else colour["Kd"]
        return Material(name, ambient=diffuse, diffuse=diffuse, specular=colour["Ks"], emissive=colour["Ke"],
                        texture=texture)

    return {name: material(name, given) for name, given in materials.items()}


def _read_dae(path: str) -> List[_Part]:
    import collada
    from collada.common import DaeBrokenRefError, DaeUnsupportedError

    document = collada.Collada(path, ignore=[DaeUnsupportedError, DaeBrokenRefError])
    unit = float(document.assetInfo.unitmeter or 1.0)
    # x, y, z of the file as the z-up frame has them
    turn = {"X_UP": np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]]).T @ np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]]),
            "Y_UP": np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])}.get(document.assetInfo.upaxis, np.eye(3))
    if document.scene is None:
        raise DescriptionError(f"mesh {path}: the Collada file has no visual scene")
    parts = []
    for geometry in document.scene.objects("geometry"):
        for primitive in geometry.primitives():
            if hasattr(primitive, "triangleset"):
                primitive = primitive.triangleset()
            if not hasattr(primitive, "vertex_index") or primitive.vertex_index is None \
                    or np.ndim(primitive.vertex_index) != 2 or primitive.vertex_index.shape[1] != 3:
                continue  # lines
            material = _dae_material(primitive.material, path)
            columns = [primitive.vertex_index.ravel()]
            has_normals = primitive.normal is not None and primitive.normal_index is not None
            has_uv = bool(primitive.texcoordset) and bool(material.texture)
            columns.append(primitive.normal_index.ravel() if has_normals else np.zeros_like(columns[0]))
            columns.append(primitive.texcoord_indexset[0].ravel() if has_uv else np.zeros_like(columns[0]))
            unique, inverse = np.unique(np.stack(columns, axis=1), axis=0, return_inverse=True)
            normals = primitive.normal[unique[:, 1]] @ turn.T if has_normals else None
            parts.append(_Part(geometry.original.name or geometry.original.id,
                               primitive.vertex[unique[:, 0]] @ turn.T * unit, inverse.reshape(-1, 3), normals,
                               primitive.texcoordset[0][unique[:, 2], :2] if has_uv else None, material))
    return parts


def _dae_material(material, path: str) -> Material:
    effect = getattr(material, "effect", None)
    if effect is None:
        return Material()
    texture = ""

    def colour(value):
        nonlocal texture
        if isinstance(value, (tuple, list)):
            return tuple(float(v) for v in (tuple(value) + (1.0,))[:4])
        image = getattr(getattr(getattr(value, "sampler", None), "surface", None), "image", None)
        if image is not None and not texture:
            texture = _texture_file(image.path, path)
        return None

    diffuse = colour(effect.diffuse)
    alpha = 1.0
    if isinstance(effect.transparency, (int, float)) and effect.transparency not in (0, 1):
        # exporters disagree on which end is opaque; A_ONE, the standard one, counts
        alpha = float(effect.transparency)
    if texture:
        diffuse = (1.0, 1.0, 1.0, 1.0)
    if diffuse is not None and alpha != 1.0:
        diffuse = diffuse[:3] + (alpha,)
    emissive = colour(effect.emission)
    return Material(getattr(material, "name", "") or "", ambient=diffuse, diffuse=diffuse,
                    specular=colour(effect.specular), emissive=emissive if emissive and any(emissive[:3]) else None,
                    texture=texture)


def _texture_file(name: str, mesh_path: str) -> str:
    """An image that a mesh names: beside it, or in the ``materials/textures`` of its model."""
    from urllib.parse import unquote

    name = unquote(name[7:] if name.startswith("file://") else name).replace("\\", "/")
    folder = os.path.dirname(mesh_path)
    base = os.path.basename(name)
    for candidate in (os.path.join(folder, name), os.path.join(folder, base),
                      os.path.join(folder, "../materials/textures", base), os.path.join(folder, "textures", base)):
        if os.path.isfile(candidate):
            return os.path.abspath(candidate)
    return ""


# ---------------------------------------------------------------------------------------------- surfaces

def _weld(vertices: np.ndarray, triangles: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """Merge vertices closer than a millionth of the size, drop triangles without area and unused vertices."""
    extent = np.ptp(vertices, axis=0).max() if len(vertices) else 0.0
    grid = np.round(vertices / (extent * 1e-6 or 1.0)).astype(np.int64)
    _, first, inverse = np.unique(grid, axis=0, return_index=True, return_inverse=True)
    # in the order of the file, so that the result does not depend on the grid
    order = np.argsort(first, kind="stable")
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    vertices, triangles = vertices[first[order]], rank[inverse.ravel()][triangles]
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    triangles = triangles[area > 1e-14 * extent * extent]
    used, triangles = np.unique(triangles, return_inverse=True)
    return vertices[used], triangles.reshape(-1, 3)


def _drawn(part: _Part, scale: np.ndarray) -> VisualPart:
    vertices, triangles, normals, uv = part.vertices, part.triangles, part.normals, part.uv
    if normals is None:
        vertices, triangles, normals, uv = _with_normals(vertices, triangles, uv)
    normals = normals / np.where(scale == 0.0, 1.0, scale)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.divide(normals, length, out=np.zeros_like(normals), where=length > 0.0)
    if np.prod(scale) < 0.0:
        triangles = triangles[:, ::-1]
    return VisualPart(_frozen(vertices * scale, np.float32), _frozen(triangles, np.int32),
                      _frozen(normals, np.float32), None if uv is None else _frozen(uv, np.float32), part.material)


def _with_normals(vertices, triangles, uv, crease: float = np.radians(40.0)):
    """Vertices split where faces meet at a sharp edge; normals weighted by area within a smooth patch."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    weighted = np.cross(b - a, c - a)
    length = np.linalg.norm(weighted, axis=1, keepdims=True)
    flat = np.divide(weighted, length, out=np.zeros_like(weighted), where=length > 0.0)
    corner_vertex = triangles.ravel()
    corner_face = np.repeat(np.arange(len(triangles)), 3)
    order = np.argsort(corner_vertex, kind="stable")
    starts = np.searchsorted(corner_vertex[order], np.arange(len(vertices) + 1))
    normals = np.empty((len(corner_vertex), 3))
    for vertex in range(len(vertices)):
        corners = order[starts[vertex]:starts[vertex + 1]]
        faces = corner_face[corners]
        close = flat[faces] @ flat[faces].T > np.cos(crease)
        normals[corners] = close @ weighted[faces]
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.divide(normals, length, out=np.zeros_like(normals), where=length > 0.0)
    keys = np.column_stack([corner_vertex, np.round(normals * 1e5)]).astype(np.int64)
    _, first, inverse = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    chosen = corner_vertex[first]
    return vertices[chosen], inverse.reshape(-1, 3), normals[first], None if uv is None else uv[chosen]


def _frozen(array: np.ndarray, dtype) -> np.ndarray:
    array = np.ascontiguousarray(array, dtype=dtype)
    array.setflags(write=False)
    return array

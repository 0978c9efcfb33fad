"""STL, DAE and OBJ files as parts, each with one material. :mod:`ode_sim.mesh` is the door to them."""
from __future__ import annotations

import functools
import logging
import os
import struct
from dataclasses import dataclass
from typing import Dict, List, Optional, Tuple
from urllib.parse import unquote

import numpy as np

from ode_sim.description.model import DescriptionError, Material

logging.getLogger("collada").setLevel(logging.ERROR)


@dataclass(frozen=True)
class MeshPart:
    """A piece of a file with one material, unscaled."""

    name: str
    vertices: np.ndarray  # (V, 3) float64, metres
    triangles: np.ndarray  # (T, 3) int64
    normals: Optional[np.ndarray]  # (V, 3)
    uv: Optional[np.ndarray]  # (V, 2)
    material: Material


@functools.lru_cache(maxsize=64)
def read_parts(path: str, stamp) -> List[MeshPart]:
    readers = {".stl": _read_stl, ".stlb": _read_stl, ".stla": _read_stl, ".dae": _read_dae, ".obj": _read_obj}
    suffix = os.path.splitext(path)[1].lower()
    if suffix not in readers:
        raise DescriptionError(f"mesh {path}: '{suffix}' files cannot be read; use .stl, .dae or .obj")
    try:
        parts = readers[suffix](path)
    except DescriptionError:
        raise
    except ImportError as error:
        raise DescriptionError(f"mesh {path}: needs the Python package {error.name}; "
                               "scripts/setup installs it") from None
    except Exception as error:  # a parser fed with a broken file may raise anything
        reason = " ".join(str(error).split())[:150] or type(error).__name__
        raise DescriptionError(f"mesh {path}: is broken, {reason}") from None
    parts = [part for part in parts if len(part.triangles)]
    if not parts:
        raise DescriptionError(f"mesh {path}: holds no triangles")
    if not all(np.isfinite(part.vertices).all() for part in parts):
        raise DescriptionError(f"mesh {path}: holds coordinates that are not finite")
    return parts


def _read_stl(path: str) -> List[MeshPart]:
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
    vertices, triangles = weld(points, np.arange(len(points)).reshape(-1, 3))
    return [MeshPart(os.path.basename(path), vertices, triangles, None, None, Material())]


def _read_obj(path: str) -> List[MeshPart]:
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
        parts.append(MeshPart(
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


def _read_dae(path: str) -> List[MeshPart]:
    import collada
    from collada.common import DaeBrokenRefError, DaeUnsupportedError

    document = collada.Collada(path, ignore=[DaeUnsupportedError, DaeBrokenRefError])
    unit = float(document.assetInfo.unitmeter or 1.0)
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
            normals = primitive.normal[unique[:, 1]] if has_normals else None
            parts.append(MeshPart(geometry.original.name or geometry.original.id,
                               primitive.vertex[unique[:, 0]] * unit, inverse.reshape(-1, 3), normals,
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
    alpha = _dae_alpha(effect)
    if texture:
        diffuse = (1.0, 1.0, 1.0, 1.0)
    if diffuse is not None and alpha != 1.0:
        diffuse = diffuse[:3] + (alpha,)
    emissive = colour(effect.emission)
    return Material(getattr(material, "name", "") or "", ambient=diffuse, diffuse=diffuse,
                    specular=colour(effect.specular), emissive=emissive if emissive and any(emissive[:3]) else None,
                    texture=texture)


def _dae_alpha(effect) -> float:
    """Opacity by the file's own mode. A wholly transparent result is an exporter's mistake: it counts as opaque."""
    amount = effect.transparency if isinstance(effect.transparency, (int, float)) else 1.0
    colour = effect.transparent
    if not isinstance(colour, (tuple, list)):
        return 1.0
    colour = tuple(colour) + (1.0,)
    if str(getattr(effect, "opaque_mode", None) or "A_ONE").endswith("RGB_ZERO"):
        alpha = 1.0 - amount * sum(colour[:3]) / 3.0
    else:
        alpha = amount * colour[3]
    return float(alpha) if 0.0 < alpha < 1.0 else 1.0


def _texture_file(name: str, mesh_path: str) -> str:
    """An image that a mesh names: beside it, or in the ``materials/textures`` of its model."""
    name = unquote(name[7:] if name.startswith("file://") else name).replace("\\", "/")
    folder = os.path.dirname(mesh_path)
    base = os.path.basename(name)
    for candidate in (os.path.join(folder, name), os.path.join(folder, base),
                      os.path.join(folder, "../materials/textures", base), os.path.join(folder, "textures", base)):
        if os.path.isfile(candidate):
            return os.path.abspath(candidate)
    return ""


def weld(vertices: np.ndarray, triangles: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """Merge vertices closer than a millionth of the size, drop triangles without area and unused vertices."""
    if len(vertices) == 0:
        return vertices, triangles
    extent = np.ptp(vertices, axis=0).max()
    grid = np.round((vertices - vertices.min(axis=0)) / (extent * 1e-6 or 1.0)).astype(np.int64)
    keys = (grid[:, 0] * 1_000_003 + grid[:, 1]) * 1_000_003 + grid[:, 2]
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
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

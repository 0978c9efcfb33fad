"""STL, DAE and OBJ files as parts, each with one material. :mod:`ode_sim.mesh` is the door to them."""

from __future__ import annotations

import functools
import os
import re
import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ode_sim.description.model import DescriptionError, Material, one_line

MOST_BYTES = 256_000_000  # of a file
MOST_TEXT = 128_000_000  # of one that is text: it takes several times its size in memory
MOST_TRIANGLES = 5_000_000
_LONGEST_MTL = 4_000_000  # characters; what follows is not read
_VERTEX = re.compile(rb"\svertex\s+(\S+)\s+(\S+)\s+(\S+)", re.IGNORECASE)
_CORNER = re.compile(rb"\svertex\s", re.IGNORECASE)
FARTHEST = 1e9  # of a coordinate, in the file's own unit
LARGEST = 1e30  # of a surface, scaled or not; the products of larger ones are infinite


@dataclass(frozen=True)
class MeshPart:
    """A piece of a file with one material, unscaled."""

    name: str
    vertices: np.ndarray  # (V, 3) float64, metres
    triangles: np.ndarray  # (T, 3) int64
    normals: np.ndarray | None  # (V, 3)
    uv: np.ndarray | None  # (V, 2)
    material: Material
    node: str = ""  # of a Collada scene, or group of an OBJ file, that the piece is in


@functools.lru_cache(maxsize=64)
def read_parts(path: str, stamp: tuple[int, int], groups: bool = False) -> list[MeshPart]:
    """The parts of the file ``path``.

    :param groups: the groups of an OBJ file are pieces of their own, for who asks for one of them; fewer are drawn quicker
    :param stamp: of the file, by which what was read is remembered
    :raises DescriptionError: one line that names the file.
    """
    readers: dict[str, Callable[[str, bytes], list[MeshPart]]] = {
        ".stl": _read_stl,
        ".stlb": _read_stl,
        ".stla": _read_stl,
        ".dae": _read_dae,
        ".obj": functools.partial(_read_obj, groups=groups),
    }
    suffix = os.path.splitext(path)[1].lower()
    if suffix not in readers:
        raise DescriptionError(f"mesh {path}: '{suffix}' files cannot be read; use .stl, .dae or .obj")
    try:
        with np.errstate(all="ignore"):  # numbers that overflow are refused below
            parts = readers[suffix](path, file_content(path, suffix))
    except DescriptionError:
        raise
    except ImportError as error:
        raise DescriptionError(f"mesh {path}: needs the Python package {error.name}; scripts/setup installs it") from None
    except MemoryError:
        raise DescriptionError(f"mesh {path}: there is not enough memory to read it") from None
    except Exception as error:  # a parser fed with a broken file may raise anything
        reason = " ".join(one_line(error, 150).split()) or type(error).__name__
        raise DescriptionError(f"mesh {path}: is broken, {reason}") from None
    parts = [part for part in parts if len(part.triangles)]
    if not parts:
        raise DescriptionError(f"mesh {path}: holds no triangles")
    return [usable(part, path) for part in parts]


def file_content(path: str, suffix: str) -> bytes:
    """The bytes of the file ``path``; its ``suffix`` says how many make sense. :raises DescriptionError: no file, or larger."""
    most = MOST_BYTES if suffix.startswith(".stl") else MOST_TEXT
    if not os.path.isfile(path):
        raise DescriptionError(f"mesh {path}: is no file")  # a pipe would be waited for
    with open(path, "rb") as stream:
        data = stream.read(most + 1)
    if len(data) > most:
        raise DescriptionError(f"mesh {path}: is larger than {most // 1_000_000} MB; reduce its triangles")
    return data


def check_triangles(count: int, path: str) -> None:
    """:raises DescriptionError: ``count`` of them, in the file ``path``, is more than :data:`MOST_TRIANGLES`."""
    if count > MOST_TRIANGLES:
        raise DescriptionError(f"mesh {path}: has more than {MOST_TRIANGLES // 1_000_000} million triangles; reduce them")


def usable(part: MeshPart, path: str) -> MeshPart:
    """``part`` of the file ``path`` with vertices that can be drawn and collided with; normals and uv of no use are left out.

    :raises DescriptionError: broken.
    """
    _check_vertices(part.vertices, path)
    if part.triangles.min() < 0 or part.triangles.max() >= len(part.vertices):
        raise DescriptionError(f"mesh {path}: a triangle refers to a vertex that is not there")

    def fits(array: np.ndarray | None, width: int) -> bool:
        return array is not None and array.shape == (len(part.vertices), width) and bool((np.abs(array) <= FARTHEST).all())

    if (part.normals is None or fits(part.normals, 3)) and (part.uv is None or fits(part.uv, 2)):
        return part
    return replace(part, normals=part.normals if fits(part.normals, 3) else None, uv=part.uv if fits(part.uv, 2) else None)


def _check_vertices(vertices: np.ndarray, path: str) -> None:
    if not np.isfinite(vertices).all():
        raise DescriptionError(f"mesh {path}: holds coordinates that are not finite")
    if np.abs(vertices).max(initial=0.0) > FARTHEST:
        raise DescriptionError(f"mesh {path}: holds coordinates beyond {FARTHEST:g}")


def _read_stl(path: str, data: bytes) -> list[MeshPart]:
    points = _stl_text(path, data) if _is_stl_text(data) else _stl_records(path, data)
    check_triangles(len(points) // 3, path)
    _check_vertices(points, path)
    vertices, triangles = weld(points, np.arange(len(points)).reshape(-1, 3))
    return [MeshPart(os.path.basename(path), vertices, triangles, None, None, Material())]


def _is_stl_text(data: bytes) -> bool:
    """Many binary files begin with the word 'solid' as well; the length that they tell of decides, then what stands behind the word."""
    if len(data) >= 84 and len(data) == 84 + 50 * struct.unpack_from("<I", data, 80)[0]:
        return False
    begin = data[:2000].lower()
    return b"\0" not in begin and (begin.lstrip()[:5] == b"solid" or b"vertex" in begin)


def _stl_records(path: str, data: bytes) -> np.ndarray:
    """(3 T, 3) corners; what stands behind the last triangle is not read."""
    if len(data) < 84:
        raise DescriptionError(f"mesh {path}: is no STL file, or cut off ({len(data)} bytes)")
    (count,) = struct.unpack_from("<I", data, 80)
    whole = (len(data) - 84) // 50
    if count > whole:
        raise DescriptionError(f"mesh {path}: is no STL file, or cut off: it tells of {count} triangles and has {whole}")
    check_triangles(count, path)
    record = np.dtype([("normal", "<f4", 3), ("points", "<f4", (3, 3)), ("attribute", "<u2")])
    return np.frombuffer(data, record, count, 84)["points"].reshape(-1, 3).astype(float)


def _stl_text(path: str, data: bytes) -> np.ndarray:
    """(3 T, 3) corners; words may be in capitals, and all on one line."""
    found = _VERTEX.findall(data)
    check_triangles(len(found) // 3, path)
    if len(found) % 3 or len(found) != len(_CORNER.findall(data)):
        raise DescriptionError(f"mesh {path}: is cut off, {len(found)} vertices are no whole triangles")
    return np.array(found, dtype=float).reshape(-1, 3)


def _read_obj(path: str, data: bytes, groups: bool) -> list[MeshPart]:
    """Polygons with v, vt, vn; one part for each object and material, and for each group if wanted."""
    points: list[list[float]] = []
    texture_points: list[list[float]] = []
    normals: list[list[float]] = []
    materials: dict[str, Material] = {}
    corners: dict[tuple[str, str, str], list[tuple[int, int, int]]] = {}
    name, group, material = os.path.basename(path), "", ""
    rows = {"v": points, "vt": texture_points, "vn": normals}
    lines = data.decode("utf-8", "replace").replace("\\\n", " ").splitlines()
    corner_count = 0
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
            corner_count += 3 * max(0, len(polygon) - 2)
            check_triangles(corner_count // 3, path)
            fan = corners.setdefault((name, group, material), [])
            for i in range(1, len(polygon) - 1):
                fan += [polygon[0], polygon[i], polygon[i + 1]]
        elif key == "mtllib" and len(words) > 1:
            materials.update(_read_mtl(_beside(path, line.split(None, 1)[1].strip())))
        elif key == "usemtl":
            material = " ".join(words[1:])
        elif key == "o" and len(words) > 1:
            name, group = words[1], ""
        elif key == "g" and groups:
            group = words[1] if len(words) > 1 else ""
    parts = []
    for (name, group, material), used in corners.items():
        unique, inverse = np.unique(np.array(used), axis=0, return_inverse=True)
        parts.append(
            MeshPart(
                name,
                np.array(points, dtype=float)[unique[:, 0]],
                inverse.reshape(-1, 3),
                np.array(normals, dtype=float)[unique[:, 2]] if normals and (unique[:, 2] >= 0).all() else None,
                np.array([row[:2] for row in texture_points], dtype=float)[unique[:, 1]]
                if texture_points and (unique[:, 1] >= 0).all()
                else None,
                materials.get(material, Material(name=material)),
                group,
            )
        )
    return parts


def _obj_corner(word: str, points: int, texture_points: int, normals: int) -> tuple[int, int, int]:
    """``v/vt/vn``, from 1 or, negative, from the end; -1 for what is not given."""
    fields = (word.split("/") + ["", ""])[:3]

    def place(text: str, count: int) -> int:
        return -1 if not text else int(text) - 1 if int(text) > 0 else count + int(text)

    return place(fields[0], points), place(fields[1], texture_points), place(fields[2], normals)


def _numbers(words: Sequence[str]) -> list[float]:
    """Of a line; none where one of them is no number: a colour is not worth the mesh."""
    try:
        return [float(word) for word in words]
    except ValueError:
        return []


def _beside(path: str, name: str) -> str:
    """A file that ``path`` names; capitals count only if there is one with the same, as on the systems where such files are made."""
    wanted = os.path.join(os.path.dirname(path), name.replace("\\", "/"))
    if not os.path.exists(wanted):
        folder, base = os.path.split(wanted)
        try:
            names = sorted(os.listdir(folder or "."))
        except OSError:
            return wanted
        return next((os.path.join(folder, each) for each in names if each.lower() == base.lower()), wanted)
    return wanted


def _read_mtl(path: str) -> dict[str, Material]:
    if not os.path.isfile(path):
        return {}  # the shape is there all the same, drawn white
    materials: dict[str, dict[str, Any]] = {}
    current: dict[str, Any] = {}
    with open(path, encoding="utf-8", errors="replace") as stream:
        for line in stream.read(_LONGEST_MTL).splitlines():
            words = line.split()
            if not words:
                continue
            key = words[0].lower()
            if key == "newmtl":
                current = materials.setdefault(" ".join(words[1:]), {})
            elif key in ("ka", "kd", "ks", "ke"):
                colour = _numbers(words[1:4])
                if len(colour) == 3:
                    current[key.capitalize()] = tuple(colour)
            elif key == "ns" and (value := _numbers(words[1:2])):
                current["Ns"] = value[0]
            elif key in ("d", "tr") and (value := _numbers(words[-1:])):
                current["d"] = value[0] if key == "d" else 1.0 - value[0]
            elif key == "map_kd" and len(words) > 1:
                texture = _beside(path, words[-1])
                current["map_Kd"] = os.path.abspath(texture) if os.path.isfile(texture) else ""

    def material(name: str, given: dict[str, Any]) -> Material:
        alpha = (given.get("d", 1.0),)
        colour = {key: given[key] + alpha if key in given else None for key in ("Ka", "Kd", "Ks", "Ke")}
        texture = given.get("map_Kd", "")
        diffuse = colour["Kd"] or ((1.0, 1.0, 1.0) + alpha if texture else None)
        # As Gazebo 11's pictures have it (test_rendering_gazebo.py): what is not given is black, the exponent 1.
        ambient = colour["Ka"] or ((0.0, 0.0, 0.0) + alpha if given else None)
        return Material(name, ambient, diffuse, colour["Ks"], colour["Ke"], texture, given.get("Ns", 1.0))

    return {name: material(name, given) for name, given in materials.items()}


def _read_dae(path: str, data: bytes) -> list[MeshPart]:
    from ode_sim.collada_mesh import read_dae  # which takes a moment to load

    return read_dae(path, data)


def weld(vertices: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Merge vertices closer than a millionth of the size, drop triangles without area and unused vertices.

    :raises DescriptionError: the size is beyond all measure.
    """
    if len(vertices) == 0:
        return vertices, triangles
    extent = np.ptp(vertices, axis=0).max()
    if not extent < LARGEST:
        raise DescriptionError(f"its coordinates reach over {extent:g}; at most {LARGEST:g} make sense")
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

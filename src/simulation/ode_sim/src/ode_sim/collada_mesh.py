"""Collada files as parts. What their XML may hide is looked for before the library behind it reads them."""

from __future__ import annotations

import io
import logging
import os
import re
import zipfile
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Any, cast
from urllib.parse import unquote
from xml.etree import ElementTree
from xml.parsers import expat

import numpy as np

from ode_sim.description.model import DescriptionError, Material, Rgba, quoted
from ode_sim.description.xmlsource import DEEPEST, MOST_ELEMENTS
from ode_sim.mesh_files import MeshPart, check_triangles

logging.getLogger("collada").setLevel(logging.ERROR)
_MOST_INSTANCES = 50_000  # of nodes and shapes in the scene
_SHADERS = ("phong", "lambert", "blinn", "constant")
_START_TAG = re.compile(rb"""<([A-Za-z_][^\s<>/"']*)((?:\s+[^\s<>/="']+\s*=\s*(?:"[^"]*"|'[^']*'))+)""")
_LONE_AMPERSAND = re.compile(rb"&(?!(?:amp|lt|gt|quot|apos|#\d+|#x[0-9A-Fa-f]+);)")
_ENCODING = re.compile(rb"""\s*<\?xml[^>]*\sencoding\s*=\s*["']([^"']*)["']""")

# What Gazebo 11 takes for an ambient colour that is black or not there (its own pictures: test_rendering_gazebo.py).
_SHADE = (0.4, 0.4, 0.4, 1.0)


def read_dae(path: str, data: bytes) -> list[MeshPart]:
    """The shapes of the visual scene of ``data``, in metres; ``path`` is where it was read, for errors and textures.

    :raises DescriptionError: one line that names the file. A broken file may raise anything else.
    """
    scene = document(_without_bones(sound_document(path, data)))
    unit = float(scene.assetInfo.unitmeter or 1.0)
    if scene.scene is None:
        raise DescriptionError(f"mesh {path}: the Collada file has no visual scene")
    parts: list[MeshPart] = []
    triangles = 0
    for node, geometry in _placed(scene.scene.nodes):
        for primitive in geometry.primitives():
            found = [replace(part, node=node) for part, _ in parts_of(primitive, geometry.original, primitive.material, path, unit)]
            triangles += sum(len(part.triangles) for part in found)
            check_triangles(triangles, path)
            parts += found
    return parts


def _placed(nodes: Iterable[Any], matrix: np.ndarray | None = None, name: str = "") -> Iterator[tuple[str, Any]]:
    """(name of the node that it is in, geometry in its place) of all shapes below these nodes."""
    for node in nodes:
        if hasattr(node, "children"):
            inner = node.matrix if matrix is None else matrix @ node.matrix
            yield from _placed(node.children, inner, getattr(node, "node", node).xmlnode.get("name") or name)
        else:
            yield from ((name, geometry) for geometry in node.objects("geometry", matrix))


def _without_bones(data: bytes) -> bytes:
    """The same file with each shape that has a skin in the pose in which it was bound, and nothing that moves it."""
    if b"<library_controllers" not in data and b"<library_animations" not in data:
        return data
    root = ElementTree.fromstring(data)
    skins = {
        controller.get("id"): skin
        for controller in root.iter()
        if _tag(controller) == "controller"
        for skin in controller
        if _tag(skin) == "skin"
    }
    for node in list(root.iter()):
        for instance in [entry for entry in node if _tag(entry) == "instance_controller"]:
            node.remove(instance)
            skin = skins.get((instance.get("url") or "").lstrip("#"))
            if skin is not None:
                node.append(_bound(instance, skin))
    for library in [entry for entry in root if _tag(entry) in ("library_controllers", "library_animations", "library_animation_clips")]:
        root.remove(library)
    return ElementTree.tostring(root)


def _bound(instance: ElementTree.Element, skin: ElementTree.Element) -> ElementTree.Element:
    """A node with the shape below the skin."""
    namespace = instance.tag[: -len("instance_controller")]
    place = ElementTree.Element(namespace + "node")
    for matrix in (entry for entry in skin if _tag(entry) == "bind_shape_matrix"):
        ElementTree.SubElement(place, namespace + "matrix").text = matrix.text
    shape = ElementTree.SubElement(place, namespace + "instance_geometry", url="#" + (skin.get("source") or "").lstrip("#"))
    shape.extend(entry for entry in instance if _tag(entry) == "bind_material")
    return place


def document(data: bytes) -> Any:
    """What the library reads of ``data``. A shape is there all the same where how it looks is told wrongly, as in Gazebo."""
    import collada
    from collada.common import DaeBrokenRefError, DaeError, DaeUnsupportedError

    ignored = [DaeUnsupportedError, DaeBrokenRefError]
    try:
        return collada.Collada(io.BytesIO(data), ignore=ignored)
    except (AttributeError, DaeError, TypeError, ValueError):
        mended = _without_faulty_shading(data)
        if mended is None:
            raise
        return collada.Collada(io.BytesIO(mended), ignore=ignored)


def _without_faulty_shading(data: bytes) -> bytes | None:
    """The same file less what its shaders cannot be told, as MakeHuman's empty ``<transparency>``; None where none of that is in it."""
    root = ElementTree.fromstring(data)
    faulty = [(shader, told) for shader in root.iter() if _tag(shader) in _SHADERS for told in shader if not _is_shading(told)]
    for shader, told in faulty:
        shader.remove(told)
    return ElementTree.tostring(root) if faulty else None


def _tag(element: ElementTree.Element) -> str:
    return str(element.tag).rpartition("}")[2]


def _is_shading(told: ElementTree.Element) -> bool:
    if not len(told):
        return False
    kind, text = _tag(told[0]), told[0].text or ""
    if kind in ("texture", "param"):
        return True
    try:
        numbers = [float(word) for word in text.split()]
    except ValueError:
        return False
    return kind == "color" and len(numbers) >= 3 or kind == "float" and len(numbers) == 1


def parts_of(primitive: Any, geometry: Any, material: Any, path: str, unit: float = 1.0) -> list[tuple[MeshPart, np.ndarray]]:
    """Its triangles as parts, each with the numbers of the shape's corners (V,) that its own are.

    :param primitive, geometry, material: pycollada's. :param path: of the file, for textures.
    :param unit: of the file, m.
    """
    if hasattr(primitive, "triangleset"):
        primitive = primitive.triangleset()
    if (
        not hasattr(primitive, "vertex_index")
        or primitive.vertex_index is None
        or np.ndim(primitive.vertex_index) != 2
        or primitive.vertex_index.shape[1] != 3
    ):
        return []  # lines
    material = _material(material, path)
    columns = [primitive.vertex_index.ravel()]
    has_normals = primitive.normal is not None and primitive.normal_index is not None
    has_uv = bool(primitive.texcoordset) and bool(material.texture)
    columns.append(primitive.normal_index.ravel() if has_normals else np.zeros_like(columns[0]))
    columns.append(primitive.texcoord_indexset[0].ravel() if has_uv else np.zeros_like(columns[0]))
    unique, inverse = np.unique(np.stack(columns, axis=1), axis=0, return_inverse=True)
    normals = primitive.normal[unique[:, 1]] if has_normals else None
    part = MeshPart(
        geometry.name or geometry.id,
        primitive.vertex[unique[:, 0]] * unit,
        inverse.reshape(-1, 3),
        normals,
        primitive.texcoordset[0][unique[:, 2], :2] if has_uv else None,
        material,
    )
    return [(part, unique[:, 0])]


def sound_document(path: str, data: bytes) -> bytes:
    """What parsers of XML can be fed with: ``data`` of the file ``path``, or what was meant where Gazebo's parser is not as strict.

    :raises DescriptionError: what no parser should be fed with.
    """
    try:
        _Check(path).run(data)
    except expat.ExpatError as error:
        mended = _escaped(data)
        try:
            _Check(path).run(mended)
        except expat.ExpatError:
            raise DescriptionError(f"mesh {path}: is broken, {error}") from None
        return mended
    return data


def _escaped(data: bytes) -> bytes:
    """With ``<`` in attributes (Assimp names what was an STL file ``<STL_BINARY>``), lone ``&`` and old encodings put right."""
    data = _LONE_AMPERSAND.sub(b"&amp;", data)
    data = _START_TAG.sub(lambda tag: b"<" + tag[1] + tag[2].replace(b"<", b"&lt;"), data)
    encoding = _ENCODING.match(data)
    if encoding is None or encoding[1].lower() == b"utf-8":
        data = data.decode("utf-8", "replace").encode()
    return data


class _Check:
    """Refuses what would take for ever: entities, deep nesting, nodes that stand for more and more of themselves."""

    def __init__(self, path: str):
        self._path = path
        self._depth = self._elements = 0
        self._open: list[str] = [""]  # ids of the nodes around; '' is the file itself
        self._weights: dict[str, int] = {"": 0}  # of a node: itself, what is written in it
        self._refers: dict[str, list[str]] = {"": []}  # and what it stands for

    def run(self, data: bytes) -> None:
        """:raises DescriptionError: refused. :raises ExpatError: no XML."""
        if zipfile.is_zipfile(io.BytesIO(data)):
            raise self._error("is a zip archive; unpack it")
        parser = expat.ParserCreate()
        parser.StartElementHandler, parser.EndElementHandler = self._start, self._end
        parser.EntityDeclHandler = self._entity
        try:
            parser.Parse(data, True)
        finally:
            parser.StartElementHandler = parser.EndElementHandler = parser.EntityDeclHandler = None
        if self._instances() > _MOST_INSTANCES:
            raise self._error(f"its nodes stand for each other more than {_MOST_INSTANCES} times")

    def _error(self, reason: str) -> DescriptionError:
        return DescriptionError(f"mesh {self._path}: {reason}")

    def _entity(self, name: str, *_declaration: object) -> None:
        raise self._error(f"declares the entity '{quoted(name)}'; entities are not read")

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        self._depth += 1
        self._elements += 1
        if self._depth > DEEPEST:
            raise self._error(f"nests more than {DEEPEST} elements deep")
        if self._elements > MOST_ELEMENTS:
            raise self._error(f"has more than {MOST_ELEMENTS} elements")
        tag = tag.rpartition(":")[2]
        if tag == "node":
            name = attributes.get("id") or f"\0{self._elements}"
            self._refers[self._open[-1]].append(name)
            self._refers.setdefault(name, [])
            self._weights[name] = self._weights.get(name, 0) + 1
            self._open.append(name)
        elif tag == "instance_node":
            self._refers[self._open[-1]].append(attributes.get("url", "")[1:])
        elif tag in ("instance_geometry", "instance_controller"):
            self._weights[self._open[-1]] += 1

    def _end(self, tag: str) -> None:
        self._depth -= 1
        if tag.rpartition(":")[2] == "node":
            self._open.pop()

    def _instances(self) -> int:
        """How many nodes and shapes the file unfolds to, at most.

        :raises DescriptionError: a node stands for itself.
        """
        known: dict[str, int] = {}
        path: dict[str, None] = {}
        todo: list[tuple[str, bool]] = [("", False)]
        while todo:
            name, done = todo.pop()
            if done:
                del path[name]
                total = self._weights.get(name, 0) + sum(known.get(other, 0) for other in self._refers.get(name, ()))
                known[name] = min(total, _MOST_INSTANCES + 1)
            elif name in path:
                raise self._error(f"node '{quoted(name)}' stands for itself")
            elif name not in known:
                path[name] = None
                todo.append((name, True))
                todo += [(other, False) for other in self._refers.get(name, ()) if other not in known]
        return known[""]


def _material(material: Any, path: str) -> Material:
    effect = getattr(material, "effect", None)
    if effect is None:
        return Material()
    texture = ""

    def colour(value: Any) -> Rgba | None:
        nonlocal texture
        if isinstance(value, (tuple, list)):
            return cast(Rgba, tuple(float(v) for v in (tuple(value) + (1.0,))[:4]))
        image = getattr(getattr(getattr(value, "sampler", None), "surface", None), "image", None)
        if image is not None and not texture:
            texture = _texture_file(image.path, path)
        return None

    diffuse = colour(effect.diffuse)
    alpha = _alpha(effect)
    if texture:
        diffuse = (1.0, 1.0, 1.0, 1.0)
    if diffuse is not None and alpha != 1.0:
        diffuse = diffuse[:3] + (alpha,)
    emissive = colour(effect.emission)
    ambient = colour(effect.ambient) if isinstance(effect.ambient, (tuple, list)) else None
    shininess = getattr(effect, "shininess", None)
    return Material(
        getattr(material, "name", "") or "",
        ambient=ambient if ambient and any(ambient[:3]) else _SHADE,
        diffuse=diffuse,
        specular=colour(effect.specular),
        emissive=emissive if emissive and any(emissive[:3]) else None,
        texture=texture,
        shininess=float(shininess) if isinstance(shininess, (int, float)) else 0.0,
    )


def _alpha(effect: Any) -> float:
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
    for candidate in (
        os.path.join(folder, name),
        os.path.join(folder, base),
        os.path.join(folder, "../materials/textures", base),
        os.path.join(folder, "textures", base),
    ):
        if os.path.isfile(candidate):
            return os.path.abspath(candidate)
    return ""

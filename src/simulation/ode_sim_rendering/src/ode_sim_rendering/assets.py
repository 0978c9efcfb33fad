"""From a visual of the description to what is drawn: meshes, textures, colours. Everything is loaded once."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass, replace

import numpy as np
from ode_sim.description import model as d
from ode_sim.description.model import DescriptionError, one_line, quoted
from ode_sim.heightmap import load_heights
from ode_sim.images import read_rgba

from ode_sim_rendering import geometry
from ode_sim_rendering.geometry import TriMesh
from ode_sim_rendering.ground import painted

_WHITE = (1.0, 1.0, 1.0, 1.0)
_BLACK = (0.0, 0.0, 0.0, 1.0)

Piece = tuple[Hashable, d.Material | None]  # key of a mesh, the mesh's own material


@dataclass(frozen=True)
class Look:
    """Colours 0..1 as drawn: ``ambient diffuse emissive`` rgb, ``specular`` rgb, ``alpha``; ``texture`` a file or
    ''; ``texture_unit``, ``blend`` and ``alpha_above`` as in a material."""

    ambient: tuple[float, float, float]
    diffuse: tuple[float, float, float]
    specular: tuple[float, float, float]
    emissive: tuple[float, float, float]
    alpha: float
    texture: str = ""
    shininess: float = 0.0
    texture_unit: d.TextureUnit = d.TextureUnit()
    blend: str = ""
    alpha_above: float | None = None

    @property
    def see_through(self) -> bool:
        """Whether what is behind shows."""
        return self.alpha < 1.0 or self.blend not in ("", "replace")


@dataclass(frozen=True)
class Part:
    """One mesh with one look: ``key`` names the mesh among :attr:`Assets.meshes`; ``pose`` X_LP, ``scale`` (3,)."""

    key: Hashable
    look: Look
    pose: d.Pose
    scale: tuple[float, float, float]


def look_of(material: d.Material | None, own: d.Material | None, transparency: float) -> Look:
    """``material`` as written in the visual wins over the mesh's ``own``; what neither says is white.

    :param transparency: of the visual, 0 (none) to 1; the colour's own alpha counts too.
    """
    named = material if material is not None and _says_something(material) else own
    diffuse = (named and named.diffuse) or (named and named.ambient) or _WHITE
    ambient = (named and named.ambient) or diffuse
    specular = (named and named.shininess > 0.0 and named.specular) or _BLACK
    emissive = (named and named.emissive) or _BLACK
    given = named or d.Material()
    alpha = min(1.0, max(0.0, (1.0 if given.blend == "replace" else diffuse[3]) * (1.0 - transparency)))
    if not given.lighting:
        ambient, diffuse, specular, emissive = _BLACK, _BLACK, _BLACK, _WHITE
    return Look(
        ambient[:3],
        diffuse[:3],
        specular[:3],
        emissive[:3],
        alpha,
        given.texture,
        given.shininess,
        given.texture_unit,
        given.blend,
        given.alpha_above,
    )


def _says_something(material: d.Material) -> bool:
    return (
        bool(material.texture)
        or not material.lighting
        or any(colour is not None for colour in (material.ambient, material.diffuse, material.specular, material.emissive))
    )


class Assets:
    """Meshes by key and textures by file, with the lines to say about those that could not be had.

    :param load_mesh: reads a mesh file; None: ``ode_sim.mesh.load_visual``.
    :ivar meshes: key -> TriMesh. :ivar problems: lines, each naming visual, model and file; drained by the caller.
    """

    def __init__(self, load_mesh: Callable | None = None):
        if load_mesh is None:
            from ode_sim.mesh import load_visual

            load_mesh = load_visual
        self._load_mesh: Callable = load_mesh
        self.meshes: dict[Hashable, TriMesh] = {}
        self.problems: list[str] = []
        self._grounds: dict[str, d.Heightmap] = {}  # by the names of their pictures
        self._files: dict[Hashable, list[Piece]] = {}
        self._shapes = {"box": geometry.box, "sphere": geometry.sphere, "cylinder": geometry.cylinder, "plane": geometry.plane}

    def note(self, name: str, trouble: str) -> None:
        """A problem of the visual of that scoped ``name``; ``trouble`` is what is wrong with it."""
        self.problems.append(f"{_describe(name)} {trouble}")

    def parts(self, visual: d.Visual, name: str) -> list[Part]:
        """What to draw for ``visual``; empty (and a problem noted) where there is nothing.

        :param name: scoped name ``model::link::visual`` for messages.
        """
        shape = visual.geometry
        try:
            with np.errstate(all="ignore"):
                pieces, pose, scale = self._pieces(shape, visual.pose)
                given = None if isinstance(shape, d.Heightmap) and shape.layers else visual.material  # as in Gazebo
                return [Part(key, look_of(given, own, visual.transparency), pose, scale) for key, own in pieces]
        except Exception as error:  # whatever a broken file makes a parser raise: the rest is drawn all the same
            self.note(name, f"is not drawn: {one_line(error, 200).strip() or type(error).__name__}")
            return []

    def _pieces(self, shape: d.Geometry, pose: d.Pose) -> tuple[list[Piece], d.Pose, d.Vec3]:
        """([(mesh key, the mesh's own material)], pose, scale) of a geometry."""
        one = (1.0, 1.0, 1.0)
        if shape is None:
            return [], pose, one
        if isinstance(shape, d.Box):
            return self._shape("box"), pose, shape.size
        if isinstance(shape, d.Sphere):
            return self._shape("sphere"), pose, (shape.radius,) * 3
        if isinstance(shape, d.Cylinder):
            return self._shape("cylinder"), pose, (shape.radius, shape.radius, shape.length)
        if isinstance(shape, d.Plane):
            # its normal is the collision's alone, in Gazebo as well
            return self._shape("plane"), pose, (shape.size[0], shape.size[1], 1.0)
        if isinstance(shape, d.Capsule):
            return self._made(shape, lambda: geometry.capsule(shape.radius, shape.length)), pose, one
        if isinstance(shape, d.Polyline):
            return self._made(shape, lambda: geometry.extrusion(np.array(shape.points), shape.height)), pose, one
        if isinstance(shape, d.Ribbon):
            return self._made(shape, lambda: geometry.ribbon(np.array(shape.points), shape.width)), pose, one
        if isinstance(shape, d.Heightmap):
            if not shape.path:
                return [], pose, one  # the reader has said so already
            ground = self._made(shape, lambda: geometry.height_grid(load_heights(shape), shape.size, shape.pos))
            return [(key, self._painted(shape)) for key, _ in ground], pose, one
        if isinstance(shape, d.Mesh):
            return (self._mesh_file(shape) if shape.path else []), pose, one
        raise ValueError(f"geometry {type(shape).__name__} cannot be drawn")

    def _painted(self, shape: d.Heightmap) -> d.Material | None:
        """The look of a height map with layers: a picture of its own."""
        if not shape.layers:
            return None
        name = f"ground of {shape.path} {hash(shape):x}"
        self._grounds[name] = shape
        return d.Material(name, ambient=_WHITE, diffuse=_WHITE, texture=name)

    def _shape(self, name: str) -> list[Piece]:
        return self._made(name, self._shapes[name])

    def _made(self, key: Hashable, make: Callable[[], TriMesh]) -> list[Piece]:
        if key not in self.meshes:
            self.meshes[key] = make()
        return [(key, None)]

    def _mesh_file(self, shape: d.Mesh) -> list[Piece]:
        shape = replace(shape, uri="")  # the same file by two names is drawn as one mesh
        if shape not in self._files:
            pieces: list[Piece] = []
            for number, (vertices, triangles, normals, uv, material) in enumerate(
                self._load_mesh(shape.path, shape.scale, shape.submesh, shape.center)
            ):
                key = (shape, number)
                self.meshes[key] = TriMesh(vertices, normals, triangles, uv)
                pieces.append((key, material))
            self._files[shape] = pieces
        return self._files[shape]

    def _ground(self, shape: d.Heightmap, name: str) -> np.ndarray:
        def image(layer: d.GroundLayer) -> np.ndarray | None:
            try:
                return read_rgba(layer.path) if layer.path else None
            except DescriptionError as error:
                self.note(name, f"is drawn without a picture of its ground: {error}")
                return None

        return painted(shape, load_heights(shape), image)

    def texture(self, path: str, name: str, most: int = 4096) -> np.ndarray | None:
        """RGBA bytes (H,W,4), first row at the bottom, of the image file ``path``; None (and a problem noted) if unreadable.

        :param name: scoped, of the visual that wants it.
        :param most: pixels along a side; of a larger image only every second, third ... row and column is taken.
        """
        try:
            image = self._ground(self._grounds[path], name) if path in self._grounds else read_rgba(path)
        except DescriptionError as error:
            self.note(name, f"is drawn without its texture: {error}")
            return None
        step = -(-max(image.shape[:2]) // most)
        return np.ascontiguousarray(image[::-step, ::step])


def _describe(name: str) -> str:
    """``visual 'v' of link 'l' of model 'm'`` from a scoped name."""
    model, _, rest = name.partition("::")
    link, _, visual = rest.rpartition("::")
    return f"visual '{quoted(visual or name)}' of link '{quoted(link)}' of model '{quoted(model)}'"

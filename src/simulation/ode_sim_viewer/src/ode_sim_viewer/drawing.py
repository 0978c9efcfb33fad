"""The world in the page: models and lights, moved by the frames of the stream."""

from __future__ import annotations

import io
import itertools
import math
import struct
import zlib
from collections.abc import Callable, Sequence
from typing import IO, Any

import numpy as np
from ode_sim.description import model as d
from ode_sim.math3 import quat_between, quat_multiply, transform, vec3
from ode_sim_rendering.assets import Assets, Look, Part
from ode_sim_rendering.geometry import TriMesh, texture_coordinates

from ode_sim_viewer.simulation import Frame, ModelRecord, WorldRecord

_MOST_TEXTURE = 1024  # pixels along a side that a page is sent
_STILL = 1e-6  # m, and of a quaternion's parts: what moves less is not sent
_FULL = math.pi  # three.js divides by it: a light of this intensity shows a surface in its own colour
_SKY_ROWS = 128  # of the picture behind all
_SKY = ((0.44, 0.62, 0.86), (0.87, 0.92, 0.97))  # above, at the horizon
_HAZE = ((0.60, 0.68, 0.77), (0.86, 0.88, 0.90))  # where the world says nothing: Gazebo's grey, with an above
_FROM_ABOVE, _FROM_BELOW = 1.25, 0.6  # of the ambient light: what stands on a floor of its own colour is seen by its sides
_LAMP = d.Light("", "directional", diffuse=(0.6, 0.6, 0.6, 1.0), direction=(0.3, 0.5, -0.8), cast_shadows=True)  # of a world without one
_GRID_LIFT = 0.002  # m, so that the grid is seen on a ground plane


def wxyz(q: d.Quat) -> tuple[float, float, float, float]:
    """viser's order of a quaternion ``q``, x y z w."""
    return (q[3], q[0], q[1], q[2])


def byte_of(part: float) -> int:
    """``part``, 0 to 1, as 0 to 255."""
    return int(round(255 * min(1.0, max(0.0, part))))


def rgb255(colour: Sequence[float]) -> tuple[int, int, int]:
    """``colour``, red green blue from 0 to 1, as 0 to 255."""
    red, green, blue = (byte_of(part) for part in colour[:3])
    return red, green, blue


def fading_png(above: tuple[int, int, int], below: tuple[int, int, int]) -> bytes:
    """A picture of one column that goes from the colour ``above`` to ``below`` (0 to 255); all of its lower part has the second, which
    is the horizon's.
    """

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    shares = [min(1.0, row / (_SKY_ROWS / 2)) for row in range(_SKY_ROWS)]
    rows = b"".join(b"\0" + bytes(round(a + share * (b - a)) for a, b in zip(above, below)) for share in shares)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, _SKY_ROWS, 8, 2, 0, 0, 0))
        + chunk(b"IDAT", zlib.compress(rows))
        + chunk(b"IEND", b"")
    )


def _picture(pixels: np.ndarray) -> Any:
    """An image that is encoded once, quickly, for all meshes that show it: trimesh has PIL do it for each, as a small PNG, which takes a
    house of 60 models 20 s of processor time.

    :param pixels: (rows, columns, 4), 0 to 255
    """
    from PIL import Image

    image, content = Image.fromarray(pixels), io.BytesIO()
    if (pixels[..., 3] == 255).all():
        image = image.convert("RGB")
        image.save(content, "JPEG", quality=90)
        image.format = "JPEG"  # trimesh names it so
    else:
        image.save(content, "PNG", compress_level=1)

    def save(file: IO[bytes], format: str | None = None) -> None:
        file.write(content.getvalue())

    setattr(image, "save", save)  # noqa: B010  an assignment to a method is none to mypy
    return image


def take_away(node: Any) -> None:
    """Remove a node of the scene, unless it went with the one above it."""
    if not node._impl.removed:
        node.remove()


class ModelDrawing:
    """The nodes of one model: ``/m<serial>/l<link>/v<visual>_<part>``; names that people chose stay out of them."""

    def __init__(self, root: str, record: ModelRecord):
        self.root = root
        self.record = record
        self.links: dict[int, Any] = {}  # row -> frame
        self.meshes: list[Any] = []
        self.handles: list[Any] = []  # all, in the order to remove them
        self.boxes: list[tuple[str, np.ndarray]] = []  # link, (8, 3) corners in its frame of what is to be seen


class Drawing:
    """Draws a :class:`WorldRecord` with viser and keeps it up to date. One thread at a time.

    :ivar problems: lines about what cannot be drawn, drained by the caller
    """

    def __init__(
        self,
        server: Any,
        on_pick: Callable[[str, str, object], None],
        on_draw: Callable[[object, str, str], None] = lambda mesh, model, link: None,
    ):
        """:param on_pick: ``f(model, link, event)``, a click on it. :param on_draw: ``f(mesh, model, link)``."""
        self._server = server
        self._scene = server.scene
        self._on_pick = on_pick
        self._on_draw = on_draw
        self._assets = Assets()
        self._textures: dict[str, object | None] = {}
        self._models: dict[str, ModelDrawing] = {}
        self._lights: list[object] = []
        self._roads: list[Any] = []  # meshes of
        self._laid: tuple[d.Visual, ...] = ()
        self._lit: tuple = ()
        self._serial = 0
        self._shown: np.ndarray | None = None
        self._rows: dict[int, Any] = {}
        self.transparent = False
        self.wireframe = False
        self.shadows = True
        self._hidden = False
        self.grid = self._scene.add_grid(
            "/grid",
            width=20.0,
            height=20.0,
            cell_size=1.0,
            cell_thickness=0.6,
            section_size=10.0,
            section_thickness=0.8,
            position=(0.0, 0.0, _GRID_LIFT),
            cell_color=(120, 120, 120),
            section_color=(80, 80, 80),
            shadow_opacity=0.0,
        )
        self._scene.configure_environment_map(hdri=None)  # those of viser come from the internet
        self._scene.configure_default_lights(enabled=False)

    @property
    def problems(self) -> list[str]:
        return self._assets.problems

    # ------------------------------------------------------------------------------------------ what is there

    def update(self, world: WorldRecord) -> None:
        """Draw what is new in ``world``, take away what has gone."""
        wanted = {model.name: model for model in world.models}
        for name in [
            name for name, drawn in self._models.items() if name not in wanted or drawn.record.description != wanted[name].description
        ]:
            self._remove(name)
        with self._server.atomic():
            for name, record in wanted.items():
                if name in self._models:
                    self._models[name].record = record
                else:
                    self._models[name] = self._draw(record)
            self._light(world)
            self._lay(world.scene.roads)
        self.grid.visible = world.scene.grid
        self._scene.world_axes.visible = False
        self._rows = {}
        for drawn in self._models.values():
            nodes = list(drawn.links.values())
            drawn.links = dict(zip(drawn.record.links.values(), nodes))
            self._rows.update(drawn.links)
        self._shown = None

    def hide(self, on: bool) -> None:
        """Leave the models out for a while (``on``), so that something else is seen; their clicks too."""
        self._hidden = on
        for drawn in self._models.values():
            for node in drawn.links.values():
                node.visible = not on
        for mesh in self._roads:
            mesh.visible = not on

    def redraw(self, world: WorldRecord) -> None:
        """All of ``world`` anew, after a change of how things are drawn."""
        for name in list(self._models):
            self._remove(name)
        self._lit, self._laid = (), ()
        self.update(world)

    def model_root(self, name: str) -> ModelDrawing | None:
        """How the model ``name`` is drawn; None where it is not."""
        return self._models.get(name)

    def _remove(self, name: str) -> None:
        for handle in reversed(self._models.pop(name).handles):
            take_away(handle)

    def _lay(self, roads: tuple[d.Visual, ...]) -> None:
        if roads == self._laid:
            return
        self._laid = roads
        for mesh in self._roads:
            take_away(mesh)
        self._roads = [
            self._mesh(f"/road{number}_{at}", part, road, road.name)
            for number, road in enumerate(roads)
            for at, part in enumerate(self._assets.parts(road, road.name))
        ]
        for mesh in self._roads:
            mesh.visible = not self._hidden

    def _draw(self, record: ModelRecord) -> ModelDrawing:
        self._serial += 1
        drawn = ModelDrawing(f"/m{self._serial}", record)
        links = {link.name: link for link in record.description.links}
        for number, (name, row) in enumerate(record.links.items()):
            node = f"{drawn.root}_l{number}"
            drawn.links[row] = self._scene.add_frame(node, show_axes=False, visible=not self._hidden)
            drawn.handles.append(drawn.links[row])
            link = links.get(name)
            for at, visual in enumerate(link.visuals if link else ()):
                scoped = f"{record.name}::{name}::{visual.name}"
                for part_number, part in enumerate(self._assets.parts(visual, scoped)):
                    mesh = self._mesh(f"{node}/v{at}_{part_number}", part, visual, scoped)
                    drawn.meshes.append(mesh)
                    if not isinstance(visual.geometry, (d.Plane, d.Heightmap)):
                        drawn.boxes.append((name, self._box(part)))
                    drawn.handles.append(mesh)
                    mesh.on_click(lambda event, model=record.name, link=name: self._on_pick(model, link, event))
                    if not record.static:
                        self._on_draw(mesh, record.name, name)
        return drawn

    def _mesh(self, node: str, part: Part, visual: d.Visual, scoped: str) -> Any:
        look, mesh = part.look, self._assets.meshes[part.key]
        alpha = look.alpha * (0.4 if self.transparent else 1.0)
        shadow = visual.cast_shadows and alpha > 0.99
        place = dict(position=part.pose.p, wxyz=wxyz(part.pose.q))
        image = self._image(look.texture, scoped) if look.texture else None
        if image is not None and not self.wireframe:
            return self._scene.add_mesh_trimesh(node, _textured(mesh, part, image, look, alpha), cast_shadow=shadow, **place)
        # a flat thing of nothing but its scale has one side, as in Gazebo; files are shown from both
        side = "double" if isinstance(part.key, tuple) else "front"
        return self._scene.add_mesh_simple(
            node,
            np.asarray(mesh.vertices, np.float32),
            np.asarray(mesh.triangles, np.uint32),
            color=rgb255(_seen(look)),
            opacity=alpha if alpha < 0.995 else None,
            wireframe=self.wireframe,
            side=side,
            scale=tuple(float(s) for s in part.scale),
            cast_shadow=shadow,
            **place,
        )

    def _box(self, part: Part) -> np.ndarray:
        points = np.asarray(self._assets.meshes[part.key].vertices) * part.scale
        corners = itertools.product(*zip(points.min(axis=0), points.max(axis=0)))
        return np.array([transform(part.pose, vec3(corner)) for corner in corners])

    def corners(self, frame: Frame) -> tuple[np.ndarray, np.ndarray]:
        """(N, 3) corners in the world at ``frame``, m, of the boxes around what stands still and around what can move; not the
        ground's.
        """
        found: tuple[list, list] = ([], [])
        for drawn in self._models.values():
            for link, box in drawn.boxes:
                pose = frame.pose(drawn.record.links[link])
                found[0 if drawn.record.static else 1].extend(transform(pose, vec3(corner)) for corner in box)
        still, moving = (np.array(points, float).reshape(-1, 3) for points in found)
        return still, moving

    def _image(self, file: str, scoped: str) -> Any:
        if file not in self._textures:
            pixels = self._assets.texture(file, scoped, _MOST_TEXTURE)
            self._textures[file] = None if pixels is None else _picture(np.ascontiguousarray(pixels[::-1]))
        return self._textures[file]

    # ------------------------------------------------------------------------------------------ light

    def _light(self, world: WorldRecord) -> None:
        carried = tuple(
            (model.links.get(link.name), light) for model in world.models for link in model.description.links for light in link.lights
        )
        lit = (world.lights, carried, world.scene, self.shadows)
        if lit == self._lit:
            return
        self._lit = lit
        for handle in self._lights:
            take_away(handle)
        shadows = world.scene.shadows and self.shadows
        self._lights = [self._ambient(world.scene.ambient)]
        for number, light in enumerate(world.lights or (() if carried else (_LAMP,))):
            self._lights.append(self._lamp(f"/light{number}", light, shadows))
        for number, (row, light) in enumerate(carried):
            frame = next((m.links[row] for m in self._models.values() if row in m.links), None)
            if frame is not None:
                self._lights.append(self._lamp(f"{frame.name}/light{number}", light, False))
        self._background(world.scene)

    def _ambient(self, colour: d.Rgba) -> Any:
        """Gazebo's comes from everywhere, which makes one patch of grey of a grey post and its floor in a world without a lamp."""
        above, below = (rgb255([part * share for part in colour[:3]]) for share in (_FROM_ABOVE, _FROM_BELOW))
        return self._scene.add_light_hemisphere(
            "/light_ambient", sky_color=above, ground_color=below, intensity=_FULL, position=(0.0, 0.0, 1.0)
        )

    def _background(self, scene: d.Scene) -> None:
        """viser's own way would load OpenCV to write this picture, half a second before anything is seen."""
        from viser._messages import BackgroundImageMessage

        usual = d.Scene()
        colours = _SKY if scene.sky else _HAZE if scene.background == usual.background else (scene.behind_all,) * 2
        picture = fading_png(rgb255(colours[0]), rgb255(colours[1]))
        self._scene._websock_interface.queue_message(BackgroundImageMessage(format="png", rgb_data=picture, depth_data=None))

    def _lamp(self, node: str, light: d.Light, shadows: bool) -> Any:
        common = dict(color=rgb255(light.diffuse), cast_shadow=shadows and light.cast_shadows)
        turn = quat_between((0.0, 0.0, -1.0), light.direction)
        if light.type == "directional":
            # three.js: from its place towards the origin of its parent
            away = np.array(light.direction) / (np.linalg.norm(light.direction) or 1.0)
            place = tuple(float(v) for v in -away)
            return self._scene.add_light_directional(node, intensity=_FULL * 0.8, position=place, **common)
        decay = 2.0 if light.quadratic > 0.0 else 1.0 if light.linear > 0.0 else 0.0
        fading = {0.0: light.constant, 1.0: light.linear, 2.0: light.quadratic}[decay]
        options = dict(intensity=min(_FULL / max(fading, 0.05), 30.0), distance=light.range, decay=decay, position=light.pose.p, **common)
        if light.type == "spot":
            return self._scene.add_light_spot(
                node,
                angle=min(max(light.spot[1] / 2, 0.01), math.pi / 2),
                penumbra=0.5,
                direction=(0.0, 0.0, -1.0),
                wxyz=wxyz(quat_multiply(light.pose.q, turn)),
                **options,
            )
        return self._scene.add_light_point(node, **options)

    # ------------------------------------------------------------------------------------------ what moves

    def move(self, frame: Frame) -> int:
        """Put every link where ``frame`` has it; returns how many moved."""
        poses = frame.poses
        if self._shown is None or self._shown.shape != poses.shape:
            rows: np.ndarray = np.arange(len(poses))
        else:
            rows = np.flatnonzero((np.abs(poses - self._shown) > _STILL).any(axis=1))
        moved = 0
        with self._server.atomic():
            for row in rows:
                node = self._rows.get(int(row))
                if node is not None:
                    x, y, z, qx, qy, qz, qw = poses[row].tolist()
                    node.position = (x, y, z)
                    node.wxyz = (qw, qx, qy, qz)
                    moved += 1
        self._shown = poses.copy()
        return moved


def _seen(look: Look) -> tuple[float, ...]:
    return tuple(max(a, b) for a, b in zip(look.diffuse, look.emissive))


def _textured(mesh: TriMesh, part: Part, image: Any, look: Look, alpha: float) -> Any:
    import trimesh

    material = trimesh.visual.material.PBRMaterial(
        baseColorTexture=image,
        baseColorFactor=[*rgb255(_seen(look)), int(255 * alpha)],
        metallicFactor=0.0,
        roughnessFactor=1.0,
        doubleSided=True,
        alphaMode="BLEND" if alpha < 0.995 or look.blend == "alpha_blend" else "OPAQUE" if look.alpha_above is None else "MASK",
        alphaCutoff=look.alpha_above,
    )
    made = trimesh.Trimesh(
        np.asarray(mesh.vertices, float) * part.scale,
        np.asarray(mesh.triangles, np.int64),
        vertex_normals=np.asarray(mesh.normals, float),
        process=False,
    )
    made.visual = trimesh.visual.TextureVisuals(uv=texture_coordinates(mesh, look.texture_unit), material=material)
    return made

"""Draws a scene: colour, depth and segmentation images of any number of cameras, off screen."""

from __future__ import annotations

import os
from collections import OrderedDict
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from ode_sim.math3 import Pose

from ode_sim_rendering import shaders
from ode_sim_rendering.assets import Assets, Part
from ode_sim_rendering.buffers import Buffers, ImageKey, MeshKey, image_of, mesh_of
from ode_sim_rendering.camera import Camera
from ode_sim_rendering.context import create_context
from ode_sim_rendering.geometry import bounding_sphere
from ode_sim_rendering.lens import Lens
from ode_sim_rendering.scene import WORLD_FRAME, SceneDescription
from ode_sim_rendering.shadow import ShadowMap
from ode_sim_rendering.target import Target
from ode_sim_rendering.wide_lens import WideView

MAX_LIGHTS = 16
ANTIALIASING = ("none", "msaa")
_MAX_TARGETS = 8  # frame buffers kept for cameras of different sizes
_VISIBLE = 1.0 / 512.0  # a highlight darker than half a grey level is not computed

# one record per drawn part in the instance buffer; the order is that of the attributes in shaders.py
_INSTANCE = np.dtype(
    [
        ("clip", "f4", (4, 4)),
        ("world", "f4", (3, 4)),
        ("shrink", "f4", 3),
        ("base", "f4", 4),
        ("diffuse", "f4", 3),
        ("specular", "f4", 4),
        ("ident", "i4"),
    ]
)
_INSTANCE_LAYOUT = (
    ("clip0 clip1 clip2 clip3", "4f 4f 4f 4f"),
    ("world0 world1 world2", "4f 4f 4f"),
    ("shrink", "3f"),
    ("base", "4f"),
    ("diffuse", "3f"),
    ("specular", "4f"),
    ("ident", "1i"),
)


def pose_matrices(poses: np.ndarray) -> np.ndarray:
    """(N,4,4) homogeneous matrices of (N,7) poses x y z qx qy qz qw."""
    poses = np.asarray(poses, float).reshape(-1, 7)
    x, y, z, w = poses[:, 3:].T
    matrix = np.zeros((len(poses), 4, 4))
    matrix[:, 0, :3] = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], axis=1)
    matrix[:, 1, :3] = np.stack([2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)], axis=1)
    matrix[:, 2, :3] = np.stack([2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)], axis=1)
    matrix[:, :3, 3] = poses[:, :3]
    matrix[:, 3, 3] = 1
    return matrix


def _row(pose: Pose) -> np.ndarray:
    return np.array(pose.p + pose.q, float)


#: by a look's blend: OpenGL's factors of what is drawn and of what is there (moderngl is loaded with the first context)
_ZERO, _ONE, _SRC_COLOR, _ONE_MINUS_SRC_COLOR, _SRC_ALPHA, _ONE_MINUS_SRC_ALPHA, _DST_COLOR = 0, 1, 0x300, 0x301, 0x302, 0x303, 0x306
_BLENDS = {"add": (_ONE, _ONE), "modulate": (_DST_COLOR, _ZERO), "colour_blend": (_SRC_COLOR, _ONE_MINUS_SRC_COLOR)}
_OVER = (_SRC_ALPHA, _ONE_MINUS_SRC_ALPHA)


@dataclass
class _Batch:
    """Parts that one draw call covers: same mesh, same texture."""

    mesh: MeshKey
    texture: ImageKey | None
    rows: np.ndarray  # of the scene's part arrays
    instances: Any  # moderngl buffer, room for all rows
    arrays: dict[tuple[frozenset, int], Any]  # (shader flags, program) -> vertex array
    transparent: bool = False
    blend: str = ""
    alpha_above: float = 0.02  # what is hardly there is not drawn


class Renderer:
    """One OpenGL context with one scene. Use it from the thread that made it.

    :param backend: ``egl``, ``osmesa`` or ``auto``. :param antialiasing: ``none`` or ``msaa`` (4 samples).
    :param shadows: of the sun, where the scene wants them: ``on``, ``off`` or ``auto``: only where a graphics card
        draws, because with software GL a shadow costs several times the picture (``ODE_SIM_SHADOWS`` overrides
        ``auto``).
    :param assets: meshes and textures that are loaded already; None: none.
    :raises RenderingUnavailable: no OpenGL.
    """

    def __init__(self, backend: str = "auto", antialiasing: str = "none", shadows: str = "auto", assets: Assets | None = None):
        if antialiasing not in ANTIALIASING:
            raise ValueError(f"antialiasing '{antialiasing}'; use one of {', '.join(ANTIALIASING)}")
        if shadows == "auto":
            shadows = os.environ.get("ODE_SIM_SHADOWS", "") or "auto"
        if shadows not in ("on", "off", "auto"):
            raise ValueError(f"shadows '{shadows}'; use on, off or auto")
        trouble: list[str] = []
        self._ctx = create_context(backend, trouble)
        self._software = any(name in self._ctx.info["GL_RENDERER"] for name in ("llvmpipe", "softpipe"))
        # what is no longer used is deleted in set_scene, with this context current: a collector that runs while another
        # renderer draws would delete that one's objects of the same number
        self._ctx.gc_mode = "context_gc"
        self._closed = False
        self._samples = 4 if antialiasing == "msaa" else 0
        self._shadows = shadows
        self._assets = assets or Assets()
        self._assets.problems += trouble
        self._buffers = Buffers(self._ctx, self._assets)
        self._programs: dict[tuple, Any] = {}
        self._targets: OrderedDict[tuple, Target] = OrderedDict()
        self._lenses: dict[tuple, Lens] = {}
        self._views: dict[tuple, WideView] = {}  # of wide-angle lenses
        self._shadow: ShadowMap | None = None
        self.set_scene(SceneDescription())

    @property
    def device(self) -> str:
        """Name of what draws, e.g. ``llvmpipe (LLVM 15.0.6, 256 bits)``."""
        with self._ctx:
            return self._ctx.info["GL_RENDERER"]

    def take_problems(self) -> list[str]:
        """Lines about meshes, textures and lights that could not be drawn, each reported once."""
        problems, self._assets.problems = self._assets.problems, []
        return problems

    def close(self) -> None:
        """Give up the context; the renderer is of no use any more."""
        if not self._closed:
            self._closed = True
            self._ctx.release()

    # ------------------------------------------------------------------------------------------ scene

    def set_scene(self, scene: SceneDescription) -> None:
        """Draw ``scene`` from now on. Meshes and textures already loaded stay loaded."""
        with self._ctx, np.errstate(all="ignore"):
            self._scene = scene
            parts: list[tuple[int, int, str, Part]] = []  # (link row, number of the visual, its name, part)
            for number, seen in enumerate(scene.visuals):
                parts += [
                    (seen.link, number, seen.name, part)
                    for part in self._assets.parts(seen.visual, seen.name)
                    if self._buffers.take(part, seen.name)
                ]
            self._names = tuple(seen.name for seen in scene.visuals)
            self._set_parts(parts)
            # a flat floor shades nothing, and would stretch the shadow map over all of its size
            self._casts = np.array(
                [
                    scene.visuals[number].visual.cast_shadows and not part.look.see_through and part.key != "plane"
                    for _, number, _, part in parts
                ],
                bool,
            )
            self._set_batches(parts)
            self._set_lights(scene)
            self._ctx.gc()
            if self._shadow is not None:
                self._shadow.forget()
            elif self._sun >= 0:
                self._shadow = ShadowMap(self._ctx)

    @property
    def visual_names(self) -> tuple[str, ...]:
        """``model::link::visual`` for each value of a segmentation image."""
        return self._names

    def _set_parts(self, parts: list[tuple[int, int, str, Part]]) -> None:
        count = len(parts)
        ambient = np.array(self._scene.scene.ambient[:3])
        self._links = np.array([row for row, _, _, _ in parts], int)
        self._local = pose_matrices(np.array([_row(part.pose) for _, _, _, part in parts], float))
        scale = np.array([part.scale for _, _, _, part in parts], float).reshape(-1, 3)
        self._local[:, :3, :3] *= scale[:, None, :]
        spheres = [bounding_sphere(self._assets.meshes[part.key]) for _, _, _, part in parts]
        self._centres = np.array([centre for centre, _ in spheres], float).reshape(-1, 3)
        self._radii = np.array([radius for _, radius in spheres], float) * np.abs(scale).max(axis=1, initial=0)
        self._fixed = fixed = np.zeros(count, _INSTANCE)
        looks = [part.look for _, _, _, part in parts]
        # normals turn with R and shrink with S^-1; the model matrix is R S, so S^-2 makes up the difference
        fixed["shrink"] = 1.0 / np.where(scale == 0, 1.0, scale) ** 2
        for row, look in enumerate(looks):
            fixed["base"][row, :3] = np.array(look.emissive) + np.array(look.ambient) * ambient
            fixed["base"][row, 3] = look.alpha
            fixed["diffuse"][row] = look.diffuse
            fixed["specular"][row] = look.specular + (look.shininess,)
            fixed["ident"][row] = parts[row][1]

    def _set_batches(self, parts: list[tuple[int, int, str, Part]]) -> None:
        groups: OrderedDict[tuple, list[int]] = OrderedDict()
        for row, (_, _, _, part) in enumerate(parts):
            look, image = part.look, image_of(part.look)
            if image and self._buffers.texture(image) is None:
                image = None
            # transparent parts are drawn one by one, far to near
            key = (mesh_of(part), image, row if look.see_through else -1, look.blend, look.alpha_above)
            groups.setdefault(key, []).append(row)
        self._batches = [
            _Batch(
                mesh,
                image,
                np.array(rows),
                self._ctx.buffer(reserve=_INSTANCE.itemsize * len(rows), dynamic=True),
                {},
                single >= 0,
                blend,
                0.02 if alpha_above is None else alpha_above,
            )
            for (mesh, image, single, blend, alpha_above), rows in groups.items()
        ]

    def _set_lights(self, scene: SceneDescription) -> None:
        lights = list(scene.lights)
        if len(lights) > MAX_LIGHTS:
            self._assets.problems.append(
                f"{len(lights)} lights in the scene; pictures show the first {MAX_LIGHTS} only "
                f"(the first left out is '{lights[MAX_LIGHTS].light.name}')"
            )
            lights = lights[:MAX_LIGHTS]
        self._lights = lights
        self._light_kinds = tuple(entry.light.type if entry.light.type in ("point", "spot") else "directional" for entry in lights)
        wants = scene.scene.shadows and self._shadows != "off" and self._casts.any()
        if self._shadows == "auto" and self._software:
            wants = False
        self._sun = next(
            (i for i, entry in enumerate(lights) if wants and entry.light.cast_shadows and self._light_kinds[i] == "directional"), -1
        )
        brightest = max([max(entry.light.specular[:3]) for entry in lights], default=0.0)
        glossy = float(self._fixed["specular"][:, :3].max(initial=0.0)) * brightest > _VISIBLE
        flags = {"color"}
        if glossy:
            flags |= {"specular", "position"}
        if self._sun >= 0 or any(kind != "directional" for kind in self._light_kinds):
            flags.add("position")
        if "position" not in flags:
            flags.add("by_vertex")  # only suns and nothing glossy: exact on flat faces, and half the cost of a pixel
        self._color_flags = frozenset(flags)

    def _light_uniforms(self, matrices: np.ndarray) -> np.ndarray:
        """(n,5,4) float32, see shaders._light."""
        values = np.zeros((len(self._lights), 5, 4), np.float32)
        for row, entry in enumerate(self._lights):
            light = entry.light
            X_WL = pose_matrices(_row(light.pose))[0]
            if entry.link != WORLD_FRAME:
                X_WL = matrices[entry.link] @ X_WL
            direction = X_WL[:3, :3] @ np.asarray(light.direction, float)
            length = np.linalg.norm(direction)
            inner, outer, falloff = light.spot
            values[row, 0] = (*X_WL[:3, 3], light.range)
            values[row, 1] = (*(direction / length if length else (0, 0, -1)), np.cos(inner / 2))
            values[row, 2] = (*light.diffuse[:3], np.cos(outer / 2))
            values[row, 3, :3] = light.specular[:3]
            values[row, 4] = (light.constant, light.linear, light.quadratic, falloff if falloff > 0 else 1.0)
        return values

    # ------------------------------------------------------------------------------------------ images

    def color(self, camera: Camera, link_poses: np.ndarray) -> np.ndarray:
        """(H,W,3) uint8 RGB, first row at the top: what an ideal sensor ``camera`` sees (no noise; with lens distortion).

        :param link_poses: (L,7) x y z qx qy qz qw of the scene's links, world frame.
        """
        return self.images(camera, link_poses, ("color",))["color"]

    def depth(self, camera: Camera, link_poses: np.ndarray) -> np.ndarray:
        """(H,W) float32 m along the optical axis; +inf where nothing is nearer than the far clip.

        ``camera``, ``link_poses``: as for :meth:`color`.
        """
        return self.images(camera, link_poses, ("depth",))["depth"]

    def segmentation(self, camera: Camera, link_poses: np.ndarray) -> np.ndarray:
        """(H,W) int32: index into :attr:`visual_names`, :data:`~ode_sim_rendering.target.NOTHING` for the background.

        ``camera``, ``link_poses``: as for :meth:`color`.
        """
        return self.images(camera, link_poses, ("ident",))["ident"]

    def images(self, camera: Camera, link_poses: np.ndarray, outputs: Sequence[str]) -> dict[str, np.ndarray]:
        """Several ``outputs`` of one moment from one pass: any of ``color``, ``depth``, ``ident``.

        ``camera``, ``link_poses``: as for :meth:`color`. :raises ValueError: fewer poses than the scene has links.
        """
        outputs = tuple(name for name in ("color", "depth", "ident") if name in outputs)
        link_poses = np.asarray(link_poses, float).reshape(-1, 7)
        if len(link_poses) < len(self._scene.links):
            raise ValueError(f"{len(link_poses)} link poses for a scene of {len(self._scene.links)} links")
        matrices = pose_matrices(link_poses)
        with self._ctx, np.errstate(all="ignore"):  # what flew off the map is not seen
            if camera.lens is not None:
                view = self._view(camera)
                return view.joined([self._draw(side, None, matrices, outputs) for side in view.cameras(camera)])
            lens = self._lens(camera)
            pictures = self._draw(camera, lens, matrices, outputs)
        return {name: lens.distort(picture, name) for name, picture in pictures.items()} if lens else pictures

    def _lens(self, camera: Camera) -> Lens | None:
        if not camera.distortion:
            return None
        key = (camera.width, camera.height, camera.hfov, camera.distortion)
        if key not in self._lenses:
            self._lenses[key] = Lens(camera)
        return self._lenses[key]

    def _view(self, camera: Camera) -> WideView:
        key = (camera.width, camera.height, camera.lens)
        if key not in self._views:
            self._views[key] = WideView(camera)
        return self._views[key]

    def _draw(self, camera: Camera, lens: Lens | None, matrices: np.ndarray, outputs: tuple[str, ...]) -> dict[str, np.ndarray]:
        width, height = (lens.width, lens.height) if lens else (camera.width, camera.height)
        X_WC = pose_matrices(_row(camera.pose))[0]
        if camera.link:
            try:
                X_WC = matrices[self._scene.links.index(camera.link)] @ X_WC
            except ValueError:
                raise ValueError(f"camera '{camera.name}' is on link '{camera.link}', which is not in the scene") from None
        X_CW = np.linalg.inv(X_WC)
        clip = camera.projection(width, height) @ X_CW
        world = np.concatenate([matrices, np.eye(4)[None]])[self._links] @ self._local  # row -1: the world itself
        seen = self._in_view(camera, width, height, X_CW, world)
        instances = self._fixed.copy()
        instances["world"] = world[:, :3]
        instances["clip"] = clip @ world

        uniforms = self._light_uniforms(matrices) if "color" in outputs else None
        if self._sun >= 0 and uniforms is not None:
            self._draw_shadow(uniforms[self._sun, 1, :3].astype(float), world, X_WC[:3, 3])
        target = self._target(width, height, outputs)
        target.clear(self._scene.scene.behind_all)
        flags = (self._color_flags if "color" in outputs else frozenset()) | (frozenset(outputs) - {"color"})
        eye = X_WC[:3, 3]
        self._ctx.enable_only(self._ctx.DEPTH_TEST | self._ctx.CULL_FACE)
        self._ctx.front_face = "cw"  # the picture is drawn head over heels, so that its first row comes first
        clear_parts = []
        for batch in self._batches:
            rows = batch.rows[seen[batch.rows]]
            if not len(rows):
                continue
            if batch.transparent and "color" in outputs:
                clear_parts.append((float(-(X_CW[:3] @ np.append(world[rows[0], :3, 3], 1.0))[0]), rows, batch))
            else:
                self._draw_batch(batch, instances[rows], flags, uniforms, eye)
        if clear_parts:
            self._draw_transparent(clear_parts, target.frame, instances, flags, uniforms, eye)
        return target.read()

    def _draw_shadow(self, direction: np.ndarray, world: np.ndarray, eye: np.ndarray) -> None:
        casters = np.flatnonzero(self._casts)
        centres = np.einsum("pij,pj->pi", world[casters, :3, :3], self._centres[casters]) + world[casters, :3, 3]
        assert self._shadow is not None  # else nobody asks
        clip = self._shadow.aim(direction, centres, self._radii[casters], eye)
        if not self._shadow.begin(clip.tobytes() + world[casters].tobytes()):
            return
        instances = self._fixed.copy()
        instances["clip"] = clip @ world
        self._ctx.enable_only(self._ctx.DEPTH_TEST | self._ctx.CULL_FACE)
        self._ctx.front_face = "ccw"
        self._ctx.polygon_offset = 2.0, 4.0  # keeps a lit face from shading itself
        for batch in self._batches:
            rows = batch.rows[self._casts[batch.rows]]
            if len(rows):
                self._draw_batch(batch, instances[rows], frozenset(), None, eye)
        self._ctx.polygon_offset = 0.0, 0.0

    def _draw_transparent(
        self,
        parts: list[tuple[float, np.ndarray, _Batch]],
        target: Any,
        instances: np.ndarray,
        flags: frozenset[str],
        uniforms: np.ndarray | None,
        eye: np.ndarray,
    ) -> None:
        """Far to near, over what is there; depth and segmentation keep what stands behind."""
        self._ctx.enable(self._ctx.BLEND)
        target.depth_mask = False
        masks = target.color_mask
        if isinstance(masks, tuple) and isinstance(masks[0], tuple):
            target.color_mask = ((True,) * 4,) + ((False,) * 4,) * (len(masks) - 1)
        for _, rows, batch in sorted(parts, key=lambda part: part[0]):
            self._ctx.blend_func = _BLENDS.get(batch.blend, _OVER)
            self._draw_batch(batch, instances[rows], flags, uniforms, eye)
        target.color_mask, target.depth_mask = masks, True
        self._ctx.disable(self._ctx.BLEND)

    def _draw_batch(
        self, batch: _Batch, instances: np.ndarray, flags: frozenset[str], uniforms: np.ndarray | None, eye: np.ndarray
    ) -> None:
        if batch.texture is not None and "color" in flags:
            flags = flags | {"textured"} | ({batch.texture.address} & {"mirror", "border"})
            self._buffers.texture(batch.texture).use(0)
        program = self._program(flags)
        if uniforms is not None and "lights" in program:
            lights = program["lights"]  # a compiler leaves out the end of the array if the shader does not read it
            lights.write(uniforms.reshape(-1, 4)[: lights.array_length].tobytes())
        if "fog" in program:
            fog = self._scene.scene.fog
            program["fog"].value = (fog.start, fog.end, fog.density)
        if "fog_color" in program:
            program["fog_color"].value = self._scene.scene.fog.color[:3]
        if "alpha_above" in program:
            program["alpha_above"].value = batch.alpha_above
        if "eye" in program:
            program["eye"].value = tuple(eye)
        if "shadow_map" in program and self._shadow is not None:
            self._shadow.bind(program)
        batch.instances.write(instances.tobytes())
        self._vertex_array(batch, flags, program).render(instances=len(instances))

    def _in_view(self, camera: Camera, width: int, height: int, X_CW: np.ndarray, world: np.ndarray) -> np.ndarray:
        """(P,) bool: parts whose bounding sphere touches the view pyramid."""
        centre = np.einsum("pij,pj->pi", world[:, :3, :3], self._centres) + world[:, :3, 3]
        x, y, z = (centre @ X_CW[:3, :3].T + X_CW[:3, 3]).T
        radius, f = self._radii, camera.focal_length
        half_width, half_height = width / 2 / f, height / 2 / f
        return (
            (x + radius > camera.near)
            & (x - radius < camera.far)
            & (np.abs(y) - x * half_width < radius * np.hypot(1, half_width))
            & (np.abs(z) - x * half_height < radius * np.hypot(1, half_height))
        )

    # ------------------------------------------------------------------------------------------ OpenGL objects

    def _program(self, flags: frozenset) -> Any:
        lights = self._light_kinds if "color" in flags else ()
        sun = self._sun if "color" in flags else -1
        fog = self._scene.scene.fog.kind if "color" in flags and self._scene.scene.fog else ""
        key = (flags, lights, sun, fog)
        if key not in self._programs:
            self._programs[key] = self._ctx.program(
                vertex_shader=shaders.vertex_shader(flags, lights), fragment_shader=shaders.fragment_shader(flags, lights, sun, fog)
            )
        return self._programs[key]

    def _vertex_array(self, batch: _Batch, flags: frozenset, program: Any) -> Any:
        key = (flags, program.glo)
        if key not in batch.arrays:
            vertices, triangles = self._buffers.mesh(batch.mesh)
            content = [self._attributes(program, vertices, "3f 3f 2f", ("vertex", "normal", "uv"))]
            layout = " ".join(formats for _, formats in _INSTANCE_LAYOUT)
            names = tuple(" ".join(names for names, _ in _INSTANCE_LAYOUT).split())
            content.append(self._attributes(program, batch.instances, layout, names, per_instance=True))
            batch.arrays[key] = self._ctx.vertex_array(program, content, triangles)
        return batch.arrays[key]

    @staticmethod
    def _attributes(program: Any, buffer: Any, layout: str, names: Sequence[str], per_instance: bool = False) -> tuple[Any, ...]:
        """Buffer binding with padding in place of what ``program`` does not use."""
        formats, used = [], []
        for name, fmt in zip(names, layout.split()):
            if name in program:
                formats.append(fmt)
                used.append(name)
            else:
                formats.append(f"{4 * int(fmt[:-1])}x")
        return (buffer, " ".join(formats) + ("/i" if per_instance else ""), *used)

    def _target(self, width: int, height: int, outputs: tuple[str, ...]) -> Target:
        samples = self._samples if outputs == ("color",) else 0  # a depth or an index must not be averaged
        key = (width, height, outputs, samples)
        if key not in self._targets:
            while len(self._targets) >= _MAX_TARGETS:
                self._targets.popitem(last=False)
            self._targets[key] = Target(self._ctx, width, height, outputs, samples)
        self._targets.move_to_end(key)
        return self._targets[key]

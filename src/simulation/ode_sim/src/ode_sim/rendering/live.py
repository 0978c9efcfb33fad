"""The scene of a world that runs: what changed since the last picture, and pictures from within the same process."""
from __future__ import annotations

import hashlib
import weakref
from typing import Optional, Tuple

import numpy as np

from ode_sim.rendering.camera import Camera
from ode_sim.rendering.image import add_noise, encode
from ode_sim.rendering.renderer import Renderer
from ode_sim.rendering.scene import SceneDescription, describe

KINDS = ("image", "depth", "segmentation")


class SceneWatch:
    """Notices models that come and go, and lights or scene settings that change."""

    def __init__(self, world):
        self._world = weakref.ref(world)
        self._changed = True
        self._settings: Tuple = ()
        self._note = lambda _model: self.mark()
        world.on_spawn.append(self._note)
        world.on_remove.append(self._note)

    def mark(self) -> None:
        """Whoever keeps the scene has lost it: :meth:`news` tells it again."""
        self._changed = True

    def news(self) -> Optional[SceneDescription]:
        """The scene if it is another one than at the last call, else None. Physics thread."""
        world = self._world()
        settings = (world.scene, *world.lights.values())
        if not self._changed and settings == self._settings:
            return None
        self._changed, self._settings = False, settings
        return describe(world)

    def close(self) -> None:
        world = self._world()
        if world is not None:
            for callbacks in (world.on_spawn, world.on_remove):
                if self._note in callbacks:
                    callbacks.remove(self._note)


class _Studio:
    def __init__(self, world):
        self.watch = SceneWatch(world)
        self.renderer = Renderer()
        weakref.finalize(world, self.renderer.close)


_studios: "weakref.WeakKeyDictionary" = weakref.WeakKeyDictionary()


def camera_seed(world, name: str) -> int:
    """The seed of a camera's noise: from the world's seed and the camera's (scoped) name alone. Not drawn from
    ``world.rng``, whose numbers depend on how many were drawn before: a picture depends on the state shown and the
    time."""
    return int.from_bytes(hashlib.sha256(f"{world.seed}/camera {name}".encode()).digest()[:8], "little")


def render(world, camera: Camera, kind: str = "image") -> np.ndarray:
    """What ``camera`` sees of ``world`` now. Call it from one thread only.

    :param kind: ``image``: as the sensor delivers it, in the camera's format, with its noise and lens, uint8 or uint16,
        (H,W,3) or (H,W); ``depth``: (H,W) float32 m, +inf beyond the far clip; ``segmentation``: (H,W) int32, index
        into :func:`segment_names`, -1 for the background.
    :raises RenderingUnavailable: no OpenGL on this machine.
    """
    if kind not in KINDS:
        raise ValueError(f"picture kind '{kind}'; use one of {', '.join(KINDS)}")
    studio = _studio(world)
    poses = world.link_poses
    if kind == "depth":
        return studio.renderer.depth(camera, poses)
    if kind == "segmentation":
        return studio.renderer.segmentation(camera, poses)
    rgb = add_noise(studio.renderer.color(camera, poses), camera, camera_seed(world, camera.name), world.time_ns)
    return encode(rgb, camera.encoding)


def segment_names(world) -> Tuple[str, ...]:
    """``model::link::visual`` for each index of a segmentation image of ``world``."""
    return _studio(world).renderer.visual_names


def _studio(world) -> _Studio:
    if world not in _studios:
        _studios[world] = _Studio(world)
    studio = _studios[world]
    scene = studio.watch.news()
    if scene is not None:
        studio.renderer.set_scene(scene)
        world.messages.extend(studio.renderer.take_problems())
    return studio

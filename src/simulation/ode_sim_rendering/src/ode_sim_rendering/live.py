"""Pictures of a world that runs, drawn in its own process."""

from __future__ import annotations

import weakref
from typing import TYPE_CHECKING

import numpy as np

from ode_sim_rendering.camera import Camera
from ode_sim_rendering.image import add_noise, encode
from ode_sim_rendering.renderer import Renderer
from ode_sim_rendering.watch import SceneWatch, camera_seed

if TYPE_CHECKING:
    from ode_sim.world import World

KINDS = ("image", "depth", "segmentation")


class _Studio:
    def __init__(self, world: World):
        self.watch = SceneWatch(world)
        self.renderer = Renderer()
        weakref.finalize(world, self.renderer.close)


_studios: weakref.WeakKeyDictionary = weakref.WeakKeyDictionary()


def render(world: World, camera: Camera, kind: str = "image") -> np.ndarray:
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


def segment_names(world: World) -> tuple[str, ...]:
    """``model::link::visual`` for each index of a segmentation image of ``world``."""
    return _studio(world).renderer.visual_names


def _studio(world: World) -> _Studio:
    if world not in _studios:
        _studios[world] = _Studio(world)
    studio = _studios[world]
    scene = studio.watch.news()
    if scene is not None:
        studio.renderer.set_scene(scene)
        world.messages.extend(studio.renderer.take_problems())
    return studio

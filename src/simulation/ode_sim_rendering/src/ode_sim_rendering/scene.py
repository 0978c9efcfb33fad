"""What there is to see, as plain records that can be sent to another process: visuals and lights, each on a link."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from ode_sim.description.model import Light, Model, Pose, Scene, Visual
from ode_sim.math3 import compose

if TYPE_CHECKING:
    from ode_sim.world import World

WORLD_FRAME = -1


@dataclass(frozen=True)
class SceneVisual:
    """``link``: row of the link-pose array, or :data:`WORLD_FRAME`. ``name``: ``model::link::visual``, of a road its own."""

    link: int
    name: str
    visual: Visual


@dataclass(frozen=True)
class SceneLight:
    """``link``: row of the link-pose array that carries the light, or :data:`WORLD_FRAME`."""

    link: int
    light: Light


@dataclass(frozen=True)
class SceneDescription:
    """``links``: scoped names, one per row of the (L,7) link-pose array that goes with this scene."""

    links: tuple[str, ...] = ()
    visuals: tuple[SceneVisual, ...] = ()
    lights: tuple[SceneLight, ...] = ()
    scene: Scene = Scene()


def _of_link(row: int, scoped: str, visuals: Iterable[Visual], lights: Iterable[Light]) -> tuple[list[SceneVisual], list[SceneLight]]:
    return ([SceneVisual(row, f"{scoped}::{visual.name}", visual) for visual in visuals], [SceneLight(row, light) for light in lights])


def roads_of(scene: Scene) -> list[SceneVisual]:
    """The roads of ``scene`` as visuals of the world."""
    return [SceneVisual(WORLD_FRAME, road.name, road) for road in scene.roads]


def describe(world: World) -> SceneDescription:
    """The scene of a running :class:`ode_sim.World`; rows are those of ``world.link_poses``."""
    links, visuals, lights = {}, [], []
    for model in world.models.values():
        for link in model.links.values():
            links[link.index] = link.scoped_name
            seen, shining = _of_link(link.index, link.scoped_name, link.description.visuals, link.lights.values())
            visuals += seen
            lights += shining
    names = tuple(links.get(row, "") for row in range(max(links, default=-1) + 1))
    lights = [SceneLight(WORLD_FRAME, light) for light in world.lights.values()] + lights
    return SceneDescription(names, (*visuals, *roads_of(world.scene)), tuple(lights), world.scene)


def arrange(models: Iterable[Model], lights: Iterable[Light] = (), scene: Scene = Scene()) -> tuple[SceneDescription, np.ndarray]:
    """The scene of ``models`` that stand where their descriptions put them, without physics.

    :param lights: of the world, beside those of the links. :param scene: its background, ambient light, fog.
    :return: (scene, link poses (L,7): x y z qx qy qz qw, world frame).
    """
    names: list[str] = []
    visuals, shining, poses = [], [], []
    for model in models:
        for link in model.links:
            scoped = f"{model.name}::{link.name}"
            seen, of_link = _of_link(len(names), scoped, link.visuals, link.lights)
            visuals += seen
            shining += of_link
            names.append(scoped)
            pose: Pose = compose(model.pose, link.pose)
            poses.append(pose.p + pose.q)
    shining = [SceneLight(WORLD_FRAME, light) for light in lights] + shining
    return (SceneDescription(tuple(names), (*visuals, *roads_of(scene)), tuple(shining), scene), np.array(poses, float).reshape(-1, 7))

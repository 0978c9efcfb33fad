"""A running world as a description that can be written down and started again."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING

from ode_sim.description import model as d
from ode_sim.math3 import inverse, transform, vec3

if TYPE_CHECKING:
    from ode_sim.handles import LinkHandle, ModelHandle
    from ode_sim.world import World


def describe_now(world: World) -> d.World:
    """The description of ``world`` (an :class:`ode_sim.World`) with what it has become: models, poses, velocities,
    lights, settings. In the thread that steps it."""
    models, states = [], []
    for model in world.models.values():
        pose = model.pose
        models.append(
            replace(
                model.description,
                name=model.name,
                pose=pose,
                static=model.static,
                links=tuple(_link_now(model, link) for link in model.description.links),
            )
        )
        states.append(
            d.ModelState(
                model.name,
                pose,
                links=tuple(
                    d.LinkState(link.name, link.pose, _plain(link.com_velocity()), _plain(link.angular_velocity()))
                    for link in model.links.values()
                ),
            )
        )
    return replace(
        world.description,
        gravity=world.gravity,
        physics=world.physics.record(),
        scene=world.scene,
        models=tuple(models),
        lights=tuple(world.lights.values()),
        state=d.WorldState(world.time, world.iterations, tuple(states)),
    )


def _link_now(model: ModelHandle, link: d.Link) -> d.Link:
    handle = model.links.get(link.name)
    if handle is None:
        return link
    return replace(
        link,
        gravity=bool(handle.gravity),
        lights=tuple(handle.lights.values()),
        inertial=_inertial_now(handle, link.inertial) if not model.static else link.inertial,
        collisions=tuple(_collision_now(handle, collision) for collision in link.collisions),
    )


def _inertial_now(handle: LinkHandle, written: d.Inertial) -> d.Inertial:
    """As it was written, unless the mass was changed since."""
    if handle.mass == written.mass:
        return written
    ixx, iyy, izz, ixy, ixz, iyz = (float(v) for v in handle.inertia)
    com = transform(inverse(handle.pose), handle.com())
    return d.Inertial(handle.mass, d.Pose(com), ixx, ixy, ixz, iyy, iyz, izz)


def _collision_now(handle: LinkHandle, written: d.Collision) -> d.Collision:
    now = handle.collisions.get(written.name)
    if now is None:
        return written
    changed = {
        name: getattr(now.surface, name)
        for name in ("mu", "mu2", "restitution")
        if getattr(now.surface, name) != getattr(written.surface, name)
    }
    return replace(written, surface=replace(written.surface, **changed)) if changed else written


def _plain(vector: Iterable[float]) -> d.Vec3:
    return vec3(vector)

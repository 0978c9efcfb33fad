"""What must hold in every world, however it came about."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from fuzzing.findings import Found, check_message

STEPS = 50
_TURNS = np.linspace(0.0, 2.0 * np.pi, 8, endpoint=False)
_DIRECTIONS = np.concatenate([np.column_stack([np.cos(_TURNS), np.sin(_TURNS), np.full(8, z)]) for z in (-0.5, 0.0)])
_ORIGINS = np.tile((0.05, 0.03, 0.7), (len(_DIRECTIONS), 1))
_CROWDED = 5000  # contacts
_MOST_WATCHED = 200  # collisions whose contact forces are measured


def settle(world, steps: int = STEPS) -> bool:
    """Step, with contact forces measured. :return: False if it is so crowded that a step takes its time.

    :raises Found: a number of the state is not finite, or a contact belongs to nothing.
    """
    for collision in list(world._collisions.values())[:_MOST_WATCHED]:
        world.watch_contacts(collision)
    world.step(1)
    crowded = len(world.contacts()) > _CROWDED
    if not crowded:
        world.step(steps - 1)
    check_state(world)
    return not crowded


def check_state(world) -> None:
    for name in ("link_poses", "joint_positions", "joint_velocities"):
        _check_finite(world, name, np.array(getattr(world, name)))
    contacts = world.contacts()
    for name in ("position", "normal", "depth", "force", "torque"):
        _check_finite(world, f"contacts {name}", contacts[name])
    for number in set(contacts["collision1"].tolist()) | set(contacts["collision2"].tolist()):
        if world.collision(number) is None:
            raise Found("ghost", "contact with a collision that belongs to no model", f"id {number}")
    if np.isnan(world.time) or world.time < 0:
        raise Found("silent NaN", "time", str(world.time))


def _check_finite(world, name: str, numbers: np.ndarray) -> None:
    if not np.isfinite(numbers).all():
        bad = numbers[~np.isfinite(numbers)][:3]
        raise Found("silent NaN", name, f"{bad} after {world.iterations} steps; world says: {(world.messages or ['nothing'])[0][:200]}")


def check_rays(world) -> None:
    """Rays into all directions meet nothing that is not there."""
    ranges, ids = world.cast_rays(_ORIGINS, _DIRECTIONS, 20.0)
    if np.isnan(ranges).any():
        raise Found("silent NaN", "ray ranges")
    for number in set(ids.tolist()) - {-1}:
        if world.collision(number) is None:
            raise Found("ghost", "a ray hits a collision that belongs to no model", f"id {number}")


def check_replay(world) -> None:
    """A state saved, left and restored is the same, and so is what follows."""
    before = world.save()
    world.step(5)
    after = world.save()
    world.restore(before)
    if world.save() != before:
        raise Found("not restored", "the state after restore differs from the one saved")
    world.step(5)
    if world.save() != after:
        raise Found("not repeatable", "steps after restore differ from the steps before")


def check_end(world) -> None:
    """Reset, and every model removed."""
    world.reset()
    world.step(2)
    check_state(world)
    for name in list(world.models):
        world.remove(name)
    if len(world.link_poses) or len(world.joint_positions) or world._collisions:
        raise Found("left behind", "links or joints after every model was removed")
    world.step(1)


def check_messages(world, lines: Iterable[object], place: str) -> None:
    for line in lines:
        check_message(str(line), place)

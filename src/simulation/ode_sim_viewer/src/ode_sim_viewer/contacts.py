"""Where bodies touch, and with what force, for whoever draws it."""

from __future__ import annotations

from typing import Any

import numpy as np

_MOST = 2000  # contacts that are told


class ContactWatch:
    """Has the forces of all contacts measured while it is switched on. In the thread that steps the world.

    :param world: :class:`ode_sim.World`
    """

    def __init__(self, world: Any):
        self._world = world
        self._watched: dict[str, list] = {}  # model -> its collisions
        self._on = False
        world.on_spawn.append(self._add)
        world.on_remove.append(lambda model: self._watched.pop(model.name, None))

    def watch(self, on: bool) -> None:
        """Begin or end to measure (``on``)."""
        self._on = on
        for collisions in self._watched.values():
            for collision in collisions:
                self._world.watch_contacts(collision, False)
        self._watched.clear()
        if on:
            for model in self._world.models.values():
                self._add(model)

    def read(self) -> np.ndarray:
        """(N, 6) float32 of the last step: place m, force N on the body that can move (on the first of two), world axes."""
        found = self._world.contacts()[:_MOST]
        bears = np.array(
            [self._stands(one) and not self._stands(other) for one, other in zip(found["collision1"], found["collision2"])], bool
        )
        force = np.where(bears[:, None], -found["force"], found["force"])
        return np.concatenate([found["position"], force], axis=1).astype(np.float32)

    def _stands(self, collision_id: int) -> bool:
        collision = self._world.collision(collision_id)
        return collision is None or collision.link.model.static

    def _add(self, model: Any) -> None:
        if self._on:
            self._watched[model.name] = [collision for link in model.links.values() for collision in link.collisions.values()]
            for collision in self._watched[model.name]:
                self._world.watch_contacts(collision)

"""What changed in a world since its last picture, and the seed of a camera's noise: all that the physics process needs
of the rendering."""

from __future__ import annotations

import hashlib
import weakref
from typing import TYPE_CHECKING

from ode_sim_rendering.scene import SceneDescription, describe

if TYPE_CHECKING:
    from ode_sim.world import World


class SceneWatch:
    """Notices models that come and go, and lights, colours or scene settings that change."""

    def __init__(self, world: World):
        self._world = weakref.ref(world)
        self._changed = True
        self._settings: tuple = ()
        self._note = lambda _model: self.mark()
        world.on_spawn.append(self._note)
        world.on_remove.append(self._note)

    def mark(self) -> None:
        """Whoever keeps the scene has lost it: :meth:`news` tells it again."""
        self._changed = True

    def changed(self) -> bool:
        """Whether the scene is another one than at the last call. Physics thread."""
        world = self._world()
        if world is None:
            return False
        settings = (
            world.scene,
            *world.lights.values(),
            *(
                part
                for model in world.models.values()
                for link in model.links.values()
                for part in (link.description.visuals, *link.lights.values())
            ),
        )
        if not self._changed and settings == self._settings:
            return False
        self._changed, self._settings = False, settings
        return True

    def news(self) -> SceneDescription | None:
        """The scene if it :meth:`changed`, else None. Physics thread."""
        world = self._world()
        return describe(world) if world is not None and self.changed() else None

    def close(self) -> None:
        world = self._world()
        if world is not None:
            for callbacks in (world.on_spawn, world.on_remove):
                if self._note in callbacks:
                    callbacks.remove(self._note)


def camera_seed(world: World, name: str) -> int:
    """The seed of a camera's noise: from the world's seed and the camera's (scoped) name alone. Not drawn from
    ``world.rng``, whose numbers depend on how many were drawn before: a picture depends on the state shown and the
    time."""
    return int.from_bytes(hashlib.sha256(f"{world.seed}/camera {name}".encode()).digest()[:8], "little")

"""Links held together without a joint."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ode_sim.core_numbers import flat, pose_of
from ode_sim.description.model import Pose
from ode_sim.handles import LinkHandle

if TYPE_CHECKING:
    from ode_sim import _core


class Attachment:
    """Two links held together by :meth:`ode_sim.World.attach`. Part of snapshots."""

    def __init__(self, core: _core.World, parent: LinkHandle | None, child: LinkHandle) -> None:
        self.parent = parent  # None: the world
        self.child = child
        self._core = core
        self._id = core.attach(parent.core if parent else None, child.core)  # no other attachment ever has this number

    @property
    def active(self) -> bool:
        return self._core.attached(self._id)

    @property
    def pose(self) -> Pose:
        """X_PC, where the child is held; may be changed a little in every step, to move it along a path.

        :raises RuntimeError: it has let go.
        """
        return pose_of(self._core.weld_pose(self._id))

    @pose.setter
    def pose(self, pose: Pose) -> None:
        self._core.set_weld_pose(self._id, flat(pose, f"pose of attached link {self.child.scoped_name}"))

    def detach(self) -> None:
        """Let go; nothing happens if it has let go already."""
        self._core.detach(self._id)

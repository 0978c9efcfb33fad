"""The render process that all cameras of one simulator share, those of compiled plugins too; it lives as long as there is a camera."""

from __future__ import annotations

import weakref
from collections.abc import Callable

import numpy as np
import rospy
from ode_sim_rendering import Camera, Frame, RenderProcess
from ode_sim_rendering.camera import Fan


class _Shared:
    def __init__(self, world):
        self.process = RenderProcess(world, lambda line: rospy.logwarn("%s", line), lambda line: rospy.loginfo("%s", line))
        self.users = 0


_shared: weakref.WeakKeyDictionary = weakref.WeakKeyDictionary()


class Shooting:
    """One camera in the render process of ``server``'s world. Physics thread, except that frames arrive in another one.

    :param label: ``camera 'c' of model 'm'``, for the one line that says why there are no pictures.
    :param fan: it is a lidar with these rays: the simulation waits for each picture.
    :param most: of its pictures that may be under way, 1 to 8.
    :ivar failed: a picture did not come; said once.
    :param depth_range: m; depths outside of it are invalid.
    """

    def __init__(
        self, server, camera: Camera, label: str, depth_range: tuple[float, float] = (0.0, np.inf), most: int = 8, fan: Fan | None = None
    ):
        self._world = server.world
        self._wait = server.lockstep or fan is not None
        self._label, self._most = label, most
        self.failed = False
        shared = _shared.get(self._world)
        if shared is None:
            shared = _shared[self._world] = _Shared(self._world)
        self._shared = shared
        shared.users += 1
        self._camera, self._depth_range = camera, depth_range
        self._key = shared.process.add_camera(camera, depth_range, fan)

    def shoot(self, outputs: tuple[str, ...], deliver: Callable[[Frame], None]) -> bool:
        """Take a picture now; ``deliver(frame)`` is called from the pictures' thread, and not at all if there is none.

        In lock-step this returns when ``deliver`` has. Without it the picture may come later, with the stamp of now.

        :param outputs: which pictures the frame holds, see ``ode_sim_rendering.OUTPUTS``
        :returns: False when the picture is left out because too many are under way
        """
        return self._shared.process.draw(self._key, outputs, lambda frame: self._arrived(frame, deliver), self._wait, self._most)

    def _arrived(self, frame: Frame, deliver: Callable[[Frame], None]) -> None:
        if not frame.error:
            deliver(frame)
        elif not self.failed:
            self.failed = True
            rospy.logerr("%s gives no pictures: %s", self._label, frame.error)

    def change(self, camera: Camera) -> None:
        """Draw as ``camera`` is, from the next picture on."""
        process = self._shared.process
        if (camera.width, camera.height) == (self._camera.width, self._camera.height):
            process.change_camera(self._key, camera)
        else:
            process.remove_camera(self._key)
            self._key = process.add_camera(camera, self._depth_range)
        self._camera = camera

    def close(self) -> None:
        self._shared.process.remove_camera(self._key)
        self._shared.users -= 1
        if not self._shared.users:
            del _shared[self._world]
            self._shared.process.close()

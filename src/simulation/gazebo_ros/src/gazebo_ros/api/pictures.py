"""Pictures of the world for whoever asks, without a camera in it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import rospy
from ode_sim_rendering import describe

from gazebo_ros.api.handlers import Refused, advertise, listing
from gazebo_ros.server import Server
from gazebo_ros.srv import TakePicture

if TYPE_CHECKING:
    from ode_sim_rendering.portrait import Painter

_SIZE = (1280, 800)
_LARGEST = 4096  # pixels along a side


class PictureServices:
    def __init__(self, server: Server):
        self._server = server
        self._painter: Painter | None = None
        advertise(server, "take_picture", TakePicture, self._take, in_physics_thread=False)

    def _take(self, request, response) -> str:
        from ode_sim_rendering.portrait import VIEWS, Painter, Portrait

        width, height = request.width or _SIZE[0], request.height or _SIZE[1]
        eye = self._server.first_view if not request.view and not request.model else None
        view = request.view or "iso"
        if view not in VIEWS:
            raise Refused(f"no view '{view}'; there are {', '.join(VIEWS)}")
        if not 16 <= width <= _LARGEST or not 16 <= height <= _LARGEST:
            raise Refused(f"{width}x{height} pixels; each side must be 16 to {_LARGEST}")
        scene, poses, names = self._server.call(self._now)
        if request.model and request.model not in names:
            raise Refused(f"no model '{request.model}'; there are {listing(names)}")
        self._painter = self._painter or Painter()
        response.png, problems = self._painter.take(Portrait(scene, poses, request.model, view, width, height, eye))
        for line in problems:
            rospy.logdebug("take_picture: %s", line)
        return "TakePicture: done"

    def _now(self):
        world = self._server.world
        return describe(world), np.array(world.link_poses), list(world.models)

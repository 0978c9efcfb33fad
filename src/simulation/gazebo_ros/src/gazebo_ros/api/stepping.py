"""Pause, single steps and resets."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from std_srvs.srv import Empty

from gazebo_ros.api.handlers import advertise
from gazebo_ros.server import Server
from gazebo_ros.srv import StepWorld


class SteppingServices:
    def __init__(self, server: Server):
        self._server = server
        for name, f in (
            ("pause_physics", server.pause),
            ("unpause_physics", server.unpause),
            ("reset_world", server.reset_world),
            ("reset_simulation", server.reset_simulation),
            ("reset_time", server.reset_time),
        ):
            advertise(server, name, Empty, self._calling(f))
        advertise(server, "step", StepWorld, self._step, in_physics_thread=False)

    @staticmethod
    def _calling(f: Callable[[], None]) -> Callable[[Any, Any], None]:
        return lambda request, response: f()

    def _step(self, request, response) -> str:
        """Answers when the last step is done."""
        self._server.call(lambda: self._server.request_steps(request.steps)).result()
        response.sim_time, response.iterations = self._server.call(lambda: (self._server.now(), self._server.world.iterations))
        return f"Step: {request.steps} steps done"

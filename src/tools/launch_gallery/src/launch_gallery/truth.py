"""The simulated robot as the simulator knows it, and how fast the simulation runs."""

from __future__ import annotations

import time
from collections.abc import Callable

import rospy

from .errors import MeasuringError
from .motion import Sample, sample
from .simulator import Simulator

_STANDSTILL = 60.0  # s of wall time in which simulated time has to pass


class Truth:
    """Follows ``model``. Simulated time comes with each pose: no clock can run ahead of it."""

    def __init__(self, simulator: Simulator, model: str):
        self.model = model
        self._state = simulator.service("get_model_state", persistent=True)
        self._physics = simulator.service("get_physics_properties")
        self._set_physics = simulator.service("set_physics_properties")
        self._own_rate = self._physics().max_update_rate

    def now(self) -> Sample:
        """:raises MeasuringError: the robot is no longer there, or its pose is not a number."""
        answer = self._state(self.model, "")
        if not answer.success:
            raise MeasuringError(f"model {self.model}: {answer.status_message}")
        p, q = answer.pose.position, answer.pose.orientation
        found = sample(answer.header.stamp.to_sec(), (p.x, p.y, p.z), (q.x, q.y, q.z, q.w))
        if found.x != found.x:
            raise MeasuringError(f"model {self.model}: its pose is not a number")
        return found

    def pace(self, factor: float | None) -> None:
        """:param factor: simulated seconds per wall second; 0 as fast as possible, None as the world file says."""
        physics = self._physics()
        rate = self._own_rate if factor is None else factor / physics.time_step
        self._set_physics(physics.time_step, rate, physics.gravity, physics.ode_config)

    def follow(self, seconds: float, meanwhile: Callable[[float], None] | None = None) -> list[Sample]:
        """Samples over ``seconds`` of simulation.

        :param meanwhile: called with the simulated time about every 0.05 s of it.
        :raises MeasuringError: simulated time stands still.
        """
        samples = [self.now()]
        called, moved = -1.0, time.monotonic()
        while samples[-1].time < samples[0].time + seconds:
            if meanwhile and not called <= samples[-1].time < called + 0.05:
                called = samples[-1].time
                meanwhile(called)
            rospy.rostime.wallsleep(0.02 if meanwhile else 0.1)
            new = self.now()
            if new.time > samples[-1].time:
                samples.append(new)
                moved = time.monotonic()
            elif time.monotonic() - moved > _STANDSTILL:
                raise MeasuringError(f"simulated time stands still at {new.time:g} s")
        return samples

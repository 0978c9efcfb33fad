"""Pulling at a body with the mouse: a spring from the place that was gripped to the pointer; with Shift it only turns the body."""

from __future__ import annotations

import math
import threading
from typing import Any

import numpy as np
from ode_sim.math3 import Vec3, add, cross, inverse, scale, sub, transform

from ode_sim_viewer.arrows import Forces
from ode_sim_viewer.simulation import Frame, ModelRecord

MODIFIER = "cmd/ctrl"
TURNING = "cmd/ctrl+shift"
_STIFF = 30.0  # N for each m and kg of the model
_DAMPED = 0.35  # of what would not swing at all
_LASTS = 0.1  # s of sim time that one push acts; the next one comes sooner


class Pull:
    """One hand at a time. Drawing thread, but for :meth:`attach`'s events."""

    def __init__(self, page: Any):
        self._page = page
        self._arrow = Forces(page.server.scene, "/pull", (230, 120, 0))
        self._lock = threading.Lock()
        self._news: tuple | None = None  # event, model, link: the newest
        self._grip: tuple[str, str, tuple] | None = None  # model, link, place in the link's frame
        self._event: Any = None
        self._last: tuple[float, tuple] | None = None  # sim time and place of the grip

    def attach(self, mesh: Any, model: str, link: str) -> None:
        """Let ``mesh``, of ``link`` of ``model``, be pulled at, with the left button and Ctrl, or turned with Shift as well."""

        async def on_drag(event: Any) -> None:
            with self._lock:
                waiting, self._news = self._news is not None, (event, model, link)
            if not waiting:
                self._page.later(self._take)

        for modifier in (MODIFIER, TURNING):
            mesh.on_drag("left", modifier=modifier)(on_drag)

    def _take(self) -> None:
        with self._lock:
            news, self._news = self._news, None
        if news is None:
            return
        event, model, link = news
        frame = self._page.frame
        if event.phase == "end":
            self._grip = self._event = self._last = None
            self._arrow.hide()
            return
        record = self._page.world.model(model)
        if record is None or record.static or frame is None or frame.revision != self._page.world.revision:
            return
        if self._grip is None or self._grip[:2] != (model, link):
            pose = frame.pose(record.links[link])
            self._grip = (model, link, transform(inverse(pose), event.start_position))
        self._event = event
        self.move(frame)

    def move(self, frame: Frame) -> None:
        """Once for each frame: the spring pulls from where the grip is now."""
        if self._grip is None or self._event is None:
            return
        model, link, grip = self._grip
        record = self._page.world.model(model)
        if record is None or link not in record.links:
            self._grip = None
            return
        pose = frame.pose(record.links[link])
        place = transform(pose, grip)
        force = self._force(record, frame, place)
        inertial = next(other.inertial for other in record.description.links if other.name == link)
        arm = sub(place, transform(pose, inertial.pose.p))
        self._arrow.show(np.array([place]), np.array([sub(self._event.end_position, place)]), 1.0)
        torque = cross(arm, force)
        if self._event.modifier == TURNING:
            force = (0.0, 0.0, 0.0)
        self._page.attempt(self._event, lambda: self._page.simulation.push(model, link, force, torque, _LASTS))

    def _force(self, record: ModelRecord, frame: Frame, place: Vec3) -> Vec3:
        mass = sum(max(0.0, link.inertial.mass) for link in record.description.links)
        stiffness = _STIFF * mass
        force = scale(sub(self._event.end_position, place), stiffness)
        if self._last is not None and frame.sim_time > self._last[0]:
            speed = 1.0 / (frame.sim_time - self._last[0])
            brake = -2.0 * _DAMPED * math.sqrt(stiffness * mass) * speed
            force = add(force, scale(sub(place, self._last[1]), brake))
        self._last = (frame.sim_time, place)
        return force

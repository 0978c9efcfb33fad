"""Gravity, step, rate and solver of the world."""
from __future__ import annotations

from dataclasses import replace
from typing import Any, Optional

from ode_sim.viewer.panels.base import Panel
from ode_sim.viewer.simulation import WorldRecord


class PhysicsPanel(Panel):
    title = "Physics"

    def __init__(self, page: Any):
        super().__init__(page)
        self._known: Optional[str] = None
        self._gravity = self.gui.add_vector3("Gravity (m/s²)", (0.0, 0.0, -9.8), step=0.1)
        self._step = self.gui.add_number("Step (s)", 0.001, min=1e-6, max=0.1, step=0.001)
        self._rate = self.gui.add_number("Steps per second", 1000.0, min=0.0, step=100.0, hint="0: as fast as possible")
        self._iterations = self.gui.add_number("Solver iterations", 50, min=1, max=10_000, step=10)
        for control in (self._gravity, self._step, self._rate, self._iterations):
            self.on_update(control, lambda _: self._set())
        self.on_click(self.gui.add_button("Read again"), self._read)

    def on_world(self, world: WorldRecord) -> None:
        if self._known is None:
            self._known = world.name
            self._read()

    def _read(self) -> None:
        physics, gravity = self.simulation.physics()
        self._gravity.value = tuple(float(v) for v in gravity)
        self._step.value = float(physics.max_step_size)
        self._rate.value = float(physics.real_time_update_rate)
        self._iterations.value = int(physics.iters)

    def _set(self) -> None:
        physics, _ = self.simulation.physics()
        try:
            self.simulation.set_physics(
                replace(physics, max_step_size=float(self._step.value), real_time_update_rate=float(self._rate.value),
                        iters=int(self._iterations.value)), tuple(float(v) for v in self._gravity.value))
        finally:
            self._read()

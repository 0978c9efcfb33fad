"""Gravity, step, rate and solver of the world."""
from __future__ import annotations

import threading
from dataclasses import replace
from typing import Any, Callable, Optional, Tuple

from ode_sim.description import model as d
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
        self._sor = self.gui.add_number("Relaxation (SOR)", 1.3, min=0.01, max=2.0, step=0.05)
        self._soft = self.gui.add_vector2("CFM, ERP", (0.0, 0.2), min=(0.0, 0.0), max=(1.0, 1.0), step=0.01,
                                          hint="how soft contacts are, and how much of an error a step mends")
        self._correcting = self.gui.add_number("Contacts: fastest correction (m/s)", 100.0, min=0.0, step=1.0)
        self._layer = self.gui.add_number("Contacts: depth that stays (m)", 0.001, min=0.0, max=0.1, step=0.0005)
        self._contacts = self.gui.add_number("Contacts of a pair at most", 20, min=1, max=1000, step=1)
        self._lock = threading.Lock()  # each key of a number is a call of its own, in a thread of its own
        self._shown: Tuple[Tuple[Any, Callable[[d.Physics, d.Vec3], Any]], ...] = (
            (self._gravity, lambda physics, gravity: tuple(float(v) for v in gravity)),
            (self._step, lambda physics, _: float(physics.max_step_size)),
            (self._rate, lambda physics, _: float(physics.real_time_update_rate)),
            (self._iterations, lambda physics, _: int(physics.iters)),
            (self._sor, lambda physics, _: float(physics.sor)),
            (self._soft, lambda physics, _: (float(physics.cfm), float(physics.erp))),
            (self._correcting, lambda physics, _: float(physics.contact_max_correcting_vel)),
            (self._layer, lambda physics, _: float(physics.contact_surface_layer)),
            (self._contacts, lambda physics, _: int(physics.max_contacts)))
        for control, shown in self._shown:
            self.on_update(control, lambda _, control=control, shown=shown: self._set(control, shown))
        self.on_click(self.gui.add_button("Read again"), self._read)

    def on_world(self, world: WorldRecord) -> None:
        if self._known is None:
            self._known = world.name
            self._read()

    def _read(self) -> None:
        with self._lock:
            physics, gravity = self.simulation.physics()
            for control, shown in self._shown:
                control.value = shown(physics, gravity)

    def _set(self, changed: Any, shown: Callable[[d.Physics, d.Vec3], Any]) -> None:
        """What the fields hold now. None of them is written to: a hand may be typing on in it. What is refused is taken back."""
        with self._lock:
            physics, gravity = self.simulation.physics()
            try:
                self.simulation.set_physics(
                    replace(physics, max_step_size=float(self._step.value), real_time_update_rate=float(self._rate.value),
                            iters=int(self._iterations.value), sor=float(self._sor.value), cfm=float(self._soft.value[0]),
                            erp=float(self._soft.value[1]), contact_max_correcting_vel=float(self._correcting.value),
                            contact_surface_layer=float(self._layer.value), max_contacts=int(self._contacts.value)),
                    tuple(float(v) for v in self._gravity.value))
            except Exception:
                changed.value = shown(physics, gravity)
                raise

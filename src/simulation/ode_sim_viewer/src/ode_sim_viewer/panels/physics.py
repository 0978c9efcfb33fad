"""Gravity, step, rate and solver of the world."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

from ode_sim.description import model as d

from ode_sim_viewer.panels.base import Panel
from ode_sim_viewer.simulation import WorldRecord

PATIENCE = 2.0  # s after the last key, until a refused number is taken back: the "0" of 0.002 is no step


class _Field(NamedTuple):
    control: Any
    shown: Callable[[d.Physics, d.Vec3], Any]
    put: Callable[[d.Physics, d.Vec3, Any], tuple[d.Physics, d.Vec3]]


def _number(control: Any, name: str, kind: Callable[[Any], Any] = float) -> _Field:
    """:param name: of an attribute of Physics"""
    return _Field(
        control,
        lambda physics, _: kind(getattr(physics, name)),
        lambda physics, gravity, value: (replace(physics, **{name: kind(value)}), gravity),
    )


def _vector(value: Any) -> d.Vec3:
    x, y, z = (float(v) for v in value)
    return x, y, z


class PhysicsPanel(Panel):
    title = "Physics"

    def __init__(self, page: Any):
        super().__init__(page)
        self._known: str | None = None
        self._gravity = self.gui.add_vector3("Gravity (m/s²)", (0.0, 0.0, -9.8), step=0.1)
        self._step = self.gui.add_number("Step (s)", 0.001, min=1e-6, max=0.1, step=0.001)
        self._rate = self.gui.add_number("Steps per second", 1000.0, min=0.0, step=100.0, hint="0: as fast as possible")
        self._iterations = self.gui.add_number("Solver iterations", 50, min=1, max=10_000, step=10)
        self._sor = self.gui.add_number("Relaxation (SOR)", 1.3, min=0.01, max=2.0, step=0.05)
        self._soft = self.gui.add_vector2(
            "CFM, ERP",
            (0.0, 0.2),
            min=(0.0, 0.0),
            max=(1.0, 1.0),
            step=0.01,
            hint="how soft contacts are, and how much of an error a step mends",
        )
        self._correcting = self.gui.add_number("Contacts: fastest correction (m/s)", 100.0, min=0.0, step=1.0)
        self._layer = self.gui.add_number("Contacts: depth that stays (m)", 0.001, min=0.0, max=0.1, step=0.0005)
        self._contacts = self.gui.add_number("Contacts of a pair at most", 20, min=1, max=1000, step=1)
        self._lock = threading.Lock()  # each key of a number is a call of its own, in a thread of its own
        self._waiting: dict[str, threading.Timer] = {}
        self._fields = (
            _Field(self._gravity, lambda _, gravity: _vector(gravity), lambda physics, _, value: (physics, _vector(value))),
            _Field(
                self._soft,
                lambda physics, _: (float(physics.cfm), float(physics.erp)),
                lambda physics, gravity, value: (replace(physics, cfm=float(value[0]), erp=float(value[1])), gravity),
            ),
            _number(self._step, "max_step_size"),
            _number(self._rate, "real_time_update_rate"),
            _number(self._iterations, "iters", int),
            _number(self._sor, "sor"),
            _number(self._correcting, "contact_max_correcting_vel"),
            _number(self._layer, "contact_surface_layer"),
            _number(self._contacts, "max_contacts", int),
        )
        for field in self._fields:
            self.on_update(field.control, partial(self._set, field))
        self.on_click(self.gui.add_button("Read again"), self._read)

    def on_world(self, world: WorldRecord) -> None:
        if self._known is None:
            self._known = world.name
            self._read()

    def _read(self) -> None:
        with self._lock:
            now = self.simulation.physics()
            for field in self._fields:
                field.control.value = field.shown(*now)

    def _set(self, field: _Field, _value: Any = None) -> None:
        """What the field holds now. It is not written to: a hand may be typing on in it. What is refused is taken back later."""
        label = str(field.control.label)
        with self._lock:
            earlier = self._waiting.pop(label, None)
            if earlier:
                earlier.cancel()
            try:
                physics, gravity = self.simulation.physics()
                self.simulation.set_physics(*field.put(physics, gravity, field.control.value))
            except Exception:
                later = self._waiting[label] = threading.Timer(PATIENCE, self._take_back, (field, label))
                later.daemon = True
                later.start()
                raise

    def _take_back(self, field: _Field, label: str) -> None:
        with self._lock:
            if self._waiting.get(label) is threading.current_thread():
                del self._waiting[label]
                field.control.value = field.shown(*self.simulation.physics())

"""Joints of the picked model: put, or driven by force, position or velocity, as Gazebo's joint tab."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

from ode_sim.description import model as d

from ode_sim_viewer.panels.base import Panel
from ode_sim_viewer.simulation import JOINT_MODES, Frame

_MOST = 24  # sliders
_MODES = ("set", *JOINT_MODES)
_GAINS = {"position": (100.0, 0.0, 5.0), "velocity": (1.0, 0.1, 0.01)}  # p, i, d; more throws a light link about that is to keep a speed


class JointsPanel(Panel):
    title = "Joints"

    def __init__(self, page: Any):
        super().__init__(page)
        self._mode = self.gui.add_dropdown(
            "Slider", _MODES, hint="set: put the joint there at once. force, position, velocity: drive it from now on. none: let go"
        )
        with self.gui.add_folder("PID of position and velocity", expand_by_default=False):
            self._pid = tuple(
                self.gui.add_number(name, value, step=step) for name, value, step in zip("pid", _GAINS["position"], (1.0, 0.1, 0.1))
            )
        self._force = self.gui.add_number("Largest force (N m, N)", 10.0, min=0.001, step=1.0)
        self._folder = self.gui.add_folder("Pick a model first")
        self._sliders: dict[str, Any] = {}
        self._made: list[Any] = []
        self._model = ""
        page.selection.on_change.append(self._on_select)
        self._gains = dict(_GAINS)  # as they were typed last, by mode
        for gain in self._pid:
            self.on_update(gain, lambda _: self._gains.update({self._mode.value: self._typed()}))
        self.on_update(self._mode, lambda mode: page.later(lambda: self._switch(mode)))
        self._force.on_update(lambda event: event.client_id is not None and page.later(self._build))

    def on_frame(self, frame: Frame) -> None:
        record = self.page.world.model(self._model)
        if record is None or frame.revision != self.page.world.revision or self._mode.value not in ("set", "none"):
            return
        for name, slider in self._sliders.items():
            row = record.joints.get(name)
            if row is not None:
                slider.value = min(slider.max, max(slider.min, round(float(frame.joints[row]), 3)))

    def _typed(self) -> tuple:
        return tuple(float(gain.value) for gain in self._pid)

    def _switch(self, mode: str) -> None:
        for gain, value in zip(self._pid, self._gains.get(mode, self._typed())):
            gain.value = value
        self._build()

    def _on_select(self) -> None:
        if self.page.selection.model != self._model:
            self._model = self.page.selection.model
            self._build()

    def _build(self) -> None:
        for handle in self._made:
            handle.remove()
        self._made, self._sliders = [], {}
        record = self.page.world.model(self._model)
        movable = [joint for joint in record.description.joints if joint.name in record.joints] if record else []
        self._folder.label = f"{self._model}: {len(movable)} joints" if record else "Pick a model first"
        mode = self._mode.value
        with self._folder:
            for joint in movable[:_MOST]:
                low, high = range_of(joint, mode, float(self._force.value))
                slider = self.gui.add_slider(joint.name, low, high, (high - low) / 1000, max(low, min(high, 0.0)))
                self.on_update(slider, partial(self._command, joint.name))
                self._sliders[joint.name] = slider
                self._made.append(slider)

    def _command(self, joint: str, value: float) -> None:
        mode = self._mode.value
        if mode == "set":
            self.simulation.set_joint_position(self._model, joint, float(value))
        else:
            self.simulation.command_joint(self._model, joint, mode, float(value), self._typed())


def range_of(joint: d.Joint, mode: str, largest_force: float = 10.0) -> tuple[float, float]:
    """What a slider of this joint goes through: its limits, or what is usual where it has none.

    :param mode: ``force`` (N m, N), ``velocity`` (rad/s, m/s), else a position (rad, m). :param largest_force: whatever the joint bears
    """
    axis = joint.axes[0]
    if mode == "force":
        most = min(axis.effort if 0.0 < axis.effort < 1e6 else largest_force, largest_force)
        return -most, most
    if mode == "velocity":
        most = axis.velocity if 0.0 < axis.velocity < 100.0 else 2.0
        return -most, most
    low = axis.lower if axis.lower > -1e3 else -math.pi if joint.type != "prismatic" else -1.0
    high = axis.upper if axis.upper < 1e3 else math.pi if joint.type != "prismatic" else 1.0
    return (float(low), float(high)) if high > low else (float(low), float(low) + 1e-3)

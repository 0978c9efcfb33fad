"""The properties of what is picked, and what is done to it by hand."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from ode_sim.math3 import Pose

from ode_sim_viewer.eye import put_eye
from ode_sim_viewer.panels.base import Panel, escaped
from ode_sim_viewer.panels.properties import LightProperties, ModelProperties, Properties
from ode_sim_viewer.shapes import Simple
from ode_sim_viewer.simulation import Frame

_NOTHING = "Nothing is picked"


class PickedPanel(Panel):
    title = "Properties"

    def __init__(self, page: Any):
        super().__init__(page)
        self._properties: Properties | None = None
        self._folder = self.gui.add_folder(_NOTHING)
        with self.gui.add_folder("By hand"):
            self._snap = self.gui.add_number("Snap to (m)", 0.0, min=0.0, max=10.0, step=0.05)
            self._snap_angle = self.gui.add_number("Snap to (deg)", 0.0, min=0.0, max=180.0, step=5.0, hint="of roll, pitch and yaw")
        with page.commands:
            self._edit = self.gui.add_button_group("Picked", ("Copy", "Delete", "Look at"))
            self._history = self.gui.add_button_group("History", ("Undo", "Redo"))
            self._gizmo = self.gui.add_checkbox("Move and rotate by hand", False)
            self._resize = self.gui.add_checkbox("Resize by hand", False)
            self._name = self.gui.add_html(_named(""))
        self.on_update(self._gizmo, lambda _: self._set_gizmo())
        self.on_update(self._resize, lambda _: self._set_gizmo())
        for control in (self._snap, self._snap_angle):
            self.on_update(control, lambda _: self._set_gizmo())
        self._edit.on_click(self._on_edit)
        self._history.on_click(lambda event: page.attempt(event, self._undo_redo(event.target.value)))
        page.selection.on_change.append(self._on_select)
        page.resizing.on_pull = self._on_pull

    def on_frame(self, frame: Frame) -> None:
        if self._properties is not None:
            self._properties.on_frame(frame)

    def _on_select(self) -> None:
        if self._properties is not None:
            self._properties.remove()
            self._properties = None
        selection = self.page.selection
        name = selection.light or (f"{selection.model}::{selection.link}" if selection.link else selection.model)
        self._folder.label = name or _NOTHING
        self._name.content = _named(name)
        with self._folder:
            if name:
                self._properties = (LightProperties if selection.light else ModelProperties)(self)
                self._properties.build()

    def _set_gizmo(self) -> None:
        on, resize, snap = self._gizmo.value, self._resize.value, float(self._snap.value)
        angle = math.radians(float(self._snap_angle.value))
        self.page.later(lambda: self.page.selection.gizmo(on, snap, angle))
        self.page.later(lambda: self.page.resizing.show(resize, snap))

    def _on_edit(self, event: Any) -> None:
        selection = self.page.selection
        self.page.catch_up()  # what was picked a moment before is what is meant
        selection.come_back()
        if event.target.value == "Look at":
            pose = selection.pose()
            if pose is not None and event.client is not None:
                look_at(event.client, pose)
            return
        self.page.attempt(event, selection.copy if event.target.value == "Copy" else selection.delete)

    def _undo_redo(self, what: str) -> Callable[[], Any]:
        history = self.page.selection.history

        def turn() -> None:
            try:
                (history.undo if what == "Undo" else history.redo)()
            finally:
                self.page.later(self._show_anew)

        return turn

    def _on_pull(self, geometry: Simple, done: bool) -> None:
        if done:
            self._show_anew()  # the inertia, too
        elif self._properties is not None:
            self._properties.show_size(geometry)

    def _show_anew(self) -> None:
        if self._properties is not None:
            self._properties.show(self.page.simulation.describe())


def _named(name: str) -> str:
    """The frame reads it."""
    return f"<b id='picked'>{escaped(name)}</b>"


def look_at(client: Any, pose: Pose, distance: float = 2.5) -> None:
    """Turn the eye of ``client``'s page to ``pose``, from the side where it is, ``distance`` m away."""
    eye = client.camera.position
    away = [float(e) - p for e, p in zip(eye, pose.p)]
    length = math.sqrt(sum(v * v for v in away)) or 1.0
    put_eye(client, [p + v / length * distance for p, v in zip(pose.p, away)], pose.p)

"""The tree of the world, and the properties of what is picked."""
from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, Callable, List, Optional, Tuple

from ode_sim.math3 import Pose, quat_from_rpy, to_rpy
from ode_sim.viewer.panels.base import Panel
from ode_sim.viewer.simulation import Frame, LinkProperties, WorldRecord

_MOST_ROWS = 30


class WorldPanel(Panel):
    title = "World"

    def __init__(self, page: Any):
        super().__init__(page)
        self._search = self.gui.add_text("Search", "", hint="of models, links and lights whose name has this in it")
        self._list = self.gui.add_folder("Models and lights")
        self._rows: List[Any] = []
        self._listed: Optional[Tuple] = None
        self._folder = self.gui.add_folder("Nothing is picked")
        self._properties: Optional[_Properties] = None
        with self.gui.add_folder("Edit"):
            self._gizmo = self.gui.add_checkbox("Move and rotate by hand", False)
            self._snap = self.gui.add_number("Snap to (m)", 0.0, min=0.0, max=10.0, step=0.05)
            self._edit = self.gui.add_button_group("Picked", ("Copy", "Delete", "Look at"))
            self._history = self.gui.add_button_group("History", ("Undo", "Redo"))
        self._search.on_update(lambda event: self.page.later(self._list_rows))
        self.on_update(self._gizmo, lambda _: self._set_gizmo())
        self.on_update(self._snap, lambda _: self._set_gizmo())
        self._edit.on_click(self._on_edit)
        self._history.on_click(lambda event: page.attempt(event, self._undo_redo(event.target.value)))
        page.selection.on_change.append(self._on_select)

    def on_world(self, world: WorldRecord) -> None:
        self._list_rows()

    def on_frame(self, frame: Frame) -> None:
        if self._properties is not None:
            self._properties.on_frame(frame)

    # ------------------------------------------------------------------------------------------ tree

    def _list_rows(self) -> None:
        """Models and lights whose name fits, the picked model with its links."""
        rows = self._fitting()
        if rows == self._listed:
            return
        self._listed = rows
        for row in self._rows:
            row.remove()
        self._rows = []
        with self._list:
            for label, model, link, light in rows[:_MOST_ROWS]:
                button = self.gui.add_button(label, color="gray" if not link else None)
                button.on_click(lambda event, what=(model, link, light): self.page.attempt(
                    event, lambda: self.page.later(lambda: self.page.selection.select(*what))))
                self._rows.append(button)
            if len(rows) > _MOST_ROWS:
                self._rows.append(self.gui.add_html(
                    f"<div style='padding:0 0.6em;font-size:0.8em'>and {len(rows) - _MOST_ROWS} more: search</div>"))

    def _fitting(self) -> Tuple:
        """((label, model, link, light), ...)"""
        wanted, picked = self._search.value.lower(), self.page.selection.model
        rows = []
        for model in self.page.world.models:
            links = [name for name in model.links if wanted and wanted in name.lower() or model.name == picked]
            if wanted in model.name.lower() or links:
                rows.append((model.name, model.name, "", ""))
                rows += [(f"· {name}", model.name, name, "") for name in links]
        rows += [(light.name, "", "", light.name) for light in self.page.world.lights if wanted in light.name.lower()]
        return tuple(rows)

    # ------------------------------------------------------------------------------------------ what is picked

    def _on_select(self) -> None:
        self._list_rows()
        if self._properties is not None:
            self._properties.remove()
            self._properties = None
        selection = self.page.selection
        name = selection.light or (f"{selection.model}::{selection.link}" if selection.link else selection.model)
        self._folder.label = name or "Nothing is picked"
        with self._folder:
            if selection.light:
                self._properties = _LightProperties(self)
            elif selection.model:
                self._properties = _ModelProperties(self)

    def _set_gizmo(self) -> None:
        on, snap = self._gizmo.value, float(self._snap.value)
        self.page.later(lambda: self.page.selection.gizmo(on, snap))

    def _on_edit(self, event: Any) -> None:
        selection = self.page.selection
        if event.target.value == "Look at":
            pose = selection.pose()
            if pose is not None and event.client is not None:
                look_at(event.client, pose)
            return
        self.page.attempt(event, selection.copy if event.target.value == "Copy" else selection.delete)

    def _undo_redo(self, what: str) -> Callable[[], Any]:
        history = self.page.selection.history
        return history.undo if what == "Undo" else history.redo


def look_at(client: Any, pose: Pose, distance: float = 2.5) -> None:
    """Turn a page's eye to a place, from the side where it is."""
    eye = client.camera.position
    away = [float(e) - p for e, p in zip(eye, pose.p)]
    length = math.sqrt(sum(v * v for v in away)) or 1.0
    client.camera.look_at = pose.p
    client.camera.position = tuple(p + v / length * distance for p, v in zip(pose.p, away))


class _Properties:
    """Controls in the folder; removed when something else is picked."""

    def __init__(self, panel: WorldPanel):
        self.panel = panel
        self.page = panel.page
        self.gui = panel.gui
        self.handles: List[Any] = []
        self._texts: dict = {}

    def add(self, handle: Any) -> Any:
        self.handles.append(handle)
        return handle

    def remove(self) -> None:
        for handle in self.handles:
            handle.remove()

    def on_frame(self, frame: Frame) -> None:
        """Show what is now."""

    def _pose_controls(self) -> None:
        self.position = self.add(self.gui.add_vector3("Position (m)", (0.0, 0.0, 0.0), step=0.01))
        self.angles = self.add(self.gui.add_vector3("Roll pitch yaw (deg)", (0.0, 0.0, 0.0), step=1.0))
        for control in (self.position, self.angles):
            self.panel.on_update(control, lambda _: self._move())
        self._show_pose()

    def _show_pose(self) -> None:
        pose = self.page.selection.pose()
        if pose is not None:
            self.position.value = tuple(round(float(v), 4) for v in pose.p)
            self.angles.value = tuple(round(math.degrees(v), 2) for v in to_rpy(pose))

    def _move(self) -> None:
        roll, pitch, yaw = (math.radians(float(v)) for v in self.angles.value)
        self.page.selection.move(Pose(tuple(float(v) for v in self.position.value), quat_from_rpy(roll, pitch, yaw)))


class _ModelProperties(_Properties):
    def __init__(self, panel: WorldPanel):
        super().__init__(panel)
        selection = self.page.selection
        record = selection.record
        self._model = record.name
        self._link = selection.link or (next(iter(record.links)) if len(record.links) == 1 else "")
        self._pose_controls()
        for control in (self.position, self.angles):
            control.disabled = bool(selection.link)  # a link is moved by its joints, or with its model
        if self._link and not record.static:
            self._mass_controls(self.page.simulation.link_properties(self._model, self._link))

    def on_frame(self, frame: Frame) -> None:
        self._show_pose()

    def _mass_controls(self, now: LinkProperties) -> None:
        self.mass = self.add(self.gui.add_number("Mass (kg)", float(now.mass), min=1e-6, step=0.1))
        self.gravity = self.add(self.gui.add_checkbox("Gravity", now.gravity))
        self.force = self.add(self.gui.add_vector3("Force (N)", (0.0, 0.0, 10.0), step=1.0))
        self.torque = self.add(self.gui.add_vector3("Torque (N m)", (0.0, 0.0, 0.0), step=0.1))
        self.duration = self.add(self.gui.add_number("For (s)", 0.1, min=0.001, max=1000.0, step=0.1))
        push = self.add(self.gui.add_button("Apply force and torque"))
        self.panel.on_update(self.mass, lambda _: self._set_mass())
        self.panel.on_update(self.gravity, lambda _: self._set_mass())
        self.panel.on_click(push, lambda: self.page.simulation.push(
            self._model, self._link, tuple(self.force.value), tuple(self.torque.value), float(self.duration.value)))

    def _set_mass(self) -> None:
        """A new mass keeps the shape: the inertia grows with it."""
        simulation = self.page.simulation
        now = simulation.link_properties(self._model, self._link)
        mass = float(self.mass.value)
        factor = mass / now.mass if now.mass else 1.0
        simulation.set_link_properties(self._model, self._link, replace(
            now, mass=mass, inertia=tuple(v * factor for v in now.inertia), gravity=bool(self.gravity.value)))


class _LightProperties(_Properties):
    def __init__(self, panel: WorldPanel):
        super().__init__(panel)
        light = self.page.selection.light_record
        self._pose_controls()
        self.diffuse = self.add(self.gui.add_rgb("Colour", tuple(int(255 * min(1.0, c)) for c in light.diffuse[:3])))
        self.shadows = self.add(self.gui.add_checkbox("Casts shadows", light.cast_shadows))
        self.panel.on_update(self.diffuse, lambda value: self._set(
            diffuse=tuple(c / 255 for c in value) + (1.0,)))
        self.panel.on_update(self.shadows, lambda value: self._set(cast_shadows=bool(value)))
        if light.type != "directional":
            self.range = self.add(self.gui.add_number("Range (m)", float(light.range), min=0.0, step=0.5))
            self.panel.on_update(self.range, lambda value: self._set(range=float(value)))

    def _set(self, **changes: Any) -> None:
        self.page.simulation.set_light(replace(self.page.selection.light_record, **changes))

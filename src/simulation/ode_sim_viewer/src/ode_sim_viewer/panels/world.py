"""The tree of the world, and the properties of what is picked."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any

from ode_sim.math3 import Pose

from ode_sim_viewer.eye import put_eye
from ode_sim_viewer.panels.base import Panel, note
from ode_sim_viewer.panels.properties import LightProperties, ModelProperties, Properties
from ode_sim_viewer.shapes import Simple
from ode_sim_viewer.simulation import Frame, WorldRecord

_MOST_ROWS = 30
_KEPT = 10.0  # wall s that a row is kept after it was hidden: a click on it may be under way, an undo may bring it back
Row = tuple[str, str, str, str]  # label, model, link, light


class WorldPanel(Panel):
    title = "World"

    def __init__(self, page: Any):
        super().__init__(page)
        # above what grows and shrinks by what they do, else the next click of a quick hand lands on something else
        self._edit = self.gui.add_button_group("Picked", ("Copy", "Delete", "Look at"))
        self._history = self.gui.add_button_group("History", ("Undo", "Redo"))
        self._search = self.gui.add_text("Search", "", hint="of models, links and lights whose name has this in it")
        self._list = self.gui.add_folder("Models and lights")
        self._rows: dict[Row, Any] = {}
        self._hidden: dict[Row, float] = {}  # row -> wall s when it was hidden
        self._more: Any | None = None
        self._listed: tuple | None = None
        self._folder = self.gui.add_folder("Nothing is picked")
        self._properties: Properties | None = None
        with self.gui.add_folder("By hand"):
            self._gizmo = self.gui.add_checkbox("Move and rotate by hand", False)
            self._resize = self.gui.add_checkbox("Resize by hand", False, hint="the three knobs of a box, sphere or cylinder")
            self._snap = self.gui.add_number("Snap to (m)", 0.0, min=0.0, max=10.0, step=0.05)
            self._snap_angle = self.gui.add_number("Snap to (deg)", 0.0, min=0.0, max=180.0, step=5.0, hint="of roll, pitch and yaw")
        self._search.on_update(lambda event: self.page.later(self._list_rows))
        self.on_update(self._gizmo, lambda _: self._set_gizmo())
        self.on_update(self._resize, lambda _: self._set_gizmo())
        for control in (self._snap, self._snap_angle):
            self.on_update(control, lambda _: self._set_gizmo())
        self._edit.on_click(self._on_edit)
        self._history.on_click(lambda event: page.attempt(event, self._undo_redo(event.target.value)))
        page.selection.on_change.append(self._on_select)
        page.resizing.on_pull = self._on_pull

    def on_world(self, world: WorldRecord) -> None:
        self._list_rows()

    def on_frame(self, frame: Frame) -> None:
        if self._properties is not None:
            self._properties.on_frame(frame)
        long_ago = time.monotonic() - _KEPT
        for row in [row for row, since in self._hidden.items() if since < long_ago]:
            del self._hidden[row]
            self._rows.pop(row).remove()

    # ------------------------------------------------------------------------------------------ tree

    def _list_rows(self) -> None:
        """Models and lights whose name fits, the picked model with its links."""
        rows = self._fitting()
        if rows == self._listed:
            return
        self._listed = rows
        shown = rows[:_MOST_ROWS]
        for row, button in self._rows.items():
            if row not in shown and row not in self._hidden:
                button.visible = False
                self._hidden[row] = time.monotonic()
        if self._more is not None:
            self._more.remove()
            self._more = None
        with self._list:
            for number, row in enumerate(shown):  # rows that stay are not drawn anew under the hand
                if row not in self._rows:
                    self._rows[row] = self._row(row, float(number))
                    continue
                self._rows[row].order = float(number)
                if self._hidden.pop(row, None) is not None:
                    self._rows[row].visible = True
            if len(rows) > _MOST_ROWS:
                self._more = self.gui.add_html(note(f"and {len(rows) - _MOST_ROWS} more: search"), order=1e6)

    def _row(self, row: Row, order: float) -> Any:
        label, *what = row
        button = self.gui.add_button(label, color="gray" if not row[2] else None, order=order)
        button.on_click(lambda event: self.page.attempt(event, lambda: self.page.later(lambda: self.page.selection.select(*what))))
        return button

    def _fitting(self) -> tuple[Row, ...]:
        wanted, picked = self._search.value.lower(), self.page.selection.model
        rows = []
        for model in self.page.world.models:
            fits = wanted in model.name.lower()
            links = [name for name in model.links if wanted and wanted in name.lower() or fits and model.name == picked]
            if fits or links:
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


def look_at(client: Any, pose: Pose, distance: float = 2.5) -> None:
    """Turn a page's eye to a place, from the side where it is."""
    eye = client.camera.position
    away = [float(e) - p for e, p in zip(eye, pose.p)]
    length = math.sqrt(sum(v * v for v in away)) or 1.0
    put_eye(client, [p + v / length * distance for p, v in zip(pose.p, away)], pose.p)

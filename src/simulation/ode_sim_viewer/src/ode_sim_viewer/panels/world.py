"""The tree of the world: what is in it, and what else of it has a list of properties."""

from __future__ import annotations

import time
from typing import Any

from ode_sim_viewer.panels.base import Panel, note
from ode_sim_viewer.simulation import Frame, WorldRecord

_MOST_ROWS = 30
_KEPT = 10.0  # wall s that a row is kept after it was hidden: a click on it may be under way, an undo may bring it back
_LISTS = ("Scene", "Physics")  # tabs of this title: the frame opens them. Without icons: viser takes 20 ms to read one
_MODEL, _LINK, _LIGHT = "box", "point-filled", "bulb"  # icons; the frame moves a link to the right by its own
_PICKED, _OTHER = "blue", "gray"  # rows; the frame draws them otherwise
Row = tuple[str, str, str, str]  # label, model, link, light


class WorldPanel(Panel):
    title = "World"
    upper = True

    def __init__(self, page: Any):
        super().__init__(page)
        self._search = self.gui.add_text("Search", "", hint="of models, links and lights whose name has this in it")
        for title in _LISTS:
            self.gui.add_button(title, color=_OTHER)
        self._models = self.gui.add_folder("Models")
        self._lights = self.gui.add_folder("Lights")
        self._rows: dict[Row, Any] = {}
        self._hidden: dict[Row, float] = {}  # row -> wall s when it was hidden
        self._more: Any | None = None
        self._listed: tuple | None = None
        self._search.on_update(lambda event: self.page.later(self._list_rows))
        page.selection.on_change.append(self._on_select)

    def on_world(self, world: WorldRecord) -> None:
        self._list_rows()

    def on_frame(self, frame: Frame) -> None:
        long_ago = time.monotonic() - _KEPT
        for row in [row for row, since in self._hidden.items() if since < long_ago]:
            del self._hidden[row]
            self._rows.pop(row).remove()

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
        for number, row in enumerate(shown):  # rows that stay are not drawn anew under the hand
            if row not in self._rows:
                self._rows[row] = self._row(row, float(number))
                continue
            self._rows[row].order = float(number)
            if self._hidden.pop(row, None) is not None:
                self._rows[row].visible = True
        if len(rows) > _MOST_ROWS:
            with self._models:
                self._more = self.gui.add_html(note(f"and {len(rows) - _MOST_ROWS} more: search"), order=1e6)

    def _row(self, row: Row, order: float) -> Any:
        label, model, link, light = row
        icon = _LIGHT if light else _LINK if link else _MODEL
        with self._lights if light else self._models:
            button = self.gui.add_button(label, color=self._colour(row), icon=icon, order=order)
        button.on_click(
            lambda event: self.page.attempt(event, lambda: self.page.later(lambda: self.page.selection.select(model, link, light)))
        )
        return button

    def _colour(self, row: Row) -> Any:
        selection = self.page.selection
        return _PICKED if row[1:] == (selection.model, selection.link, selection.light) else _OTHER

    def _fitting(self) -> tuple[Row, ...]:
        wanted, picked = self._search.value.lower(), self.page.selection.model
        rows = []
        for model in self.page.world.models:
            fits = wanted in model.name.lower()
            links = [name for name in model.links if wanted and wanted in name.lower() or fits and model.name == picked]
            if fits or links:
                rows.append((model.name, model.name, "", ""))
                rows += [(name, model.name, name, "") for name in links]
        rows += [(light.name, "", "", light.name) for light in self.page.world.lights if wanted in light.name.lower()]
        return tuple(rows)

    def _on_select(self) -> None:
        self._list_rows()
        for row, button in self._rows.items():
            colour = self._colour(row)
            if button.color != colour:
                button.color = colour

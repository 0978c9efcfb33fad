"""How the world is drawn."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable
from functools import partial
from typing import Any

from ode_sim_viewer.eye import put_eye, view_of
from ode_sim_viewer.overlays import Overlays
from ode_sim_viewer.panels.base import Panel, escaped
from ode_sim_viewer.simulation import Frame

_VIEWS = {"Front": (1.0, 0.0, 0.15), "Left": (0.0, 1.0, 0.15), "Top": (0.01, 0.0, 1.0), "Corner": (0.7, -0.7, 0.4)}


class ViewPanel(Panel):
    title = "Scene"

    def __init__(self, page: Any):
        super().__init__(page)
        self._doing, self._telling = threading.Lock(), threading.Lock()  # viser calls back from several threads at once
        self._switches: dict[str, tuple[Any, Callable[[bool], Any]]] = {}  # by label: the box, and what it does
        self._heard: dict[int, str] = {}  # by client: what it asked last
        with page.commands:  # for the menu: a browser draws the boxes of a list that is not shown only when it is idle
            self._asked = self.gui.add_text("Switch", "")
            self._told = self.gui.add_html("")
        self._asked.on_update(self._on_asked)
        for kind in Overlays.KINDS:
            box = self.gui.add_checkbox(kind.capitalize(), False)
            self._on_box(box, partial(page.overlays.show, kind))
        self._on_box(self.gui.add_checkbox("Contacts", False, hint="where bodies touch, and with what force"), page.overlays.contacts)
        self._scale = self.gui.add_number("Arrow for 1 N (m)", page.overlays.force_scale, min=1e-6, max=10.0, step=0.001)
        self._scale.on_update(lambda event: setattr(page.overlays, "force_scale", float(event.target.value)))
        self._on_box(self.gui.add_checkbox("Grid", True), lambda on: setattr(page.drawing.grid, "visible", on))
        for name in ("transparent", "wireframe", "shadows"):
            box = self.gui.add_checkbox(name.capitalize(), getattr(page.drawing, name))
            self._on_box(box, partial(self._draw_as, name))
        self.gui.add_button("Show all", hint="from where the whole world is seen").on_click(self._on_all)
        self._follow = self.gui.add_checkbox("Follow what is picked", False, hint="the eye keeps its distance")
        self._on_box(self._follow, lambda on: None)
        views = self.gui.add_button_group("Look from", tuple(_VIEWS))
        views.on_click(self._on_view)
        self._followed: tuple = ()
        self._tell()

    def _on_box(self, box: Any, f: Callable[[bool], Any]) -> None:
        self._switches[box.label] = box, f

        def pressed(event: Any) -> None:
            if event.client_id is not None:
                self._switch(f, event.target.value)

        box.on_update(pressed)

    def _switch(self, f: Callable[[bool], Any], on: bool) -> None:
        self.page.later(lambda: f(on))
        self._tell()

    def _tell(self) -> None:
        """What is on, a label a line, whose asking has been heard, and what else the website shows; the frame reads it."""
        with self._telling:
            on = [escaped(label) for label, (box, _) in self._switches.items() if box.value]
            links = map(escaped, self.page.website.links)
            heard = map(escaped, self._heard.values())
            told = {"switches": on, "heard": heard, "links": links}
            self._told.content = "".join(f"<b id='{name}'>{chr(10).join(lines)}</b>" for name, lines in told.items())

    def _on_asked(self, event: Any) -> None:
        """``["a7 3", {"Shadows": true}]``: what the frame a7 writes for the third entry that is chosen from its menu, with those before it
        of which it has not been told yet that they were heard."""
        if event.client_id is None:
            return
        with self._doing:  # who comes last reads last
            try:
                name, wanted = json.loads(event.target.value)
                known = {label: bool(wanted[label]) for label in self._switches if label in wanted}
            except (ValueError, TypeError):  # a page may send anything
                return
            for label, on in known.items():
                box, f = self._switches[label]
                if box.value != on:
                    box.value = on
                    self.page.later(partial(f, on))
            here = self.page.server.get_clients()
            self._heard = {one: said for one, said in self._heard.items() if one in here} | {event.client_id: str(name)}
            self._tell()

    def _draw_as(self, name: str, on: bool) -> None:
        setattr(self.page.drawing, name, on)
        self.page.redraw()

    def on_frame(self, frame: Frame) -> None:
        pose = self.page.selection.pose() if self._follow.value else None
        if pose is None:
            self._followed = ()
            return
        if self._followed:
            moved = [now - before for now, before in zip(pose.p, self._followed)]
            if max(map(abs, moved)) > 1e-4:
                for client in self.page.server.get_clients().values():
                    eye, at = client.camera.position, client.camera.look_at
                    put_eye(client, [float(v) + m for v, m in zip(eye, moved)], [float(v) + m for v, m in zip(at, moved)])
        self._followed = pose.p

    def _on_all(self, event: Any) -> None:
        if event.client is not None and self.page.frame is not None:
            still, moving = self.page.drawing.corners(self.page.frame)
            place, target = view_of(still, moving, event.client.camera.aspect)
            put_eye(event.client, place, target)

    def _on_view(self, event: Any) -> None:
        if event.client is None:
            return
        pose, camera = self.page.selection.pose(), event.client.camera
        at = pose.p if pose is not None else tuple(float(v) for v in camera.look_at)
        distance = sum((float(a) - b) ** 2 for a, b in zip(camera.position, at)) ** 0.5 or 3.0
        put_eye(event.client, [a + distance * v for a, v in zip(at, _VIEWS[event.target.value])], at)

"""The frames of TF, where they are in the world."""

from __future__ import annotations

from typing import Any

import numpy as np
from ode_sim.math3 import Pose
from ode_sim_viewer.panels.base import Panel, note
from ode_sim_viewer.simulation import Frame

from gzclient.tf_frames import TfFrames

_SIZE = 0.15  # m


class FramesPanel(Panel):
    """Subscribes while its box is checked."""

    title = "TF"

    def __init__(self, page: Any):
        super().__init__(page)
        self._frames = TfFrames()
        self._axes: Any | None = None
        self._labels: dict[str, Any] = {}
        self._named = self.gui.add_checkbox("Names", True)
        self._on = self.gui.add_checkbox("TF frames", False)
        self._note = self.gui.add_html(note("each tree hangs on the first of its frames that is a link of the world"))
        self.on_update(self._on, self._switch)

    def _switch(self, on: bool) -> None:
        if on:
            self._frames.listen()
        else:
            self._frames.end()
            self.page.later(lambda: self._draw({}))

    def on_frame(self, frame: Frame) -> None:
        if self._frames.listening and frame.revision == self.page.world.revision:
            self._draw(self._frames.placed(self.page.world, frame))

    def _draw(self, placed: dict[str, Pose]) -> None:
        scene = self.page.server.scene
        names = sorted(placed)
        positions = np.array([placed[name].p for name in names], np.float32).reshape(-1, 3)
        turns = np.array([(q[3], q[0], q[1], q[2]) for q in (placed[name].q for name in names)], np.float32).reshape(-1, 4)
        if self._axes is not None and len(self._axes.batched_positions) != len(names):
            self._axes.remove()
            self._axes = None
        if self._axes is None and names:
            self._axes = scene.add_batched_axes("/tf", turns, positions, axes_length=_SIZE, axes_radius=_SIZE / 30)
        elif self._axes is not None:
            self._axes.batched_positions, self._axes.batched_wxyzs = positions, turns
        shown = names if self._named.value else []
        for name in [name for name in self._labels if name not in shown]:
            self._labels.pop(name).remove()
        for name in shown:
            if name not in self._labels:
                self._labels[name] = scene.add_label(f"/tf_name_{abs(hash(name))}", name)
            self._labels[name].position = placed[name].p

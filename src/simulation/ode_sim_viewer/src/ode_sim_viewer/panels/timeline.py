"""Going back in time: moments that the simulator has kept."""

from __future__ import annotations

import time
from typing import Any

from ode_sim_viewer.panels.base import Panel, note
from ode_sim_viewer.panels.play import clock
from ode_sim_viewer.simulation import Frame, KeptMoment, Refused, WorldRecord

_PERIOD = 1.0  # wall s between two looks at what is kept, while moments are recorded


class TimelinePanel(Panel):
    """The slider goes through the moments; the world follows it, paused."""

    title = "Timeline"

    def __init__(self, page: Any):
        super().__init__(page)
        self._moments: tuple[KeptMoment, ...] = ()
        self._next = 0.0
        self._record = self.gui.add_checkbox("Record", False, hint="keep moments while the simulation runs")
        self._period = self.gui.add_number(
            "One every (s)", 0.5, min=0.01, max=1000.0, step=0.1, hint="of sim time; the newest 300 are kept"
        )
        self._keep = self.gui.add_button("Keep this moment")
        self._slider = self.gui.add_slider("Moment", 0, 1, 1, 0, disabled=True)
        self._text = self.gui.add_html(note("nothing is kept yet"))
        self._steps = self.gui.add_button_group("Go", ("First", "Back", "On", "Last"))
        self.on_update(self._record, lambda on: self._set_recording())
        self.on_update(self._period, self._period_changed)
        self.on_click(self._keep, self._keep_now)
        self.on_update(self._slider, lambda value: self._go(int(value)))
        self._steps.on_click(lambda event: page.attempt(event, lambda: self._step(event.target.value)))

    def on_world(self, world: WorldRecord) -> None:
        self._next = 0.0 if self._moments or self._record.value else self._next

    def on_frame(self, frame: Frame) -> None:
        now = time.monotonic()
        if (self._record.value and not frame.paused or self._next == 0.0 and self._moments) and now >= self._next:
            self._next = now + _PERIOD
            self._look()

    def _period_changed(self, _value: Any) -> None:
        if self._record.value:
            self._set_recording()

    def _set_recording(self) -> None:
        self.simulation.record(float(self._period.value) if self._record.value else 0.0)
        self._look()

    def _keep_now(self) -> None:
        self.simulation.keep()
        self._look()

    def _look(self) -> None:
        """What is kept now."""
        self._moments = self.simulation.moments()
        many = len(self._moments)
        self._slider.disabled = many < 1
        self._slider.max = max(1, many - 1)
        self._text.content = note(
            f"{many} moment{'s' if many > 1 else ''}, {clock(self._moments[0].time)} to {clock(self._moments[-1].time)}"
            if many
            else "nothing is kept; a model that comes or goes begins anew"
        )

    def _go(self, which: int) -> None:
        if not self._moments:
            raise Refused("No moment is kept yet.")
        moment = self._moments[max(0, min(which, len(self._moments) - 1))]
        self.simulation.go_back(moment.number)
        self._text.content = note(f"at {clock(moment.time)}, one of {len(self._moments)}")

    def _step(self, where: str) -> None:
        self._look()
        frame, many = self.page.frame, len(self._moments)
        now = frame.sim_time if frame is not None else 0.0
        before = [at for at, moment in enumerate(self._moments) if moment.time < now - 1e-9]
        after = [at for at, moment in enumerate(self._moments) if moment.time > now + 1e-9]
        which = {"First": 0, "Back": before[-1] if before else 0, "On": after[0] if after else many - 1, "Last": many - 1}[where]
        self._go(which)
        self._slider.value = max(0, which)

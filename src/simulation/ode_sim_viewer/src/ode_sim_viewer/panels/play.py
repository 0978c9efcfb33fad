"""Play, pause, step, reset; times and real-time factor."""

from __future__ import annotations

from typing import Any

from ode_sim_viewer.panels.base import Panel
from ode_sim_viewer.simulation import Frame


class PlayPanel(Panel):
    def __init__(self, page: Any):
        super().__init__(page)
        self._times = self.gui.add_html(_table("waiting for the simulator", "", "", ""))
        self._run = self.gui.add_button_group("Run", ("Play", "Pause", "Step"), hint="Step takes the number of steps below")
        self._count = self.gui.add_number("Steps", 1, min=1, max=1_000_000, step=1)
        self._reset = self.gui.add_button_group(
            "Reset", ("Time", "Models", "All"), hint="Models: poses as at the start. All: time and joints, too"
        )
        self._hold = self.gui.add_checkbox("Hold the controls", False, hint="Other pages only look while this one holds them")
        self._run.on_click(self._on_run)
        self._reset.on_click(self._on_reset)
        self._hold.on_update(self._on_hold)
        page.on_let_go = self._let_go

    def on_frame(self, frame: Frame) -> None:
        state = "paused" if frame.paused else f"real-time factor {frame.real_time_factor:.2f}"
        self._times.content = _table(state, clock(frame.sim_time), clock(frame.real_time), f"{frame.iterations}")

    def on_absent(self) -> None:
        self._times.content = _table("no simulator answers", "", "", "")

    def _on_run(self, event: Any) -> None:
        what = event.target.value
        if what == "Step":
            self.page.attempt(event, lambda: self.simulation.step(int(self._count.value)))
        else:
            self.page.attempt(event, lambda: self.simulation.pause(what == "Pause"))

    def _on_reset(self, event: Any) -> None:
        self.page.attempt(event, lambda: self.simulation.reset(event.target.value.lower()))

    def _on_hold(self, event: Any) -> None:
        if event.client_id is not None and not self.page.hold(event, event.target.value):
            self._hold.value = not event.target.value

    def _let_go(self) -> None:
        self._hold.value = False


def clock(seconds: float) -> str:
    """As Gazebo's window shows it: days hours:minutes:seconds.milliseconds."""
    milliseconds = int(round(max(0.0, seconds) * 1000))
    minutes, milliseconds = divmod(milliseconds, 60_000)
    hours, minutes = divmod(minutes, 60)
    days, hours = divmod(hours, 24)
    return f"{days:02d} {hours:02d}:{minutes:02d}:{milliseconds // 1000:02d}.{milliseconds % 1000:03d}"


def _table(state: str, sim: str, real: str, iterations: str) -> str:
    rows = (("Sim time", "sim_time", sim), ("Real time", "real_time", real), ("Iterations", "iterations", iterations))
    cells = "".join(f"<tr><td style='padding-right:1em'>{name}</td><td id='{key}'>{value}</td></tr>" for name, key, value in rows)
    return (
        f"<div style='font-size:0.8em;padding:0 0.6em;font-variant-numeric:tabular-nums'><b id='state'>{state}</b>"
        f"<table>{cells}</table></div>"
    )

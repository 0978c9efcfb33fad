"""Says once why a camera gives fewer pictures than it was asked for."""

from __future__ import annotations

import math

_NS = 1_000_000_000
_WINDOW_NS = 3 * _NS
_PAUSE_NS = _NS  # nobody listened for so long: counting starts anew
_KEPT = 0.9  # of the rate


class RateWatch:
    """Counts a camera's pictures over three seconds of simulated time, until it has said something."""

    def __init__(self) -> None:
        self._said = False
        self._start_ns = self._last_ns = 0
        self._due = self._taken = 0

    def asked(self, now_ns: int, taken: bool, sensor_rate: float, plugin_rate: float, dt: float) -> str | None:
        """A picture is due at ``now_ns``; after a window that was too thin, the reason, once.

        :param taken: False when it was left out because too many are being drawn
        :param sensor_rate: Hz of the sensor's ``<update_rate>``, 0 = every step
        :param plugin_rate: the plugin's ``<updateRate>``, 0 = none
        :param dt: s, of one step of the physics
        """
        if self._said:
            return None
        if not 0 < now_ns - self._last_ns <= _PAUSE_NS:
            self._start_ns, self._due, self._taken = now_ns, 0, 0
            self._last_ns = now_ns
            return None  # the pictures are counted that follow the first one
        self._last_ns = now_ns
        self._due += 1
        self._taken += taken
        seconds = (now_ns - self._start_ns) / _NS
        if seconds * _NS < _WINDOW_NS:
            return None
        due, got = self._due / seconds, self._taken / seconds
        left_out, of = self._due - self._taken, self._due
        self._start_ns, self._due, self._taken = now_ns, 0, 0
        wanted = min((rate for rate in (sensor_rate, plugin_rate) if rate > 0.0), default=due)
        if got >= _KEPT * wanted:
            return None
        why = self._why(due, wanted, f"{left_out} of {of}", sensor_rate, plugin_rate, dt)
        if not why:
            return None
        self._said = True
        return f"gives {got:.3g} pictures a second of simulated time, not the {wanted:.3g} that are asked for: {why}"

    @staticmethod
    def _why(due: float, wanted: float, left_out: str, sensor_rate: float, plugin_rate: float, dt: float) -> str:
        """'' where nothing is set wrongly: nobody listened for a moment.

        :param due, wanted: pictures a second. :param left_out: how many of how many
        """
        if due >= _KEPT * wanted:
            return (
                f"{left_out} were left out, since this machine does not draw them as fast as the simulation runs. Fewer or smaller "
                "pictures help, a lower real_time_update_rate of the world, or lock-step, where the simulation waits for each "
                "picture (ODE_SIM_LOCKSTEP=1 in the environment)"
            )
        if 1.0 / (dt * math.ceil(1.0 / (wanted * dt) - 1e-6)) < _KEPT * wanted:
            return f"one is taken after a step of the physics, which is {dt:g} s long"
        if plugin_rate <= 0.0:
            return ""
        return (
            f"of the sensor's {sensor_rate:g} a second (<update_rate>) the plugin takes those that are "
            f"1/{plugin_rate:g} s or more apart (<updateRate>). "
            + ("Leave <updateRate> out" if sensor_rate == plugin_rate else "Give both the same number, or leave <updateRate> out")
        )

"""Valenti's complementary filter (R. Valenti, I. Dryanovski, J. Xiao, 2015)."""
from __future__ import annotations

import math
from typing import Optional

from .rotation import Quaternion, Vector, about, advanced, conjugate, cross, dot, level_or_north, product, turned, unit

_GRAVITY = 9.81  # m/s^2
_STEADY = 0.1, 0.01, 0.2  # m/s^2 off gravity, rad/s of change, rad/s off the bias: less than these is standing still


class Complementary:
    """``orientation`` (w, x, y, z) of the sensor in a world whose z is up; with a magnetic field its x is magnetic north.

    :param gain_acc: 0 to 1, share of the error against gravity that one reading takes away; likewise ``gain_mag`` of the yaw.
    :param adaptive: readings that are not of gravity's size count less: at 10 % off in full, at 20 % not at all.
    :param bias_alpha: 0 to 1, share of the turn rates at rest that goes into their bias; None: no bias is looked for.
    """

    def __init__(self, gain_acc: float = 0.01, gain_mag: float = 0.01, adaptive: bool = True,
                 bias_alpha: Optional[float] = 0.01):
        self.gain_acc, self.gain_mag, self.adaptive, self.bias_alpha = gain_acc, gain_mag, adaptive, bias_alpha
        self.reset()

    def reset(self) -> None:
        self.orientation: Quaternion = (1.0, 0.0, 0.0, 0.0)
        self.bias: Vector = (0.0, 0.0, 0.0)
        self.steady = False
        self._before: Optional[Vector] = None

    def update(self, acceleration: Vector, rate: Vector, field: Optional[Vector], dt: float) -> None:
        """One reading: m/s^2, rad/s, magnetic field in any unit or None, s since the last one."""
        if self._before is None:
            first = level_or_north("nwu", acceleration, field)
            if first is None:
                return
            self.orientation, self._before = first, rate
            return
        if self.bias_alpha is not None:
            self._look_for_bias(acceleration, rate)
        self._before = rate
        q = advanced(self.orientation, tuple(w - b for w, b in zip(rate, self.bias)), dt)
        seen = unit(acceleration)
        if seen is not None:
            expected = turned(conjugate(q), (0.0, 0.0, 1.0))
            turn = cross(seen, expected)
            axis = unit(turn, 1e-12)
            if axis is not None:
                angle = math.atan2(math.sqrt(dot(turn, turn)), dot(seen, expected))
                q = product(q, about(axis, self._trust(acceleration) * angle))
        if field is not None:
            flux = turned(q, field)
            if flux[0] or flux[1]:
                q = product(about((0.0, 0.0, 1.0), -self.gain_mag * math.atan2(flux[1], flux[0])), q)
        self.orientation = unit(q)

    def _trust(self, acceleration: Vector) -> float:
        if not self.adaptive:
            return self.gain_acc
        off = abs(math.sqrt(dot(acceleration, acceleration)) - _GRAVITY) / _GRAVITY
        return self.gain_acc * min(max(2.0 - 10.0 * off, 0.0), 1.0)

    def _look_for_bias(self, acceleration: Vector, rate: Vector) -> None:
        off_gravity, change, off_bias = _STEADY
        self.steady = (abs(math.sqrt(dot(acceleration, acceleration)) - _GRAVITY) <= off_gravity and
                       all(abs(w - before) <= change for w, before in zip(rate, self._before)) and
                       all(abs(w - b) <= off_bias for w, b in zip(rate, self.bias)))
        if self.steady:
            self.bias = tuple(b + self.bias_alpha * (w - b) for w, b in zip(rate, self.bias))

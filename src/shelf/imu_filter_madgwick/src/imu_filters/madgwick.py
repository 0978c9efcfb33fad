"""Madgwick's gradient descent filter (S. Madgwick, 2010)."""

from __future__ import annotations

import math

from .rotation import Quaternion, Vector, added, advanced, conjugate, cross, product, turned, unit

_NORTH = {"enu": (0.0, 1.0), "nwu": (1.0, 0.0), "ned": (1.0, 0.0)}  # x and y of the horizontal part of the field


class Madgwick:
    """``orientation`` (w, x, y, z) of the sensor in the world.

    :param world: enu, nwu or ned.
    :param gain: rad/s by which the turn rates may be wrong: the measured directions pull no faster.
    :param zeta: rad/s^2 or so by which their bias may drift.
    """

    def __init__(self, world: str = "enu", gain: float = 0.1, zeta: float = 0.0):
        self.world, self.gain, self.zeta = world, gain, zeta
        self.orientation: Quaternion = (1.0, 0.0, 0.0, 0.0)
        self.bias: Vector = (0.0, 0.0, 0.0)

    def update(self, acceleration: Vector, rate: Vector, field: Vector | None, dt: float) -> None:
        """One reading.

        :param acceleration: (3,) m/s^2, sensor frame, +g upwards at rest. :param rate: (3,) rad/s, sensor frame
        :param field: (3,) magnetic field, sensor frame, any unit; None: not measured. :param dt: s since the last reading
        """
        q = self.orientation
        seen = unit(acceleration)
        pull: Vector = (0.0, 0.0, 0.0)  # turn of the sensor, about its own axes, that its readings ask for
        if seen is not None:
            up = (0.0, 0.0, -1.0 if self.world == "ned" else 1.0)
            pull = cross(seen, turned(conjugate(q), up))
            seen = unit(field) if field is not None else None
            if seen is not None:
                flux = turned(q, seen)
                east, north = _NORTH[self.world]
                level = math.hypot(flux[0], flux[1])
                expected = turned(conjugate(q), (east * level, north * level, flux[2]))
                pull = added(pull, cross(seen, expected))
        pull = unit(pull, 1e-9) or (0.0, 0.0, 0.0)
        if self.zeta:
            self.bias = tuple(b - self.zeta * 2 * p * dt for b, p in zip(self.bias, pull))
        rate = tuple(w - b + 2 * self.gain * p for w, b, p in zip(rate, self.bias, pull))
        self.orientation = unit(advanced(q, rate, dt))


def shifted(q: Quaternion, yaw: float) -> Quaternion:
    """``q`` with the world turned by ``yaw`` rad."""
    return product((math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2)), q) if yaw else q

"""Bounds on velocity, acceleration and jerk of one axis of a base."""
from __future__ import annotations

import math
import sys
from typing import NamedTuple

from controller_interface import ParameterError

_LARGEST = sys.float_info.max


class Bounds(NamedTuple):
    """Lowest and highest value allowed."""

    low: float = -math.inf
    high: float = math.inf

    def clamp(self, value: float) -> float:
        return min(max(value, self.low), self.high)


UNBOUNDED = Bounds()


class SpeedLimiter:
    """Limits a commanded velocity, given the last two that came out of it.

    :param velocity: m/s or rad/s; acceleration and jerk are its derivatives
    """

    def __init__(self, velocity: Bounds = UNBOUNDED, acceleration: Bounds = UNBOUNDED, jerk: Bounds = UNBOUNDED):
        self._velocity = velocity
        self._acceleration = acceleration
        self._jerk = jerk
        self.reset()

    def reset(self) -> None:
        """The base stands still."""
        self._last = self._second_last = 0.0

    def limit(self, velocity: float, dt: float) -> float:
        """The velocity nearest to ``velocity`` that is allowed ``dt`` seconds after the last one."""
        last, second_last = self._last, self._second_last
        if self._jerk is not UNBOUNDED:
            change, last_change = velocity - last, last - second_last
            scale = 2.0 * dt * dt
            difference = min(max(change - last_change, self._jerk.low * scale), self._jerk.high * scale)
            velocity = last + last_change + difference
        if self._acceleration is not UNBOUNDED:
            velocity = last + min(max(velocity - last, self._acceleration.low * dt), self._acceleration.high * dt)
        velocity = self._velocity.clamp(velocity)
        self._second_last, self._last = last, velocity
        return velocity

    @property
    def last(self) -> float:
        """The last limited velocity."""
        return self._last


def load_limiter(nh, axis: str, jerk: bool = True) -> SpeedLimiter:
    """The limiter of ``axis`` ("linear/x", "angular/z").

    :param nh: controller_interface.NodeHandle of the controller
    :raises ParameterError: a lower bound above the upper one
    """
    def bounds(quantity: str) -> Bounds:
        if not nh.param(f"{axis}/has_{quantity}_limits", False):
            return UNBOUNDED
        high = nh.param(f"{axis}/max_{quantity}", 0.0)
        low = nh.param(f"{axis}/min_{quantity}", -high)
        if low > high:
            raise ParameterError(f"parameter {nh.resolve(f'{axis}/min_{quantity}')} is {low:g}, more than max_{quantity}, "
                                 f"which is {high:g}")
        return Bounds(max(low, -_LARGEST), min(high, _LARGEST))  # an infinite one, times a period of 0, would be NaN

    return SpeedLimiter(bounds("velocity"), bounds("acceleration"), bounds("jerk") if jerk else UNBOUNDED)

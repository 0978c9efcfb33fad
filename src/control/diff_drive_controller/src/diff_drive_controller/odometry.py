"""Pose of a base from the turning of its wheels."""
from __future__ import annotations

import math
from collections import deque
from typing import Optional, Tuple

MIN_INTERVAL = 1e-4  # s; shorter ones give no usable velocity


#: m, rad or their derivatives; what is beyond is an encoder that jumped, and would make the pose NaN for good
_LARGEST = 1e12


def _bounded(*values: float) -> bool:
    return all(-_LARGEST <= value <= _LARGEST for value in values)


class RollingMean:
    """Mean of the last ``size`` values."""

    def __init__(self, size: int):
        self._values: deque = deque(maxlen=max(1, size))

    def __call__(self, value: float) -> float:
        """Add a value. :return: the mean"""
        self._values.append(value)
        return sum(self._values) / len(self._values)

    def clear(self) -> None:
        self._values.clear()


class PlanarOdometry:
    """Pose in the odom frame, and velocity in the base frame.

    :param window: number of values over which the velocity of ``travelled`` is averaged
    :ivar x, y: m
    :ivar heading: rad, not wrapped
    :ivar linear: forward velocity, m/s
    :ivar linear_y: velocity to the left, m/s
    :ivar angular: yaw rate, rad/s
    """

    def __init__(self, window: int):
        self.x = self.y = self.heading = 0.0
        self.linear = self.linear_y = self.angular = 0.0
        self._time = 0.0
        self._mean_linear = RollingMean(window)
        self._mean_angular = RollingMean(window)

    def restart(self, time: float) -> None:
        """Forget velocities; the pose stays."""
        self._mean_linear.clear()
        self._mean_angular.clear()
        self.linear = self.linear_y = self.angular = 0.0
        self._time = time

    def interval(self, time: float) -> float:
        """Seconds since the pose was last brought up to date; negative when a simulation was reset."""
        return time - self._time

    def travelled(self, distance: float, angle: float, time: float) -> None:
        """The base went ``distance`` (m) forward while turning ``angle`` (rad), as measured at ``time``."""
        self._advance(distance, angle)
        dt = time - self._time
        if dt < MIN_INTERVAL:
            return
        self._time = time
        self.linear = self._mean_linear(distance / dt)
        self.angular = self._mean_angular(angle / dt)

    def commanded(self, linear: float, angular: float, time: float) -> None:
        """Open loop: the base has been doing ``linear`` (m/s) and ``angular`` (rad/s) up to ``time``."""
        dt = time - self._time
        self._time = time
        self.linear, self.angular = linear, angular
        self._advance(linear * dt, angular * dt)

    def moved(self, linear: float, linear_y: float, angular: float, time: float) -> None:
        """Velocities of a base that also moves sideways, as measured at ``time``."""
        if not _bounded(linear, linear_y, angular):
            return
        self.linear, self.linear_y, self.angular = linear, linear_y, angular
        dt = time - self._time
        if dt < MIN_INTERVAL:
            return
        self._time = time
        direction = self.heading + 0.5 * angular * dt
        cosine, sine = math.cos(direction), math.sin(direction)
        self.heading += angular * dt
        self.x += (linear * cosine - linear_y * sine) * dt
        self.y += (linear * sine + linear_y * cosine) * dt

    def _advance(self, distance: float, angle: float) -> None:
        if not _bounded(distance, angle):
            return
        if abs(angle) < 1e-6:
            direction = self.heading + 0.5 * angle
            self.x += distance * math.cos(direction)
            self.y += distance * math.sin(direction)
            self.heading += angle
            return
        radius, before = distance / angle, self.heading
        self.heading += angle
        self.x += radius * (math.sin(self.heading) - math.sin(before))
        self.y -= radius * (math.cos(self.heading) - math.cos(before))


class WheelTravel:
    """What a joint has turned since it was last asked. The first answer is 0: joints need not start at 0."""

    def __init__(self) -> None:
        self.restart()

    def restart(self) -> None:
        """The next answer is 0 again."""
        self._last: Optional[float] = None

    def __call__(self, position: float) -> float:
        """:param position: rad. :return: rad"""
        last, self._last = self._last, position
        return 0.0 if last is None else position - last


def differential(left: float, right: float, separation: float) -> Tuple[float, float]:
    """(distance m, angle rad) of a base whose sides went ``left`` and ``right`` (m), ``separation`` (m) apart."""
    return 0.5 * (left + right), (right - left) / separation

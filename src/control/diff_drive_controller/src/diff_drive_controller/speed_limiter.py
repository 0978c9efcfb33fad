"""Bounds on velocity, acceleration and jerk of one axis of a base."""

from __future__ import annotations

from controller_interface import ParameterError

from .laws import SpeedLimiter


def load_limiter(nh, axis: str, jerk: bool = True) -> SpeedLimiter:
    """The limiter of ``axis`` ("linear/x", "angular/z").

    :param nh: controller_interface.NodeHandle of the controller
    :param jerk: whether the parameters of jerk are read; False limits none
    :raises ParameterError: a lower bound above the upper one
    """

    def bounds(quantity: str) -> tuple[float, float] | None:
        if not nh.param(f"{axis}/has_{quantity}_limits", False):
            return None
        high = nh.param(f"{axis}/max_{quantity}", 0.0)
        low = nh.param(f"{axis}/min_{quantity}", -high)
        if low > high:
            raise ParameterError(
                f"parameter {nh.resolve(f'{axis}/min_{quantity}')} is {low:g}, more than max_{quantity}, which is {high:g}"
            )
        return low, high

    return SpeedLimiter(bounds("velocity"), bounds("acceleration"), bounds("jerk") if jerk else None)

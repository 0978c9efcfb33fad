"""Angles in rad."""

from math import isfinite, nan, pi, remainder


def normalize_angle(angle: float) -> float:
    """``angle`` in (-pi, pi]; NaN for one that is not finite."""
    if not isfinite(angle):
        return nan
    result = remainder(angle, 2.0 * pi)
    return pi if result == -pi else result


def shortest_angular_distance(start: float, end: float) -> float:
    """Signed way from ``start`` to ``end`` in (-pi, pi]."""
    return normalize_angle(end - start)


def distance_within_limits(start: float, end: float, lower: float, upper: float) -> float:
    """Way from ``start`` to ``end`` that stays inside [lower, upper] (which may span several turns): the short way
    round if it ends inside, else the long one if that does, else the short one."""
    delta = shortest_angular_distance(start, end)
    if lower > upper or lower <= start + delta <= upper:
        return delta
    other = delta + 2.0 * pi if delta <= 0.0 else delta - 2.0 * pi
    return other if lower <= start + other <= upper else delta

"""Vectors (3,) and unit quaternions (w, x, y, z), as plain tuples: a filter makes a few of them a thousand times a second."""

from __future__ import annotations

import math

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]


def dot(a: Vector, b: Vector) -> float:
    """The scalar product of ``a`` and ``b``."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def added(a: Vector, b: Vector) -> Vector:
    """``a`` + ``b``."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """The vector product ``a`` x ``b``."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def unit(v, least: float = 0.0):
    """``v`` at length 1; None where it is not longer than ``least``, or no number."""
    length = math.sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v) if math.isfinite(length) and length > least else None


def product(a: Quaternion, b: Quaternion) -> Quaternion:
    """The rotation ``b``, then ``a``."""
    return (
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    )


def conjugate(q: Quaternion) -> Quaternion:
    """The rotation that undoes ``q``."""
    return q[0], -q[1], -q[2], -q[3]


def turned(q: Quaternion, v: Vector) -> Vector:
    """``v`` of the sensor's frame in the world's, with ``q`` the orientation of the sensor in the world."""
    return product(product(q, (0.0, *v)), conjugate(q))[1:]


def about(axis: Vector, angle: float) -> Quaternion:
    """:param axis: of length 1. :param angle: rad."""
    sine = math.sin(angle / 2)
    return math.cos(angle / 2), axis[0] * sine, axis[1] * sine, axis[2] * sine


def advanced(q: Quaternion, rate: Vector, dt: float) -> Quaternion:
    """``q`` after ``dt`` s at ``rate`` rad/s of the sensor's own axes."""
    speed = math.sqrt(dot(rate, rate))
    if speed * abs(dt) < 1e-12:
        return q
    return product(q, about((rate[0] / speed, rate[1] / speed, rate[2] / speed), speed * dt))


def of_axes(x: Vector, y: Vector, z: Vector) -> Quaternion:
    """The orientation of a sensor that sees the world's axes as ``x``, ``y``, ``z`` (each of length 1, in its own frame)."""
    (a, b, c), (d, e, f), (g, h, i) = x, y, z
    trace = a + e + i
    if trace > 0:
        q = (1 + trace, h - f, c - g, d - b)
    elif a >= e and a >= i:
        q = (h - f, 1 + a - e - i, b + d, c + g)
    elif e >= i:
        q = (c - g, b + d, 1 - a + e - i, f + h)
    else:
        q = (d - b, c + g, f + h, 1 - a - e + i)
    return unit(q)


def roll_pitch_yaw(q: Quaternion) -> Vector:
    """Of ``q``, rad, about the fixed axes x, y, z in that order."""
    w, x, y, z = q
    return (
        math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
        math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x)))),
        math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
    )


def level_or_north(world: str, acceleration: Vector, field: Vector | None = None) -> Quaternion | None:
    """The orientation that one reading tells; None in free fall, or where the field is vertical.

    :param world: enu, nwu or ned: what the world's axes point to.
    :param acceleration: m/s^2, with gravity: a sensor at rest sees its own support, 9.8 upwards.
    :param field: magnetic, in any unit; without one the yaw is 0.
    """
    up = unit(acceleration, 1e-3)
    if up is None:
        return None
    if field is None:
        ahead = (1.0, 0.0, 0.0) if abs(up[0]) < 0.9 else (0.0, 0.0, math.copysign(1.0, -up[0]))
        first = unit(tuple(a - dot(ahead, up) * u for a, u in zip(ahead, up)), 1e-6)
        last = tuple(-u for u in up) if world == "ned" else up
        return of_axes(first, cross(last, first), last)
    east = unit(cross(unit(field) or (0.0, 0.0, 0.0), up), 1e-3)
    if east is None:
        return None
    north = cross(up, east)
    down, west = tuple(-u for u in up), tuple(-e for e in east)
    return of_axes(*{"enu": (east, north, up), "nwu": (north, west, up), "ned": (north, east, down)}[world])

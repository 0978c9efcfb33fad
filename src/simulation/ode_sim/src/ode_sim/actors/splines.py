"""Curves through poses, as Gazebo's (ignition-math's ``Spline`` and ``RotationSpline``): the same poses at the same times.

Between two points the parameter runs from 0 to 1; how long it takes changes nothing of the curve.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from ode_sim.math3 import Quat, Vec3, add, dot, quat_inverse, quat_multiply, quat_normalize, scale, sub

_SMALL = 1e-3  # of a sine or a rest of a cosine: below, upstream takes the straight way


class PositionSpline:
    """A curve through ``points``, m.

    :param tension: 0: a Catmull-Rom curve; 1: straight lines.
    """

    def __init__(self, points: Sequence[Vec3], tension: float = 0.0):
        self._points = list(points)
        self._tangents = self._make_tangents(1.0 - tension)

    def _make_tangents(self, loose: float) -> list[Vec3]:
        points = self._points
        last = len(points) - 1
        if last < 1:
            return [(0.0, 0.0, 0.0)] * len(points)
        closed = points[0] == points[last]
        tangents = []
        for i in range(last + 1):
            if i in (0, last):
                before, after = (points[last - 1], points[1]) if closed else (points[max(i - 1, 0)], points[min(i + 1, last)])
            else:
                before, after = points[i - 1], points[i + 1]
            tangents.append(scale(sub(after, before), 0.5 * loose))
        return tangents

    def at(self, index: int, t: float) -> Vec3:
        """The point at ``t`` (0 to 1) of the way from point ``index`` to the next."""
        p, q = self._points[index], self._points[index + 1]
        u, v = self._tangents[index], self._tangents[index + 1]
        t2, t3 = t * t, t * t * t
        return add(add(scale(p, 2 * t3 - 3 * t2 + 1), scale(u, t3 - 2 * t2 + t)), add(scale(q, 3 * t2 - 2 * t3), scale(v, t3 - t2)))


class RotationSpline:
    """A way through ``points``, rotations x y z w."""

    def __init__(self, points: Sequence[Quat]):
        self._points = list(points)
        self._tangents = self._make_tangents()

    def _make_tangents(self) -> list[Quat]:
        points = self._points
        last = len(points) - 1
        if last < 1:
            return list(points)
        closed = points[0] == points[last]
        tangents = []
        for i, p in enumerate(points):
            back = quat_inverse(p)
            if i in (0, last) and closed:
                after, before = points[1], points[last - 1]
            else:
                after, before = points[min(i + 1, last)], points[max(i - 1, 0)]
            one, other = _log(quat_multiply(back, after)), _log(quat_multiply(back, before))
            tangents.append(quat_multiply(p, _exp(scale(add(one, other), -0.25))))
        return tangents

    def at(self, index: int, t: float) -> Quat:
        """The rotation at ``t`` (0 to 1) of the way from point ``index`` to the next."""
        direct = _slerp(t, self._points[index], self._points[index + 1], True)
        bent = _slerp(t, self._tangents[index], self._tangents[index + 1], False)
        return quat_normalize(_slerp(2.0 * t * (1.0 - t), direct, bent, False))


def _log(q: Quat) -> Vec3:
    if abs(q[3]) < 1.0:
        angle = math.acos(q[3])
        sine = math.sin(angle)
        if abs(sine) >= _SMALL:
            return scale(q[:3], angle / sine)
    return q[:3]


def _exp(v: Vec3) -> Quat:
    angle = math.sqrt(dot(v, v))
    sine = math.sin(angle)
    part = scale(v, sine / angle) if abs(sine) >= _SMALL else v
    return (*part, math.cos(angle))


def _slerp(t: float, p: Quat, q: Quat, shortest: bool) -> Quat:
    cosine = sum(a * b for a, b in zip(p, q))
    if cosine < 0.0 and shortest:
        cosine, q = -cosine, (-q[0], -q[1], -q[2], -q[3])
    if abs(cosine) < 1.0 - _SMALL:
        sine = math.sqrt(1.0 - cosine * cosine)
        angle = math.atan2(sine, cosine)
        a, b = math.sin((1.0 - t) * angle) / sine, math.sin(t * angle) / sine
        return (a * p[0] + b * q[0], a * p[1] + b * q[1], a * p[2] + b * q[2], a * p[3] + b * q[3])
    return quat_normalize([(1.0 - t) * a + t * b for a, b in zip(p, q)])

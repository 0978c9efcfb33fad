"""How a robot moved, from samples of its true pose. Pure arithmetic: no ROS."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Sample:
    """Pose of the robot's model frame in the world: ``time`` in s of simulation, ``x``, ``y``, ``z`` in m; ``yaw`` and
    ``tilt`` (angle between the robot's and the world's upward axes) in rad."""

    time: float
    x: float
    y: float
    z: float
    yaw: float
    tilt: float


def sample(time: float, position: Sequence[float], quaternion: Sequence[float]) -> Sample:
    """:param time: s. :param position: x, y, z, m. :param quaternion: x, y, z, w, of length 1."""
    x, y, z, w = quaternion
    p_x, p_y, p_z = position
    return Sample(
        time,
        p_x,
        p_y,
        p_z,
        math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
        math.acos(max(-1.0, min(1.0, 1 - 2 * (x * x + y * y)))),
    )


def turned(samples: Sequence[Sample]) -> float:
    """Angle turned about the vertical, rad, whole turns counted: samples lie less than half a turn apart."""
    return sum(math.remainder(after.yaw - before.yaw, 2 * math.pi) for before, after in zip(samples, samples[1:]))


def advanced(samples: Sequence[Sample]) -> tuple[float, float]:
    """Way from the first sample to the last one, m: (ahead, to the left) as the robot headed on average on the way."""
    first, last = samples[0], samples[-1]
    dx, dy = last.x - first.x, last.y - first.y
    heading = first.yaw + turned(samples) / 2
    return dx * math.cos(heading) + dy * math.sin(heading), dy * math.cos(heading) - dx * math.sin(heading)


@dataclass(frozen=True)
class Motion:
    """What came of a command held for ``seconds`` of simulation: ``ahead`` and ``left`` in m, ``turned`` in rad,
    ``tilt`` at the end in rad, ``rise`` in m."""

    seconds: float
    ahead: float
    left: float
    turned: float
    rise: float
    tilt: float

    @staticmethod
    def of(samples: Sequence[Sample]) -> Motion:
        ahead, left = advanced(samples)
        return Motion(samples[-1].time - samples[0].time, ahead, left, turned(samples), samples[-1].z - samples[0].z, samples[-1].tilt)


def reachable(angle: float, step: float, lower: float | None, upper: float | None) -> float:
    """A place for a joint at ``angle`` to go: ``step`` further, or back where ``lower`` or ``upper`` is in the way; None is no limit."""
    low, high = -math.inf if lower is None else lower, math.inf if upper is None else upper
    for target in (angle + step, angle - step):
        if low <= target <= high:
            return target
    return (low + high) / 2 if math.isfinite(low + high) else angle


def longest_silence(times: Sequence[float]) -> float:
    """The longest time between two of ``times``, in the order in which they came, s; 0 of fewer than two."""
    return max((after - before for before, after in zip(times, times[1:])), default=0.0)

"""Numbers on their way into the core and out of it."""

from __future__ import annotations

import math
from collections.abc import Collection
from typing import TYPE_CHECKING

from ode_sim.description.model import FARTHEST, Pose
from ode_sim.math3 import quat_normalize

if TYPE_CHECKING:
    from ode_sim._core import _Pose


def finite(values: Collection[float], what: str) -> None:
    """Refuse NaN and infinity among ``values`` where they would poison the physics.

    :raises ValueError: one line that names ``what``.
    """
    if not all(math.isfinite(v) for v in values):
        raise ValueError(f"{what} must be finite numbers, not {tuple(values)}")


def flat(pose: Pose, what: str = "pose") -> _Pose:
    """Seven floats for the core: x y z qx qy qz qw of ``pose``.

    :raises ValueError: not finite, or further than :data:`FARTHEST` from the origin of its frame; the line names ``what``.
    """
    values = (*pose.p, *pose.q)
    finite(values, what)
    far = max(map(abs, values[:3]))
    if far > FARTHEST:
        raise ValueError(f"{what} lies {far:g} m away; stay within {FARTHEST:g} m")
    return values


def unit_pose(pose: Pose) -> Pose:
    """``pose`` with a quaternion of unit length; one that has it already is left as it is, to the last bit."""
    if abs(sum(v * v for v in pose.q) - 1.0) < 1e-9:
        return pose
    largest = max(map(abs, pose.q)) or 1.0  # squares of 1e200 overflow
    return Pose(pose.p, quat_normalize([v / largest for v in pose.q]))


def pose_of(values: _Pose) -> Pose:
    """A :class:`Pose` of ``values``, the core's seven floats."""
    return Pose(values[:3], values[3:])


def unlimited(limit: float) -> float:
    """``limit``, or infinity: limits of 1e8 and beyond (1e9 and 1e16 are common) mean none."""
    return math.copysign(math.inf, limit) if abs(limit) >= 1e8 else float(limit)

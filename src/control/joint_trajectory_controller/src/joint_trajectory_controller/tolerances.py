"""How far a joint may be from its trajectory: parameters, overridden by what an action goal asks for."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from node_signals.parameters import of_kind

from ._sampler import overridden as law_of_override
from ._sampler import violation


class StateTolerance(NamedTuple):
    """Largest allowed errors in rad or m and its derivatives; 0 or less is no limit."""

    position: float = 0.0
    velocity: float = 0.0
    acceleration: float = 0.0

    def violation(self, position_error: float, velocity_error: float) -> str | None:
        """Which of ``position_error`` and ``velocity_error`` is over its limit, in words, or None. A NaN error is over any limit.

        The acceleration of joints is not measured: its error counts as 0, which no tolerance forbids.
        """
        return violation("position", position_error, self.position) or violation("velocity", velocity_error, self.velocity) or None


class JointTolerances(NamedTuple):
    """Tolerances of one joint on its way and at its goal.

    :param goal_time: seconds that the joint may take after the end of its trajectory to come inside ``goal``
    """

    path: StateTolerance = StateTolerance()
    goal: StateTolerance = StateTolerance()
    goal_time: float = 0.0


def from_parameters(joints: Sequence[str], constraints: dict) -> list[JointTolerances]:
    """Tolerances of ``joints`` from the ``constraints`` parameters.

    :raises ValueError: a value that is not a number
    """
    stopped = of_kind("constraints/stopped_velocity_tolerance", constraints.get("stopped_velocity_tolerance", 0.01), float)
    goal_time = of_kind("constraints/goal_time", constraints.get("goal_time", 0.0), float)
    result = []
    for joint in joints:
        values = constraints.get(joint, {})
        if not isinstance(values, dict):
            raise ValueError(f"constraints/{joint} must hold 'trajectory' and 'goal', it is {values!r}")
        result.append(
            JointTolerances(
                StateTolerance(position=of_kind(f"constraints/{joint}/trajectory", values.get("trajectory", 0.0), float)),
                StateTolerance(position=of_kind(f"constraints/{joint}/goal", values.get("goal", 0.0), float), velocity=stopped),
                goal_time,
            )
        )
    return result


def overridden(defaults: Sequence[JointTolerances], joints: Sequence[str], goal) -> list[JointTolerances]:
    """``defaults`` with what ``goal`` says, a FollowJointTrajectoryGoal: positive replaces, negative switches off, 0 keeps.

    :param joints: names in the order of ``defaults``
    :raises ValueError: a NaN tolerance, which nothing would ever violate
    """
    path = {t.name: t for t in goal.path_tolerance}
    end = {t.name: t for t in goal.goal_tolerance}
    for kind, tolerances in (("path", path), ("goal", end)):
        for tolerance in tolerances.values():
            if any(math.isnan(v) for v in (tolerance.position, tolerance.velocity, tolerance.acceleration)):
                raise ValueError(f"{kind}_tolerance of joint '{tolerance.name}' is NaN; use -1 to switch it off")
    goal_time = goal.goal_time_tolerance.to_sec()
    return [
        JointTolerances(
            _override(default.path, path.get(joint)), _override(default.goal, end.get(joint)), law_of_override(default.goal_time, goal_time)
        )
        for default, joint in zip(defaults, joints)
    ]


def _override(default: StateTolerance, message) -> StateTolerance:
    if message is None:
        return default
    return StateTolerance(
        law_of_override(default.position, message.position),
        law_of_override(default.velocity, message.velocity),
        law_of_override(default.acceleration, message.acceleration),
    )

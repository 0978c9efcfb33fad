"""Limits of a joint, from its URDF description and from parameters. Meant order: URDF first, parameters override."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import rospy
from node_signals.parameters import is_number

from .robot_description import JointDescription


@dataclass(frozen=True)
class JointLimits:
    """Hard limits; a value counts only if its flag is set."""

    min_position: float = 0.0
    max_position: float = 0.0
    max_velocity: float = 0.0
    max_acceleration: float = 0.0
    max_jerk: float = 0.0
    max_effort: float = 0.0
    has_position_limits: bool = False
    has_velocity_limits: bool = False
    has_acceleration_limits: bool = False
    has_jerk_limits: bool = False
    has_effort_limits: bool = False
    angle_wraparound: bool = False


@dataclass(frozen=True)
class SoftJointLimits:
    """Position window inside the hard one, in which the joint is slowed down."""

    min_position: float = 0.0
    max_position: float = 0.0
    k_position: float = 0.0
    k_velocity: float = 0.0


#: kind -> the values that a ``has_<kind>_limits`` parameter needs beside it
_VALUES = {
    "position": ("min_position", "max_position"),
    "velocity": ("max_velocity",),
    "acceleration": ("max_acceleration",),
    "jerk": ("max_jerk",),
    "effort": ("max_effort",),
}


def limits_from_urdf(joint: JointDescription, limits: JointLimits = JointLimits()) -> JointLimits | None:
    """``limits`` with what ``<limit>`` says; None for a joint without one."""
    if joint.limit is None:
        return None
    bounded = joint.kind in ("revolute", "prismatic")
    return replace(
        limits,
        has_position_limits=bounded,
        has_velocity_limits=True,
        has_effort_limits=True,
        has_acceleration_limits=False,
        angle_wraparound=joint.kind == "continuous",
        min_position=joint.limit.lower if bounded else limits.min_position,
        max_position=joint.limit.upper if bounded else limits.max_position,
        max_velocity=joint.limit.velocity,
        max_effort=joint.limit.effort,
    )


def soft_limits_from_urdf(joint: JointDescription) -> SoftJointLimits | None:
    """What ``<safety_controller>`` says; None without one."""
    safety = joint.safety
    if safety is None:
        return None
    return SoftJointLimits(safety.lower, safety.upper, safety.k_position, safety.k_velocity)


def _read(nh: Any, joint: str) -> dict[str, Any] | None:
    values = rospy.get_param(nh.resolve(f"joint_limits/{joint}"), None)
    return values if isinstance(values, dict) else None


def limits_from_params(nh: Any, joint: str, limits: JointLimits = JointLimits()) -> JointLimits | None:
    """``limits`` with what ``<nh>/joint_limits/<joint>`` says; None if that namespace is not there.

    :param nh: controller_interface.NodeHandle.
    """
    values = _read(nh, joint)
    return None if values is None else apply_limits(values, limits)


def apply_limits(values: dict[str, Any], limits: JointLimits) -> JointLimits:
    """``limits`` overridden by a parameter map. A value counts only beside ``has_<kind>_limits: true``."""
    changes: dict[str, Any] = {}
    for kind, names in _VALUES.items():
        flag = values.get(f"has_{kind}_limits")
        if flag is False:
            changes[f"has_{kind}_limits"] = False
        elif flag is True and all(_is_limit(name, values.get(name)) for name in names):
            changes[f"has_{kind}_limits"] = True
            changes.update((name, float(values[name])) for name in names)
    if values.get("has_position_limits") is False and isinstance(values.get("angle_wraparound"), bool):
        changes["angle_wraparound"] = values["angle_wraparound"]
    return replace(limits, **changes)


def soft_limits_from_params(nh: Any, joint: str) -> SoftJointLimits | None:
    """Soft limits of ``<nh>/joint_limits/<joint>``; None unless has_soft_limits and all four values are there."""
    values = _read(nh, joint)
    return None if values is None else soft_limits_of(values)


def soft_limits_of(values: dict[str, Any]) -> SoftJointLimits | None:
    numbers: list[Any] = [values.get(name) for name in ("soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity")]
    if values.get("has_soft_limits") is not True or not all(is_number(value, finite=False) for value in numbers):
        return None
    return SoftJointLimits(*map(float, numbers))


def _is_limit(name: str, value: Any) -> bool:
    """A number that something can be kept within: no upper limit is minus infinity, no lower one infinity."""
    return is_number(value, finite=False) and (value < math.inf if name.startswith("min") else value > -math.inf)

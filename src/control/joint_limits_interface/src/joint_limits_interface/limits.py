"""Limits of a joint, from its URDF description and from parameters. Meant order: URDF first, parameters override.

What each source says is read by ``limit_sources.h``, for Python and for upstream's C++ functions.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import rospy

from . import _limits
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


def limits_from_urdf(joint: JointDescription, limits: JointLimits = JointLimits()) -> JointLimits | None:
    """``limits`` with what ``<limit>`` says; None for a joint without one."""
    limit = joint.limit
    if limit is None:
        return None
    bounded, endless = joint.kind in ("revolute", "prismatic"), joint.kind == "continuous"
    return JointLimits(**_limits.apply_description(bounded, endless, limit.lower, limit.upper, limit.velocity, limit.effort, limits))


def soft_limits_from_urdf(joint: JointDescription) -> SoftJointLimits | None:
    """What ``<safety_controller>`` of ``joint`` says; None without one."""
    safety = joint.safety
    if safety is None:
        return None
    return SoftJointLimits(safety.lower, safety.upper, safety.k_position, safety.k_velocity)


def _read(nh: Any, joint: str) -> dict[str, Any] | None:
    values = rospy.get_param(nh.resolve(f"joint_limits/{joint}"), None)
    return values if values is None or isinstance(values, dict) else {}


def limits_from_params(nh: Any, joint: str, limits: JointLimits = JointLimits()) -> JointLimits | None:
    """``limits`` with what ``<nh>/joint_limits/<joint>`` says; None if that namespace is not there.

    :param nh: controller_interface.NodeHandle.
    """
    values = _read(nh, joint)
    return None if values is None else apply_limits(values, limits)


def apply_limits(values: dict[str, Any], limits: JointLimits) -> JointLimits:
    """``limits`` overridden by ``values``, a parameter map. A value counts only beside ``has_<kind>_limits: true``."""
    return JointLimits(**_limits.apply_parameters(values, limits))


def soft_limits_from_params(nh: Any, joint: str) -> SoftJointLimits | None:
    """Soft limits of ``<nh>/joint_limits/<joint>``; None unless has_soft_limits and all four values are there."""
    values = _read(nh, joint)
    return None if values is None else soft_limits_of(values)


def soft_limits_of(values: dict[str, Any]) -> SoftJointLimits | None:
    """Soft limits of a parameter map; None unless has_soft_limits and all four values are there."""
    numbers = _limits.soft_limits(values)
    return None if numbers is None else SoftJointLimits(*numbers)

"""Grippers as their nodes' parameters describe them, under upstream's names and with its defaults."""

from __future__ import annotations

import reprlib

import rospy
from node_signals.parameters import ParameterError, get, number

from .grippers import Gripper, Jaw, Linkage, Swinging

_SHORTEST = 1e-6  # m


def swinging(jaws: tuple[Jaw, ...], low: float, high: float) -> Swinging:
    """Fingers as ~pad_width and ~finger_length have them.

    :param jaws: one or two
    :param low, high: limits of the opening, m
    :raises ParameterError: a length is none
    """
    return Swinging(jaws, number("~pad_width", 0.01), finger_length(), low, high)


def finger_length() -> float:
    return number("~finger_length", 0.02, least=_SHORTEST)


def one_jaw(joint: str) -> tuple[Jaw, ...]:
    return (Jaw(joint, number("~center", 0.0), get("~invert", False, bool)),)


def two_jaws(left: str, right: str) -> tuple[Jaw, ...]:
    """The right one stands opposite: it turns the other way for the same opening.

    :param left, right: names of the joints
    """
    return (
        Jaw(left, number("~center_left", 0.0), get("~invert_left", False, bool)),
        Jaw(right, number("~center_right", 0.0), not get("~invert_right", False, bool)),
    )


def gripper() -> Gripper:
    """As ``~model`` says: dualservo, singlesided or parallel. :raises ParameterError: it is none of these, or another parameter is wrong"""
    model = get("~model", "")
    if model == "parallel":
        scale = number("~scale", 1.0)
        if scale == 0.0:
            raise ParameterError(f"parameter {rospy.resolve_name('~scale')} must not be 0: the jaws would never move")
        return Linkage(get("~joint", "gripper_joint", str), number("~center", 0.0), scale)
    if model == "dualservo":
        jaws = two_jaws(get("~joint_left", "l_gripper_joint", str), get("~joint_right", "r_gripper_joint", str))
    elif model == "singlesided":
        jaws = one_jaw(get("~joint", "gripper_joint", str))
    else:
        said = f"it is {reprlib.repr(model)}" if model else "it is not set"
        raise ParameterError(f"parameter {rospy.resolve_name('~model')} must be dualservo, singlesided or parallel; {said}")
    return swinging(jaws, number("~min_opening", 0.0), number("~max_opening", 0.09))

"""Limits of joints from a robot description."""

import math
import xml.etree.ElementTree as ET
from typing import NamedTuple

import lenient_xml
from qt_gui.errors import WindowError


class JointLimits(NamedTuple):
    """rad or m; rad/s or m/s."""

    lowest: float
    highest: float
    velocity: float


class DescriptionError(WindowError, ValueError):
    """A text that is no robot description; one line says why."""


def joint_limits(description: str) -> dict[str, JointLimits]:
    """All joints that can be moved by sliders: with limits of position (continuous ones: half a turn each way; soft limits
    narrow them) and of velocity. Joints that mimic another are left out.

    :param description: a URDF as text
    :raises DescriptionError: if it is none
    """
    try:
        root = lenient_xml.fromstring(description)
    except (ET.ParseError, TypeError, ValueError) as error:
        raise DescriptionError(f"robot_description is no XML: {error}") from error
    found: dict[str, JointLimits] = {}
    for joint in root.findall("joint"):
        limits = _limits(joint)
        if limits is not None:
            found[joint.get("name", "")] = limits
    return found


def _limits(joint: ET.Element):
    kind, limit, safety = joint.get("type"), joint.find("limit"), joint.find("safety_controller")
    if kind in ("fixed", "floating", "planar") or joint.find("mimic") is not None or joint.get("name") is None:
        return None
    velocity = _number(limit, "velocity")
    lowest, highest = (-math.pi, math.pi) if kind == "continuous" else (_number(limit, "lower", 0.0), _number(limit, "upper", 0.0))
    if limit is None and kind != "continuous" or velocity is None or velocity <= 0 or lowest is None or highest is None:
        return None
    if kind != "continuous" and safety is not None:
        lowest = max(lowest, _number(safety, "soft_lower_limit", lowest))
        highest = min(highest, _number(safety, "soft_upper_limit", highest))
    return JointLimits(lowest, highest, velocity) if lowest < highest else None


def _number(element, name: str, default=None):
    if element is None or element.get(name) is None:
        return default if element is not None else None
    try:
        value = float(element.get(name))
    except ValueError:
        return None
    return value if math.isfinite(value) else None

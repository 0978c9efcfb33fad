"""The joints of a URDF, as far as controllers and limits need them."""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import inf
from xml.etree import ElementTree

from hardware_interface import ControlError, description_root

from .angles import distance_within_limits, shortest_angular_distance

_NUMBER = re.compile(r"\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", re.ASCII)


class DescriptionError(ControlError):
    """The robot description cannot be used; one line saying why."""


@dataclass(frozen=True)
class Limit:
    """URDF ``<limit>``: rad or m, rad/s or m/s, Nm or N."""

    lower: float
    upper: float
    velocity: float
    effort: float


@dataclass(frozen=True)
class Safety:
    """URDF ``<safety_controller>``."""

    lower: float
    upper: float
    k_position: float
    k_velocity: float


@dataclass(frozen=True)
class JointDescription:
    """A joint of the URDF; ``kind`` is its type there."""

    name: str
    kind: str
    limit: Limit | None = None
    safety: Safety | None = None

    @property
    def lower(self) -> float:
        """Lower position limit; -inf where the joint has none."""
        return self.limit.lower if self.limit and self.kind in ("revolute", "prismatic") else -inf

    @property
    def upper(self) -> float:
        """Upper position limit; inf where the joint has none."""
        return self.limit.upper if self.limit and self.kind in ("revolute", "prismatic") else inf

    def clamp(self, position: float) -> float:
        """``position`` inside the position limits."""
        return min(max(position, self.lower), self.upper)

    def error(self, position: float, target: float) -> float:
        """target - position, the way round that the joint can go."""
        if self.kind == "revolute":
            return distance_within_limits(position, target, self.lower, self.upper)
        if self.kind == "continuous":
            return shortest_angular_distance(position, target)
        return target - position


def _number(element: ElementTree.Element, attribute: str, joint: str) -> float:
    """A number as urdfdom reads it, which knows neither NaN nor infinity."""
    text = element.get(attribute, "0")
    value = float(text) if _NUMBER.fullmatch(text) else inf
    if value in (inf, -inf):
        raise DescriptionError(f"joint '{joint}': <{element.tag} {attribute}=\"{text}\"> is no number")
    return value


def _joint(element: ElementTree.Element) -> JointDescription:
    name = element.get("name", "")
    limit, safety = element.find("limit"), element.find("safety_controller")
    return JointDescription(
        name,
        element.get("type", ""),
        None if limit is None else Limit(*(_number(limit, key, name) for key in ("lower", "upper", "velocity", "effort"))),
        None
        if safety is None
        else Safety(*(_number(safety, key, name) for key in ("soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"))),
    )


def read_joints(urdf: str) -> dict[str, JointDescription]:
    """The joints of ``urdf``, a text, by name.

    :raises DescriptionError: the text is no XML, or a limit no number.
    """
    try:
        root = description_root(urdf)
    except ElementTree.ParseError as error:
        raise DescriptionError(f"the robot description is no valid XML: {error}") from None
    return {joint.name: joint for joint in map(_joint, root.iterfind("joint"))}

"""Joints and wheels of a URDF."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass

from controller_interface import ParameterError
from hardware_interface import description_root

Vector = tuple[float, float, float]


class GeometryError(ParameterError):
    """The URDF in robot_description does not say what was asked; one line with the joint or link and what was found."""


@dataclass(frozen=True)
class UrdfJoint:
    """A joint; ``origin`` is its position in the frame of the parent link, m."""

    name: str
    type: str
    parent: str
    child: str
    origin: Vector


class RobotGeometry:
    """A parsed URDF.

    :param text: the URDF
    :param source: where it came from, for messages
    :raises GeometryError: not a URDF
    """

    def __init__(self, text: str, source: str = "the URDF"):
        self._source = source
        try:
            robot = description_root(text)
        except ET.ParseError as error:
            raise GeometryError(f"{source} is not valid XML: {error}") from None
        if robot.tag != "robot":
            raise GeometryError(f"{source} is not a URDF: its root element is <{robot.tag}>, not <robot>")
        self._joints: dict[str, UrdfJoint] = {}
        for element in robot.iterfind("joint"):
            joint = UrdfJoint(
                element.get("name", ""), element.get("type", ""), _link(element, "parent"), _link(element, "child"), self._origin(element)
            )
            self._joints[joint.name] = joint
        self._links = {element.get("name", ""): element for element in robot.iterfind("link")}

    def _origin(self, joint: ET.Element) -> Vector:
        origin = joint.find("origin")
        text = "0 0 0" if origin is None else origin.get("xyz", "0 0 0")
        try:
            x, y, z = map(float, text.split())
        except ValueError:
            raise GeometryError(f"joint '{joint.get('name')}' in {self._source}: origin xyz=\"{text}\" is not three numbers") from None
        return x, y, z

    def joint(self, name: str) -> UrdfJoint:
        """The joint of that name.

        :raises GeometryError: there is none
        """
        try:
            return self._joints[name]
        except KeyError:
            raise GeometryError(f"joint '{name}' is not in {self._source}; it has: {', '.join(sorted(self._joints)) or 'none'}") from None

    def position(self, joint: str, ancestor: str) -> Vector:
        """Position of a joint in the frame of link ``ancestor``, m, adding up the origins on the way.

        Rotated joints in between are not accounted for, as in urdf_geometry_parser.

        :raises GeometryError: ``ancestor`` is not above the joint
        """
        parents = {entry.child: entry for entry in self._joints.values()}
        entry = self.joint(joint)
        x, y, z = entry.origin
        visited = set()
        while entry.parent != ancestor:
            if entry.parent not in parents or entry.name in visited:
                raise GeometryError(
                    f"link '{ancestor}' is not above joint '{joint}' in {self._source}; set base_frame_id to the robot's base link"
                )
            visited.add(entry.name)
            entry = parents[entry.parent]
            x, y, z = x + entry.origin[0], y + entry.origin[1], z + entry.origin[2]
        return x, y, z

    def distance(self, first: str, second: str) -> float:
        """Distance between the origins of joints ``first`` and ``second``, of one parent link, m.

        :raises GeometryError: there is no such joint
        """
        return math.dist(self.joint(first).origin, self.joint(second).origin)

    def wheel_radius(self, joint: str, shapes: Sequence[str] = ("cylinder", "sphere")) -> float:
        """Radius of the collision shape of the link that ``joint`` turns, m.

        :param shapes: collision shapes that count as a wheel
        :raises GeometryError: another shape, or none
        """
        name = self.joint(joint).child
        link = self._links.get(name)
        geometry = None if link is None else link.find("collision/geometry")
        for shape in shapes:
            element = None if geometry is None else geometry.find(shape)
            if element is None:
                continue
            try:
                radius = float(element.get("radius", ""))
            except ValueError:
                radius = 0.0
            if radius > 0.0:
                return radius
        found = "none" if geometry is None or not len(geometry) else f"a {geometry[0].tag}"
        raise GeometryError(
            f"wheel link '{name}' of joint '{joint}' needs a collision geometry that is a "
            f"{' or '.join(shapes)} with a radius, it has {found}; or set the radius by parameter"
        )


def _link(joint: ET.Element, role: str) -> str:
    element = joint.find(role)
    return "" if element is None else element.get("link", "")

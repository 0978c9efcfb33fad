"""A robot's links, joints, materials and transmissions, read from URDF and written back.

::

    robot = URDF.from_xml_file("arm.urdf")          # or from_xml_string(text), from_parameter_server("robot_description")
    robot.get_root(); robot.joint_map["elbow"].limit.upper; robot.get_chain("base_link", "hand", links=False)

Lengths are in m, angles in rad, masses in kg, as in the file; what it leaves out is None or URDF's default.
"""

from __future__ import annotations

from typing import Any
from xml.etree import ElementTree

import urdf_parser_py.xml_reflection as xmlr
from urdf_parser_py.xml_reflection.core import Aggregate, Attribute, Child, Object, number, numbers, text

verbose = True


class Pose(Object):
    """``xyz``: m; ``rpy``: rad, about fixed axes."""

    TAG = "origin"
    FIELDS = [Attribute("xyz", numbers(3), False, [0, 0, 0]), Attribute("rpy", numbers(3), False, [0, 0, 0])]

    def __init__(self, xyz=None, rpy=None):
        self.xyz, self.rpy = xyz, rpy

    def check_valid(self):
        if any(part is not None and len(part) != 3 for part in (self.xyz, self.rpy)):
            raise ValueError("xyz and rpy are three numbers each")

    position = property(lambda self: self.xyz, lambda self, value: setattr(self, "xyz", value))
    rotation = property(lambda self: self.rpy, lambda self, value: setattr(self, "rpy", value))


_NAME = Attribute("name", text)
_ORIGIN = Child("origin", Pose, False)


class Color(Object):
    TAG = "color"
    FIELDS = [Attribute("rgba", numbers(4))]

    def __init__(self, *args):
        rgba = list(args[0] if len(args) == 1 else args) or None
        if rgba is not None and len(rgba) == 3:
            rgba.append(1.0)
        if rgba is not None and len(rgba) != 4:
            raise Exception("Invalid color argument count")
        self.rgba = rgba


class Texture(Object):
    TAG = "texture"
    FIELDS = [Attribute("filename", text)]

    def __init__(self, filename=None):
        self.filename = filename


class Material(Object):
    TAG = "material"
    FIELDS = [_NAME, Child("color", Color, False), Child("texture", Texture, False)]

    def __init__(self, name=None, color=None, texture=None):
        self.name, self.color, self.texture = name, color, texture

    def check_valid(self):
        if self.color is None and self.texture is None:
            xmlr.core.on_error("Material has neither a color nor texture.")


class LinkMaterial(Material):
    """One of a visual, which may name the robot's."""

    def check_valid(self):
        pass


class Box(Object):
    TAG = "box"
    FIELDS = [Attribute("size", numbers(3))]

    def __init__(self, size=None):
        self.size = size


class Cylinder(Object):
    TAG = "cylinder"
    FIELDS = [Attribute("radius", number), Attribute("length", number)]

    def __init__(self, radius=0.0, length=0.0):
        self.radius, self.length = radius, length


class Sphere(Object):
    TAG = "sphere"
    FIELDS = [Attribute("radius", number)]

    def __init__(self, radius=0.0):
        self.radius = radius


class Mesh(Object):
    TAG = "mesh"
    FIELDS = [Attribute("filename", text), Attribute("scale", numbers(3), False)]

    def __init__(self, filename=None, scale=None):
        self.filename, self.scale = filename, scale


class _Geometry:
    """Reads ``<geometry>`` into the shape that is in it."""

    SHAPES = {cls.TAG: cls for cls in (Box, Cylinder, Sphere, Mesh)}

    @classmethod
    def from_xml(cls, node: ElementTree.Element, path: str) -> Object:
        children = [child for child in node if isinstance(child.tag, str)]
        if len(children) != 1:
            raise xmlr.ParseError(ValueError("One element only for geometric"), path)
        if children[0].tag not in cls.SHAPES:
            raise xmlr.ParseError(ValueError(f"Invalid geometric tag: {children[0].tag}"), path)
        return cls.SHAPES[children[0].tag].from_xml(children[0], f"{path}/{children[0].tag}")


class _GeometryChild(Child):
    def to_xml(self, parent, value):
        ElementTree.SubElement(parent, self.xml).append(value.to_xml())


class Collision(Object):
    TAG = "collision"
    FIELDS = [Attribute("name", text, False), _ORIGIN, _GeometryChild("geometry", _Geometry)]

    def __init__(self, geometry=None, origin=None, name=None):
        self.geometry, self.origin, self.name = geometry, origin, name


class Visual(Object):
    TAG = "visual"
    FIELDS = [*Collision.FIELDS, Child("material", LinkMaterial, False)]

    def __init__(self, geometry=None, material=None, origin=None, name=None):
        self.geometry, self.material, self.origin, self.name = geometry, material, origin, name


class Inertia(Object):
    """kg m^2, about the centre of mass."""

    KEYS = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]
    TAG = "inertia"
    FIELDS = [Attribute(key, number) for key in KEYS]

    def __init__(self, ixx=0.0, ixy=0.0, ixz=0.0, iyy=0.0, iyz=0.0, izz=0.0):
        self.ixx, self.ixy, self.ixz, self.iyy, self.iyz, self.izz = ixx, ixy, ixz, iyy, iyz, izz

    def to_matrix(self) -> list[list[float]]:
        return [[self.ixx, self.ixy, self.ixz], [self.ixy, self.iyy, self.iyz], [self.ixz, self.iyz, self.izz]]


class Inertial(Object):
    TAG = "inertial"
    FIELDS = [_ORIGIN, Child("mass", ("value", number)), Child("inertia", Inertia, False)]

    def __init__(self, mass=0.0, inertia=None, origin=None):
        self.mass, self.inertia, self.origin = mass, inertia, origin


class JointDynamics(Object):
    TAG = "dynamics"
    FIELDS = [Attribute("damping", number, False), Attribute("friction", number, False)]

    def __init__(self, damping=None, friction=None):
        self.damping, self.friction = damping, friction


class JointCalibration(Object):
    TAG = "calibration"
    FIELDS = [Attribute("rising", number, False, 0), Attribute("falling", number, False, 0)]

    def __init__(self, rising=None, falling=None):
        self.rising, self.falling = rising, falling


class JointLimit(Object):
    TAG = "limit"
    FIELDS = [
        Attribute("effort", number),
        Attribute("lower", number, False, 0),
        Attribute("upper", number, False, 0),
        Attribute("velocity", number),
    ]

    def __init__(self, effort=None, velocity=None, lower=None, upper=None):
        self.effort, self.velocity, self.lower, self.upper = effort, velocity, lower, upper


class JointMimic(Object):
    TAG = "mimic"
    FIELDS = [Attribute("joint", text), Attribute("multiplier", number, False), Attribute("offset", number, False)]

    def __init__(self, joint_name=None, multiplier=None, offset=None):
        self.joint, self.multiplier, self.offset = joint_name, multiplier, offset


class SafetyController(Object):
    TAG = "safety_controller"
    FIELDS = [
        Attribute("k_velocity", number),
        Attribute("k_position", number, False, 0),
        Attribute("soft_lower_limit", number, False, 0),
        Attribute("soft_upper_limit", number, False, 0),
    ]

    def __init__(self, velocity=None, position=None, lower=None, upper=None):
        self.k_velocity, self.k_position, self.soft_lower_limit, self.soft_upper_limit = velocity, position, lower, upper


class Joint(Object):
    TYPES = ["unknown", "revolute", "continuous", "prismatic", "floating", "planar", "fixed"]
    TAG = "joint"
    FIELDS = [
        _NAME,
        Attribute("type", text),
        _ORIGIN,
        Child("axis", ("xyz", numbers(3)), False),
        Child("parent", ("link", text)),
        Child("child", ("link", text)),
        Child("limit", JointLimit, False),
        Child("dynamics", JointDynamics, False),
        Child("safety_controller", SafetyController, False),
        Child("calibration", JointCalibration, False),
        Child("mimic", JointMimic, False),
    ]

    def __init__(
        self,
        name=None,
        parent=None,
        child=None,
        joint_type=None,
        axis=None,
        origin=None,
        limit=None,
        dynamics=None,
        safety_controller=None,
        calibration=None,
        mimic=None,
    ):
        self.name, self.parent, self.child, self.type, self.axis, self.origin = name, parent, child, joint_type, axis, origin
        self.limit, self.dynamics, self.safety_controller = limit, dynamics, safety_controller
        self.calibration, self.mimic = calibration, mimic

    def check_valid(self):
        if self.type not in self.TYPES:
            raise ValueError(f"Invalid joint type: {self.type}")

    joint_type = property(lambda self: self.type, lambda self, value: setattr(self, "type", value))


def _first(kind: str) -> property:
    """The first visual or collision, or None."""

    def get(self):
        return next(iter(getattr(self, kind + "s")), None)

    def put(self, value):
        first = get(self)
        if first is not None:
            self.remove_aggregate(first)
        if value is not None:
            self.add_aggregate(kind, value)
            listed = getattr(self, kind + "s")
            listed.insert(0, listed.pop())

    return property(get, put)


class Link(Object):
    TAG = "link"
    FIELDS = [_NAME, _ORIGIN, Aggregate("visual", Visual), Aggregate("collision", Collision), Child("inertial", Inertial, False)]

    def __init__(self, name=None, visual=None, inertial=None, collision=None, origin=None):
        self.aggregate_init()
        self.name, self.inertial, self.origin = name, inertial, origin
        self.visuals: list[Visual] = []
        self.collisions: list[Collision] = []
        self.visual, self.collision = visual, collision

    visual = _first("visual")
    collision = _first("collision")


class Actuator(Object):
    TAG = "actuator"
    FIELDS = [_NAME, Child("mechanicalReduction", number, False)]

    def __init__(self, name=None, mechanicalReduction=1):
        self.name, self.mechanicalReduction = name, mechanicalReduction


class TransmissionJoint(Object):
    TAG = "joint"
    FIELDS = [_NAME, Aggregate("hardwareInterface", text)]

    def __init__(self, name=None):
        self.aggregate_init()
        self.name = name
        self.hardwareInterfaces: list[str] = []

    def check_valid(self):
        if not self.hardwareInterfaces:
            raise ValueError("no hardwareInterface defined")


class PR2Transmission(Object):
    """The form before ros_control."""

    TAG = "pr2_transmission"
    FIELDS = [
        _NAME,
        Attribute("type", text),
        Child("joint", ("name", text)),
        Child("actuator", ("name", text)),
        Child("mechanicalReduction", number),
    ]

    def __init__(self, name=None, joint=None, actuator=None, type=None, mechanicalReduction=1):
        self.name, self.joint, self.actuator, self.type, self.mechanicalReduction = name, joint, actuator, type, mechanicalReduction


class Transmission(Object):
    TAG = "transmission"
    FIELDS = [_NAME, Child("type", text), Aggregate("joint", TransmissionJoint), Aggregate("actuator", Actuator)]

    def __init__(self, name=None):
        self.aggregate_init()
        self.name, self.type = name, None
        self.joints: list[TransmissionJoint] = []
        self.actuators: list[Actuator] = []

    def check_valid(self):
        for what in ("joint", "actuator"):
            if not getattr(self, what + "s"):
                raise ValueError(f"no {what} defined")


class _AnyTransmission:
    @staticmethod
    def from_xml(node: ElementTree.Element, path: str) -> Object:
        return (PR2Transmission if node.get("type") else Transmission).from_xml(node, path)


class Robot(Object):
    SUPPORTED_VERSIONS = ["1.0"]
    TAG = "robot"
    FIELDS = [
        _NAME,
        Attribute("version", text, False),
        Aggregate("link", Link),
        Aggregate("joint", Joint),
        Aggregate("gazebo", ElementTree.Element),
        Aggregate("transmission", _AnyTransmission),
        Aggregate("material", Material),
    ]

    def __init__(self, name: str | None = None, version: str = "1.0"):
        self.aggregate_init()
        self.name, self.version = name, version
        self._check_version()
        self.links: list[Link] = []
        self.joints: list[Joint] = []
        self.materials: list[Material] = []
        self.gazebos: list[ElementTree.Element] = []
        self.transmissions: list[Any] = []
        self.link_map: dict[str, Link] = {}
        self.joint_map: dict[str, Joint] = {}
        #: child link -> (joint, parent link); parent link -> [(joint, child link)]
        self.parent_map: dict[str, tuple[str, str]] = {}
        self.child_map: dict[str, list[tuple[str, str]]] = {}

    def _check_version(self):
        if self.version not in self.SUPPORTED_VERSIONS:
            raise ValueError(f"Invalid version; only {','.join(self.SUPPORTED_VERSIONS)} is supported")

    def post_read_xml(self):
        self.version = self.version or "1.0"
        self._check_version()

    def add_aggregate(self, xml_var: str, obj: Any) -> None:
        super().add_aggregate(xml_var, obj)
        if xml_var == "joint":
            self.joint_map[obj.name] = obj
            self.parent_map[obj.child] = (obj.name, obj.parent)
            self.child_map.setdefault(obj.parent, []).append((obj.name, obj.child))
        elif xml_var == "link":
            self.link_map[obj.name] = obj

    def add_link(self, link: Link) -> None:
        """Append ``link``."""
        self.add_aggregate("link", link)

    def add_joint(self, joint: Joint) -> None:
        """Append ``joint``."""
        self.add_aggregate("joint", joint)

    def get_chain(self, root: str, tip: str, joints: bool = True, links: bool = True, fixed: bool = True) -> list[str]:
        """Names from ``root`` to ``tip``, both included.

        :param joints, links: whose names are wanted
        :param fixed: with fixed joints
        :raises KeyError: ``tip`` does not hang from ``root``
        """
        chain, link = [tip] if links else [], tip
        while link != root:
            joint, link = self.parent_map[link]
            if joints and (fixed or self.joint_map[joint].type != "fixed"):
                chain.append(joint)
            if links:
                chain.append(link)
        return chain[::-1]

    def get_root(self) -> str:
        """:raises AssertionError: none, or several"""
        roots = [name for name in self.link_map if name not in self.parent_map]
        if len(roots) != 1:
            raise AssertionError(f"{'Multiple' if roots else 'No'} roots detected, invalid URDF{': ' + ', '.join(roots) if roots else ''}.")
        return roots[0]

    @classmethod
    def from_parameter_server(cls, key: str = "robot_description") -> Robot:
        """The robot in the parameter ``key``. :raises KeyError: there is no such parameter. :raises ParseError: it is no robot"""
        import rospy

        return cls.from_xml_string(rospy.get_param(key))


URDF = Robot

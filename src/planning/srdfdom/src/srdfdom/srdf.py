"""An SRDF document as objects: groups, states, end effectors, virtual joints, collisions that are never checked.

As upstream's module::

    robot = SRDF.from_xml_string(text)
    robot.group_map["arm"].chains[0].tip_link
    robot.to_xml_string()
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from typing import Any, TypeVar, cast

_Robot = TypeVar("_Robot", bound="Robot")


class ParseError(ValueError):
    """A document that is no SRDF; one line naming the element."""


class Element:
    """Base of all elements. ``_attributes``: (name, required, field); ``_children``: (tag, class, field of a list).

    A required attribute is typed as what it is once it was read or set; an element made without it has None there.
    """

    _tag = ""
    _attributes: tuple[tuple[str, bool, str], ...] = ()
    _children: tuple[tuple[str, type[Element], str], ...] = ()

    @classmethod
    def from_xml(cls, node: ET.Element):
        """Read the element ``node``; unknown children and attributes are passed over.

        :raises ParseError: a required attribute is missing.
        """
        made = cls()
        for name, required, field in cls._attributes:
            value = node.get(name)
            if value is None and required:
                raise ParseError(f"<{node.tag}{' name=' + repr(node.get('name')) if node.get('name') else ''}> has no attribute '{name}'")
            if value is not None:
                setattr(made, field, made._read(field, value))
        for tag, kind, field in cls._children:
            getattr(made, field).extend(kind.from_xml(child) for child in node.findall(tag))
        made._loaded()
        return made

    def _read(self, _field: str, value: str) -> Any:
        return value

    def _write(self, _field: str, value: Any) -> str:
        return str(value)

    def _loaded(self) -> None:
        """After the element was read."""

    def to_xml(self, tag: str | None = None) -> ET.Element:
        """The element as XML, called ``tag`` (None: as it always is)."""
        node = ET.Element(tag or self._tag)
        for name, _, field in self._attributes:
            value = getattr(self, field)
            if value is not None:
                node.set(name, self._write(field, value))
        for child_tag, _, field in self._children:
            node.extend(child.to_xml(child_tag) for child in getattr(self, field))
        return node

    def to_xml_string(self) -> str:
        """The element as indented text."""
        node = self.to_xml()
        ET.indent(node)
        return '<?xml version="1.0"?>\n' + ET.tostring(node, encoding="unicode") + "\n"

    def __repr__(self) -> str:
        fields = ", ".join(f"{key}={value!r}" for key, value in vars(self).items())
        return f"{type(self).__name__}({fields})"


class Link(Element):
    """A link of a group."""

    _tag, _attributes = "link", (("name", True, "name"),)

    def __init__(self, name: str | None = None):
        self.name = cast(str, name)


class Joint(Link):
    """A joint of a group."""

    _tag = "joint"


class PassiveJoint(Link):
    """A joint without an actuator."""

    _tag = "passive_joint"


class JointVal(Element):
    """The value of a joint in a group state: a list, as a joint may have several variables."""

    _tag, _attributes = "joint", (("name", True, "name"), ("value", True, "value"))

    def __init__(self, name: str | None = None, value: Any = None):
        self.name = cast(str, name)
        self.value: list[float] = [] if value is None else value

    def _read(self, field: str, value: str) -> Any:
        if field != "value":
            return value
        try:
            return [float(part) for part in value.split()]
        except ValueError as error:
            raise ParseError(f"a joint of a group_state has the value '{value[:40]}', which is no number") from error

    def _write(self, field: str, value: Any) -> str:
        return " ".join(f"{number:g}" for number in value) if field == "value" else str(value)


class Sphere(Element):
    """One sphere of a link's approximation: centre as text "x y z" and radius, metres in the link frame."""

    _tag, _attributes = "sphere", (("center", True, "center"), ("radius", True, "radius"))

    def __init__(self, center: str | None = None, radius: float = 0.0):
        self.center = center
        self.radius = radius

    def _read(self, field: str, value: str) -> Any:
        return float(value) if field == "radius" else value


class VirtualJoint(Element):
    """A joint ``name`` between the robot and the world: ``child_link`` moves in ``parent_frame``.

    :param joint_type: fixed, floating or planar.
    """

    TYPES = ["unknown", "fixed", "floating", "planar"]
    _tag = "virtual_joint"
    _attributes = (
        ("name", True, "name"),
        ("child_link", True, "child_link"),
        ("parent_frame", True, "parent_frame"),
        ("type", True, "type"),
    )

    def __init__(
        self, name: str | None = None, child_link: str | None = None, parent_frame: str | None = None, joint_type: str | None = None
    ):
        self.name = cast(str, name)
        self.child_link = cast(str, child_link)
        self.parent_frame = cast(str, parent_frame)
        self.type = cast(str, joint_type)

    @property
    def joint_type(self) -> str:
        return self.type

    @joint_type.setter
    def joint_type(self, value: str) -> None:
        self.type = value

    def check_valid(self) -> None:
        """:raises AssertionError: unknown type."""
        assert self.type in self.TYPES, f"Invalid joint type: {self.type}"

    def _loaded(self) -> None:
        if self.type not in self.TYPES:
            raise ParseError(f"virtual_joint '{self.name}' has the type '{self.type}'; there are: {', '.join(self.TYPES[1:])}")


class Chain(Element):
    """All joints from ``base_link`` to ``tip_link``."""

    _tag, _attributes = "chain", (("base_link", True, "base_link"), ("tip_link", True, "tip_link"))

    def __init__(self, base_link: str | None = None, tip_link: str | None = None):
        self.base_link = cast(str, base_link)
        self.tip_link = cast(str, tip_link)


class EndEffector(Element):
    """A ``group``, called ``name``, that hangs on ``parent_link``, a link of ``parent_group`` (None: of whichever has it)."""

    _tag = "end_effector"
    _attributes = (
        ("name", True, "name"),
        ("group", True, "group"),
        ("parent_link", True, "parent_link"),
        ("parent_group", False, "parent_group"),
    )

    def __init__(self, name: str | None = None, group: str | None = None, parent_link: str | None = None, parent_group: str | None = None):
        self.name = cast(str, name)
        self.group = cast(str, group)
        self.parent_link = cast(str, parent_link)
        self.parent_group = parent_group


class DisableCollisions(Element):
    """Two links, ``link1`` and ``link2``, that are never checked against each other; ``reason``: for people."""

    _tag = "disable_collisions"
    _attributes = (("link1", True, "link1"), ("link2", True, "link2"), ("reason", False, "reason"))

    def __init__(self, link1: str | None = None, link2: str | None = None, reason: str | None = None):
        self.link1 = cast(str, link1)
        self.link2 = cast(str, link2)
        self.reason = reason


class Group(Element):
    """Joints that are planned for together; ``subgroups`` is another name of ``groups``."""

    _tag, _attributes = "group", (("name", True, "name"),)

    def __init__(self, name: str | None = None):
        self.name = cast(str, name)
        self.links: list[Link] = []
        self.joints: list[Joint] = []
        self.chains: list[Chain] = []
        self.groups: list[Group] = []
        self.subgroups = self.groups


Group._children = (("link", Link, "links"), ("joint", Joint, "joints"), ("chain", Chain, "chains"), ("group", Group, "groups"))


class GroupState(Element):
    """A state ``name`` of ``group``."""

    _tag, _attributes = "group_state", (("name", True, "name"), ("group", True, "group"))
    _children = (("joint", JointVal, "joints"),)

    def __init__(self, name: str | None = None, group: str | None = None):
        self.name = cast(str, name)
        self.joints: list[JointVal] = []
        self.group = cast(str, group)


class LinkSphereApproximation(Element):
    """A link as spheres."""

    _tag, _attributes = "link_sphere_approximation", (("link", True, "link"),)
    _children = (("sphere", Sphere, "spheres"),)

    def __init__(self, link: str | None = None):
        self.link = cast(str, link)
        self.spheres: list[Sphere] = []


class Robot(Element):
    """The whole document. The list of disabled collisions is called ``disable_collisionss``, as in urdfdom's Python."""

    _tag, _attributes = "robot", (("name", False, "name"),)
    _children = (
        ("group", Group, "groups"),
        ("group_state", GroupState, "group_states"),
        ("end_effector", EndEffector, "end_effectors"),
        ("virtual_joint", VirtualJoint, "virtual_joints"),
        ("passive_joint", PassiveJoint, "passive_joints"),
        ("disable_collisions", DisableCollisions, "disable_collisionss"),
        ("link_sphere_approximation", LinkSphereApproximation, "link_sphere_approximations"),
    )

    def __init__(self, name: str | None = None):
        self.name = name
        self.groups: list[Group] = []
        self.group_states: list[GroupState] = []
        self.end_effectors: list[EndEffector] = []
        self.virtual_joints: list[VirtualJoint] = []
        self.disable_collisionss: list[DisableCollisions] = []
        self.passive_joints: list[PassiveJoint] = []
        self.link_sphere_approximations: list[LinkSphereApproximation] = []
        self.group_map: dict[str, Group] = {}
        self.group_state_map: dict[str, GroupState] = {}

    def _loaded(self) -> None:
        self.group_map = {group.name: group for group in self.groups}
        self.group_state_map = {state.name: state for state in self.group_states}

    def add_aggregate(self, type_name: str, element: Element) -> None:
        """Append ``element`` by its tag, ``type_name``. :raises ParseError: a robot has no such elements."""
        for tag, _, field in self._children:
            if tag == type_name:
                getattr(self, field).append(element)
                self._loaded()
                return
        raise ParseError(f"a robot has no element <{type_name}>")

    def add_group(self, group: Group) -> None:
        """Append ``group``."""
        self.add_aggregate("group", group)

    def add_group_state(self, state: GroupState) -> None:
        """Append ``state``."""
        self.add_aggregate("group_state", state)

    def add_passive_joint(self, joint: PassiveJoint) -> None:
        """Append ``joint``."""
        self.add_aggregate("passive_joint", joint)

    def add_disable_collisions(self, pair: DisableCollisions) -> None:
        """Append ``pair``."""
        self.add_aggregate("disable_collisions", pair)

    def add_link_sphere_approximation(self, link: LinkSphereApproximation) -> None:
        """Append ``link``."""
        self.add_aggregate("link_sphere_approximation", link)

    @classmethod
    def from_xml_string(cls: type[_Robot], text) -> _Robot:
        """Read a document, ``text``.

        :raises ParseError: not XML, not a robot, or an attribute is missing.
        """
        try:
            root = ET.fromstring(text)
        except ET.ParseError as error:
            raise ParseError(f"the SRDF is not XML: {error}") from error
        if root.tag != "robot":
            raise ParseError(f"the SRDF's root is <{root.tag}>, not <robot>")
        return cls.from_xml(root)

    @classmethod
    def from_xml_file(cls, path: str) -> Robot:
        """Read the file ``path``. :raises ParseError: as :meth:`from_xml_string`"""
        with open(path, encoding="utf-8") as file:
            return cls.from_xml_string(file.read())

    @classmethod
    def from_parameter_server(cls, key: str = "robot_description_semantic") -> Robot:
        """Read the document that the parameter ``key`` holds. :raises ParseError: as :meth:`from_xml_string`"""
        import rospy

        return cls.from_xml_string(rospy.get_param(key))


SRDF = Robot

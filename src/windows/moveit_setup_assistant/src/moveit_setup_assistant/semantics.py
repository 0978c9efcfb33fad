"""An SRDF as a document that people read: elements in the usual order, a comment before each kind."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterable
from pathlib import Path

from srdfdom.srdf import ParseError, Robot

from moveit_setup_assistant.errors import AssistantError
from moveit_setup_assistant.robot_source import expanded

# (tag, comment) in the order in which they are written. Other elements keep their place at the end.
SECTIONS: tuple[tuple[str, str], ...] = (
    (
        "group",
        "GROUPS: joints that are planned for together. A <link> brings its parent joint with it, a <joint> its child link, "
        "a <chain> every joint between its two links, a <group> all that is in it.",
    ),
    ("group_state", "GROUP STATES: named joint values of a group, for example a pose in which an arm is folded."),
    ("end_effector", "END EFFECTORS: groups that hang on a link of another group, as a gripper on an arm."),
    ("virtual_joint", "VIRTUAL JOINTS: how the robot's root link stands in the world."),
    ("passive_joint", "PASSIVE JOINTS: joints without an actuator; nobody plans for them."),
    ("joint_property", "JOINT PROPERTIES: what planning should know of a joint besides the URDF."),
    ("link_sphere_approximation", "LINK SPHERE APPROXIMATIONS: links as spheres, for planners that want them."),
    ("disable_default_collisions", "DEFAULT COLLISIONS: links that are checked only against those named in enable_collisions."),
    ("enable_collisions", "ENABLED COLLISIONS: pairs that are checked although a link's default says otherwise."),
    ("disable_collisions", "DISABLED COLLISIONS: pairs of links that are never checked against each other, and why."),
)
_HEAD = (
    "This file adds to the URDF what planning needs to know of a robot: groups, named states, end effectors, and which links "
    "need not be checked for collision. It does not replace the URDF."
)

_ROUNDED = 1e-4  # rad or m: poses are written with four digits


class Semantics(Robot):
    """srdfdom's document, and with it every element that srdfdom does not know: kept as it was read."""

    def __init__(self, name=None):
        super().__init__(name)
        self.others: list[ET.Element] = []

    @classmethod
    def from_xml(cls, node: ET.Element) -> Semantics:
        made = super().from_xml(node)
        known = {tag for tag, _, _ in cls._children}
        made.others = [child for child in node if child.tag not in known]
        return made

    @classmethod
    def load(cls, path: Path, xacro_args: str = "") -> Semantics:
        """The SRDF in the file ``path``.

        :param xacro_args: ``name:=value name:=value``, for a file that ends with .xacro
        :raises AssistantError: the file is missing, no XML, or lacks an attribute.
        """
        try:
            return cls.from_xml_string(expanded(path, xacro_args) if path.suffix == ".xacro" else path.read_bytes())
        except OSError as error:
            raise AssistantError(f"SRDF '{path}' cannot be read: {error.strerror}") from error
        except ParseError as error:
            raise AssistantError(f"SRDF '{path}': {error}") from error

    def to_text(self) -> str:
        """The whole document, indented, sections in the usual order."""
        root = ET.Element("robot", {"name": self.name or ""})
        children = [child for field in self._children for child in self._elements(field)] + self.others
        for tag, comment in SECTIONS:
            section = [child for child in children if child.tag == tag]
            if section:
                root.append(ET.Comment(f" {comment} "))
                root.extend(section)
        tags = {tag for tag, _ in SECTIONS}
        root.extend(child for child in children if child.tag not in tags)
        ET.indent(root, "  ")
        return f'<?xml version="1.0" encoding="UTF-8"?>\n<!-- {_HEAD} -->\n{ET.tostring(root, encoding="unicode")}\n'

    def _elements(self, field) -> Iterable[ET.Element]:
        tag, _, name = field
        return [child.to_xml(tag) for child in getattr(self, name)]

    def problems(self, model) -> list[str]:
        """What does not fit together, one line each: unknown names, groups in a circle, empty groups, double names.

        :param model: the robot, read without this document.
        """
        found = self._unknown_names(model) + self._circles()
        for kind, names in (
            ("group", [g.name for g in self.groups]),
            ("end effector", [e.name for e in self.end_effectors]),
            ("virtual joint", [v.name for v in self.virtual_joints]),
            ("pose", [f"{s.name} of group {s.group}" for s in self.group_states]),
        ):
            found += [f"{kind} '{name}' is there {names.count(name)} times" for name in sorted(set(names)) if names.count(name) > 1]
        found += [
            f"group '{g.name}' is empty: give it joints, links, a chain or other groups"
            for g in self.groups
            if not (g.joints or g.links or g.chains or g.groups)
        ]
        return found

    def unreachable_poses(self, model) -> list[str]:
        """Poses that MoveIt takes and never plans to, one line for each joint: beyond its limits, or not of the pose's group.

        :param model: the robot, read with this document.
        """
        found = []
        for state in self.group_states:
            of_group = set(model.group(state.group).joints) if model.has_group(state.group) else set()
            for joint in state.joints:
                what = f"Pose '{state.name}' of group '{state.group}'"
                if of_group and joint.name not in of_group:
                    found.append(f"{what} moves joint '{joint.name}', which is not in that group: it is left out when MoveIt plans to it.")
                if not model.has_joint(joint.name):
                    continue
                for value, limits in zip(joint.value, model.joint(joint.name).limits):
                    if limits.has_position and not limits.min_position - _ROUNDED <= value <= limits.max_position + _ROUNDED:
                        found.append(
                            f"{what}: joint '{joint.name}' is at {value:g}, beyond its limits {limits.min_position:g} to "
                            f"{limits.max_position:g}; MoveIt does not plan to it."
                        )
        return found

    def _unknown_names(self, model) -> list[str]:
        groups, links, joints = {g.name for g in self.groups}, set(model.links), set(model.joints)
        found = []

        def check(what: str, kind: str, name: str, known) -> None:
            if name not in known:
                found.append(f"{what} names the {kind} '{name}', which the robot does not have")

        for group in self.groups:
            what = f"group '{group.name}'"
            for joint in group.joints:
                check(what, "joint", joint.name, joints)
            for link in [x.name for x in group.links] + [n for c in group.chains for n in (c.base_link, c.tip_link)]:
                check(what, "link", link, links)
            for other in group.groups:
                check(what, "group", other.name, groups)
        for state in self.group_states:
            check(f"pose '{state.name}'", "group", state.group, groups)
            for value in state.joints:
                check(f"pose '{state.name}'", "joint", value.name, joints)
        for effector in self.end_effectors:
            check(f"end effector '{effector.name}'", "group", effector.group, groups)
            check(f"end effector '{effector.name}'", "link", effector.parent_link, links)
        for virtual in self.virtual_joints:
            check(f"virtual joint '{virtual.name}'", "link", virtual.child_link, links)
        for passive in self.passive_joints:
            check("a passive joint", "joint", passive.name, joints)
        for disabled in self.disable_collisionss:
            for link in (disabled.link1, disabled.link2):
                check("a disabled collision", "link", link, links)
        return found

    def _circles(self) -> list[str]:
        below = {group.name: [other.name for other in group.groups] for group in self.groups}

        def reaches(start: str) -> bool:
            seen, waiting = set(), list(below.get(start, ()))
            while waiting:
                name = waiting.pop()
                if name == start:
                    return True
                if name not in seen:
                    seen.add(name)
                    waiting += below.get(name, ())
            return False

        return [f"group '{name}' holds itself, through its subgroups" for name in below if reaches(name)]

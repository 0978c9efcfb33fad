"""``<gazebo>`` extensions of a URDF: what they say about links and joints, and where it goes in the SDF."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from ode_sim import math3
from ode_sim.description.model import FARTHEST, Pose, Vec3, quoted
from ode_sim.description.xmlsource import Element, child, clone, is_true, leading_numbers, text_of

if TYPE_CHECKING:
    from ode_sim.description.sdf import SdfReader

LUMP = "_fixed_joint_lump__"
_GIVEN = "given"  # attribute of an <xyzOffset>
_MATERIAL_SCRIPT = "file://media/materials/scripts/gazebo.material"

# tag -> path below the element it is inserted in
_COLLISION_TAGS = {
    "mu1": "surface/friction/ode/mu",
    "mu2": "surface/friction/ode/mu2",
    "fdir1": "surface/friction/ode/fdir1",
    "kp": "surface/contact/ode/kp",
    "kd": "surface/contact/ode/kd",
    "maxVel": "surface/contact/ode/max_vel",
    "minDepth": "surface/contact/ode/min_depth",
    "maxContacts": "max_contacts",
    "laserRetro": "laser_retro",
}
_JOINT_TAGS = {
    "stopCfm": "physics/ode/limit/cfm",
    "stopErp": "physics/ode/limit/erp",
    "fudgeFactor": "physics/ode/fudge_factor",
    "provideFeedback": "physics/provide_feedback",
    "implicitSpringDamper": "physics/ode/implicit_spring_damper",
    "cfmDamping": "physics/ode/implicit_spring_damper",
    "springReference": "axis/dynamics/spring_reference",
    "springStiffness": "axis/dynamics/spring_stiffness",
}
_LINK_TAGS = {"selfCollide": "self_collide"}
_OWN_MEANING = (
    "material",
    "visual",
    "collision",
    "turnGravityOff",
    "dampingFactor",
    "static",
    "canonicalBody",
    "preserveFixedJoint",
    "disableFixedJointLumping",
)
_NAMING = {"plugin": ("bodyName", "frameName"), "joint": ("parent", "child"), "gripper": ("gripper_link", "palm_link")}
_MOVED_WITH_POSE = ("sensor", "light", "projector")


def _numbers(*values: float) -> str:
    return " ".join(map(repr, values))


def _pose(text: str) -> Pose:
    """Of seven numbers; the identity for any other text."""
    numbers = leading_numbers(text, 7)
    if len(numbers) < 7 or not all(map(math.isfinite, numbers)):
        return Pose()
    x, y, z, *q = numbers
    return Pose((x, y, z), math3.quat_normalize(q))


def merged_at(plugin: ET.Element, tag: str) -> Pose:
    """X_LM of the link that ``<tag>`` of a ``plugin`` of the robot named in the URDF, on the link L that it was merged into; the identity
    where it is a link still."""
    offset = plugin.find("xyzOffset")
    return Pose() if offset is None else _pose(offset.get(tag, ""))


def given_offset(plugin: ET.Element) -> tuple[Vec3, Vec3] | None:
    """x, y, z and roll, pitch, yaw (m, rad) of ``<xyzOffset>`` and ``<rpyOffset>`` of a ``plugin`` in the URDF, before a link that it names
    was merged; None where none was."""
    offset = plugin.find("xyzOffset")
    numbers = () if offset is None else leading_numbers(offset.get(_GIVEN, ""), 6)
    if len(numbers) < 6 or not all(map(math.isfinite, numbers)):
        return None
    x, y, z, *rpy = numbers
    return (x, y, z), (rpy[0], rpy[1], rpy[2])


@dataclass
class _Extension:
    """One ``<gazebo reference>`` block. ``origin`` stays the link it was written for when that one is lumped."""

    origin: str
    values: dict[str, ET.Element] = field(default_factory=dict)  # known tags
    in_visual: list[ET.Element] = field(default_factory=list)
    in_collision: list[ET.Element] = field(default_factory=list)
    others: list[Element] = field(default_factory=list)  # copied verbatim


class Extensions:
    """All ``<gazebo>`` blocks of a robot, by the link or joint they refer to; '' for the robot itself."""

    def __init__(self, robot: ET.Element, reader: SdfReader):
        self._reader = reader
        self._blocks: dict[str, list[_Extension]] = {}
        known = set(_COLLISION_TAGS) | set(_JOINT_TAGS) | set(_LINK_TAGS) | set(_OWN_MEANING)
        names = {e.get("name") for e in robot if e.tag in ("link", "joint")}
        for block in robot.findall("gazebo"):
            reference = (block.get("reference") or "").strip()
            if reference and reference not in names:
                reader.warn(block, f"refers to '{quoted(reference)}', which is no link or joint of the robot; ignored")
            extension = _Extension(reference)
            for element in block:
                if element.tag in ("visual", "collision") and reference:
                    (extension.in_visual if element.tag == "visual" else extension.in_collision).extend(element)
                elif element.tag in known:
                    extension.values[element.tag] = element
                else:
                    extension.others.append(clone(element))
            self._blocks.setdefault(reference, []).append(extension)
        self._numbered: dict[str, dict[str, list[tuple[int, _Extension]]]] = {}  # link -> origin -> its blocks, in order
        self._referring: dict[str, dict[int, Element]] = {}  # link -> what names it, beside the links, by id()
        for blocks in self._blocks.values():
            for element in (element for block in blocks for element in block.others):
                for name in {text_of(named) for tag in _NAMING.get(element.tag, ()) for named in element.findall(tag)}:
                    self._referring.setdefault(name, {})[id(element)] = element

    # ------------------------------------------------------------------ fixed joints

    def keeps_fixed_joint(self, joint: str) -> bool:
        """Whether the fixed ``joint`` stays one, instead of the links it joins becoming one."""
        return self._flag(joint, "preserveFixedJoint") or self._flag(joint, "disableFixedJointLumping")

    def fixed_as_revolute(self, joint: str) -> bool:
        """The old opt-out: a revolute joint with limits 0, 0. The newer one wins."""
        return self._flag(joint, "disableFixedJointLumping") and not self._flag(joint, "preserveFixedJoint")

    def _flag(self, reference: str, tag: str) -> bool:
        return any(is_true(text_of(block.values.get(tag))) for block in self._blocks.get(reference, ()))

    def move(self, link: str, parent: str, x_pl: Pose) -> None:
        """``link`` is lumped into ``parent`` at ``x_pl``: what it has goes along, names of it follow."""
        for block in self._blocks.pop(link, []):
            for element in block.others:
                if element.tag in _MOVED_WITH_POSE:
                    self._move_pose(element, x_pl)
                for contact in element.findall("contact/collision"):
                    if text_of(contact) == link + "_collision":
                        contact.text = f"{parent}_collision_{link}"
            self._blocks.setdefault(parent, []).append(block)
        referring = self._referring.pop(link, {})
        for element in referring.values():
            self._rename(element, link, parent, x_pl)
        self._referring.setdefault(parent, {}).update(referring)

    def _move_pose(self, element: Element, x_pl: Pose) -> None:
        old = element.find("pose")
        if old is not None and old.get("relative_to"):
            return
        pose = math3.compose(x_pl, self._reader.pose(old))
        if old is not None:
            element.remove(old)
        child(element, "pose", " ".join(repr(v) for v in (*pose.p, *pose.q)), {"rotation_format": "quat_xyzw"})

    def _rename(self, element: Element, link: str, parent: str, x_pl: Pose) -> None:
        """References to a link that is gone, in plugins and joints written beside the links."""
        if element.tag == "plugin":
            for tag in ("bodyName", "frameName"):
                named = element.find(tag)
                if named is not None and text_of(named) == link:
                    element.remove(named)
                    child(element, tag, parent)
                    self._move_offset(element, tag, x_pl)
        elif element.tag == "joint":
            for tag in ("parent", "child"):
                named = element.find(tag)
                if named is not None and text_of(named) == link:
                    named.text = parent
        elif element.tag == "gripper":
            for named in element.findall("gripper_link") + element.findall("palm_link"):
                if text_of(named) == link:
                    named.text = parent

    def _move_offset(self, plugin: Element, of: str, x_pl: Pose) -> None:
        """sdformat's offset, from the link that is left to what the plugin was given. Attributes keep what it is made of: where the links
        of ``<bodyName>`` and ``<frameName>`` were on those that are left, and what the file gave."""
        xyz, rpy = ((0.0, 0.0, 0.0),) * 2
        kept: dict[str, str] = {}
        for tag in ("xyzOffset", "rpyOffset"):
            old = plugin.find(tag)
            if old is not None:
                kept.update(old.attrib)
                values = self._reader.numbers(old, (0.0, 0.0, 0.0), most=FARTHEST)
                xyz, rpy = (values, rpy) if tag == "xyzOffset" else (xyz, values)
                plugin.remove(old)
        kept.setdefault(_GIVEN, _numbers(*xyz, *rpy))
        at = math3.compose(x_pl, _pose(kept.get(of, "")))
        kept[of] = _numbers(*at.p, *at.q)
        pose = math3.compose(x_pl, math3.from_rpy(*xyz, *rpy))
        child(plugin, "xyzOffset", _numbers(*pose.p), kept)
        child(plugin, "rpyOffset", _numbers(*math3.to_rpy(pose)))

    # ------------------------------------------------------------------ insertion

    def insert_in_model(self, model: Element) -> None:
        """Put what is said about the robot itself into ``model``, its SDF."""
        for block in self._blocks.get("", ()):
            if "static" in block.values:
                self._set(model, "static", "1" if is_true(text_of(block.values["static"])) else "0")
            model.extend(block.others)

    def insert_in_link(self, element: Element, link: str) -> None:
        """Put what is said about ``link`` into ``element``, its SDF."""
        for block in self._blocks.get(link, ()):
            if "turnGravityOff" in block.values:
                keeps = text_of(block.values["turnGravityOff"]).lower() in ("false", "no", "0")
                self._set(element, "gravity", "1" if keeps else "0")
            if "dampingFactor" in block.values:
                for tag in ("linear", "angular"):
                    self._set(element, "velocity_decay/" + tag, text_of(block.values["dampingFactor"]))
            self._insert(element, block, _LINK_TAGS)
            element.extend(block.others)

    def insert_in_collision(self, element: Element, link: str) -> None:
        """Put what is said about the shapes of ``link`` into ``element``, the SDF of one of its ``<collision>``s."""
        for block in self._blocks_for(element, link, "_collision"):
            self._insert_blobs(element, block.in_collision, "surface")
            self._insert(element, block, _COLLISION_TAGS)

    def insert_in_visual(self, element: Element, link: str) -> None:
        """Put what is said about the looks of ``link`` into ``element``, the SDF of one of its ``<visual>``s."""
        for block in self._blocks_for(element, link, "_visual"):
            self._insert_blobs(element, block.in_visual, "material")
            name = text_of(block.values.get("material"))
            if name:
                self._set(element, "material/script/name", name)
                self._set(element, "material/script/uri", _MATERIAL_SCRIPT)
        if element.find("material") is None and element.find("geometry/mesh") is None:
            self._set(element, "material/script/name", "Gazebo/White")
            self._set(element, "material/script/uri", _MATERIAL_SCRIPT)

    def sensors_of(self, joint: str) -> list[Element]:
        """The ``<sensor>``s that are said to be of ``joint``."""
        return [element for block in self._blocks.get(joint, ()) for element in block.others if element.tag == "sensor"]

    def insert_in_joint(self, element: Element, joint: str, also_link: bool) -> None:
        """Put what is said about ``joint`` into ``element``, its SDF.

        :param also_link: a link has the same name; it has the sensors that only a link can have
        """
        for block in self._blocks.get(joint, ()):
            self._insert(element, block, _JOINT_TAGS)
            for other in block.others:
                if not (also_link and other.tag == "sensor" and other.get("type") != "force_torque"):
                    element.append(other)

    def _blocks_for(self, element: Element, link: str, suffix: str) -> list[_Extension]:
        """Those of the link that the shape was written in: its name tells, as in sdformat."""
        if link not in self._numbered:
            numbered = self._numbered[link] = {}
            for number, block in enumerate(self._blocks.get(link, ())):
                numbered.setdefault(block.origin, []).append((number, block))
        origins = {link}
        pieces = (element.get("name") or "").split(LUMP)
        if len(pieces) > 1:
            origins = {piece[:end] for piece in pieces[1:] for end in range(len(piece)) if piece.startswith(suffix, end)}
        found = [entry for origin in origins for entry in self._numbered[link].get(origin, ())]
        return [block for _, block in sorted(found, key=lambda entry: entry[0])]

    @staticmethod
    def _insert_blobs(element: Element, blobs: list[ET.Element], replacing: str) -> None:
        for blob in blobs:
            if blob.tag == replacing:
                for old in element.findall(replacing):
                    element.remove(old)
            element.append(clone(blob))

    def _insert(self, element: Element, block: _Extension, tags: dict[str, str]) -> None:
        for tag, path in tags.items():
            if tag in block.values:
                self._set(element, path, text_of(block.values[tag]), block.values[tag])

    def _set(self, element: ET.Element, path: str, text: str, like: ET.Element | None = None) -> None:
        """Give the element at ``path`` this text, made if it is not there."""
        tags = path.split("/")
        for tag in tags[:-1]:
            found = element.find(tag)
            element = found if found is not None else child(element, tag)
        old = element.find(tags[-1])
        if old is not None:
            if text_of(old) != text:
                self._reader.warn(
                    like,
                    f"<{like.tag if like is not None else tags[-1]}> is given twice; "
                    f"'{quoted(text)}' takes the place of '{quoted(text_of(old))}'",
                    "note",
                )
            element.remove(old)
        child(element, tags[-1], text, like=like)

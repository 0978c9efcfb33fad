"""URDF to SDF by the conversion rules of sdformat 9, then read by the SDF reader.

The rules that matter to a robot: a fixed joint is removed and its child lumped into the parent (unless the joint says
otherwise); a link without mass takes its sub-tree with it; ``<gazebo reference>`` extensions are applied on top.
Children are taken in the order of their joints' names, as urdfdom keeps them.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from ode_sim import math3
from ode_sim.description import urdf_extensions as extensions
from ode_sim.description import urdf_parts as parts
from ode_sim.description.model import DescriptionError, Joint, Model, Pose, Vec3, quoted
from ode_sim.description.xmlsource import Element, child, fault

if TYPE_CHECKING:
    from ode_sim.description.sdf import SdfReader

_LUMP = extensions.LUMP
_MOST_FIXED = 200  # fixed joints in a row; what hangs on the last is moved as often


@dataclass
class _Mass:
    mass: float
    com: Vec3  # in the link frame
    inertia: math3.Mat3  # about the centre of mass, in the axes of the link frame


@dataclass
class _Shape:
    """A ``<visual>`` or ``<collision>`` in the link it ended up in."""

    element: ET.Element
    form: ET.Element  # <box>, <mesh> ...
    name: str  # '' until it is lumped
    pose: Pose


@dataclass
class _UrdfLink:
    name: str
    element: ET.Element
    inertial: _Mass | None = None
    raw_inertial: tuple[Pose, tuple[float, ...]] | None = None  # as written, while nothing was lumped in
    fault: DescriptionError | None = None  # why it has no mass although it has an <inertial>
    visuals: list[_Shape] = field(default_factory=list)
    collisions: list[_Shape] = field(default_factory=list)
    parent_joint: _UrdfJoint | None = None
    child_joints: list[_UrdfJoint] = field(default_factory=list)  # as written
    joints: list[_UrdfJoint] = field(default_factory=list)  # those that hang on it, once fixed ones are lumped
    fixed_below: int = 0  # of the longest row of fixed joints that was lumped into it
    lumped_into: _UrdfLink | None = None


@dataclass
class _UrdfJoint:
    name: str
    element: ET.Element
    says: parts.JointParts
    parent: _UrdfLink
    child: _UrdfLink
    pose: Pose  # X_PC

    @property
    def type(self) -> str:
        return self.says.type


def urdf_to_model(robot: ET.Element, reader: SdfReader) -> Model:
    """The :class:`Model` of a ``<robot>`` element.

    :param reader: the :class:`~ode_sim.description.sdf.SdfReader` that reads the converted text and takes the warnings.
    :raises DescriptionError: what urdfdom would refuse as well: no tree, a missing name, a limit, a number.
    """
    return _Conversion(robot, reader).model()


def _tree_of(top: _UrdfLink, last_first: bool = False) -> Iterator[_UrdfLink]:
    """``top`` and all that hangs on it, each link before what hangs on it, the joints of one in the order of their names."""
    todo = [top]
    while todo:
        link = todo.pop()
        yield link
        todo += [joint.child for joint in (link.child_joints if last_first else reversed(link.child_joints))]


def _write_pose(parent: ET.Element, pose: Pose) -> None:
    """As a quaternion (the SDF 1.9 form), so that nothing is rounded on the way to the SDF reader."""
    child(parent, "pose", " ".join(repr(v) for v in (*pose.p, *pose.q)), {"rotation_format": "quat_xyzw"})


class _Conversion:
    def __init__(self, robot: ET.Element, reader: SdfReader):
        self.robot = robot
        self.reader = reader
        self.extensions = extensions.Extensions(robot, reader)
        self.links: dict[str, _UrdfLink] = {}
        self.joints: dict[str, _UrdfJoint] = {}

    # ------------------------------------------------------------------ reading

    def model(self) -> Model:
        name = parts.name_of(self.robot)
        parts.check_robot(self.robot)
        root = self._tree()
        self._reduce(root)
        sdf = Element("model", {"name": name})
        sdf.file, sdf.line = getattr(self.robot, "file", ""), getattr(self.robot, "line", 0)
        if root.name == "world":
            for joint in root.child_joints:
                self._convert(sdf, joint.child)
        else:
            self._convert(sdf, root)
        self.extensions.insert_in_model(sdf)
        if self.robot.find("origin") is not None:
            _write_pose(sdf, parts.origin(self.robot))
        if sdf.find("link") is None:
            if root.fault is not None:
                raise DescriptionError(
                    f"{root.fault.message}, so robot '{quoted(name)}' has no link with a mass that could be simulated", root.fault.source
                )
            mass = root.element.find("inertial/mass")
            raise fault(
                root.element,
                f"robot '{quoted(name)}' has no link with a mass that could be simulated; give the "
                "root link "
                + ("an <inertial>" if mass is None else f"a positive mass, not {quoted(mass.get('value'))} kg")
                + ", or join one that has it by a fixed joint",
            )
        model = self.reader.model(sdf)
        return replace(model, joints=tuple(self._with_urdf_facts(joint) for joint in model.joints))

    def _with_urdf_facts(self, joint: Joint) -> Joint:
        urdf = self.joints.get(joint.name)
        if urdf is None:
            return joint
        return replace(joint, urdf_type=urdf.type, mimic=urdf.says.mimic)

    def _tree(self) -> _UrdfLink:
        for element in self.robot.findall("link"):
            name = parts.name_of(element)
            if name in self.links:
                raise fault(element, f"a link named '{quoted(name)}' is there already")
            self.links[name] = self._link(name, element)
        if not self.links:
            raise fault(self.robot, "has no <link>")
        for element in self.robot.findall("joint"):
            joint = self._joint(element)
            self.joints[joint.name] = joint
        for _, joint in sorted(self.joints.items()):
            if joint.child.parent_joint is not None:
                raise fault(
                    joint.element,
                    f"link '{quoted(joint.child.name)}' is the child of joint "
                    f"'{quoted(joint.child.parent_joint.name)}' already; a robot must be a tree",
                )
            joint.child.parent_joint = joint
            joint.parent.child_joints.append(joint)
            joint.parent.joints.append(joint)
        roots = [link for link in self.links.values() if link.parent_joint is None]
        if len(roots) != 1:
            what = (
                "no root link, its joints form a circle"
                if not roots
                else "several root links (" + quoted(", ".join(link.name for link in roots), 200) + "), join them"
            )
            raise fault(self.robot, f"{what}; a robot must be a tree")
        reached = {link.name for link in _tree_of(roots[0])}
        astray = next((link for link in self.links.values() if link.name not in reached), None)
        if astray is not None:
            raise fault(
                astray.element, f"its joints form a circle, apart from the root link '{quoted(roots[0].name)}'; a robot must be a tree"
            )
        return roots[0]

    def _link(self, name: str, element: ET.Element) -> _UrdfLink:
        link = _UrdfLink(name, element)
        inertial = element.find("inertial")
        if inertial is not None:
            self._weigh(link, inertial)
        link.visuals = self._shapes(element.findall("visual"), name)
        link.collisions = self._shapes(element.findall("collision"), name)
        return link

    def _weigh(self, link: _UrdfLink, inertial: ET.Element) -> None:
        faults: list[DescriptionError] = []
        mass, pose, tensor = parts.inertial(inertial, faults.append)
        self._refuse_xacro(faults)
        if mass > 0.0:
            ixx, ixy, ixz, iyy, iyz, izz = tensor
            link.inertial = _Mass(mass, pose.p, math3.rotate_inertia(pose.q, ((ixx, ixy, ixz), (ixy, iyy, iyz), (ixz, iyz, izz))))
            link.raw_inertial = (pose, tensor)
            if faults:
                self._warn_of(faults[0], f"link '{quoted(link.name)}'", "its mass counts without it")
        elif mass < 0.0:
            link.fault = fault(parts.part(inertial, "mass"), f"its mass of {mass:g} kg is negative")
        elif faults:
            link.fault = faults[0]

    def _shapes(self, elements: list[ET.Element], link: str) -> list[_Shape]:
        shapes = []
        for element in elements:
            try:
                form, pose = parts.shape(element)
            except DescriptionError as error:
                self._refuse_xacro([error])
                self._warn_of(error, f"link '{quoted(link)}'", f"the <{element.tag}> is left out")
            else:
                shapes.append(_Shape(element, form, (element.get("name") or "").strip(), pose))
        return shapes

    @staticmethod
    def _refuse_xacro(faults: list[DescriptionError]) -> None:
        for error in faults:
            if parts.is_xacro(error):
                raise error

    def _warn_of(self, error: DescriptionError, where: str, consequence: str) -> None:
        self.reader.warn(error.source, f"{where}: {error.message}; {consequence}")

    def _joint(self, element: ET.Element) -> _UrdfJoint:
        name = parts.name_of(element)
        says = parts.joint(element, name, self.reader.warn)
        if name in self.joints:
            raise fault(element, f"a joint named '{quoted(name)}' is there already")
        ends = []
        for tag in ("parent", "child"):
            end = element.find(tag)
            if end is None:
                raise fault(element, f"<{tag} link='...'/> is missing")
            link = parts.name_of(end, "link")
            if link not in self.links:
                raise fault(element, f"{tag} link '{quoted(link)}' is not in the robot")
            ends.append(self.links[link])
        return _UrdfJoint(name, element, says, ends[0], ends[1], says.pose)

    # ------------------------------------------------------------------ lumping

    def _lumps(self, joint: _UrdfJoint) -> bool:
        return joint.type == "fixed" and joint.parent.name != "world" and not self.extensions.keeps_fixed_joint(joint.name)

    def _reduce(self, root: _UrdfLink) -> None:
        """Lump what hangs on fixed joints into its parent, from the ends of the tree to its root."""
        for link in reversed(list(_tree_of(root, last_first=True))):
            joint = link.parent_joint
            if joint is None or not self._lumps(joint):
                continue
            # of a link of the same name it is a sensor, whatever becomes of the joint
            for sensor in () if joint.name in self.links else self.extensions.sensors_of(joint.name):
                self.reader.warn(
                    sensor,
                    f"sensor '{quoted(sensor.get('name'))}' is left out: its joint '{quoted(joint.name)}' is fixed, "
                    "and Gazebo makes one link of such a joint's two; to keep the joint, write <gazebo reference="
                    f'"{quoted(joint.name)}"><preserveFixedJoint>true</preserveFixedJoint></gazebo>',
                )
            self._lump(link, joint.parent, joint.pose)
            joint.parent.fixed_below = max(joint.parent.fixed_below, link.fixed_below + 1)
            if link.fixed_below > _MOST_FIXED:
                raise fault(joint.element, f"more than {_MOST_FIXED} fixed joints hang one behind the other")

    def _lump(self, link: _UrdfLink, parent: _UrdfLink, x_pl: Pose) -> None:
        link.lumped_into = parent
        if link.fault is not None:
            self._warn_of(link.fault, f"link '{quoted(link.name)}'", "it counts as massless")
        self.extensions.move(link.name, parent.name, x_pl)
        if link.inertial is not None:
            parent.inertial = _combined(parent.inertial, link.inertial, x_pl)
            parent.raw_inertial = None
        for mine, theirs in ((link.visuals, parent.visuals), (link.collisions, parent.collisions)):
            for shape in mine:
                theirs.append(_Shape(shape.element, shape.form, shape.name or link.name, math3.compose(x_pl, shape.pose)))
        for joint in link.joints:  # its own, and those of what was lumped into it before
            if joint.child.lumped_into is None:
                joint.parent, joint.pose = parent, math3.compose(x_pl, joint.pose)
                parent.joints.append(joint)

    # ------------------------------------------------------------------ writing

    def _convert(self, sdf: Element, top: _UrdfLink) -> None:
        """Append ``top`` and what hangs on it to the model."""
        todo = [(top, math3.IDENTITY)]  # links with the pose X_MP of the link that their joint hangs on
        while todo:
            link, x_mp = todo.pop()
            joint = link.parent_joint
            x_ml = x_mp
            if link.lumped_into is None:  # else its joints hang on the link that took it in, whose pose x_mp is
                if joint is not None:
                    x_ml = math3.compose(x_mp, joint.pose)
                if link.inertial is None:
                    self._drop(link)
                    continue
                if joint is not None:
                    self._write_joint(sdf, joint)
                self._write_link(sdf, link, x_ml)
            todo += [(child_joint.child, x_ml) for child_joint in reversed(link.child_joints)]

    def _drop(self, link: _UrdfLink) -> None:
        others = [other.name for other in _tree_of(link)][1:]
        joint = link.parent_joint
        why = f" ({link.fault.message})" if link.fault is not None else ""
        self.reader.warn(
            link.element if link.fault is None else link.fault.source,
            f"link '{quoted(link.name)}' has no mass{why}, so it is left out"
            + (f" and with it {quoted(', '.join(others), 500)}" if others else "")
            + (f" (joint '{quoted(joint.name)}' too)" if joint is not None else "")
            + f"; to keep {'them' if others else 'it'}, give '{quoted(link.name)}' an <inertial> with a mass"
            + ("" if joint is None else " or make the joint fixed"),
        )

    def _write_link(self, sdf: Element, link: _UrdfLink, x_ml: Pose) -> None:
        element = child(sdf, "link", attrib={"name": link.name}, like=link.element)
        _write_pose(element, x_ml)
        inertial = child(element, "inertial")
        assert link.inertial is not None  # else it was dropped
        if link.fault is not None:  # what it weighs was lumped into it
            self._warn_of(link.fault, f"link '{quoted(link.name)}'", "it counts as massless")
        if link.raw_inertial is not None:
            pose, tensor = link.raw_inertial
            values = {key: repr(value) for key, value in zip(parts.TENSOR, tensor)}
        else:
            pose, (a, b, c) = Pose(link.inertial.com), link.inertial.inertia
            values = {"ixx": repr(a[0]), "ixy": repr(a[1]), "ixz": repr(a[2]), "iyy": repr(b[1]), "iyz": repr(b[2]), "izz": repr(c[2])}
        _write_pose(inertial, pose)
        child(inertial, "mass", repr(link.inertial.mass))
        inertia = child(inertial, "inertia")
        for key, value in values.items():
            child(inertia, key, value)
        for kind, shapes in (("collision", link.collisions), ("visual", link.visuals)):
            for i, shape in enumerate(shapes):
                name = f"{shape.name or link.name}_{kind}" + (f"_{i}" if i else "")
                if not name.startswith(link.name):
                    name = link.name + _LUMP + name
                self._write_shape(element, link, shape, kind, name)
        self.extensions.insert_in_link(element, link.name)

    def _write_shape(self, parent: Element, link: _UrdfLink, shape: _Shape, kind: str, name: str) -> None:
        element = child(parent, kind, attrib={"name": name}, like=shape.element)
        _write_pose(element, shape.pose)
        geometry = child(element, "geometry")
        given = shape.form
        form = child(geometry, given.tag, like=given)
        if given.tag == "box":
            child(form, "size", " ".join(repr(v) for v in parts.floats(given, "size", (0.0, 0.0, 0.0))))
        elif given.tag in ("cylinder", "capsule"):
            child(form, "radius", repr(parts.number(given, "radius")))
            child(form, "length", repr(parts.number(given, "length")))
        elif given.tag == "sphere":
            child(form, "radius", repr(parts.number(given, "radius")))
        elif given.tag == "mesh":
            child(form, "uri", (given.get("filename") or "").strip())
            child(form, "scale", " ".join(repr(v) for v in parts.mesh_scale(given)))
        if kind == "collision":
            self.extensions.insert_in_collision(element, link.name)
        else:
            self.extensions.insert_in_visual(element, link.name)

    def _write_joint(self, sdf: Element, joint: _UrdfJoint) -> None:
        if joint.type in ("floating", "planar"):
            return
        kind = "revolute" if joint.type == "continuous" else joint.type
        as_revolute = kind == "fixed" and self.extensions.fixed_as_revolute(joint.name)
        element = child(sdf, "joint", attrib={"name": joint.name, "type": "revolute" if as_revolute else kind}, like=joint.element)
        child(element, "parent", joint.parent.name)
        child(element, "child", joint.child.name)
        if kind != "fixed" or as_revolute:
            self._write_axis(child(element, "axis"), joint, as_revolute)
        self.extensions.insert_in_joint(element, joint.name, joint.name in self.links)

    def _write_axis(self, axis: Element, joint: _UrdfJoint, as_revolute: bool) -> None:
        limit = child(axis, "limit")
        dynamics = child(axis, "dynamics")
        if as_revolute:
            child(axis, "xyz", "0 0 1")
            child(limit, "lower", "0")
            child(limit, "upper", "0")
            return
        child(axis, "xyz", " ".join(repr(v) for v in joint.says.axis))
        for key, value in zip(("damping", "friction"), joint.says.losses or ()):
            child(dynamics, key, repr(value))
        limits = joint.says.limit
        if limits is None:
            return
        if joint.type != "continuous":
            lower, upper = limits.lower, limits.upper
            if lower > upper:
                self.reader.warn(
                    joint.element.find("limit"),
                    f"joint '{quoted(joint.name)}': lower limit {lower:g} is above upper limit {upper:g}; switching the two",
                )
                lower, upper = upper, lower
            child(limit, "lower", repr(lower))
            child(limit, "upper", repr(upper))
        child(limit, "effort", repr(limits.effort))
        child(limit, "velocity", repr(limits.velocity))


def _combined(parent: _Mass | None, lumped: _Mass, x_pl: Pose) -> _Mass:
    """Both bodies as one, in the frame of the parent."""
    moved = _Mass(lumped.mass, math3.transform(x_pl, lumped.com), math3.rotate_inertia(x_pl.q, lumped.inertia))
    if parent is None:
        return moved
    mass = parent.mass + moved.mass
    com = math3.scale(math3.add(math3.scale(parent.com, parent.mass), math3.scale(moved.com, moved.mass)), 1.0 / mass)
    rows = [[0.0] * 3 for _ in range(3)]
    for body in (parent, moved):
        d = math3.sub(body.com, com)
        square = math3.dot(d, d)
        for i in range(3):
            for j in range(3):
                rows[i][j] += body.inertia[i][j] + body.mass * ((square if i == j else 0.0) - d[i] * d[j])
    return _Mass(mass, com, math3.mat3(rows))

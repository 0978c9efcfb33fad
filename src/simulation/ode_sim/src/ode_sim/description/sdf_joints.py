"""Joints of SDF models."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from typing import TypeVar

from ode_sim import math3
from ode_sim.description.model import FORCE_TORQUE, Axis, Collision, Joint, Light, Link, Plugin, Pose, Sensor, Vec3, Visual, quoted
from ode_sim.description.sdf_frames import relative_to
from ode_sim.description.sdf_shapes import SdfShapes
from ode_sim.description.sdf_values import LONGEST
from ode_sim.description.xmlsource import is_true, joint_end, source_of, text_of

Named = TypeVar("Named", Collision, Light, Sensor, Visual)

_JOINT_AXES = {"revolute": 1, "prismatic": 1, "fixed": 0, "ball": 0, "universal": 2, "revolute2": 2, "screw": 1, "gearbox": 2, "piston": 1}
_NOT_SIMULATED = ("piston",)  # the builder says so
_OLD_JOINT_TYPES = {"hinge": "revolute", "slider": "prismatic", "hinge2": "revolute2", "continuous": "revolute"}


@dataclass
class Parts:
    """A model while it is read: everything in its own frame M, nested models already merged in as ``sub::x``."""

    name: str
    element: ET.Element
    pose: Pose  # of M in whatever it is part of
    links: list[Link] = field(default_factory=list)
    joints: list[Joint] = field(default_factory=list)
    plugins: list[Plugin] = field(default_factory=list)
    frames: dict[str, Pose] = field(default_factory=dict)  # X_M of links, joints, frames, for relative_to
    still: set[str] = field(default_factory=set)  # links of nested models that are static
    attached_to: dict[str, str] = field(init=False)  # of each <frame>, by name

    def __post_init__(self) -> None:
        self.attached_to = {frame.get("name") or "": (frame.get("attached_to") or "").strip() for frame in self.element.findall("frame")}


def _turn_round(sensor: ET.Element) -> None:
    """A force-torque sensor of a joint whose parent and child are exchanged goes on to measure the same."""
    block = sensor.find(FORCE_TORQUE)
    if block is None:
        block = ET.SubElement(sensor, FORCE_TORQUE)
    for tag, usual, other in (("frame", "child", "parent"), ("measure_direction", "child_to_parent", "parent_to_child")):
        element = block.find(tag)
        if element is None:
            element = ET.SubElement(block, tag)
        said = text_of(element, usual)
        element.text = {usual: other, other: usual}.get(said, said)


class SdfJoints(SdfShapes):
    """Reads ``<joint>``. What it shares with links is the model's reader's."""

    def _pose_in(self, owner: ET.Element, x_mo: Pose, child: ET.Element, frames: dict[str, Pose]) -> Pose:
        raise NotImplementedError

    def _unique(self, parent: ET.Element, tag: str, read: Callable[[ET.Element], Named]) -> Iterator[Named]:
        raise NotImplementedError

    def _sensor(self, element: ET.Element, pose: Pose, of_joint: bool) -> Sensor:
        raise NotImplementedError

    def joint(self, element: ET.Element, parts: Parts, known: set[str]) -> list[Joint]:
        """The joints of a ``<joint>`` ``element``: one, none if it is at fault (a warning says why).

        :param parts: the model as far as it is read, with its frames. :param known: names of its links.
        """
        name = element.get("name") or ""
        kind = (element.get("type") or "").strip()
        endless = kind == "continuous"
        kind = _OLD_JOINT_TYPES.get(kind, kind)
        if kind not in _JOINT_AXES:
            simulated = [known for known in _JOINT_AXES if known not in _NOT_SIMULATED]
            self.warn(
                element,
                f"unknown joint type '{quoted(kind)}'; use one of continuous, {', '.join(simulated)}; the joint is left out",
                "error",
            )
            return []
        parent, child = (self._link_of(joint_end(element, tag), parts, known) for tag in ("parent", "child"))
        for role, link in (("parent", parent), ("child", child)):
            if link not in known and link != "world":
                self.warn(element, f"{role} link '{quoted(link)}' is not in model '{quoted(parts.name)}'; the joint is left out", "error")
                return []
        if parent == child:
            self.warn(element, f"cannot join '{quoted(parent)}' to '{quoted(child)}'; the joint is left out", "error")
            return []
        x_mj = self._joint_pose(element.find("pose"), child, parts)
        axes = tuple(self._axes(element, kind, parts.frames, x_mj))
        if endless:
            axes = tuple(replace(axis, lower=-1e16, upper=1e16) for axis in axes)
        if child == "world":  # told the other way round: the link moves, its axes are the opposite ones in the opposite order
            parent, child = child, parent
            for sensor in element.findall("sensor"):
                _turn_round(sensor)
            axes = tuple(replace(axis, xyz=math3.scale(axis.xyz, -1.0)) for axis in reversed(axes))
        sensors = tuple(
            self._unique(element, "sensor", lambda e: self._sensor(e, self._pose_in(element, x_mj, e, parts.frames), of_joint=True))
        )
        return [
            Joint(
                name=name,
                type=kind,
                parent=parent,
                child=child,
                pose=math3.relative(parts.frames[child], x_mj),
                axes=axes,
                limit_erp=self.number(element, "physics/ode/limit/erp", 0.2),
                limit_cfm=self.number(element, "physics/ode/limit/cfm", 0.0),
                provide_feedback=bool(sensors)
                or self.boolean(element, "physics/provide_feedback", self.boolean(element, "physics/ode/provide_feedback", False)),
                implicit_spring_damper=self.boolean(
                    element, "physics/ode/implicit_spring_damper", self.boolean(element, "physics/ode/cfm_damping", False)
                ),
                fudge_factor=self.number(element, "physics/ode/fudge_factor", 1.0),
                thread_pitch=self._thread_pitch(element, kind),
                gearbox_ratio=self.number(element, "gearbox_ratio", 1.0),
                gearbox_reference_body=self._link_of(text_of(element.find("gearbox_reference_body")), parts, known),
                sensors=sensors,
                source=source_of(element),
            )
        ]

    def _thread_pitch(self, element: ET.Element, kind: str) -> float:
        """rad/m, as ``<thread_pitch>`` has it; ``<screw_thread_pitch>`` of SDF 1.10 is in metres a turn, positive of a right-handed
        thread."""
        pitch, lead = (element.find(tag) for tag in ("thread_pitch", "screw_thread_pitch"))
        if kind != "screw":
            return 1.0
        if pitch is None and lead is not None:
            metres = self.number(element, "screw_thread_pitch", 0.0)
            if metres != 0.0:
                return -2.0 * math.pi / metres
        elif pitch is not None:
            radians = self.number(element, "thread_pitch", 1.0)
            if radians != 0.0:
                return radians
        else:
            self.warn(element, "a screw needs a <thread_pitch>, rad/m; using 1")
            return 1.0
        self.warn(lead if pitch is None else pitch, "a thread's pitch cannot be 0; using 1 rad/m")
        return 1.0

    def _joint_pose(self, pose: ET.Element | None, child: str, parts: Parts) -> Pose:
        """X_MJ; without a frame of its own in that of the child, and in the world's where the world is the child."""
        reference = relative_to(pose) or child
        if reference == "world":
            return math3.compose(math3.relative(parts.pose, math3.IDENTITY), self.pose(pose))
        if reference not in parts.frames:
            self.warn(pose, f"there is no frame '{quoted(reference)}'; using that of the child link")
            reference = child
            if child == "world":
                return self._joint_pose(None, child, parts)
        return math3.compose(parts.frames[reference], self.pose(pose))

    @staticmethod
    def _link_of(name: str, parts: Parts, known: set[str]) -> str:
        """The link that a joint names, or that the frame it names is attached to; ``name`` where there is none."""
        link = name
        for _ in parts.attached_to:
            if link in known or link not in parts.attached_to:
                break
            link = parts.attached_to[link]
        return link if link in known else name

    def _axes(self, element: ET.Element, kind: str, frames: dict[str, Pose], x_mj: Pose) -> Iterator[Axis]:
        tags = ("axis", "axis2")[: _JOINT_AXES[kind]]
        if kind == "revolute2" and element.find("axis2") is None:
            self.warn(element, "a revolute2 joint needs an <axis2>; using the z axis")
        if kind == "gearbox" and element.find("axis2") is None:
            self.warn(element, "a gearbox needs an <axis2>, that of its parent; using that of its child")
            tags = ("axis", "axis")
        for tag in tags:
            axis = element.find(tag)
            if axis is None:
                yield Axis()
                continue
            xyz_element = axis.find("xyz")
            xyz = self.numbers(xyz_element, (0.0, 0.0, 1.0), most=LONGEST)
            if math3.norm(xyz) == 0.0:
                self.warn(axis, "the axis has no length; using 0 0 1")
                xyz = (0.0, 0.0, 1.0)
            expressed_in = (xyz_element.get("expressed_in") or "").strip() if xyz_element is not None else ""
            if not expressed_in:
                self._warn_of_old_frame(axis, xyz, x_mj)
            if expressed_in in frames:
                in_model = math3.rotate(frames[expressed_in], xyz)
                xyz = math3.quat_rotate(math3.quat_inverse(x_mj.q), in_model)
            elif expressed_in:
                self.warn(axis, f"there is no frame '{quoted(expressed_in)}'; using that of the joint")
            lower, upper = self.number(axis, "limit/lower", -1e16), self.number(axis, "limit/upper", 1e16)
            if lower > upper:
                self.warn(axis, f"lower limit {lower:g} is above upper limit {upper:g}; switching the two")
                lower, upper = upper, lower
            yield Axis(
                xyz=math3.unit(xyz),
                lower=max(lower, -1e16),
                upper=min(upper, 1e16),
                effort=self.number(axis, "limit/effort", -1.0),
                velocity=self.number(axis, "limit/velocity", -1.0),
                damping=self.number(axis, "dynamics/damping", 0.0),
                friction=self.number(axis, "dynamics/friction", 0.0),
                spring_reference=self.number(axis, "dynamics/spring_reference", 0.0),
                spring_stiffness=self.number(axis, "dynamics/spring_stiffness", 0.0),
            )

    def _warn_of_old_frame(self, axis: ET.Element, xyz: Vec3, x_mj: Pose) -> None:
        """What SDF 1.7 and URDF do not have any more, where it would make a difference; ``sdf_root`` has read that of older files."""
        flag = axis.find("use_parent_model_frame")
        if is_true(text_of(flag)) and math.dist(math3.quat_rotate(x_mj.q, xyz), xyz) > 1e-6 * math3.norm(xyz):
            self.warn(
                flag,
                "has no effect in a URDF, nor in SDF from 1.7 on: the axis is in the joint's frame, as in Noetic; "
                "write <xyz expressed_in='__model__'> for the model's",
            )

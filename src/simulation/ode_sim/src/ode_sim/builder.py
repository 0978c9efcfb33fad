"""Puts a described model into the physics core."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from ode_sim import collision_meshes
from ode_sim.core_numbers import flat, unlimited
from ode_sim.description import model as d
from ode_sim.handles import CollisionHandle, JointHandle, LinkHandle, ModelHandle
from ode_sim.inertia import usable_inertia, usable_mass
from ode_sim.math3 import compose, cross, dot, norm, unit
from ode_sim.physics import BOUNDS

if TYPE_CHECKING:
    from ode_sim import _core
    from ode_sim.world import World

JOINT_TYPES = {
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "prismatic",
    "fixed": "fixed",
    "ball": "ball",
    "universal": "universal",
    "revolute2": "universal",
    "screw": "screw",
    "gearbox": "gearbox",
}
SURFACE = (
    "mu",
    "mu2",
    "fdir1",
    "slip1",
    "slip2",
    "kp",
    "kd",
    "max_vel",
    "min_depth",
    "restitution",
    "bounce_threshold",
    "torsional_mu",
    "torsional_slip",
    "patch_radius",
    "surface_radius",
    "use_patch_radius",
    "collide_without_contact",
)
AXIS = ("lower", "upper", "effort", "velocity", "damping", "friction", "spring_reference", "spring_stiffness")


class Builder:
    """Builds one model; ``problems`` collects what had to be changed or left out."""

    def __init__(self, core: _core.World) -> None:
        self.core = core
        self.problems: list[d.Problem] = []

    def build(self, world: World, model: d.Model, name: str, pose: d.Pose) -> ModelHandle:
        """The handle of ``model`` in ``world``, called ``name`` and put at X_WM ``pose``.

        :raises ValueError: a number that no world can hold; nothing of the model is left in the core then.
        """
        sensors = any(link.sensors for link in model.links)
        may_sleep = model.allow_auto_disable and not model.joints and not sensors and not model.static
        core = self.core.add_model(name, model.static, model.self_collide, may_sleep)
        try:
            handle = ModelHandle(world, name, model, pose, core)
            for link in model.links:
                self._link(handle, link, compose(pose, link.pose))
            for joint in model.joints:
                self._joint(handle, joint)
            handle.bind()
            core.finish()
        except BaseException:
            self.core.remove_model(core)
            raise
        return handle

    def _problem(self, severity: str, message: str, source: d.Source) -> None:
        self.problems.append(d.Problem(severity, message, source))

    def _number(self, value: Any, default: float, what: str, source: d.Source, least: float = -math.inf) -> float:
        """``value``, at least ``least``; the default, with a problem, where it is a NaN."""
        if not math.isnan(value):
            return max(float(value), least)
        self._problem("warning", f"{what} is no number; {default:g} is used", source)
        return default

    # ------------------------------------------------------------------------------------------ links

    def _link(self, model: ModelHandle, link: d.Link, pose: d.Pose) -> None:
        where = f"link '{link.name}' of model '{model.name}'"
        mass, problem = usable_mass(link.inertial.mass, where)
        tensor, second = usable_inertia(link.inertial, mass, where)
        for text in (problem, second):
            if text and not model.static:
                self._problem("warning", text, link.source)
        try:
            com = flat(link.inertial.pose, "centre of mass")[:3]
        except ValueError as error:
            com = (0.0, 0.0, 0.0)
            self._problem("warning", f"{where}: {error}; the link's origin is used", link.source)
        core = model.core.add_link(flat(pose, f"pose of {where}"), mass, com, tensor)
        core.gravity_flag = link.gravity
        core.kinematic = link.kinematic
        core.self_collide = model.description.self_collide if link.self_collide is None else link.self_collide
        core.linear_decay = self._number(link.linear_decay, 0.0, f"{where}: linear velocity decay", link.source)
        core.angular_decay = self._number(link.angular_decay, 0.0, f"{where}: angular velocity decay", link.source)
        handle = LinkHandle(model, link, core)
        model.links[link.name] = handle
        for collision in link.collisions:
            shape = self._shape(model, handle, collision)
            if shape is not None:
                handle.collisions[collision.name] = shape

    def _shape(self, model: ModelHandle, link: LinkHandle, collision: d.Collision) -> CollisionHandle | None:
        where = f"collision '{collision.name}' of link '{link.scoped_name}'"
        try:
            core = self._geometry(model.core, link.core, collision)
        except (ValueError, RuntimeError) as error:
            self._problem("warning", f"{where} is left out: {error}", collision.source)
            return None
        if core is None:
            return None
        core.max_contacts = self._max_contacts(collision, where)
        written, surface = collision.surface, core.surface
        for field in SURFACE:
            try:
                setattr(surface, field, getattr(written, field))
            except (ValueError, TypeError):
                self._problem("warning", f"{where}: {field} is no number; {getattr(surface, field)} is used", collision.source)
        surface.collide_bitmask = int(written.collide_bitmask) & 0xFFFFFFFF
        return CollisionHandle(link, collision, core)

    def _max_contacts(self, collision: d.Collision, where: str) -> int:
        written, most = collision.max_contacts, int(BOUNDS["max_contacts"].most)
        if not math.isnan(written) and 0 <= written <= most:
            return int(written)
        used = most if written > most else d.Collision.max_contacts
        self._problem("warning", f"{where}: max_contacts {written:g} must be 0 to {most}; {used} is used", collision.source)
        return used

    def _geometry(self, model: _core.Model, link: _core.Link, collision: d.Collision) -> _core.Shape | None:
        shape = collision.geometry
        if shape is None:
            return None
        pose = flat(collision.pose, "its pose")
        if isinstance(shape, d.Box):
            self._sizes(shape.size, "box size")
            return model.add_box(link, pose, shape.size)
        if isinstance(shape, d.Sphere):
            self._sizes((shape.radius,), "sphere radius")
            return model.add_sphere(link, pose, shape.radius)
        if isinstance(shape, (d.Cylinder, d.Capsule)):
            self._sizes((shape.radius, shape.length), "radius and length")
            add = model.add_cylinder if isinstance(shape, d.Cylinder) else model.add_capsule
            return add(link, pose, shape.radius, shape.length)
        if isinstance(shape, d.Plane):
            normal = unit(shape.normal)
            if not 0.0 < norm(normal) < math.inf:
                raise d.DescriptionError("the normal of a plane must have a direction")
            return model.add_plane(link, pose, normal)
        if isinstance(shape, d.Mesh):
            if not shape.path:
                return None  # the reader of the description has said so
            return model.add_mesh(link, pose, collision_meshes.ready(shape))
        if isinstance(shape, d.Heightmap):
            pose = flat(compose(collision.pose, d.Pose(shape.pos)), "its pose")
            return model.add_heightmap(link, pose, collision_meshes.ready(shape), shape.size[0], shape.size[1])
        if isinstance(shape, d.Polyline):
            return model.add_mesh(link, pose, collision_meshes.ready(shape))
        raise d.DescriptionError(f"shape {type(shape).__name__} cannot collide")

    @staticmethod
    def _sizes(values: tuple[float, ...], what: str) -> None:
        if not all(0.0 < v <= d.FARTHEST for v in values):
            raise d.DescriptionError(f"{what} must be positive and at most {d.FARTHEST:g} m, not {' '.join(f'{v:g}' for v in values)}")

    # ------------------------------------------------------------------------------------------ joints

    def _joint(self, model: ModelHandle, joint: d.Joint) -> None:
        where = f"joint '{joint.name}' of model '{model.name}'"
        kind = JOINT_TYPES.get(joint.type)
        child, parent = model.links.get(joint.child), model.links.get(joint.parent)
        reason = ""
        if kind is None:
            reason = f"type '{joint.type}' is not simulated (there are {', '.join(JOINT_TYPES)})"
        elif child is None:
            reason = f"there is no child link '{joint.child}'"
        elif parent is None and joint.parent != "world":
            reason = f"there is no parent link '{joint.parent}'"
        elif parent is child:
            reason = "parent and child are the same link"
        elif kind == "universal" and len(joint.axes) < 2:
            reason = "it needs two axes"
        if kind is None or child is None or reason:
            self._problem("error", f"{where} is left out, its links are not joined: {reason}", joint.source)
            return
        axes = self._axes(joint, kind, where)
        core = model.core.add_joint(kind, parent.core if parent else None, child.core, flat(joint.pose, f"pose of {where}"))
        core.stop_erp = self._number(joint.limit_erp, d.Joint.limit_erp, f"{where}: limit erp", joint.source)
        core.stop_cfm = self._number(joint.limit_cfm, d.Joint.limit_cfm, f"{where}: limit cfm", joint.source)
        core.implicit_spring_damper = joint.implicit_spring_damper
        if kind == "screw":
            core.thread_pitch = self._pitch(joint, where)
        if kind == "gearbox":
            self._gear(model, joint, core, where)
        for i, axis in enumerate(axes):
            axis = self._numbers_of(axis, where, joint)
            lower, upper = unlimited(axis.lower), unlimited(axis.upper)
            if lower == math.inf or upper == -math.inf:
                self._problem(
                    "warning", f"{where}: no position is between the limits {axis.lower:g} and {axis.upper:g}; it has none", joint.source
                )
                lower, upper = -math.inf, math.inf
            if lower > upper:
                self._problem("warning", f"{where}: lower limit {lower:g} is above upper limit {upper:g}; they are swapped", joint.source)
                lower, upper = upper, lower
            core.set_axis(
                i,
                axis.xyz,
                lower,
                upper,
                axis.effort,
                axis.velocity,
                axis.damping,
                axis.friction,
                axis.spring_reference,
                axis.spring_stiffness,
            )
        if joint.provide_feedback:
            core.watch()
        written = joint if tuple(axes) == joint.axes else replace(joint, axes=tuple(axes))
        model.joints[joint.name] = JointHandle(model, written, parent, child, core)

    def _pitch(self, joint: d.Joint, where: str) -> float:
        """rad/m"""
        if 1e-6 <= abs(joint.thread_pitch) <= 1e6:
            return joint.thread_pitch
        self._problem("warning", f"{where}: thread_pitch is {joint.thread_pitch:g} rad/m; 1 is used", joint.source)
        return 1.0

    def _gear(self, model: ModelHandle, joint: d.Joint, core: _core.Joint, where: str) -> None:
        reference = model.links.get(joint.gearbox_reference_body)
        if reference is None:
            self._problem(
                "warning",
                f"{where}: its gearbox_reference_body '{joint.gearbox_reference_body}' is no link of the model; "
                "angles are seen from the world",
                joint.source,
            )
        core.see_from(reference.core if reference else None)
        ratio = self._number(joint.gearbox_ratio, 1.0, f"{where}: gearbox_ratio", joint.source)
        if abs(ratio) > 1e6:
            self._problem("warning", f"{where}: gearbox_ratio is {ratio:g}; 1 is used", joint.source)
            ratio = 1.0
        core.gear_ratio = ratio

    def _numbers_of(self, axis: d.Axis, where: str, joint: d.Joint) -> d.Axis:
        """The axis without a NaN."""
        wrong = [name for name in AXIS if math.isnan(getattr(axis, name))]
        for name in wrong:
            self._problem("warning", f"{where}: {name} is no number; it is left out", joint.source)
        return replace(axis, **{name: getattr(d.Axis, name) for name in wrong}) if wrong else axis

    def _axes(self, joint: d.Joint, kind: str, where: str) -> list[d.Axis]:
        count = {"revolute": 1, "prismatic": 1, "universal": 2, "screw": 1, "gearbox": 2}.get(kind, 0)
        axes = [self._unit_axis(axis, where, joint) for axis in (joint.axes + (d.Axis(),) * count)[:count]]
        if kind == "screw":  # the second one is the way along the first
            axes.append(d.Axis(axes[0].xyz))
        if kind == "universal" and abs(dot(axes[0].xyz, axes[1].xyz)) > 1e-6:
            first, second = axes[0].xyz, axes[1].xyz
            square = unit(cross(cross(first, second), first))
            if norm(square) == 0.0:
                square = cross(first, (1.0, 0.0, 0.0) if abs(first[0]) < 0.9 else (0.0, 1.0, 0.0))
            self._problem("warning", f"{where}: its two axes are not at right angles; the second is turned to be so", joint.source)
            axes[1] = replace(axes[1], xyz=unit(square))
        return axes

    def _unit_axis(self, axis: d.Axis, where: str, joint: d.Joint) -> d.Axis:
        if not 0.0 < norm(axis.xyz) < math.inf:
            self._problem("warning", f"{where}: axis {' '.join(f'{v:g}' for v in axis.xyz)} has no direction; 0 0 1 is used", joint.source)
            return replace(axis, xyz=(0.0, 0.0, 1.0))
        return replace(axis, xyz=unit(axis.xyz))

"""Puts a described model into the physics core."""
from __future__ import annotations

from dataclasses import replace
from typing import List, Optional, Tuple

from ode_sim import collision_meshes
from ode_sim.description import model as d
from ode_sim.handles import CollisionHandle, JointHandle, LinkHandle, ModelHandle, flat, unlimited
from ode_sim.inertia import usable_inertia, usable_mass
from ode_sim.math3 import compose, cross, dot, norm, unit

JOINT_TYPES = {"revolute": "revolute", "continuous": "revolute", "prismatic": "prismatic", "fixed": "fixed", "ball": "ball",
               "universal": "universal", "revolute2": "universal"}


class Builder:
    """Builds one model; ``problems`` collects what had to be changed or left out."""

    def __init__(self, core) -> None:
        self.core = core
        self.problems: List[d.Problem] = []

    def build(self, world, model: d.Model, name: str, pose: d.Pose) -> ModelHandle:
        """The handle of the model put at X_WM ``pose``."""
        sensors = any(link.sensors for link in model.links)
        may_sleep = model.allow_auto_disable and not model.joints and not sensors and not model.static
        core = self.core.add_model(name, model.static, model.self_collide, may_sleep)
        handle = ModelHandle(world, name, model, pose, core)
        for link in model.links:
            self._link(handle, link, compose(pose, link.pose))
        for joint in model.joints:
            self._joint(handle, joint)
        handle.bind()
        core.finish()
        return handle

    def _problem(self, severity: str, message: str, source: d.Source) -> None:
        self.problems.append(d.Problem(severity, message, source))

    # ------------------------------------------------------------------------------------------ links

    def _link(self, model: ModelHandle, link: d.Link, pose: d.Pose) -> None:
        where = f"link '{link.name}' of model '{model.name}'"
        mass, problem = usable_mass(link.inertial.mass, where)
        tensor, second = usable_inertia(link.inertial, mass, where)
        for text in (problem, second):
            if text and not model.static:
                self._problem("warning", text, link.source)
        core = model.core.add_link(flat(pose, f"pose of {where}"), mass, link.inertial.pose.p, tensor)
        core.gravity_flag = link.gravity
        core.kinematic = link.kinematic
        core.self_collide = model.description.self_collide if link.self_collide is None else link.self_collide
        core.linear_decay = max(link.linear_decay, 0.0)
        core.angular_decay = max(link.angular_decay, 0.0)
        handle = LinkHandle(model, link, core)
        model.links[link.name] = handle
        for collision in link.collisions:
            shape = self._shape(model, handle, collision)
            if shape is not None:
                handle.collisions[collision.name] = shape

    def _shape(self, model: ModelHandle, link: LinkHandle, collision: d.Collision) -> Optional[CollisionHandle]:
        where = f"collision '{collision.name}' of link '{link.scoped_name}'"
        try:
            core = self._geometry(model.core, link.core, collision)
        except d.DescriptionError as error:
            self._problem("warning", f"{where} is left out: {error}", collision.source)
            return None
        if core is None:
            return None
        core.max_contacts = collision.max_contacts
        written, surface = collision.surface, core.surface
        for field in ("mu", "mu2", "fdir1", "slip1", "slip2", "kp", "kd", "max_vel", "min_depth", "bounce_threshold",
                      "collide_without_contact"):
            setattr(surface, field, getattr(written, field))
        surface.restitution = written.restitution
        surface.collide_bitmask = int(written.collide_bitmask) & 0xFFFFFFFF
        return CollisionHandle(link, collision, core)

    def _geometry(self, model, link, collision: d.Collision):
        shape, pose = collision.geometry, flat(collision.pose)
        if shape is None:
            return None
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
            if norm(normal) == 0.0:
                raise d.DescriptionError("the normal of a plane must not be zero")
            return model.add_plane(link, pose, normal)
        if isinstance(shape, d.Mesh):
            if not shape.path:
                return None  # the reader of the description has said so
            return model.add_mesh(link, pose, collision_meshes.load(shape))
        if isinstance(shape, d.Heightmap):
            from ode_sim.heightmap import load_heights
            heights = load_heights(shape)
            pose = flat(compose(collision.pose, d.Pose(shape.pos)))
            return model.add_heightmap(link, pose, heights, shape.size[0], shape.size[1])
        if isinstance(shape, d.Polyline):
            from ode_sim.polyline import extrude
            return model.add_mesh(link, pose, collision_meshes.mesh_data(*extrude(shape)))
        raise d.DescriptionError(f"shape {type(shape).__name__} cannot collide")

    @staticmethod
    def _sizes(values: Tuple[float, ...], what: str) -> None:
        if not all(0.0 < v < 1e9 for v in values):
            raise d.DescriptionError(f"{what} must be positive and below 1e9 m, not {' '.join(f'{v:g}' for v in values)}")

    # ------------------------------------------------------------------------------------------ joints

    def _joint(self, model: ModelHandle, joint: d.Joint) -> None:
        where = f"joint '{joint.name}' of model '{model.name}'"
        kind = JOINT_TYPES.get(joint.type)
        child, parent = model.links.get(joint.child), model.links.get(joint.parent)
        reason = None
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
        if reason:
            self._problem("error", f"{where} is left out, its links are not joined: {reason}", joint.source)
            return
        axes = self._axes(joint, kind, where)
        core = model.core.add_joint(kind, parent.core if parent else None, child.core, flat(joint.pose, f"pose of {where}"))
        core.stop_erp = joint.limit_erp
        core.stop_cfm = joint.limit_cfm
        core.implicit_spring_damper = joint.implicit_spring_damper
        for i, axis in enumerate(axes):
            lower, upper = unlimited(axis.lower), unlimited(axis.upper)
            if lower > upper:
                self._problem("warning", f"{where}: lower limit {lower:g} is above upper limit {upper:g}; they are swapped", joint.source)
                lower, upper = upper, lower
            core.set_axis(i, axis.xyz, lower, upper, axis.effort, axis.velocity, max(axis.damping, 0.0),
                          max(axis.friction, 0.0), axis.spring_reference, max(axis.spring_stiffness, 0.0))
        if joint.provide_feedback:
            core.watch()
        written = joint if tuple(axes) == joint.axes else replace(joint, axes=tuple(axes))
        model.joints[joint.name] = JointHandle(model, written, parent, child, core)

    def _axes(self, joint: d.Joint, kind: str, where: str) -> List[d.Axis]:
        count = {"revolute": 1, "prismatic": 1, "universal": 2}.get(kind, 0)
        axes = [self._unit_axis(axis, where, joint) for axis in (joint.axes + (d.Axis(),) * count)[:count]]
        if count == 2 and abs(dot(axes[0].xyz, axes[1].xyz)) > 1e-6:
            first, second = axes[0].xyz, axes[1].xyz
            square = unit(cross(cross(first, second), first))
            if norm(square) == 0.0:
                square = cross(first, (1.0, 0.0, 0.0) if abs(first[0]) < 0.9 else (0.0, 1.0, 0.0))
            self._problem("warning", f"{where}: its two axes are not at right angles; the second is turned to be so", joint.source)
            axes[1] = replace(axes[1], xyz=unit(square))
        return axes

    def _unit_axis(self, axis: d.Axis, where: str, joint: d.Joint) -> d.Axis:
        if norm(axis.xyz) == 0.0:
            self._problem("warning", f"{where}: axis is zero; 0 0 1 is used", joint.source)
            return replace(axis, xyz=(0.0, 0.0, 1.0))
        return replace(axis, xyz=unit(axis.xyz))

"""The properties of what is picked, as controls."""
from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, List

from ode_sim.math3 import Pose, quat_from_rpy, to_rpy
from ode_sim.viewer.resizing import shape_of, size_of, with_size
from ode_sim.viewer.simulation import Frame, LinkProperties, ModelRecord, Refused, SurfaceProperties


class Properties:
    """Controls in the folder; removed when something else is picked."""

    def __init__(self, panel: Any):
        self.panel = panel
        self.page = panel.page
        self.gui = panel.gui
        self.handles: List[Any] = []
        self._texts: dict = {}

    def build(self) -> None:
        """Add the controls; a refusal leaves those that are there already.

        :raises Refused: the simulator does not tell what they show
        """

    def add(self, handle: Any) -> Any:
        self.handles.append(handle)
        return handle

    def remove(self) -> None:
        for handle in self.handles:
            handle.remove()

    def on_frame(self, frame: Frame) -> None:
        """Show what is now."""

    def _pose_controls(self) -> None:
        self.position = self.add(self.gui.add_vector3("Position (m)", (0.0, 0.0, 0.0), step=0.01))
        self.angles = self.add(self.gui.add_vector3("Roll pitch yaw (deg)", (0.0, 0.0, 0.0), step=1.0))
        for control in (self.position, self.angles):
            self.panel.on_update(control, lambda _: self._move())
        self._show_pose()

    def _show_pose(self) -> None:
        pose = self.page.selection.pose()
        if pose is not None:
            self.position.value = tuple(round(float(v), 4) for v in pose.p)
            self.angles.value = tuple(round(math.degrees(v), 2) for v in to_rpy(pose))

    def _move(self) -> None:
        roll, pitch, yaw = (math.radians(float(v)) for v in self.angles.value)
        self.page.selection.move(Pose(tuple(float(v) for v in self.position.value), quat_from_rpy(roll, pitch, yaw)), typed=True)


class ModelProperties(Properties):
    def build(self) -> None:
        selection = self.page.selection
        record = selection.record
        self._model = record.name
        self._link = selection.link or (next(iter(record.links)) if len(record.links) == 1 else "")
        self._pose_controls()
        for control in (self.position, self.angles):
            control.disabled = bool(selection.link)  # a link is moved by its joints, or with its model
        self._size_controls(record)
        if self._link and not record.static:
            self._mass_controls(self.page.simulation.link_properties(self._model, self._link))
        self._look_controls(record)

    def on_frame(self, frame: Frame) -> None:
        self._show_pose()

    def _size_controls(self, record: ModelRecord) -> None:
        shape = shape_of(record.description)
        if shape is not None:
            self.size = self.add(self.gui.add_vector3("Size (m)", size_of(shape[0]), min=(0.01,) * 3, step=0.05,
                                                      hint="what is round stays round"))
            self.panel.on_update(self.size, self._set_size)

    def _set_size(self, sizes: tuple) -> None:
        """The side that was changed; of a round thing the others follow."""
        shape = shape_of(self.page.selection.record.description)[0]
        for axis, (before, now) in enumerate(zip(size_of(shape), sizes)):
            if abs(float(now) - before) > 1e-9:
                self.page.resizing.apply(with_size(shape, axis, float(now)), typed=True)
                return

    def _mass_controls(self, now: LinkProperties) -> None:
        self.mass = self.add(self.gui.add_number("Mass (kg)", float(now.mass), min=1e-6, step=0.1))
        self.gravity = self.add(self.gui.add_checkbox("Gravity", now.gravity))
        self.com = self.add(self.gui.add_vector3("Centre of mass (m)", tuple(map(float, now.com)), step=0.01,
                                                 hint="in the frame of the link"))
        self.diagonal = self.add(self.gui.add_vector3("Inertia xx yy zz", tuple(float(now.inertia[i]) for i in (0, 3, 5)),
                                                      step=0.001, hint="kg m², about the centre of mass"))
        self.products = self.add(self.gui.add_vector3("Inertia xy xz yz", tuple(float(now.inertia[i]) for i in (1, 2, 4)),
                                                      step=0.001))
        for control in (self.com, self.diagonal, self.products):
            self.panel.on_update(control, lambda _: self._set_inertia())
        self.force = self.add(self.gui.add_vector3("Force (N)", (0.0, 0.0, 10.0), step=1.0))
        self.torque = self.add(self.gui.add_vector3("Torque (N m)", (0.0, 0.0, 0.0), step=0.1))
        self.duration = self.add(self.gui.add_number("For (s)", 0.1, min=0.001, max=1000.0, step=0.1))
        push = self.add(self.gui.add_button("Apply force and torque"))
        self.panel.on_update(self.mass, lambda _: self._set_mass())
        self.panel.on_update(self.gravity, lambda _: self._set_mass())
        self.panel.on_click(push, lambda: self.page.simulation.push(
            self._model, self._link, tuple(self.force.value), tuple(self.torque.value), float(self.duration.value)))

    def _look_controls(self, record: ModelRecord) -> None:
        links = [link for link in record.description.links if link.name == self._link or not self._link]
        visuals = [visual for link in links for visual in link.visuals]
        if visuals:
            rgba = (visuals[0].material.diffuse if visuals[0].material else None) or (0.7, 0.7, 0.7, 1.0)
            solid = 1.0 - visuals[0].transparency
            self.colour = self.add(self.gui.add_rgba("Colour", tuple(
                int(round(255 * min(1.0, max(0.0, part)))) for part in (*rgba[:3], rgba[3] * solid))))
            self.panel.on_update(self.colour, lambda value: self.page.simulation.paint(
                self._model, self._link, tuple(part / 255 for part in value)))
        if self._link and links and links[0].collisions:
            now = self.page.simulation.surface(self._model, self._link)
            self.friction = self.add(self.gui.add_vector2(
                "Friction", (min(now.mu, 1e6), min(now.mu2, 1e6)), min=(0.0, 0.0), step=0.05,
                hint="mu and mu2: of the two directions along the surface"))
            self.bounce = self.add(self.gui.add_number("Bounce", float(now.restitution), min=0.0, max=1.0, step=0.05))
            for control in (self.friction, self.bounce):
                self.panel.on_update(control, lambda _: self._set_surface())

    def _set_surface(self) -> None:
        mu, mu2 = (float(value) for value in self.friction.value)
        simulation, model, link = self.page.simulation, self._model, self._link
        before, now = simulation.surface(model, link), SurfaceProperties(mu, mu2, float(self.bounce.value))
        self.page.selection.history.do(f"friction of {model}::{link}", lambda: simulation.set_surface(model, link, now),
                                       lambda: simulation.set_surface(model, link, before), typed=True)

    def _set_mass(self) -> None:
        """A new mass keeps the shape: the inertia grows with it."""
        simulation, model, link = self.page.simulation, self._model, self._link
        before, mass = simulation.link_properties(model, link), float(self.mass.value)
        factor = mass / before.mass if before.mass else 1.0
        now = replace(before, mass=mass, inertia=tuple(v * factor for v in before.inertia),
                      gravity=bool(self.gravity.value))
        self.diagonal.value = tuple(float(now.inertia[i]) for i in (0, 3, 5))
        self.products.value = tuple(float(now.inertia[i]) for i in (1, 2, 4))
        self.page.selection.history.do(f"mass of {model}::{link}", lambda: simulation.set_link_properties(model, link, now),
                                       lambda: simulation.set_link_properties(model, link, before), typed=True)


    def _set_inertia(self) -> None:
        simulation, model, link = self.page.simulation, self._model, self._link
        (ixx, iyy, izz), (ixy, ixz, iyz) = (tuple(map(float, part.value)) for part in (self.diagonal, self.products))
        before = simulation.link_properties(model, link)
        now = replace(before, com=tuple(map(float, self.com.value)), inertia=(ixx, ixy, ixz, iyy, iyz, izz))
        self.page.selection.history.do(f"inertia of {model}::{link}", lambda: simulation.set_link_properties(model, link, now),
                                       lambda: simulation.set_link_properties(model, link, before), typed=True)


class LightProperties(Properties):
    def build(self) -> None:
        light = self.page.selection.light_record
        self._pose_controls()
        self.diffuse = self.add(self.gui.add_rgb("Colour", tuple(int(255 * min(1.0, c)) for c in light.diffuse[:3])))
        self.shadows = self.add(self.gui.add_checkbox("Casts shadows", light.cast_shadows))
        self.panel.on_update(self.diffuse, lambda value: self._set(
            diffuse=tuple(c / 255 for c in value) + (1.0,)))
        self.panel.on_update(self.shadows, lambda value: self._set(cast_shadows=bool(value)))
        self.specular = self.add(self.gui.add_rgb("Highlights", tuple(int(255 * min(1.0, c)) for c in light.specular[:3])))
        self.panel.on_update(self.specular, lambda value: self._set(specular=tuple(c / 255 for c in value) + (1.0,)))
        if light.type != "point":
            self.direction = self.add(self.gui.add_vector3("Shines along", tuple(map(float, light.direction)), step=0.05))
            self.panel.on_update(self.direction, lambda value: self._aim(tuple(map(float, value))))
        if light.type != "directional":
            self.fading = self.add(self.gui.add_vector3(
                "Fading", (float(light.constant), float(light.linear), float(light.quadratic)), min=(0.0,) * 3, step=0.01,
                hint="constant, linear, quadratic part"))
            self.panel.on_update(self.fading, lambda value: self._set(**dict(zip(
                ("constant", "linear", "quadratic"), map(float, value)))))
            self.range = self.add(self.gui.add_number("Range (m)", float(light.range), min=0.0, step=0.5))
            self.panel.on_update(self.range, lambda value: self._set(range=float(value)))

    def _aim(self, direction: tuple) -> None:
        if not any(direction):
            raise Refused("A direction is not zero.")
        self._set(direction=direction)

    def _set(self, **changes: Any) -> None:
        """A step that can be undone."""
        before, simulation = self.page.selection.light_record, self.page.simulation
        now = replace(before, **changes)
        self.page.selection.history.do(f"light {before.name}", lambda: simulation.set_light(now),
                                       lambda: simulation.set_light(before), typed=True)

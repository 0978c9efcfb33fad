"""The properties of what is picked, as controls."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from ode_sim.description import model as d
from ode_sim.math3 import Pose, quat_from_rpy, to_rpy, vec3

from ode_sim_viewer.drawing import byte_of, rgb255
from ode_sim_viewer.resizing import shape_of, size_of, with_size
from ode_sim_viewer.shapes import Simple
from ode_sim_viewer.simulation import Frame, LinkProperties, ModelRecord, Refused, SurfaceProperties, WorldRecord


class Properties:
    """Controls in the folder; removed when something else is picked."""

    def __init__(self, panel: Any):
        self.panel = panel
        self.page = panel.page
        self.gui = panel.gui
        self.handles: list[Any] = []

    def build(self) -> None:
        """Add the controls; a refusal leaves those that are there already.

        :raises Refused: the simulator does not tell what they show
        """

    def add(self, handle: Any) -> Any:
        """Remove ``handle`` with the others. :return: it"""
        self.handles.append(handle)
        return handle

    def remove(self) -> None:
        for handle in self.handles:
            handle.remove()

    def on_frame(self, frame: Frame) -> None:
        """Show what moves in ``frame``."""

    def show(self, world: WorldRecord) -> None:
        """Show what is now in ``world``, after an undo; else a field has what was typed into it."""

    def show_size(self, geometry: Simple) -> None:
        """Show the size of ``geometry`` while a hand makes it so."""
        self._put({"size": size_of(geometry)})

    def _put(self, values: dict[str, Any]) -> None:
        """:param values: attribute -> of that control, if there is one."""
        for name, value in values.items():
            if hasattr(self, name):
                getattr(self, name).value = value

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
        self.page.selection.move(Pose(vec3(self.position.value), quat_from_rpy(roll, pitch, yaw)), typed=True)


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

    def show(self, world: WorldRecord) -> None:
        record, simulation = world.model(self._model), self.page.simulation
        if record is None:
            return
        shape, visuals = shape_of(record.description), [visual for link in self._links(record) for visual in link.visuals]
        if shape is not None:
            self._put({"size": size_of(shape[0])})
        if visuals:
            self._put({"colour": _colour(visuals[0])})
        if hasattr(self, "mass"):
            self._put(_inertial(simulation.link_properties(self._model, self._link)))
        if hasattr(self, "friction"):
            self._put(_contact(simulation.surface(self._model, self._link)))

    def _size_controls(self, record: ModelRecord) -> None:
        shape = shape_of(record.description)
        if shape is not None:
            self.size = self.add(
                self.gui.add_vector3("Size (m)", size_of(shape[0]), min=(0.01,) * 3, step=0.05, hint="what is round stays round")
            )
            self.panel.on_update(self.size, self._set_size)

    def _set_size(self, sizes: tuple) -> None:
        """The sides that were changed; of a round thing the others follow."""
        record = self.page.selection.latest
        known = shape_of(record.description) if record is not None else None
        if known is None:
            return
        shape = before = known[0]
        for axis, (was, now) in enumerate(zip(size_of(before), sizes)):
            if abs(float(now) - was) > 1e-9:
                shape = with_size(shape, axis, float(now))
        self.page.resizing.apply(shape, typed=True)

    def _mass_controls(self, now: LinkProperties) -> None:
        values = _inertial(now)
        self.mass = self.add(self.gui.add_number("Mass (kg)", values["mass"], min=1e-6, step=0.1))
        self.gravity = self.add(self.gui.add_checkbox("Gravity", values["gravity"]))
        self.com = self.add(self.gui.add_vector3("Centre of mass (m)", values["com"], step=0.01, hint="in the frame of the link"))
        self.diagonal = self.add(
            self.gui.add_vector3("Inertia xx yy zz", values["diagonal"], step=0.001, hint="kg m², about the centre of mass")
        )
        self.products = self.add(self.gui.add_vector3("Inertia xy xz yz", values["products"], step=0.001))
        for control in (self.com, self.diagonal, self.products):
            self.panel.on_update(control, lambda _: self._set_inertia())
        self.force = self.add(self.gui.add_vector3("Force (N)", (0.0, 0.0, 10.0), step=1.0))
        self.torque = self.add(self.gui.add_vector3("Torque (N m)", (0.0, 0.0, 0.0), step=0.1))
        self.duration = self.add(self.gui.add_number("For (s)", 0.1, min=0.001, max=1000.0, step=0.1))
        push = self.add(self.gui.add_button("Apply force and torque"))
        self.panel.on_update(self.mass, lambda _: self._set_mass())
        self.panel.on_update(self.gravity, lambda _: self._set_mass())
        self.panel.on_click(
            push,
            lambda: self.page.simulation.push(
                self._model, self._link, tuple(self.force.value), tuple(self.torque.value), float(self.duration.value)
            ),
        )

    def _look_controls(self, record: ModelRecord) -> None:
        links = self._links(record)
        visuals = [visual for link in links for visual in link.visuals]
        if visuals:
            self.colour = self.add(self.gui.add_rgba("Colour", _colour(visuals[0])))
            self.panel.on_update(self.colour, lambda value: self._paint(tuple(part / 255 for part in value)))
        if self._link and links and links[0].collisions:
            values = _contact(self.page.simulation.surface(self._model, self._link))
            self.friction = self.add(
                self.gui.add_vector2(
                    "Friction", values["friction"], min=(0.0, 0.0), step=0.05, hint="mu and mu2: of the two directions along the surface"
                )
            )
            self.bounce = self.add(self.gui.add_number("Bounce", values["bounce"], min=0.0, max=1.0, step=0.05))
            for control in (self.friction, self.bounce):
                self.panel.on_update(control, lambda _: self._set_surface())

    def _links(self, record: ModelRecord) -> list[d.Link]:
        return [link for link in record.description.links if self._link in ("", link.name)]

    def _paint(self, rgba: d.Rgba) -> None:
        simulation, model, link, record = self.page.simulation, self._model, self._link, self.page.world.model(self._model)
        if record is None:
            raise Refused(f"There is no {model} any more.")
        before = {other.name: other.visuals for other in self._links(record) if other.visuals}
        self.page.selection.history.do(
            f"colour of {model}::{link}",
            lambda: simulation.paint(model, link, rgba),
            lambda: simulation.set_looks(model, before),
            typed=True,
        )

    def _set_surface(self) -> None:
        mu, mu2 = (float(value) for value in self.friction.value)
        simulation, model, link = self.page.simulation, self._model, self._link
        before, now = simulation.surface(model, link), SurfaceProperties(mu, mu2, float(self.bounce.value))
        self.page.selection.history.do(
            f"friction of {model}::{link}",
            lambda: simulation.set_surface(model, link, now),
            lambda: simulation.set_surface(model, link, before),
            typed=True,
        )

    def _set_mass(self) -> None:
        """A new mass keeps the shape: the inertia grows with it."""
        simulation, model, link = self.page.simulation, self._model, self._link
        before, mass = simulation.link_properties(model, link), float(self.mass.value)
        factor = mass / before.mass if before.mass else 1.0
        now = replace(before, mass=mass, inertia=tuple(v * factor for v in before.inertia), gravity=bool(self.gravity.value))
        self._put({name: value for name, value in _inertial(now).items() if name in ("diagonal", "products")})
        self.page.selection.history.do(
            f"mass of {model}::{link}",
            lambda: simulation.set_link_properties(model, link, now),
            lambda: simulation.set_link_properties(model, link, before),
            typed=True,
        )

    def _set_inertia(self) -> None:
        simulation, model, link = self.page.simulation, self._model, self._link
        (ixx, iyy, izz), (ixy, ixz, iyz) = (tuple(map(float, part.value)) for part in (self.diagonal, self.products))
        before = simulation.link_properties(model, link)
        now = replace(before, com=tuple(map(float, self.com.value)), inertia=(ixx, ixy, ixz, iyy, iyz, izz))
        self.page.selection.history.do(
            f"inertia of {model}::{link}",
            lambda: simulation.set_link_properties(model, link, now),
            lambda: simulation.set_link_properties(model, link, before),
            typed=True,
        )


def _inertial(now: LinkProperties) -> dict[str, Any]:
    diagonal, products = (tuple(float(now.inertia[i]) for i in part) for part in ((0, 3, 5), (1, 2, 4)))
    return {"mass": float(now.mass), "gravity": now.gravity, "com": tuple(map(float, now.com)), "diagonal": diagonal, "products": products}


def _contact(now: SurfaceProperties) -> dict[str, Any]:
    return {"friction": (min(now.mu, 1e6), min(now.mu2, 1e6)), "bounce": float(now.restitution)}


def _colour(visual: d.Visual) -> tuple[int, ...]:
    """0 to 255: red, green, blue and how solid it is."""
    rgba = (visual.material.diffuse if visual.material else None) or (0.7, 0.7, 0.7, 1.0)
    return (*rgb255(rgba), byte_of(rgba[3] * (1.0 - visual.transparency)))


class LightProperties(Properties):
    def build(self) -> None:
        light = self.page.selection.light_record
        self._name, values = light.name, _shine(light)
        self._pose_controls()
        self.diffuse = self.add(self.gui.add_rgb("Colour", values["diffuse"]))
        self.shadows = self.add(self.gui.add_checkbox("Casts shadows", values["shadows"]))
        self.panel.on_update(self.diffuse, lambda value: self._set(diffuse=tuple(c / 255 for c in value) + (1.0,)))
        self.panel.on_update(self.shadows, lambda value: self._set(cast_shadows=bool(value)))
        self.specular = self.add(self.gui.add_rgb("Highlights", values["specular"]))
        self.panel.on_update(self.specular, lambda value: self._set(specular=tuple(c / 255 for c in value) + (1.0,)))
        if light.type != "point":
            self.direction = self.add(self.gui.add_vector3("Shines along", values["direction"], step=0.05))
            self.panel.on_update(self.direction, lambda value: self._aim(tuple(map(float, value))))
        if light.type != "directional":
            self.fading = self.add(
                self.gui.add_vector3("Fading", values["fading"], min=(0.0,) * 3, step=0.01, hint="constant, linear, quadratic part")
            )
            self.panel.on_update(self.fading, lambda value: self._set(**dict(zip(("constant", "linear", "quadratic"), map(float, value)))))
            self.range = self.add(self.gui.add_number("Range (m)", values["range"], min=0.0, step=0.5))
            self.panel.on_update(self.range, lambda value: self._set(range=float(value)))

    def show(self, world: WorldRecord) -> None:
        for light in world.lights:
            if light.name == self._name:
                self._put(_shine(light))

    def _aim(self, direction: tuple) -> None:
        if not any(direction):
            raise Refused("A direction is not zero.")
        self._set(direction=direction)

    def _set(self, **changes: Any) -> None:
        self.page.selection.change_light(**changes)


def _shine(light: d.Light) -> dict[str, Any]:
    return {
        "diffuse": rgb255(light.diffuse),
        "shadows": light.cast_shadows,
        "specular": rgb255(light.specular),
        "direction": tuple(map(float, light.direction)),
        "range": float(light.range),
        "fading": (float(light.constant), float(light.linear), float(light.quadratic)),
    }

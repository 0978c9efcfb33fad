"""SDF 1.0 to 1.7 to :class:`World`, :class:`Model` and :class:`Light`.

What Gazebo Classic reads with a warning is read here with a :class:`Problem`; what it would crash on, or what leaves no
sensible meaning, raises :class:`DescriptionError`. One bad model of a world is left out, the rest of the world loads.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from ode_sim.description.model import (
    FARTHEST,
    DescriptionError,
    Fog,
    Light,
    LinkState,
    Model,
    ModelState,
    Physics,
    Scene,
    Vec3,
    Visual,
    World,
    WorldState,
    quoted,
)
from ode_sim.description.population import population
from ode_sim.description.scaling import largest_size, scaled_model
from ode_sim.description.sdf_actor import SdfActors
from ode_sim.description.sdf_frames import WorldFrames
from ode_sim.description.xmlsource import is_true, source_of, text_of

_UNSCALED = (1.0, 1.0, 1.0)
_STRONGEST_FIELD = 1e6  # T
_STRONGEST_WIND = 1e4  # m/s
_LONGEST_TIME = 1e9  # s; in nanoseconds it still fits into 64 bits


class _Contents:
    """Models and lights of a world, in file order."""

    def __init__(self, reader: SdfReader):
        self.roads: list[Visual] = []
        self._models: dict[str, Model] = {}  # by name, at the poses that they have in the file
        self._lights: list[tuple[Light, ET.Element | None]] = []  # with their <pose>
        self._reader = reader
        self._frames = WorldFrames(reader)

    def models(self) -> list[Model]:
        """With their poses in the world."""
        return [replace(model, pose=self._frames.of(name)) for name, model in self._models.items()]

    def lights(self) -> list[Light]:
        """With their poses in the world."""
        return [replace(light, pose=self._frames.light(light.pose, pose)) for light, pose in self._lights]

    def add(self, child: ET.Element) -> None:
        """An element of ``<world>``; of what is neither model, light nor road some is left out, with a word if it should be seen."""
        reader = self._reader
        if child.tag in ("model", "actor"):
            self._add_model(child)
        elif child.tag == "light":
            self._add_light(child)
        elif child.tag == "include":
            included = reader.include(child)
            if included is not None:
                self.add(included)
        elif child.tag == "population":
            template = child.find("model")
            include = child.find("include")
            if template is None and include is not None:
                template = reader.include(include)
            for copy in population(reader, child, template):
                self._add_model(copy)
        elif child.tag == "road":
            self._add_road(child)
        elif child.tag == "frame":
            self._frames.add_frame(child)
        elif child.tag == "joint":
            reader.warn(child, "joints between models of a world file are not simulated; left out")

    def _add_model(self, source: ET.Element) -> None:
        try:
            model = self._reader.model(source)
        except DescriptionError as error:
            self._reader.warn(error.source, f"{error.message}; {source.tag} '{quoted(source.get('name'))}' is left out", "error")
            return
        if model.name in self._models:
            self._reader.warn(source, f"a model named '{quoted(model.name)}' is there already; this one is left out")
            return
        self._models[model.name] = model
        self._frames.add_model(model.name, model.pose, source.find("pose"))

    def _add_light(self, source: ET.Element) -> None:
        try:
            self._lights.append((self._reader.light(source), source.find("pose")))
        except DescriptionError as error:
            self._reader.warn(error.source, f"{error.message}; light '{quoted(source.get('name'))}' is left out", "error")

    def _add_road(self, source: ET.Element) -> None:
        try:
            self.roads.append(self._reader.road(source))
        except DescriptionError as error:
            self._reader.warn(error.source, f"{error.message}; road '{quoted(source.get('name'))}' is left out", "error")


class SdfReader(SdfActors):
    """Reads one file or text, worlds included; collects :attr:`problems` on the way."""

    def world(self, element: ET.Element) -> World:
        """The world of ``element``, a ``<world>``."""
        plugins = self.plugins(element)
        contents = _Contents(self)
        for child in element:
            contents.add(child)
        state = self._state(element.find("state"))
        for inserted in element.findall("state/insertions/*"):
            if inserted.tag in ("model", "light", "actor"):
                contents.add(inserted)
        models = contents.models()
        if state is not None:
            models = self._scaled(models, state, element)
        coordinates = element.find("spherical_coordinates")
        default = World()
        return World(
            name=element.get("name") or "default",
            gravity=self._gravity(element, default.gravity),
            magnetic_field=self.vector(element, "magnetic_field", default.magnetic_field, most=_STRONGEST_FIELD),
            wind=self.vector(element, "wind/linear_velocity", default.wind, most=_STRONGEST_WIND),
            physics=self._physics(element),
            scene=replace(self._scene(element.find("scene")), roads=tuple(contents.roads)),
            models=tuple(models),
            lights=tuple(contents.lights()),
            plugins=tuple(plugins),
            state=state,
            spherical_coordinates=(
                self.number(coordinates, "latitude_deg", 0.0),
                self.number(coordinates, "longitude_deg", 0.0),
                self.number(coordinates, "elevation", 0.0),
                self.number(coordinates, "heading_deg", 0.0),
            ),
            source=source_of(element),
        )

    def _gravity(self, world: ET.Element, default: Vec3) -> Vec3:
        from ode_sim.physics import STRONGEST_GRAVITY

        older = self.vector(world, "physics/gravity", default, most=STRONGEST_GRAVITY)
        return self.vector(world, "gravity", older, most=STRONGEST_GRAVITY)

    def _scaled(self, models: list[Model], state: WorldState, world: ET.Element) -> list[Model]:
        """What was stretched in the simulator's window is saved at its old size, with the factors in ``<state>``."""
        scales = {saved.name: saved.scale for saved in state.models}

        def scaled(model: Model) -> Model:
            scale = scales.get(model.name, _UNSCALED)
            if scale == _UNSCALED:
                return model
            factors = " ".join(f"{factor:g}" for factor in scale)
            if not all(0.0 < factor < math.inf for factor in scale):
                reason = f"scale {factors} must be positive"
            else:
                stretched = scaled_model(model, scale)
                if largest_size(stretched) <= FARTHEST:
                    return stretched
                reason = f"scale {factors} makes it larger than {FARTHEST:g} m"
            self.warn(world.find("state"), f"model '{quoted(model.name)}': {reason}; the model keeps its size")
            return model

        return [scaled(model) for model in models]

    def _physics(self, world: ET.Element) -> Physics:
        from ode_sim.physics import usable_physics  # which is built on the records of this package

        blocks = world.findall("physics")
        if not blocks:
            return Physics()
        block = next((b for b in blocks if is_true(b.get("default", ""))), blocks[0])
        kind = (block.get("type") or "ode").strip()
        if kind != "ode":
            self.warn(block, f"the physics engine is ODE; '{quoted(kind)}' is simulated by it, its own parameters are ignored")
        default = Physics()
        ode = block.find("ode")
        values: dict[str, Any] = {  # counts as written: usable_physics makes them whole
            "max_step_size": self.number(
                block, "max_step_size", self.number(block, "dt", self.number(ode, "solver/dt", default.max_step_size))
            ),
            "max_contacts": self.number(block, "max_contacts", default.max_contacts),
        }
        for name, value in values.items():
            if value <= 0.0:
                values[name] = getattr(default, name)
                self.warn(block, f"{name} {value:g} must be positive; using {values[name]:g}")
        values.update((name, self.number(ode, f"solver/{name}", getattr(default, name))) for name in ("iters", "precon_iters"))
        written = Physics(
            **values,
            # below 0, as ArduPilot's worlds have it: as fast as possible
            real_time_update_rate=max(
                self.number(block, "real_time_update_rate", self.number(block, "update_rate", default.real_time_update_rate)), 0.0
            ),
            real_time_factor=self.number(block, "real_time_factor", default.real_time_factor),
            solver=text_of(ode.find("solver/type")) or default.solver if ode is not None else default.solver,
            sor=self.number(ode, "solver/sor", default.sor),
            cfm=self.number(ode, "constraints/cfm", default.cfm),
            erp=self.number(ode, "constraints/erp", default.erp),
            contact_max_correcting_vel=self.number(ode, "constraints/contact_max_correcting_vel", default.contact_max_correcting_vel),
            contact_surface_layer=self.number(ode, "constraints/contact_surface_layer", default.contact_surface_layer),
        )
        physics, changes = usable_physics(written)
        for change in changes:
            self.warn(block, change)
        return physics

    def _scene(self, element: ET.Element | None) -> Scene:
        if element is None:
            return Scene()
        default = Scene()
        return Scene(
            ambient=self.rgba(element, "ambient", default.ambient),
            background=self.rgba(element, "background", default.background),
            shadows=self.boolean(element, "shadows", True),
            grid=self.boolean(element, "grid", True),
            sky=element.find("sky") is not None,
            fog=self._fog(element.find("fog")),
        )

    def _fog(self, element: ET.Element | None) -> Fog:
        if element is None:
            return Fog()
        default = Fog()
        return Fog(
            kind=text_of(element.find("type")),
            color=self.rgba(element, "color", default.color),
            start=self.number(element, "start", default.start),
            end=self.number(element, "end", default.end),
            density=self.number(element, "density", default.density),
        )

    def _state(self, element: ET.Element | None) -> WorldState | None:
        if element is None:
            return None

        time = element.find("sim_time")
        given = text_of(time).split(None, 2) or ["0"]
        try:
            sim_time = float(given[0]) + (float(given[1]) * 1e-9 if len(given) > 1 else 0.0)
        except ValueError:
            sim_time = math.nan
        if not 0.0 <= sim_time <= _LONGEST_TIME:
            self.warn(time, f"'{quoted(text_of(time))}' is no time; starting from 0")
            sim_time = 0.0
        models, lost = [], []
        for model in element.findall("model"):
            try:
                models.append(self._model_state(model))
            except DescriptionError as error:
                lost.append(model.get("name") or "")
                self.warn(error.source, f"{error.message}: it has fallen out of this world; model '{quoted(lost[-1])}' is left out")
        return WorldState(
            sim_time=sim_time,
            iterations=self.whole(element, "iterations", 0, 0, 2**62),
            models=tuple(models),
            light_poses=tuple(
                (light.get("name") or "", self.pose(light.find("pose")))
                for light in element.findall("light")
                if light.find("pose") is not None
            ),
            deletions=(*(text_of(name) for name in element.findall("deletions/name")), *lost),
        )

    def _model_state(self, model: ET.Element) -> ModelState:
        """:raises DescriptionError: it is farther away than anything can be"""
        pose = model.find("pose")
        return ModelState(
            model.get("name") or "",
            self.pose(pose) if pose is not None else None,
            self.vector(model, "scale", (1.0, 1.0, 1.0)),
            tuple(self._link_states(model, "")),
        )

    def _link_states(self, model: ET.Element, scope: str) -> Iterator[LinkState]:
        for link in model.findall("link"):
            velocity = self.vector(link, "velocity", (0.0,) * 6, most=FARTHEST)
            yield LinkState(scope + (link.get("name") or ""), self.pose(link.find("pose")), velocity[:3], velocity[3:])
        for sub in model.findall("model"):
            yield from self._link_states(sub, f"{scope}{sub.get('name')}::")

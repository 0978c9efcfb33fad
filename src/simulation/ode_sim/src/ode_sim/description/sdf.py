"""SDF 1.0 to 1.7 to :class:`World`, :class:`Model` and :class:`Light`.

What Gazebo Classic reads with a warning is read here with a :class:`Problem`; what it would crash on, or what leaves no
sensible meaning, raises :class:`DescriptionError`. One bad model of a world is left out, the rest of the world loads.
"""
from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from dataclasses import replace
from typing import Iterator, List, Optional

from ode_sim import math3
from ode_sim.description.model import (
    DescriptionError, Light, LinkState, Model, ModelState, Physics, Scene, World, WorldState)
from ode_sim.description.population import population
from ode_sim.description.scaling import scaled_model
from ode_sim.description.sdf_frames import relative_to, world_frames
from ode_sim.description.sdf_model import SdfModels
from ode_sim.description.xmlsource import is_true, source_of, text_of

_UNSCALED = (1.0, 1.0, 1.0)


class SdfReader(SdfModels):
    """Reads one file or text, worlds included; collects :attr:`problems` on the way."""

    def world(self, element: ET.Element) -> World:
        models: List[Model] = []
        lights: List[Light] = []
        plugins = self.plugins(element)
        frames = world_frames(self, element)

        def add_model(source: ET.Element) -> None:
            try:
                model = self.model(source)
            except DescriptionError as error:
                self.warn(None, f"{error}; model '{source.get('name')}' is left out", "error")
                return
            if any(model.name == other.name for other in models):
                self.warn(source, f"a model named '{model.name}' is there already; this one is left out")
                return
            frame = relative_to(source.find("pose"))
            if frame in frames:
                model = replace(model, pose=math3.compose(frames[frame], model.pose))
            models.append(model)

        for child in element:
            if child.tag == "model":
                add_model(child)
            elif child.tag == "light":
                lights.append(self.light(child))
            elif child.tag == "include":
                included = self.include(child)
                if included is None:
                    continue
                if included.tag == "model":
                    add_model(included)
                elif included.tag == "light":
                    lights.append(self.light(included))
                else:
                    self.warn(child, "actors are not simulated; left out")
            elif child.tag == "population":
                template = child.find("model")
                if template is None and child.find("include") is not None:
                    template = self.include(child.find("include"))
                for copy in population(self, child, template):
                    add_model(copy)
            elif child.tag in ("actor", "road"):
                self.warn(child, f"{child.tag}s are not simulated; left out")
            elif child.tag == "joint":
                self.warn(child, "joints between models of a world file are not simulated; left out")
        state = self._state(element.find("state"))
        for inserted in element.findall("state/insertions/*"):
            if inserted.tag == "model":
                add_model(inserted)
            elif inserted.tag == "light":
                lights.append(self.light(inserted))
        if state is not None:
            models = self._scaled(models, state, element)
        coordinates = element.find("spherical_coordinates")
        default = World()
        return World(
            name=element.get("name") or "default",
            gravity=self.vector(element, "gravity", self.vector(element, "physics/gravity", default.gravity)),
            magnetic_field=self.vector(element, "magnetic_field", default.magnetic_field),
            physics=self._physics(element), scene=self._scene(element.find("scene")), models=tuple(models),
            lights=tuple(lights), plugins=tuple(plugins), state=state,
            spherical_coordinates=(self.number(coordinates, "latitude_deg", 0.0),
                                   self.number(coordinates, "longitude_deg", 0.0),
                                   self.number(coordinates, "elevation", 0.0),
                                   self.number(coordinates, "heading_deg", 0.0)),
            source=source_of(element))

    def _scaled(self, models: List[Model], state: WorldState, world: ET.Element) -> List[Model]:
        """What was stretched in the simulator's window is saved at its old size, with the factors in ``<state>``."""
        scales = {}
        for saved in state.models:
            if all(0.0 < factor < math.inf for factor in saved.scale):
                scales[saved.name] = saved.scale
            else:
                self.warn(world.find("state"), f"model '{saved.name}': scale {' '.join(f'{f:g}' for f in saved.scale)} "
                                               "must be positive; the model keeps its size")
        return [scaled_model(model, scales[model.name]) if scales.get(model.name, _UNSCALED) != _UNSCALED else model
                for model in models]

    def _physics(self, world: ET.Element) -> Physics:
        blocks = world.findall("physics")
        if not blocks:
            return Physics()
        block = next((b for b in blocks if is_true(b.get("default", ""))), blocks[0])
        kind = (block.get("type") or "ode").strip()
        if kind != "ode":
            self.warn(block, f"the physics engine is ODE; '{kind}' is simulated by it, its own parameters are ignored")
        default = Physics()
        ode = block.find("ode")
        step = self.number(block, "max_step_size", self.number(block, "dt", default.max_step_size))
        if not 0.0 < step < math.inf:
            self.warn(block, f"max_step_size {step:g} must be positive; using {default.max_step_size:g}")
            step = default.max_step_size
        return Physics(
            max_step_size=step,
            real_time_update_rate=self.number(block, "real_time_update_rate",
                                              self.number(block, "update_rate", default.real_time_update_rate)),
            real_time_factor=self.number(block, "real_time_factor", default.real_time_factor),
            max_contacts=int(self.number(block, "max_contacts", default.max_contacts)),
            solver=text_of(ode.find("solver/type")) or default.solver if ode is not None else default.solver,
            iters=int(self.number(ode, "solver/iters", default.iters)),
            precon_iters=int(self.number(ode, "solver/precon_iters", default.precon_iters)),
            sor=self.number(ode, "solver/sor", default.sor),
            cfm=self.number(ode, "constraints/cfm", default.cfm),
            erp=self.number(ode, "constraints/erp", default.erp),
            contact_max_correcting_vel=self.number(ode, "constraints/contact_max_correcting_vel",
                                                   default.contact_max_correcting_vel),
            contact_surface_layer=self.number(ode, "constraints/contact_surface_layer",
                                              default.contact_surface_layer))

    def _scene(self, element: Optional[ET.Element]) -> Scene:
        if element is None:
            return Scene()
        default = Scene()
        return Scene(ambient=self.rgba(element, "ambient", default.ambient),
                     background=self.rgba(element, "background", default.background),
                     shadows=self.boolean(element, "shadows", True), grid=self.boolean(element, "grid", True),
                     sky=element.find("sky") is not None)

    def _state(self, element: Optional[ET.Element]) -> Optional[WorldState]:
        if element is None:
            return None

        def link_states(model: ET.Element, scope: str) -> Iterator[LinkState]:
            for link in model.findall("link"):
                velocity = self.vector(link, "velocity", (0.0,) * 6)
                yield LinkState(scope + (link.get("name") or ""), self.pose(link.find("pose")),
                                velocity[:3], velocity[3:])
            for sub in model.findall("model"):
                yield from link_states(sub, f"{scope}{sub.get('name')}::")

        time = (text_of(element.find("sim_time")) or "0").split()
        try:
            sim_time = float(time[0]) + (float(time[1]) * 1e-9 if len(time) > 1 else 0.0)
        except ValueError:
            self.warn(element.find("sim_time"), f"'{' '.join(time)}' is no time; starting from 0")
            sim_time = 0.0
        return WorldState(
            sim_time=sim_time, iterations=int(self.number(element, "iterations", 0)),
            models=tuple(ModelState(
                model.get("name") or "", self.pose(model.find("pose")) if model.find("pose") is not None else None,
                self.vector(model, "scale", (1.0, 1.0, 1.0)), tuple(link_states(model, "")))
                for model in element.findall("model")),
            light_poses=tuple((light.get("name") or "", self.pose(light.find("pose")))
                              for light in element.findall("light") if light.find("pose") is not None),
            deletions=tuple(text_of(name) for name in element.findall("deletions/name")))

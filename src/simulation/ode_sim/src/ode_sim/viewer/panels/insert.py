"""Simple shapes, lights, and the models of the model path."""
from __future__ import annotations

from typing import Any, Dict

from ode_sim.description import model as d
from ode_sim.description.sdf_writer import light_text, model_text
from ode_sim.math3 import Pose
from ode_sim.viewer.panels.base import Panel
from ode_sim.viewer.simulation import Refused, WorldRecord

_NONE = "(no model on the model path)"
_GREY = d.Material("Gazebo/Grey")


class InsertPanel(Panel):
    title = "Insert"

    def __init__(self, page: Any):
        super().__init__(page)
        self._models: Dict[str, str] = self.simulation.model_names()
        self._place = self.gui.add_vector3("Place (m)", (0.0, 0.0, 0.0), step=0.1,
                                           hint="on the ground: z is the lower end")
        self._shapes = self.gui.add_button_group("Shape", ("Box", "Sphere", "Cylinder"))
        self._lights = self.gui.add_button_group("Light", ("Point", "Spot", "Sun"))
        self._search = self.gui.add_text("Search", "", hint="of models whose name has this in it")
        names = tuple(sorted(self._models)) or (_NONE,)
        self._chosen = self.gui.add_dropdown("Model", names)
        self._insert = self.gui.add_button("Insert model")
        self._shapes.on_click(lambda event: page.attempt(event, lambda: self._shape(event.target.value)))
        self._lights.on_click(lambda event: page.attempt(event, lambda: self._light(event.target.value)))
        self.on_click(self._insert, self._model)
        self._search.on_update(lambda event: self._narrow())

    def on_world(self, world: WorldRecord) -> None:
        if not self._models:
            self._models = self.simulation.model_names()
            self._narrow()

    def _narrow(self) -> None:
        wanted = self._search.value.lower()
        self._chosen.options = tuple(sorted(name for name in self._models if wanted in name.lower())) or (_NONE,)

    def _at(self, height: float = 0.0) -> Pose:
        x, y, z = (float(v) for v in self._place.value)
        return Pose((x, y, z + height))

    def _shape(self, kind: str) -> None:
        shape, name = {"Box": (d.Box(), "unit_box"), "Sphere": (d.Sphere(0.5), "unit_sphere"),
                       "Cylinder": (d.Cylinder(0.5, 1.0), "unit_cylinder")}[kind]
        self.page.selection.insert(name, model_text(shape_model(name, shape)), self._at(0.5))

    def _light(self, kind: str) -> None:
        light = {"Point": d.Light("user_point_light", "point", range=20.0, linear=0.0, constant=0.5, quadratic=0.01),
                 "Spot": d.Light("user_spot_light", "spot", range=20.0, constant=0.5, linear=0.0, quadratic=0.01,
                                 spot=(0.6, 1.0, 1.0)),
                 "Sun": d.Light("user_directional_light", "directional", direction=(0.1, 0.1, -0.9),
                                cast_shadows=True)}[kind]
        self.page.selection.insert(light.name, light_text(light), self._at(1.0 if kind != "Sun" else 10.0))

    def _model(self) -> None:
        name = self._chosen.value
        if name not in self._models:
            raise Refused("No model is chosen; GAZEBO_MODEL_PATH says where models are looked for.")
        text = f"<sdf version='1.6'><include><uri>model://{name}</uri></include></sdf>"
        try:
            with open(self._models[name], encoding="utf-8") as stream:
                text = stream.read()
        except (OSError, UnicodeDecodeError) as error:
            raise Refused(f"{self._models[name]}: {error}") from error
        self.page.selection.insert(name, text, self._at())


def shape_model(name: str, shape: d.Geometry, mass: float = 1.0) -> d.Model:
    """A grey body of one link named ``link``, as Gazebo's window inserts it: 1 kg, inertia of the full shape."""
    if isinstance(shape, d.Sphere):
        moment = 0.4 * mass * shape.radius ** 2
        moments = (moment, moment, moment)
    elif isinstance(shape, d.Cylinder):
        side = mass * (3 * shape.radius ** 2 + shape.length ** 2) / 12
        moments = (side, side, 0.5 * mass * shape.radius ** 2)
    else:
        x, y, z = (v * v * mass / 12 for v in shape.size)
        moments = (y + z, x + z, x + y)
    inertial = d.Inertial(mass, ixx=moments[0], iyy=moments[1], izz=moments[2])
    link = d.Link("link", inertial=inertial, collisions=(d.Collision("collision", Pose(), shape),),
                  visuals=(d.Visual("visual", Pose(), shape, _GREY),))
    return d.Model(name, links=(link,))

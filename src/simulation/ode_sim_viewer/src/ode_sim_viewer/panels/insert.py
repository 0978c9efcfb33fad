"""Simple shapes, lights, and the models of the model path."""

from __future__ import annotations

import threading
from typing import Any

from ode_sim.description import DescriptionError, read_model
from ode_sim.description import model as d
from ode_sim.description.sdf_writer import light_text, model_text
from ode_sim.math3 import Pose, compose, vec3

from ode_sim_viewer.panels.base import Panel, note
from ode_sim_viewer.placing import Thing
from ode_sim_viewer.shapes import Simple, shape_model
from ode_sim_viewer.simulation import Refused, WorldRecord

_MOST_ROWS = 40
_ICON, _COLOUR = "box", "gray"  # of a row; the frame draws such buttons as rows


class InsertPanel(Panel):
    """A click on a model of the list puts it into the world; so do the tools with a shape or a light."""

    title = "Insert"
    upper = True

    def __init__(self, page: Any):
        super().__init__(page)
        self._models: dict[str, str] = {}
        self._asked = False
        self._search = self.gui.add_text("Search", "", hint="of models whose name has this in it")
        self._state = self.gui.add_html(note(""))
        self._list = self.gui.add_folder("Models")
        self._rows: dict[str, Any] = {}
        self._rest: Any = None  # how many more there are
        with self.gui.add_folder("Where it goes"):
            self._by_hand = self.gui.add_checkbox(
                "Put it down with the mouse",
                True,
                hint="it hangs at the pointer, and a click in the scene puts it down (Ctrl: "
                "on whole metres); without, it goes to the place below at once",
            )
            self._place = self.gui.add_vector3("Place (m)", (0.0, 0.0, 0.0), step=0.1, hint="on the ground: z is the lower end")
        with page.commands:
            self._shapes = self.gui.add_button_group("Shape", ("Box", "Sphere", "Cylinder"))
            self._lights = self.gui.add_button_group("Light", ("Point", "Spot", "Sun"))
        page.placing.say = lambda line: setattr(self._state, "content", note(line))
        self._shapes.on_click(lambda event: page.attempt(event, lambda: self._shape(event)))
        self._lights.on_click(lambda event: page.attempt(event, lambda: self._light(event)))
        self._search.on_update(lambda event: page.later(self._narrow))
        self._by_hand.on_update(lambda event: page.later(page.placing.end))

    def on_world(self, world: WorldRecord) -> None:
        if not self._asked:
            self._asked = True
            self.on_models()

    def on_models(self) -> None:
        if self._asked:
            threading.Thread(target=self._look, name="model path", daemon=True).start()  # many folders, perhaps

    def _look(self) -> None:
        self._models = self.simulation.model_names()
        self.page.later(self._narrow)

    def _narrow(self) -> None:
        """List the models whose name fits. Drawing thread."""
        wanted = self._search.value.lower()
        fitting = sorted(name for name in self._models if wanted in name.lower())
        shown = fitting[:_MOST_ROWS]
        for name in [name for name in self._rows if name not in shown]:
            self._rows.pop(name).remove()
        if self._rest is not None:
            self._rest.remove()
        with self._list:
            for number, name in enumerate(shown):
                if name not in self._rows:
                    self._rows[name] = self._row(name)
                self._rows[name].order = float(number)
            more = "" if fitting else "no model of the model path has this in its name"
            if len(fitting) > _MOST_ROWS:
                more = f"and {len(fitting) - _MOST_ROWS} more: search"
            self._rest = self.gui.add_html(note(more), order=1e6, visible=bool(more))

    def _row(self, name: str) -> Any:
        button = self.gui.add_button(name, color=_COLOUR, icon=_ICON)
        button.on_click(lambda event: self.page.attempt(event, lambda: self._model(event, name)))
        return button

    def _put(self, event: Any, thing: Thing) -> None:
        if self._by_hand.value:
            self.page.later(lambda: self.page.placing.begin(event, thing))
        else:
            place = Pose(vec3(self._place.value))
            self.page.selection.insert(thing.name, thing.text, compose(place, thing.lift))

    def _shape(self, event: Any) -> None:
        shapes: dict[str, tuple[Simple, str]] = {
            "Box": (d.Box(), "unit_box"),
            "Sphere": (d.Sphere(0.5), "unit_sphere"),
            "Cylinder": (d.Cylinder(0.5, 1.0), "unit_cylinder"),
        }
        shape, name = shapes[event.target.value]
        model = shape_model(name, shape)
        self._put(event, Thing(name, model_text(model), Pose((0.0, 0.0, 0.5)), model))

    def _light(self, event: Any) -> None:
        kind = event.target.value
        light = {
            "Point": d.Light("user_point_light", "point", range=20.0, linear=0.0, constant=0.5, quadratic=0.01),
            "Spot": d.Light("user_spot_light", "spot", range=20.0, constant=0.5, linear=0.0, quadratic=0.01, spot=(0.6, 1.0, 1.0)),
            "Sun": d.Light("user_directional_light", "directional", direction=(0.1, 0.1, -0.9), cast_shadows=True),
        }[kind]
        self._put(event, Thing(light.name, light_text(light), Pose((0.0, 0.0, 1.0 if kind != "Sun" else 10.0))))

    def _model(self, event: Any, name: str) -> None:
        if name not in self._models:
            raise Refused(f"{name} is not on the model path any more; GAZEBO_MODEL_PATH says where models are looked for.")
        try:
            with open(self._models[name], encoding="utf-8") as stream:
                text = stream.read()
            model, _ = read_model(text, name=name, finder=self.simulation.finder(), file=self._models[name])
        except (OSError, UnicodeDecodeError, DescriptionError) as error:
            raise Refused(f"{self._models[name]}: {error}") from error
        self._put(event, Thing(name, text, Pose(), model))

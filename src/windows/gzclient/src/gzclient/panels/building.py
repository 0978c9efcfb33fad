"""The building editor: walls, doors, windows and stairs, drawn on a sheet in the page."""

from __future__ import annotations

import io
import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from building_editor import preview, sdf_model
from building_editor.building import PlanError
from ode_sim.description.materials import NAMES
from ode_sim.description.model import one_line
from ode_sim.math3 import Pose
from ode_sim_viewer.eye import put_eye
from ode_sim_viewer.panels.base import Panel, counted, note
from ode_sim_viewer.simulation import Refused
from PIL import Image

from gzclient.building import files
from gzclient.building.drawing import PlanDrawing
from gzclient.building.place import PlaceControls
from gzclient.building.plan import SNAP, Element, Plan, Point

_TOOLS = ("Wall", "Door", "Window", "Stairs", "Move", "Delete", "Pick")
_NONE = "(none is saved)"
_LARGEST = 16_000_000  # pixels of a floor plan
_SINGULAR = {"walls": "wall", "doors": "door", "windows": "window", "stairs": "stairs"}
_USUAL_LOOK = "Gazebo/CeilingTiled"


class BuildingPanel(Panel):
    """Nothing of it is in the scene while the box *Edit a building* is not checked."""

    title = "Building"

    def __init__(self, page: Any):
        super().__init__(page)
        self._plan = Plan()
        self._drawing: PlanDrawing | None = None
        self._picked: Element | None = None
        self._left: tuple[str, ...] = ()  # what a model has that this plan of it has not
        self._start: Point | None = None  # of the wall that clicks are drawing
        self._drag: tuple[Element | None, str, Point] | None = None
        self._busy = False  # the controls are being set by the program
        self._picture: np.ndarray | None = None
        gui = self.gui
        self._on = gui.add_checkbox("Edit a building", False, hint="the world is hidden meanwhile, and runs on")
        self._tool = gui.add_dropdown(
            "Tool",
            _TOOLS,
            hint="Wall: drag from end to end, or click along a path and on its last point again. Door, "
            "Window: click on a wall. Move: drag a wall, its end, a door. Pick: its measures below",
        )
        self._views = gui.add_button_group("View", ("Plan", "3-D"))
        self._history = gui.add_button_group("History", ("Undo", "Redo"))
        self._level = gui.add_dropdown("Level", ("0",))
        self._levels = gui.add_button_group("Levels", ("Add level", "Remove level"))
        self._note = gui.add_html(note("nothing is drawn yet"))
        self._add_measures()
        self._add_files()
        self._paper = gui.add_folder("Plan", visible=False)
        self._sketch: Any = None
        self.on_update(self._on, lambda on: page.later(lambda: self._switch(bool(on))))
        self._views.on_click(self._on_view)
        self._history.on_click(lambda event: self._do(event, {"Undo": self._plan.undo, "Redo": self._plan.redo}[event.target.value]))
        self._levels.on_click(
            lambda event: self._do(event, {"Add level": self._plan.add_level, "Remove level": self._plan.remove_level}[event.target.value])
        )
        self.on_update(self._level, lambda value: page.later(lambda: self._go_to_level(int(value))))
        self.on_update(self._tool, lambda value: page.later(self._end_path))

    def _add_measures(self) -> None:
        gui = self.gui
        with gui.add_folder("Snap", expand_by_default=False):
            self._snap = gui.add_number("Length (m)", SNAP, min=0.0, max=10.0, step=0.05, hint="0: none")
            self._angle = gui.add_number("Angle (deg)", 15.0, min=0.0, max=90.0, step=1.0, hint="0: none")
        self._folder = gui.add_folder("Next wall")
        with self._folder:
            self._thickness = gui.add_number("Thickness (m)", 0.15, min=0.01, max=5.0, step=0.01)
            self._height = gui.add_number("Height (m)", 2.5, min=0.1, max=50.0, step=0.1)
            self._material = gui.add_dropdown("Material", NAMES, initial_value=_USUAL_LOOK)
            self._coloured = gui.add_checkbox("Colour in its place", False)
            self._colour = gui.add_rgb("Colour", (220, 210, 190))
        with gui.add_folder("Next door, window, stairs", expand_by_default=False):
            self._door = gui.add_vector2("Door w, h (m)", (0.9, 2.0), min=(0.1, 0.1), step=0.05)
            self._window = gui.add_vector3("Window w, h, sill (m)", (0.8, 0.8, 0.5), min=(0.1, 0.1, 0.0), step=0.05)
            self._stairs = gui.add_vector3("Stairs w, length, h (m)", (1.0, 3.5, 2.5), min=(0.2, 0.2, 0.2), step=0.1)
            self._steps = gui.add_number("Steps", 15, min=1, max=200, step=1)
            self._yaw = gui.add_number("Stairs climb to (deg)", 0.0, step=15.0)
        self._place = PlaceControls(gui, self.on_update, lambda change: self.page.later(lambda: self._move_picked(change)))
        for control in (
            self._thickness,
            self._height,
            self._material,
            self._coloured,
            self._colour,
            self._door,
            self._window,
            self._stairs,
            self._steps,
            self._yaw,
        ):
            self.on_update(control, lambda value: self._busy or self.page.later(self._change_picked))
        for control in (self._snap, self._angle):
            self.on_update(control, lambda value: self.page.later(self._set_snap))

    def _add_files(self) -> None:
        gui = self.gui
        self._name = gui.add_text("Name", "building", hint=f"saved into ~/{files.FOLDER}/NAME")
        self._save = gui.add_button("Save", hint="plan.yaml, model.sdf, model.config, NAME.world")
        saved = tuple(files.names()) or (_NONE,)
        self._saved = gui.add_dropdown("Saved", saved)
        self._open = gui.add_button_group("Saved buildings", ("Open", "New"))
        self._put = gui.add_button("Put into the world")
        with gui.add_folder("Floor plan to draw over", expand_by_default=False):
            self._upload = gui.add_upload_button("Picture (PNG, JPEG)", mime_type="image/*")
            self._resolution = gui.add_number("Metres per pixel", 0.02, min=1e-4, max=10.0, step=0.001)
            self._scale = gui.add_number(
                "Scale: last drawn wall is (m)",
                0.0,
                min=0.0,
                max=1000.0,
                step=0.1,
                hint="draw a wall over a line of the picture whose length is known, and say it",
            )
            self._clear = gui.add_button("Remove picture")
        self.on_click(self._save, self._save_now)
        self._open.on_click(lambda event: self._do(event, self._open_now if event.target.value == "Open" else self._new))
        self.on_click(self._put, self._put_into_world)
        self._upload.on_upload(lambda event: self.page.attempt(event, lambda: self._take_picture(event.target.value)))
        self.on_update(self._resolution, lambda value: self.page.later(self._show_picture))
        self.on_update(self._scale, lambda value: self.page.later(lambda: self._rescale(float(value))))
        self.on_click(self._clear, lambda: self.page.later(self._drop_picture))

    # ------------------------------------------------------------------------------------------ on and off

    def _switch(self, on: bool) -> None:
        if on == (self._drawing is not None):
            return
        self.page.drawing.hide(on)
        self.page.selection.select()  # its handles would stay
        if on:
            self._drawing = PlanDrawing(self.page.server.scene, self._listen)
            self._refresh()
            self._show_picture()
            for client in self.page.server.get_clients().values():
                self._look(client, "Plan")
        elif self._drawing is not None:
            self._drawing.close()
            self._drawing = None

    def _on_view(self, event: Any) -> None:
        if event.client is not None:
            self._look(event.client, event.target.value)
            self.page.later(self._refresh)

    def _look(self, client: Any, view: str) -> None:
        """From above, north up, or from a corner; all that is drawn is seen."""
        corners = [
            point
            for level in range(self._plan.levels)
            for wall in self._plan.part(level).get("walls") or []
            for point in (wall["from"], wall["to"])
        ] or [(-4.0, -3.0), (4.0, 3.0)]
        low, high = np.min(corners, axis=0) - 1.0, np.max(corners, axis=0) + 1.0
        middle, size = (low + high) / 2, float(np.max(high - low))
        base = self._plan.base(self._plan.level)
        away = (0.0, -0.001, 1.3) if view == "Plan" else (0.6, -0.9, 0.8)
        put_eye(client, [m + size * a for m, a in zip((*middle, base), away)], (*middle, base))

    def _do(self, event: Any, f: Callable[[], Any]) -> None:
        """A button: in the drawing thread, for a page that may act."""

        def act() -> None:
            self.page.attempt(event, f)
            self._picked = self._picked if self._picked is not None and self._plan.has(self._picked) else None
            self._show_picked()
            self._refresh()

        self.page.later(act)

    def _refresh(self) -> None:
        """All that shows the plan."""
        plan = self._plan
        building = plan.building()
        if self._drawing is not None:
            with self.page.server.atomic():
                self._drawing.sheet(plan.base(plan.level), plan.snap)
                self._drawing.show(plan, building, self._picked, self._views.value == "3-D")
        self._busy = True
        self._level.options = tuple(str(number) for number in range(plan.levels))
        self._level.value = str(plan.level)
        self._busy = False
        walls = sum(len(level.walls) for level in building.levels) if building is not None else 0
        said = f"{counted(walls, 'wall')} on {counted(plan.levels, 'level')}" if walls else "nothing is drawn yet"
        if self._left:
            said += one_line(f"; not understood, and lost when it is saved under this name: {', '.join(self._left)}", 300)
        self._note.content = note(said)
        self._paper.visible = building is not None
        if building is not None:
            self._show_sketch(np.asarray(preview.draw(building, 400)))

    def _show_sketch(self, picture: np.ndarray) -> None:
        if self._sketch is None:
            with self._paper:
                self._sketch = self.gui.add_image(picture, format="png")
        else:
            self._sketch.image = picture

    # ------------------------------------------------------------------------------------------ the hand

    def _listen(self, mesh: Any, element: Element | None) -> None:
        async def on_click(event: Any) -> None:
            self.page.later(lambda: self.page.attempt(event, lambda: self._click(event, element)))

        async def on_drag(event: Any) -> None:
            start, end, phase = event.start_position, event.end_position, event.phase
            self.page.later(lambda: self.page.attempt(event, lambda: self._dragged(event, element, phase, start, end)))

        mesh.on_click(on_click)
        mesh.on_drag(on_drag)

    def _on_sheet(self, origin: Any, direction: Any) -> Point:
        """Where a ray meets the floor of the level."""
        height = self._plan.base(self._plan.level)
        if abs(direction[2]) < 1e-6:
            raise Refused("Look at the sheet from above.")
        way = (height - origin[2]) / direction[2]
        return float(origin[0] + way * direction[0]), float(origin[1] + way * direction[1])

    def _click(self, event: Any, element: Element | None) -> None:
        point, tool = self._on_sheet(event.ray_origin, event.ray_direction), self._tool.value
        if tool == "Wall":
            self._click_wall(point)
        elif tool in ("Door", "Window"):
            self._add_opening(tool, element, point)
        elif tool == "Stairs":
            self._picked = self._plan.add_stairs(point, math.radians(float(self._yaw.value)), **self._stairs_settings())
        elif tool == "Delete" and element is not None:
            self._picked = None
            self._plan.delete(element)
        elif tool in ("Pick", "Move"):
            self._picked = element
        self._show_picked()
        self._refresh()

    def _ghost(self, line: tuple[Point, Point], thickness: float) -> None:
        if self._drawing is not None:
            self._drawing.ghost(line, self._plan.base(self._plan.level), thickness)

    def _click_wall(self, point: Point) -> None:
        if self._start is None:
            self._start = self._plan.snap_point(point)
            self._ghost((self._start, self._start), 0.3)
            return
        if math.dist(self._start, self._plan.snap_point(point)) < 1e-6:
            self._end_path()
            return
        end = self._plan.snap_end(self._start, point)
        self._plan.add_wall(self._start, end, **self._wall_settings())
        self._start = end
        self._ghost((end, end), 0.3)

    def _end_path(self) -> None:
        self._start = self._drag = None
        if self._drawing is not None:
            self._drawing.ghost(None)

    def _add_opening(self, tool: str, element: Element | None, point: Point) -> None:
        if element is None or (element.kind != "walls" and element.wall < 0) or element.level != self._plan.level:
            raise Refused(f"Click on a wall of level {self._plan.level}: a {tool.lower()} is a hole in it.")
        wall = element.index if element.kind == "walls" else element.wall
        settings = (
            dict(zip(("width", "height"), map(float, self._door.value)))
            if tool == "Door"
            else dict(zip(("width", "height", "sill"), map(float, self._window.value)))
        )
        self._picked = self._plan.add_opening(tool.lower() + "s", wall, point, **settings)

    def _dragged(self, event: Any, element: Element | None, phase: str, start: Any, end: Any) -> None:
        eye = np.asarray(event.client.camera.position)
        begin = self._on_sheet(eye, np.subtract(start, eye))
        point = self._on_sheet(eye, np.subtract(end, eye))
        tool = self._tool.value
        if tool not in ("Wall", "Move") or tool == "Move" and element is None:
            return
        if phase == "start" or self._drag is None:
            self._end_path()
            of_wall = tool == "Move" and element is not None and element.kind == "walls"
            grip = self._plan.grip(element.index, begin) if element is not None and of_wall else ""
            self._drag = (element, grip, self._plan.snap_point(begin) if tool == "Wall" else begin)
        element, grip, begin = self._drag
        line = (begin, self._plan.snap_end(begin, point) if tool == "Wall" else point)
        if phase != "end":
            self._ghost(line, float(self._thickness.value))
            return
        self._end_path()
        try:
            if tool == "Wall":
                self._picked = self._plan.add_wall(*line, **self._wall_settings())
            elif element is not None:
                self._plan.move(element, grip, begin, point)
        finally:
            self._show_picked()
            self._refresh()

    # ------------------------------------------------------------------------------------------ measures

    def _wall_settings(self) -> dict:
        coloured = bool(self._coloured.value)
        return {
            "thickness": float(self._thickness.value),
            "height": float(self._height.value),
            "material": None if coloured else self._material.value,
            "color": tuple(part / 255 for part in self._colour.value) if coloured else None,
        }

    def _stairs_settings(self) -> dict:
        width, depth, height = map(float, self._stairs.value)
        looks = self._wall_settings()
        return {
            "width": width,
            "depth": depth,
            "height": height,
            "steps": int(self._steps.value),
            "material": looks["material"],
            "color": looks["color"],
        }

    def _set_snap(self) -> None:
        self._plan.snap, self._plan.snap_angle = float(self._snap.value), math.radians(float(self._angle.value))
        self._refresh()

    def _show_picked(self) -> None:
        """The measures of what is picked, in the controls."""
        self._place.show(self._plan, self._picked)
        if self._picked is None:
            self._folder.label = "Next wall"
            return
        element = self._plan.element(self._picked)
        self._folder.label = f"Picked: {_SINGULAR[self._picked.kind]}"
        self._busy = True
        try:
            if self._picked.kind == "walls":
                self._thickness.value = float(element.get("thickness", 0.15))
                self._height.value = float(element.get("height", 2.5))
                self._coloured.value = "color" in element
                if "color" in element:
                    self._colour.value = tuple(int(round(255 * part)) for part in element["color"])
                elif element.get("material") in NAMES:
                    self._material.value = element["material"]
            elif self._picked.kind == "doors":
                self._door.value = (float(element.get("width", 0.9)), float(element.get("height", 2.0)))
            elif self._picked.kind == "windows":
                self._window.value = tuple(
                    float(element.get(key, usual)) for key, usual in (("width", 0.8), ("height", 0.8), ("sill", 0.5))
                )
            else:
                self._stairs.value = tuple(
                    float(element.get(key, usual)) for key, usual in (("width", 1.0), ("depth", 3.5), ("height", 2.5))
                )
                self._steps.value = int(element.get("steps", 15))
                self._yaw.value = math.degrees(float(element.get("yaw", 0.0)))
        finally:
            self._busy = False

    def _change_picked(self) -> None:
        """The controls were changed: so is what is picked."""
        picked = self._picked
        if picked is None:
            return
        if picked.kind == "walls":
            settings = self._wall_settings()
        elif picked.kind == "doors":
            settings = dict(zip(("width", "height"), map(float, self._door.value)))
        elif picked.kind == "windows":
            settings = dict(zip(("width", "height", "sill"), map(float, self._window.value)))
        else:
            settings = {**self._stairs_settings(), "yaw": math.radians(float(self._yaw.value))}
        try:
            self._plan.change(picked, **settings)
        except Refused as error:
            self._note.content = note(str(error))
            return
        self._refresh()

    def _move_picked(self, change: Callable[[], None]) -> None:
        if self._picked is not None:
            try:
                change()
            except Refused as error:
                self._note.content = note(str(error))
                return
            self._refresh()

    def _go_to_level(self, level: int) -> None:
        if not self._busy and 0 <= level < self._plan.levels:
            self._plan.level, self._picked = level, None
            self._end_path()
            self._show_picked()
            self._refresh()

    # ------------------------------------------------------------------------------------------ files

    def _save_now(self) -> None:
        self._plan.document["name"] = files.checked_name(self._name.value.strip())
        target, self._left = files.save(self._plan.document), ()
        self._saved.options = tuple(files.names()) or (_NONE,)
        self.page.models_changed()
        self._note.content = note(f"saved in {target}")

    def _open_now(self) -> None:
        if self._saved.value == _NONE:
            raise Refused(f"No building is saved in ~/{files.FOLDER}.")
        self._take(*files.load(self._saved.value))

    def _new(self) -> None:
        self._take(None)

    def _take(self, document: dict | None, left: Sequence[str] = ()) -> None:
        try:
            plan = Plan(document)
        except PlanError as error:
            raise Refused(str(error)) from error
        plan.snap, plan.snap_angle = self._plan.snap, self._plan.snap_angle
        self._plan, self._picked, self._left = plan, None, tuple(left)
        self._end_path()
        self._name.value = str(plan.document.get("name", "building"))

    def _put_into_world(self) -> None:
        self._plan.document["name"] = files.checked_name(self._name.value.strip())
        try:
            building = self._plan.building()
        except PlanError as error:
            raise Refused(str(error)) from error
        if building is None:
            raise Refused("Nothing is drawn yet.")
        # its origin is the middle of the building: the text has its pose
        self.page.selection.insert(building.name, sdf_model.model_text(building), Pose())

    # ------------------------------------------------------------------------------------------ floor plan

    def _take_picture(self, upload: Any) -> None:
        try:
            picture = Image.open(io.BytesIO(upload.content))
            if picture.width * picture.height > _LARGEST:  # known before anything is unpacked
                raise Refused(f"{upload.name} has {picture.width}x{picture.height} pixels; at most {_LARGEST} are taken.")
            self._picture = np.asarray(picture.convert("RGB"))
        except (OSError, SyntaxError, ValueError) as error:
            raise (
                error if isinstance(error, Refused) else Refused(f"{upload.name} is no picture that can be read; PNG and JPEG can.")
            ) from error
        self.page.later(self._show_picture)

    def _show_picture(self) -> None:
        if self._drawing is not None:
            self._drawing.picture(self._picture, float(self._resolution.value))

    def _drop_picture(self) -> None:
        self._picture = None
        self._show_picture()

    def _rescale(self, length: float) -> None:
        """The last wall was drawn over a line of the picture that is ``length`` m long: the picture grows, the wall
        goes."""
        walls = self._plan.part(self._plan.level).get("walls") or []
        if length <= 0.0 or not walls:
            return
        drawn = math.dist(walls[-1]["from"], walls[-1]["to"])
        self._plan.delete(Element(self._plan.level, "walls", len(walls) - 1))
        self._resolution.value = float(self._resolution.value) * length / drawn
        self._scale.value = 0.0
        self._show_picture()
        self._refresh()

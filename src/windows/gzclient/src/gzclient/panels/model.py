"""The model editor: links of shapes and meshes, joined by clicks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from ode_sim.description import model as d
from ode_sim.math3 import Pose, vec3
from ode_sim_viewer.eye import put_eye
from ode_sim_viewer.panels.base import Panel, counted, note
from ode_sim_viewer.shapes import Simple
from ode_sim_viewer.simulation import Refused

from gzclient.modelling import draft
from gzclient.modelling.draft import JOINTS, Draft
from gzclient.modelling.drawing import ModelSketch

_NONE = "(none is saved)"
_SHAPES: dict[str, Simple] = {"Box": d.Box((0.5, 0.5, 0.5)), "Sphere": d.Sphere(0.25), "Cylinder": d.Cylinder(0.2, 0.5)}
_LIMITLESS = 1e16
_MOST_LIMIT = 1000.0  # typed limits beyond are none


class ModelPanel(Panel):
    """Nothing of it is in the scene while the box *Edit a model* is not checked."""

    title = "Model"

    def __init__(self, page: Any):
        super().__init__(page)
        self._draft = Draft()
        self._sketch: ModelSketch | None = None
        self._picked = ""
        self._ends: list[str] = []  # of the joint that clicks are making
        self._busy = False  # the controls are being set by the program
        gui = self.gui
        self._on = gui.add_checkbox("Edit a model", False, hint="the world is hidden meanwhile, and runs on")
        self._shapes = gui.add_button_group("Add", tuple(_SHAPES))
        self._upload = gui.add_upload_button("Add a mesh (STL, OBJ, DAE)", mime_type="*/*")
        self._history = gui.add_button_group("History", ("Undo", "Redo"))
        self._note = gui.add_html(note("add a shape; a click picks it"))
        self._add_link_controls()
        self._add_joint_controls()
        with gui.add_folder("Plugin", expand_by_default=False):
            self._plugin = gui.add_text("Plugin name", "")
            self._library = gui.add_text("File name", "", hint="libgazebo_ros_p3d.so")
            self._parameters = gui.add_text("Parameters (XML)", "", multiline=True)
            gui.add_button("Add plugin").on_click(
                lambda event: self._act(
                    event, lambda: self._draft.add_plugin(self._plugin.value, self._library.value, self._parameters.value)
                )
            )
        self._name = gui.add_text("Model name", "my_model", hint=f"saved into ~/{draft.FOLDER}/NAME")
        self._static = gui.add_checkbox("Static", False)
        self._save = gui.add_button("Save model", hint="model.sdf, model.config")
        self._saved = gui.add_dropdown("Saved models", tuple(draft.names()) or (_NONE,))
        self._open = gui.add_button_group("Models", ("Open model", "New model"))
        self._put = gui.add_button("Put model into the world")
        self._listen()

    def _add_link_controls(self) -> None:
        gui = self.gui
        self._folder = gui.add_folder("No link is picked")
        with self._folder:
            self._link_name = gui.add_text("Link name", "")
            self._size = gui.add_vector3(
                "Size (m)", (0.5, 0.5, 0.5), step=0.05, hint="box: x y z; sphere: radius; cylinder: radius, -, length; mesh: scale"
            )
            self._mass = gui.add_number("Mass of it (kg)", 1.0, min=1e-6, step=0.1, hint="the inertia is the shape's")
            self._colour = gui.add_rgb("Colour of it", (180, 180, 180))
            self._delete = gui.add_button("Delete link")
        for control in (self._size, self._mass, self._colour):
            self.on_update(control, lambda value: self._unless_busy(self._set_shape))
        self.on_update(self._link_name, lambda value: self._unless_busy(lambda: self._rename(value)))
        self.on_click(self._delete, lambda: self._later(self._delete_picked))

    def _add_joint_controls(self) -> None:
        gui = self.gui
        with gui.add_folder("Joint"):
            self._kind = gui.add_dropdown("Type", JOINTS)
            self._axis = gui.add_vector3("Axis", (0.0, 0.0, 1.0), step=0.1, hint="in the child's frame")
            self._anchor = gui.add_vector3("Anchor (m)", (0.0, 0.0, 0.0), step=0.05, hint="in the child's frame")
            self._limits = gui.add_vector2(
                "Limits", (-_MOST_LIMIT, _MOST_LIMIT), step=0.1, hint=f"rad or m; from {_MOST_LIMIT:g} on there is none"
            )
            self._join = gui.add_checkbox("Join by clicks", False, hint="on the parent, then on the child")
            self._fix = gui.add_button("Fix the picked link to the world")
            self._joint = gui.add_dropdown("Joints", ("(none)",))
            self._unjoin = gui.add_button("Delete joint")
        self.on_update(self._join, lambda on: self._later(self._ends.clear))
        self.on_click(self._fix, lambda: self._later(lambda: self._draft.add_joint("fixed", "world", self._picked)))
        self.on_click(self._unjoin, lambda: self._later(lambda: self._draft.delete(self._joint.value)))

    def _listen(self) -> None:
        page = self.page
        self.on_update(self._on, lambda on: page.later(lambda: self._switch(bool(on))))
        self._shapes.on_click(lambda event: self._act(event, lambda: self._pick(self._draft.add_link(_SHAPES[event.target.value]))))
        self._upload.on_upload(
            lambda event: self._act(
                event,
                lambda: self._pick(
                    self._draft.add_link(draft.keep_mesh(self._name.value.strip(), event.target.value.name, event.target.value.content))
                ),
            )
        )
        self._history.on_click(lambda event: self._act(event, self._draft.undo if event.target.value == "Undo" else self._draft.redo))
        self._save.on_click(lambda event: self._act(event, self._save_now))
        self._open.on_click(
            lambda event: self._act(
                event,
                lambda: self._take(
                    Draft.load(self._saved.value, page.simulation.finder()) if event.target.value == "Open model" else Draft()
                ),
            )
        )
        self._put.on_click(lambda event: self._act(event, self._put_into_world))

    # ------------------------------------------------------------------------------------------ drawing

    def _act(self, event: Any, f: Callable[[], Any]) -> None:
        """In the drawing thread, for a page that may act."""

        def act() -> None:
            self.page.attempt(event, f)
            self._refresh()

        self.page.later(act)

    def _unless_busy(self, f: Callable[[], Any]) -> None:
        if not self._busy:
            self._later(f)

    def _later(self, f: Callable[[], Any]) -> None:
        """The same where the page has been asked already; a refusal is a line in the tab."""

        def act() -> None:
            try:
                f()
                self._refresh()
            except Refused as error:
                self._note.content = note(str(error))

        self.page.later(act)

    def _switch(self, on: bool) -> None:
        if on == (self._sketch is not None):
            return
        self.page.drawing.hide(on)
        self.page.selection.select()  # its handles would stay
        if on:
            self._sketch = ModelSketch(self.page.server.scene, self._click, self._move)
            for client in self.page.server.get_clients().values():
                put_eye(client, (2.5, -2.5, 2.0), (0.5, 0.0, 0.5))
        elif self._sketch is not None:
            self._sketch.close()
            self._sketch = None
        self._refresh()

    def _refresh(self) -> None:
        model = self._draft.model
        if self._picked not in {link.name for link in model.links}:
            self._picked = ""
        if self._sketch is not None:
            with self.page.server.atomic():
                self._sketch.show(model, self._picked, not self._join.value)
        self._joint.options = tuple(joint.name for joint in model.joints) or ("(none)",)
        parts = ((model.links, "link"), (model.joints, "joint"), (model.plugins, "plugin"))
        self._note.content = note(
            ", ".join(counted(len(some), thing) for some, thing in parts) + (f"; joint of {self._ends[0]} and ...?" if self._ends else "")
        )
        self._folder.label = f"Link {self._picked}" if self._picked else "No link is picked"

    # ------------------------------------------------------------------------------------------ the hand

    def _click(self, event: Any, link: str) -> None:
        self._act(event, lambda: self._join_by(link) if self._join.value else self._pick(link))

    def _join_by(self, link: str) -> None:
        self._ends.append(link)
        if len(self._ends) < 2:
            return
        (parent, child), self._ends = self._ends, []
        low, high = (float(value) for value in self._limits.value)
        self._draft.add_joint(
            self._kind.value,
            parent,
            child,
            vec3(self._axis.value),
            (low if low > -_MOST_LIMIT else -_LIMITLESS, high if high < _MOST_LIMIT else _LIMITLESS),
            vec3(self._anchor.value),
        )

    def _move(self, event: Any, link: str, position: tuple, wxyz: tuple) -> None:
        """The gizmo; one step of the history for each drag."""
        pose, phase = Pose(position, (wxyz[1], wxyz[2], wxyz[3], wxyz[0])), event.phase
        if phase == "end":
            self._act(event, lambda: self._draft.set_pose(link, pose))
        else:
            self.page.later(lambda: self._place(link, pose))

    def _place(self, link: str, pose: Pose) -> None:
        if self._sketch is not None:
            self._sketch.place(link, pose)

    def _pick(self, link: str) -> None:
        """Its measures in the controls."""
        self._picked, made = link, self._draft.link(link)
        shape = made.collisions[0].geometry if made.collisions else None
        self._busy = True
        try:
            self._link_name.value = link
            self._mass.value = float(made.inertial.mass)
            self._size.value = tuple(map(float, _measures(shape)))
            colour = made.visuals[0].material.diffuse if made.visuals and made.visuals[0].material else None
            if colour:
                self._colour.value = tuple(int(round(255 * part)) for part in colour[:3])
        finally:
            self._busy = False

    def _set_shape(self) -> None:
        if self._picked:
            old = self._draft.link(self._picked).collisions
            shape = _with_measures(old[0].geometry if old else None, vec3(self._size.value))
            red, green, blue = (part / 255 for part in self._colour.value)
            self._draft.set_shape(self._picked, shape, float(self._mass.value), (red, green, blue, 1.0))

    def _rename(self, name: str) -> None:
        if self._picked and name != self._picked:
            self._draft.rename_link(self._picked, name.strip())
            self._picked = name.strip()

    def _delete_picked(self) -> None:
        if not self._picked:
            raise Refused("Click on a link first.")
        self._draft.delete(self._picked)

    # ------------------------------------------------------------------------------------------ files

    def _save_now(self) -> None:
        self._draft.model = replace(self._draft.model, static=bool(self._static.value))
        target = self._draft.save(self._name.value.strip())
        self._saved.options = tuple(draft.names()) or (_NONE,)
        self.page.models_changed()
        self.page.later(lambda: setattr(self._note, "content", note(f"saved in {target}")))

    def _take(self, made: Draft) -> None:
        self._draft, self._picked = made, ""
        self._ends.clear()
        self._name.value, self._static.value = made.model.name, made.model.static

    def _put_into_world(self) -> None:
        name = draft.checked_name(self._name.value.strip())
        self._draft.model = replace(self._draft.model, static=bool(self._static.value))
        self.page.selection.insert(name, self._draft.text(name), Pose())


def _measures(shape: d.Geometry) -> tuple:
    if isinstance(shape, d.Sphere):
        return shape.radius, 0.0, 0.0
    if isinstance(shape, d.Cylinder):
        return shape.radius, 0.0, shape.length
    return shape.scale if isinstance(shape, d.Mesh) else shape.size if isinstance(shape, d.Box) else (0.0, 0.0, 0.0)


def _with_measures(shape: d.Geometry, sizes: d.Vec3) -> draft.Solid:
    """:raises Refused: a shape that has other measures."""
    if isinstance(shape, d.Sphere):
        return d.Sphere(sizes[0])
    if isinstance(shape, d.Cylinder):
        return d.Cylinder(sizes[0], sizes[2])
    if isinstance(shape, d.Mesh):
        return replace(shape, scale=sizes)
    if isinstance(shape, d.Box):
        return d.Box(sizes)
    raise Refused("This link's shape is changed in its file: only boxes, spheres, cylinders and meshes are here.")

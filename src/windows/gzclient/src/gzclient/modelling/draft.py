"""A model that is being made: what a hand does to it, step by step, and back; kept as upstream's editor keeps it."""

from __future__ import annotations

import os
import re
import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import replace

import lenient_xml
import numpy as np
from ode_sim.description import DescriptionError, ResourceFinder, read_sdf_model
from ode_sim.description import model as d
from ode_sim.description.sdf_writer import model_text
from ode_sim.math3 import Pose, vec3
from ode_sim.whole_files import write_whole
from ode_sim_viewer.panels.base import free_name
from ode_sim_viewer.shapes import Simple, shape_model
from ode_sim_viewer.simulation import Refused

from gzclient.modelling import meshes

Solid = Simple | d.Mesh  # what the editor makes
#: As upstream's editor names it, in the home folder.
FOLDER = "model_editor_models"
JOINTS = ("revolute", "prismatic", "fixed", "ball", "universal", "revolute2", "screw")
AXES = {"revolute": 1, "prismatic": 1, "screw": 1, "universal": 2, "revolute2": 2}
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_. -]{0,80}")
_MOST_STEPS = 200  # that can be undone
_MOST_LINKS = 500


class Draft:
    """:ivar model: as it is now. Every change is one step of the history; what is refused changes nothing."""

    def __init__(self, model: d.Model | None = None):
        self.model = model or d.Model("my_model")
        self._past: list[d.Model] = []
        self._future: list[d.Model] = []

    # ------------------------------------------------------------------------------------------ history

    def _set(self, **changes) -> None:
        self._past = self._past[1 - _MOST_STEPS :] + [self.model]
        self._future.clear()
        self.model = replace(self.model, **changes)

    def undo(self) -> None:
        self._turn(self._past, self._future, "undo")

    def redo(self) -> None:
        self._turn(self._future, self._past, "do again")

    def _turn(self, source: list[d.Model], target: list[d.Model], verb: str) -> None:
        if not source:
            raise Refused(f"There is nothing to {verb}.")
        target.append(self.model)
        self.model = source.pop()

    # ------------------------------------------------------------------------------------------ links

    def link(self, name: str) -> d.Link:
        """:raises Refused: there is none."""
        found = next((link for link in self.model.links if link.name == name), None)
        if found is None:
            raise Refused(f"There is no link '{name}' any more.")
        return found

    def add_link(self, shape: Solid, mass: float = 1.0) -> str:
        """A body of one ``shape`` and ``mass`` (kg) beside the others, its inertia that of the shape; its name."""
        if len(self.model.links) >= _MOST_LINKS:
            raise Refused(f"A model has at most {_MOST_LINKS} links here.")
        name = free_name("link", {link.name for link in self.model.links})
        place = max((link.pose.p[0] for link in self.model.links), default=-1.0) + 1.0
        made = _body(name, shape, mass)
        self._set(links=self.model.links + (replace(made, pose=Pose((place, 0.0, 0.5))),))
        return name

    def change_link(self, name: str, f: Callable[[d.Link], d.Link]) -> None:
        """Put ``f(link)`` in the place of the link ``name``.

        :raises Refused: there is none, or no body can be so.
        """
        made = f(self.link(name))
        self._set(links=tuple(made if link.name == name else link for link in self.model.links))

    def set_pose(self, name: str, pose: Pose) -> None:
        """Put the link ``name`` at ``pose``, X_ML."""
        self.change_link(name, lambda link: replace(link, pose=pose))

    def set_shape(self, name: str, shape: Solid, mass: float, colour: d.Rgba | None = None) -> None:
        """Other measures: the inertia follows.

        :param name: of the link
        :param shape: the only one that it has then
        :param mass: kg
        :param colour: None: as it was
        :raises Refused: a size or the mass is not above 0
        """
        if not (mass > 0.0 and np.isfinite(mass)):
            raise Refused("A mass is more than 0.")
        sizes = [value for field in ("size", "radius", "length", "scale") for value in np.ravel(getattr(shape, field, ()))]
        if not all(np.isfinite(value) and 1e-6 < value < 1e5 for value in sizes):
            raise Refused("The sizes of a shape are more than 0.")
        material = d.Material(ambient=colour, diffuse=colour) if colour else None

        def change(link: d.Link) -> d.Link:
            made = _body(name, shape, mass)
            visual = replace(made.visuals[0], material=material or (link.visuals[0].material if link.visuals else None))
            return replace(link, inertial=made.inertial, collisions=made.collisions, visuals=(visual,))

        self.change_link(name, change)

    def rename_link(self, old: str, new: str) -> None:
        """Give the link ``old`` the name ``new``, in its joints too.

        :raises Refused: ``new`` is no name or is taken, or there is no link ``old``
        """
        new = checked_name(new)
        if new in {link.name for link in self.model.links} or new == "world":
            raise Refused(f"There is a link '{new}' already.")
        self.link(old)
        self._set(
            links=tuple(replace(link, name=new) if link.name == old else link for link in self.model.links),
            joints=tuple(
                replace(joint, parent=new if joint.parent == old else joint.parent, child=new if joint.child == old else joint.child)
                for joint in self.model.joints
            ),
        )

    def delete(self, name: str) -> None:
        """A link with its joints, or a joint."""
        self._set(
            links=tuple(link for link in self.model.links if link.name != name),
            joints=tuple(joint for joint in self.model.joints if name not in (joint.name, joint.parent, joint.child)),
        )

    # ------------------------------------------------------------------------------------------ joints, plugins

    def add_joint(
        self,
        kind: str,
        parent: str,
        child: str,
        axis: d.Vec3 = (0.0, 0.0, 1.0),
        limits: tuple[float, float] = (-1e16, 1e16),
        anchor: d.Vec3 = (0.0, 0.0, 0.0),
    ) -> str:
        """Its name.

        :param kind: one of JOINTS
        :param parent: a link, or ``world``
        :param child: a link
        :param axis: its direction, in the child's frame; any length
        :param limits: rad or m
        :param anchor: where the joint is, in the child's frame, m
        :raises Refused: no such links, or the child hangs on another one already
        """
        if kind not in JOINTS:
            raise Refused(f"A joint is one of {', '.join(JOINTS)}.")
        if parent != "world":
            self.link(parent)
        self.link(child)
        if parent == child:
            raise Refused("A joint joins two links: click on the parent, then on the child.")
        if not all(np.isfinite(value) for value in anchor):
            raise Refused("A joint is at a place of the child.")
        if not np.linalg.norm(axis) > 1e-9 or not limits[0] <= limits[1]:
            raise Refused("An axis has a direction, and the lower limit is below the upper one.")
        above = {joint.child: joint.parent for joint in self.model.joints}
        here, seen = parent, {child}
        while here in above and here not in seen:
            seen.add(here)
            here = above[here]
        if child in above or here == child:
            raise Refused(f"'{child}' hangs on '{above.get(child, child)}' already.")
        name = free_name(f"{parent}_{child}", {joint.name for joint in self.model.joints})
        unit = vec3(np.asarray(axis, float) / np.linalg.norm(axis))
        axes = tuple(d.Axis(unit if number == 0 else _across(unit), *map(float, limits)) for number in range(AXES.get(kind, 0)))
        self._set(joints=self.model.joints + (d.Joint(name, kind, parent, child, Pose(anchor), axes),))
        return name

    def add_plugin(self, name: str, filename: str, parameters: str) -> None:
        """A plugin of the model.

        :param filename: of the library, such as ``libgazebo_ros_p3d.so``
        :param parameters: XML elements, as in a file
        :raises Refused: they are none, or ``name`` or ``filename`` is empty
        """
        if not name.strip() or not filename.strip():
            raise Refused("A plugin has a name and a file name, such as libgazebo_ros_p3d.so.")
        try:
            element = lenient_xml.fromstring(f"<plugin>{parameters}</plugin>")
        except ET.ParseError as error:
            raise Refused(f"The plugin's parameters are no XML: {error}") from error
        element.set("name", name.strip())
        element.set("filename", filename.strip())
        self._set(plugins=self.model.plugins + (d.Plugin(name.strip(), filename.strip(), element),))

    # ------------------------------------------------------------------------------------------ files

    def text(self, name: str) -> str:
        """SDF of the model under that name.

        :raises Refused: there is nothing in it
        """
        if not self.model.links:
            raise Refused("The model has no link yet.")
        return model_text(replace(self.model, name=name, pose=Pose()))

    def save(self, name: str) -> str:
        """``model.sdf``, ``model.config`` and its meshes, which are those of the folder from then on; the folder.

        :raises Refused: there is nothing in it, or it cannot be written
        """
        target = path_of(name)
        self.text(name)
        try:
            os.makedirs(target, exist_ok=True)
            self.model = meshes.gather(self.model, target, name, folder())
            text = self.text(name)
            for file, content in (("model.sdf", text), ("model.config", _config(name))):
                write_whole(os.path.join(target, file), content)
        except OSError as error:
            raise Refused(f"{error.filename or target}: {error.strerror or error}") from error
        except DescriptionError as error:  # a mesh has gone
            raise Refused(str(error)) from error
        return target

    @classmethod
    def load(cls, name: str, finder: ResourceFinder | None = None) -> Draft:
        """A model that was saved as ``name``.

        :param finder: of the meshes that it names
        :raises Refused: it cannot be read
        """
        file = os.path.join(path_of(name), "model.sdf")
        try:
            with open(file, encoding="utf-8") as stream:
                model, _ = read_sdf_model(stream.read(), finder=finder, file=file)
        except (OSError, UnicodeDecodeError, DescriptionError) as error:
            raise Refused(f"{name}: {error}") from error
        return cls(replace(model, pose=Pose()))


def folder() -> str:
    return os.path.join(os.path.expanduser("~"), FOLDER)


def path_of(name: str) -> str:
    return os.path.join(folder(), checked_name(name))


def checked_name(name: str) -> str:
    """:raises Refused: it is not the name of one folder, whatever a page sends."""
    if not _NAME.fullmatch(name):
        raise Refused("A name has letters, digits, - _ . and blanks, at most 80.")
    return name


def names() -> list[str]:
    """Of the models that can be opened."""
    try:
        return sorted(
            name for name in os.listdir(folder()) if _NAME.fullmatch(name) and os.path.isfile(os.path.join(folder(), name, "model.sdf"))
        )
    except OSError:
        return []


def keep_mesh(model: str, file: str, content: bytes) -> d.Mesh:
    """Write an uploaded mesh below the model's folder and read it once.

    :param model: its name
    :param file: name of the uploaded file
    :raises Refused: ``content`` is no mesh
    """
    return meshes.keep(path_of(model), checked_name(os.path.basename(file)), content)


def _body(name: str, shape: Solid, mass: float) -> d.Link:
    """Its inertia is that of the shape."""
    solid = shape_model(name, d.Box() if isinstance(shape, d.Mesh) else shape, mass).links[0]
    inertial = meshes.inertial(shape, mass) if isinstance(shape, d.Mesh) else solid.inertial
    return replace(
        solid,
        name=name,
        inertial=inertial,
        collisions=(d.Collision("collision", Pose(), shape),),
        visuals=(replace(solid.visuals[0], geometry=shape),),
    )


def _across(axis: d.Vec3) -> d.Vec3:
    """A unit vector at right angles."""
    other = (1.0, 0.0, 0.0) if abs(axis[0]) < 0.9 else (0.0, 1.0, 0.0)
    made = np.cross(axis, other)
    return vec3(made / np.linalg.norm(made))


def _config(name: str) -> str:
    root = ET.Element("model")
    for tag, text in (("name", name), ("version", "1.0"), ("description", "A model made in gzclient's editor.")):
        ET.SubElement(root, tag).text = text
    ET.SubElement(root, "sdf", version="1.6").text = "model.sdf"
    ET.indent(root)
    return '<?xml version="1.0"?>\n' + ET.tostring(root, encoding="unicode") + "\n"

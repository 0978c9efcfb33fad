"""Poses of SDF that refer to named frames (``frame`` up to SDF 1.6, ``relative_to`` in 1.7)."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from typing import TYPE_CHECKING

from ode_sim import math3
from ode_sim.description.model import Pose
from ode_sim.description.xmlsource import joint_end, source_of
from ode_sim.errors import DescriptionError, Source, quoted

if TYPE_CHECKING:
    from ode_sim.description.sdf_values import SdfValues

Nested = tuple[str, ET.Element, dict[str, Pose]]  # name, element, X_S of its own frames


def relative_to(pose: ET.Element | None) -> str:
    """The frame a ``<pose>`` names, '' for the usual one."""
    if pose is None:
        return ""
    return (pose.get("relative_to") or pose.get("frame") or "").strip()


def model_frames(reader: SdfValues, model: ET.Element, nested: Sequence[Nested]) -> dict[str, Pose]:
    """X_M of a model's links, joints, frames and nested models, whatever their poses refer to.

    :param reader: the :class:`~ode_sim.description.sdf.SdfReader` that reads the numbers and takes the warnings.
    :raises DescriptionError: the poses refer to each other in a circle.
    """
    root = "__model__"
    solver = _Solver(reader, root)
    for sub, element, frames in nested:
        solver.add(sub, element.find("pose"), root)
        for name, x_sf in frames.items():
            if name != root:
                solver.place(f"{sub}::{name}", x_sf, sub)
    for link in model.findall("link"):
        solver.add(link.get("name") or "", link.find("pose"), root)
    for joint in model.findall("joint"):
        solver.add(joint.get("name") or "", joint.find("pose"), joint_end(joint, "child"))
    for frame in model.findall("frame"):
        solver.add_frame(frame)
    return solver.resolved()


class WorldFrames:
    """Models, lights and ``<frame>``s of a world, whose poses may refer to any model or frame of it, also to later ones. What goes round in
    a circle stands where its own numbers say.

    :param reader: takes the warnings
    """

    def __init__(self, reader: SdfValues):
        self._reader, self._solver = reader, _Solver(reader, "world")

    def add_frame(self, frame: ET.Element) -> None:
        """A ``<frame>`` of the world."""
        self._solver.add_frame(frame)

    def add_model(self, name: str, x: Pose, pose: ET.Element | None) -> None:
        """The model ``name``. :param x: what stands in its element ``pose``"""
        self._solver.place(name, x, relative_to(pose) or "world", pose if relative_to(pose) else None)

    def of(self, name: str) -> Pose:
        """X_W of the model or frame ``name``."""
        return self._tried(name)

    def light(self, x: Pose, pose: ET.Element | None) -> Pose:
        """X_W of a light, to whom no pose refers: ``x`` stands in its element ``pose``."""
        reference = relative_to(pose)
        if not reference or reference == "world":
            return x
        if reference in self._solver:
            return math3.compose(self._tried(reference), x)
        self._solver.miss(pose, reference)
        return x

    def _tried(self, name: str) -> Pose:
        try:
            return self._solver.solve(name)
        except DescriptionError as error:
            self._reader.warn(error.source, f"{error.message}; it stands where its own numbers say", "error")
            return self._solver.cut(name)


class _Solver:
    """:param root: the frame that all are in at the end"""

    def __init__(self, reader: SdfValues, root: str):
        self._reader, self._root = reader, root
        self._entries: dict[str, tuple[Pose, str, ET.Element | None]] = {}  # name -> X_RF, name of R, the element that names R
        self._solved: dict[str, Pose] = {root: math3.IDENTITY}

    def __contains__(self, name: str) -> bool:
        return name in self._entries

    def add(self, name: str, pose: ET.Element | None, usual: str) -> None:
        """:param usual: the frame in which a ``pose`` is that names none"""
        if name not in self._entries:  # links win over joints of the same name, as old files have them
            self.place(name, self._reader.pose(pose), relative_to(pose) or usual, pose if relative_to(pose) else None)

    def add_frame(self, frame: ET.Element) -> None:
        """A ``<frame>``, which hangs on what ``attached_to`` names."""
        name, pose, usual = frame.get("name") or "", frame.find("pose"), (frame.get("attached_to") or "").strip()
        if relative_to(pose) or not usual:
            self.add(name, pose, self._root)
        elif name not in self._entries:
            self.place(name, self._reader.pose(pose), usual, frame)

    def place(self, name: str, x_rf: Pose, reference: str, element: ET.Element | None = None) -> None:
        """``x_rf`` is in the frame ``reference``, which ``element`` names, if any does."""
        self._entries[name] = x_rf, reference, element

    def cut(self, name: str) -> Pose:
        """``name`` hangs on nothing but the root; its pose."""
        return self._solved.setdefault(name, self._entries[name][0])

    def miss(self, element: ET.Element | None, reference: str) -> None:
        """Says that there is no frame ``reference``."""
        of = "the model" if self._root == "__model__" else "the world"
        self._reader.warn(element, f"there is no frame '{quoted(reference)}'; using that of {of}")

    def resolved(self) -> dict[str, Pose]:
        for name in self._entries:
            self.solve(name)
        return self._solved

    def solve(self, name: str) -> Pose:
        """X of ``name`` in the root, and of the frames that it is given in, one in another.

        :raises DescriptionError: they refer to each other in a circle
        """
        path, last = {name: None}, name  # in order
        while (reference := self._entries[last][1]) in self._entries and reference not in self._solved:
            if reference in path:
                element = self._entries[last][2]
                raise DescriptionError(
                    f"the pose refers to itself ({quoted(' > '.join([*path, reference]), 200)})",
                    source_of(element) if element is not None else Source(quoted(last)),
                )
            path[reference] = None
            last = reference
        for step in reversed(path):
            if step in self._solved:
                continue
            x_rf, reference, element = self._entries[step]
            if reference in self._solved:
                x_rf = math3.compose(self._solved[reference], x_rf)
            elif element is not None and reference != "world":  # what old files call the frame of the model
                self.miss(element, reference)
            self._solved[step] = x_rf
        return self._solved[name]

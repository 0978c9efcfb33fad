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
    return _Solver(reader, model, nested).resolved()


class _Solver:
    def __init__(self, reader: SdfValues, model: ET.Element, nested: Sequence[Nested]):
        self._reader = reader
        self._entries: dict[str, tuple[Pose, str, ET.Element | None]] = {}  # name -> X_RF, name of R, element
        self._solved: dict[str, Pose] = {"__model__": math3.IDENTITY}
        for sub, element, frames in nested:
            self._add(sub, element.find("pose"), "__model__")
            for name, x_sf in frames.items():
                if name != "__model__":
                    self._entries[f"{sub}::{name}"] = (x_sf, sub, None)
        for tag in ("link", "joint", "frame"):
            for element in model.findall(tag):
                usual = "__model__"
                if tag == "joint":
                    usual = joint_end(element, "child")
                elif tag == "frame":
                    usual = (element.get("attached_to") or "").strip() or "__model__"
                self._add(element.get("name") or "", element.find("pose"), usual)

    def _add(self, name: str, pose: ET.Element | None, usual: str) -> None:
        if name not in self._entries:  # links win over joints of the same name, as old files have them
            self._entries[name] = (self._reader.pose(pose), relative_to(pose) or usual, pose)

    def resolved(self) -> dict[str, Pose]:
        for name in self._entries:
            self._solve(name)
        return self._solved

    def _solve(self, name: str) -> None:
        """X_M of ``name``, and of the frames that it is given in, one in another."""
        path = {name: None}  # in order
        while (reference := self._entries[name][1]) in self._entries and reference not in self._solved:
            if reference in path:
                element = self._entries[name][2]
                raise DescriptionError(
                    f"the pose refers to itself ({quoted(' > '.join([*path, reference]), 200)})",
                    source_of(element) if element is not None else Source(quoted(name)),
                )
            path[reference] = None
            name = reference
        for name in reversed(path):
            if name in self._solved:
                continue
            x_rf, reference, element = self._entries[name]
            if reference in self._solved:
                x_rf = math3.compose(self._solved[reference], x_rf)
            elif relative_to(element) and reference != "world":  # what old files call the frame of the model
                self._reader.warn(element, f"there is no frame '{quoted(reference)}'; using that of the model")
            self._solved[name] = x_rf


def world_frames(reader: SdfValues, world: ET.Element) -> dict[str, Pose]:
    """X_W of the ``<frame>``s of the element ``world``, as far as they refer to earlier ones; ``reader`` reads their poses."""
    frames: dict[str, Pose] = {}
    for element in world.findall("frame"):
        pose = element.find("pose")
        reference = relative_to(pose) or element.get("attached_to", "")
        x = reader.pose(pose)
        frames[element.get("name") or ""] = math3.compose(frames[reference], x) if reference in frames else x
    return frames

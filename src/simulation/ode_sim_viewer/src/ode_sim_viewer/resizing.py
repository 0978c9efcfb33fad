"""Other sizes for simple shapes: typed, or by three knobs that a hand drags along the axes.

A simple shape is a model of one link whose collisions and visuals all are the same box, sphere or cylinder, as Gazebo's
window inserts and scales them.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from ode_sim.description import model as d
from ode_sim.description.sdf_writer import model_text
from ode_sim.math3 import Pose, add, compose, rotate, scale, sub, vec3

from ode_sim_viewer.shapes import Simple, shape_model
from ode_sim_viewer.simulation import Frame, ModelRecord, Refused

_LEAST, _LARGEST = 0.01, 1000.0  # m along a side
_KNOB = 0.05  # m, radius
_OUT = 0.12  # m between the face and the knob
_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_COLOURS = ((220, 60, 60), (60, 180, 60), (60, 90, 220))


def shape_of(model: d.Model) -> tuple[Simple, Pose] | None:
    """The geometry of ``model``, if it is a simple shape, and X_LG, or None."""
    if len(model.links) != 1 or model.joints:
        return None
    link = model.links[0]
    parts = {(part.geometry, part.pose) for part in link.collisions} | {(part.geometry, part.pose) for part in link.visuals}
    if len(parts) != 1:
        return None
    geometry, pose = next(iter(parts))
    return (geometry, pose) if isinstance(geometry, (d.Box, d.Sphere, d.Cylinder)) else None


def size_of(geometry: Simple) -> d.Vec3:
    """Along the axes of ``geometry``, m."""
    if isinstance(geometry, d.Box):
        return vec3(geometry.size)
    across = 2.0 * float(geometry.radius)
    return across, across, float(geometry.length) if isinstance(geometry, d.Cylinder) else across


def with_size(geometry: Simple, axis: int, length: float) -> Simple:
    """The same kind of shape as ``geometry``, ``length`` m along its ``axis`` 0, 1 or 2; what is round stays round.

    :raises Refused: no shape is so
    """
    if not _LEAST <= length <= _LARGEST:
        raise Refused(f"A side is from {_LEAST:g} to {_LARGEST:g} m.")
    if isinstance(geometry, d.Box):
        return d.Box(vec3(length if number == axis else side for number, side in enumerate(geometry.size)))
    if isinstance(geometry, d.Cylinder) and axis == 2:
        return d.Cylinder(geometry.radius, length)
    return replace(geometry, radius=length / 2)


def resized(model: d.Model, geometry: Simple) -> d.Model:
    """``model``, a simple shape, with the measures of ``geometry``: the mass stays, the inertia is that of the new shape."""
    link = model.links[0]
    solid = shape_model(model.name, geometry, max(link.inertial.mass, 1e-9)).links[0].inertial
    made = replace(
        link,
        inertial=replace(solid, pose=link.inertial.pose) if not model.static else link.inertial,
        collisions=tuple(replace(part, geometry=geometry) for part in link.collisions),
        visuals=tuple(replace(part, geometry=geometry) for part in link.visuals),
    )
    return replace(model, links=(made,))


class Resizing:
    """The knobs at what is picked, while they are wanted. Drawing thread, but for what a hand does."""

    def __init__(self, page: Any):
        self._page = page
        self._wanted = False
        self._snap = 0.0
        self._place = Pose()  # X_W of what was resized last
        self._knobs: list[Any] = []
        self._drag: tuple[int, Simple] | None = None  # axis, the shape as it would be
        self._events: list[tuple[int, Any, str, tuple]] = []
        self.on_pull: Callable[[Simple, bool], None] = lambda geometry, done: None  # a hand makes it so, or has made it so
        self._lock = threading.Lock()

    def show(self, on: bool, snap: float = 0.0) -> None:
        """Show the knobs, or hide them (``on`` is False).

        :param snap: m, 0 = none.
        """
        self._wanted, self._snap = on, snap
        if self._page.frame is not None:
            self.move(self._page.frame)

    def apply(self, geometry: Simple, typed: bool = False) -> None:
        """What is picked gets the measures of ``geometry``; a step that can be undone.

        :param typed: see :meth:`~ode_sim_viewer.selection.History.do`
        :raises Refused: it is no simple shape
        """
        selection, frame = self._page.selection, self._page.frame
        record = selection.latest
        shape = shape_of(record.description) if record is not None else None
        if record is None or frame is None or shape is None:
            raise Refused("Only a single box, sphere or cylinder has other sizes here; pick one.")
        before = replace(record.description, name=record.name, static=record.static, pose=Pose())
        if shape[0] == geometry:
            return
        after, name = resized(before, geometry), record.name
        if selection.record is not None:  # else it is just being made anew, where it was
            self._place = record.pose(frame)
        pose = self._place
        selection.history.do(f"resize {name}", lambda: self._swap(name, after, pose), lambda: self._swap(name, before, pose), typed)

    def _swap(self, name: str, model: d.Model, usual: Pose) -> None:
        """:param usual: where it goes when the page does not know where it is: it comes from a step a moment ago."""
        page = self._page
        record, frame = page.world.model(name), page.frame
        known = record is not None and frame is not None and frame.revision == page.world.revision
        pose, text = record.pose(frame) if known else usual, model_text(model)
        page.simulation.delete(name)
        page.simulation.insert(name, text, pose)

    # ------------------------------------------------------------------------------------------ the knobs

    def move(self, frame: Frame) -> None:
        """Once for each frame."""
        record = self._page.selection.record if self._wanted else None
        shape = shape_of(record.description) if record is not None else None
        if record is None or shape is None or frame.revision != self._page.world.revision or not record.links:
            self._hide()
            return
        geometry, pose = (self._drag[1] if self._drag is not None else shape[0]), self._centre(record, frame, shape[1])
        for axis, (knob, side) in enumerate(zip(self._shown(), size_of(geometry))):
            knob.position = add(pose.p, scale(rotate(pose, _AXES[axis]), side / 2 + _OUT))

    @staticmethod
    def _centre(record: ModelRecord, frame: Frame, x_lg: Pose) -> Pose:
        return compose(frame.pose(next(iter(record.links.values()))), x_lg)

    def _hide(self) -> None:
        for knob in self._knobs:
            knob.remove()
        self._knobs, self._drag = [], None

    def _shown(self) -> list[Any]:
        if not self._knobs:
            scene = self._page.server.scene
            for axis, colour in enumerate(_COLOURS):
                knob = scene.add_icosphere(f"/knob{axis}", radius=_KNOB, color=colour, cast_shadow=False)
                self._listen(knob, axis)
                self._knobs.append(knob)
        return self._knobs

    def _listen(self, knob: Any, axis: int) -> None:
        async def on_drag(event: Any) -> None:
            update = (axis, event, event.phase, tuple(map(float, event.end_position)))
            with self._lock:
                waiting = bool(self._events)
                if waiting and self._events[-1][2] == "update":
                    self._events.pop()
                self._events.append(update)
            if not waiting:
                self._page.later(self._take)

        knob.on_drag(on_drag)

    def _take(self) -> None:
        with self._lock:
            events, self._events = self._events, []
        for axis, event, phase, place in events:
            self._page.attempt(event, lambda axis=axis, phase=phase, place=place: self._pull(axis, phase, place))

    def _pull(self, axis: int, phase: str, place: tuple) -> None:
        record, frame = self._page.selection.record, self._page.frame
        shape = shape_of(record.description) if record is not None else None
        if shape is None or frame is None or frame.revision != self._page.world.revision:
            self._drag = None
            return
        pose = self._centre(record, frame, shape[1])
        reach = float(np.dot(sub(place, pose.p), rotate(pose, _AXES[axis]))) - _OUT
        side = 2.0 * reach
        if self._snap > 0.0:
            side = max(self._snap, round(side / self._snap) * self._snap)
        geometry = with_size(shape[0], axis, min(max(side, _LEAST), _LARGEST))
        self._drag = (axis, geometry) if phase != "end" else None
        self._stretch(record, geometry)
        self.move(frame)
        try:
            if phase == "end":
                self.apply(geometry)
        finally:
            self.on_pull(geometry, phase == "end")

    def _stretch(self, record: ModelRecord, geometry: Simple) -> None:
        """What is seen already follows the hand."""
        drawn = self._page.drawing.model_root(record.name)
        sizes = (
            size_of(geometry)
            if isinstance(geometry, d.Box)
            else tuple(side / 2 for side in size_of(geometry)[:2])
            + (geometry.length if isinstance(geometry, d.Cylinder) else geometry.radius,)
        )
        for mesh in drawn.meshes if drawn is not None else ():
            if hasattr(mesh, "vertices"):  # one with a texture is drawn anew at the end
                mesh.scale = tuple(map(float, sizes))

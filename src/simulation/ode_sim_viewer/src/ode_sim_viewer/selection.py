"""What is picked: its frame, gizmo, copy, delete; undo and redo of what was done to the world."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from ode_sim.description import model as d
from ode_sim.description.sdf_writer import light_text, model_text
from ode_sim.math3 import Pose, quat_from_rpy, quat_to_rpy, vec3

from ode_sim_viewer.drawing import wxyz
from ode_sim_viewer.panels.base import free_name
from ode_sim_viewer.simulation import Frame, ModelRecord, Refused, WorldRecord

_MOST_STEPS = 50  # that can be undone
_TYPING = 2.0  # wall s between two keys of one number
_AWAY = 0.5  # wall s that what is picked may be missing: another size or range makes it anew, and somebody types on


def _on_grid(values: tuple[float, float, float], step: float) -> tuple[float, float, float]:
    x, y, z = (round(value / step) * step for value in values)
    return x, y, z


class History:
    """Steps that can be undone: pairs of functions. Any thread: a click waits for what the one before it does."""

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self._done: list[tuple[str, Callable[[], None], Callable[[], None]]] = []
        self._undone: list[tuple[str, Callable[[], None], Callable[[], None]]] = []
        self._typed = -math.inf  # wall s of the last key, if that was the last step

    def alone(self) -> Any:
        """To be held over a look at what is there and the step that follows from it."""
        return self._lock

    def do(self, what: str, forth: Callable[[], None], back: Callable[[], None], typed: bool = False) -> None:
        """Call ``forth()`` and remember ``back``.

        :param typed: into a field, which tells of every key: what is typed without a pause is one step
        :raises Refused: as ``forth`` does; then nothing is remembered
        """
        with self._lock:
            forth()
            if typed and self._done and self._done[-1][0] == what and time.monotonic() < self._typed + _TYPING:
                back = self._done.pop()[2]
            self.note(what, forth, back)
            self._typed = time.monotonic() if typed else -math.inf

    def note(self, what: str, forth: Callable[[], None], back: Callable[[], None]) -> None:
        """Remember a step that was taken already: ``what`` it is for people, ``forth`` does it again, ``back`` undoes it."""
        with self._lock:
            self._done = self._done[1 - _MOST_STEPS :] + [(what, forth, back)]
            self._undone.clear()
            self._typed = -math.inf

    def undo(self) -> str:
        """What was undone."""
        return self._turn(True)

    def redo(self) -> str:
        return self._turn(False)

    def _turn(self, back: bool) -> str:
        with self._lock:
            self._typed = -math.inf
            source, target = (self._done, self._undone) if back else (self._undone, self._done)
            if not source:
                raise Refused(f"There is nothing to {'undo' if back else 'do again'}.")
            step = source.pop()
            what, forth, backwards = step
            (backwards if back else forth)()
            target.append(step)
            return what


class Selection:
    """One model, link or light at a time, the same for all pages.

    What was picked last is picked again when it comes back (undo of a delete), and what was clicked on a page that is
    ahead of this one or behind it when it is there.

    :ivar model: name, '' = nothing or a light. :ivar link: name, '' = the whole model. :ivar light: name or ''.
    """

    def __init__(self, page: Any):
        self._page = page
        self.history = History()
        self.model = ""
        self.link = ""
        self.light = ""
        self._wanted = ("", "", "")  # model, link, light: the last click
        self.on_change: list[Callable[[], None]] = []
        self._dragged: Pose | None = None  # where the drag began
        self._updates: list[tuple[Any, Pose, str]] = []  # of the drag, to be done
        self._lock = threading.Lock()
        self._given: set[str] = set()  # names of what was inserted and the world has not told of yet
        self._missing: float | None = None  # wall s since when what is picked is not there
        self._latest: ModelRecord | None = None
        self._lights: dict[str, tuple[d.Light, d.Light]] = {}  # name -> as the world told of it, as it was set since
        self._gizmo_wanted = False
        self._snap = self._snap_angle = 0.0
        scene = page.server.scene
        self._frame = scene.add_frame("/selected", axes_length=0.3, axes_radius=0.006, visible=False)
        self._gizmo = scene.add_transform_controls("/gizmo", scale=0.7, visible=False, depth_test=False)
        self._gizmo.on_update(self._on_drag)

    # ------------------------------------------------------------------------------------------ picking

    @property
    def record(self) -> ModelRecord | None:
        return self._page.world.model(self.model) if self.model else None

    @property
    def latest(self) -> ModelRecord | None:
        """The same, or as it was before it went away for a moment."""
        return self.record or (self._latest if self._missing is not None else None)

    @property
    def light_record(self) -> d.Light | None:
        return self._light(self.light)

    def _light(self, name: str) -> d.Light | None:
        """As it was set here, until the world tells of it: the next change must not take this one back."""
        told = next((light for light in self._page.world.lights if light.name == name), None)
        before, since = self._lights.get(name, (None, None))
        return since if told is not None and told == before else told

    def _put_light(self, light: d.Light) -> None:
        told = next((other for other in self._page.world.lights if other.name == light.name), None)
        self._page.simulation.set_light(light)
        if told is not None:
            self._lights[light.name] = (told, light)

    def change_light(self, **changes: Any) -> None:
        """Of the light that is picked; a step that can be undone.

        :raises Refused: none is picked
        """
        with self.history.alone():
            before = self.light_record
            if before is None:
                raise Refused("That light is not there any more.")
            now = replace(before, **changes)
            self.history.do(
                f"{', '.join(changes)} of light {before.name}", lambda: self._put_light(now), lambda: self._put_light(before), typed=True
            )

    def select(self, model: str = "", link: str = "", light: str = "") -> None:
        """Pick ``model``, or its ``link``, or ``light`` (names, '' for none). Drawing thread."""
        self._wanted = (model, link, light)
        self._become(*self._present(self._page.world))

    def update(self, world: WorldRecord) -> None:
        self._given -= {model.name for model in world.models} | {light.name for light in world.lights}
        now, before = self._present(world), (self.model, self.link, self.light)
        if now != before and any(before) and not any(now) and before == self._wanted:
            self._missing = self._missing or time.monotonic()
            if time.monotonic() < self._missing + _AWAY:
                return
        self._missing = None
        if now != before:
            self._become(*now)
        self._latest = self.record

    def _present(self, world: WorldRecord) -> tuple[str, str, str]:
        """What is wanted, if it is there; else nothing."""
        model, link, light = self._wanted
        record = world.model(model) if model else None
        there = record is not None and (not link or link in record.links) if model else any(other.name == light for other in world.lights)
        return self._wanted if there else ("", "", "")

    def _become(self, model: str, link: str, light: str) -> None:
        self.model, self.link, self.light = model, link, light
        self._latest, self._missing = self.record, None
        self._show()
        for f in self.on_change:
            f()

    def come_back(self) -> None:
        """Return when what is picked is there, in a frame of the world that the page knows, or has gone for good: a copy may be asked
        for right after the undo of a delete, before the world has told of either. Other threads than the drawing one."""
        end = time.monotonic() + _AWAY
        while not self._placed() and time.monotonic() < end and self._page.catch_up():
            time.sleep(0.01)

    def _placed(self) -> bool:
        frame = self._page.frame
        told = frame is not None and frame.revision == self._page.world.revision
        return not (self.model or self.light) or told and self._missing is None

    def pose(self) -> Pose | None:
        """X_W of what is picked, in the newest frame."""
        frame, record = self._page.frame, self.record
        if self.light_record is not None:
            return self.light_record.pose
        if record is None or frame is None or frame.revision != self._page.world.revision:
            return None
        return frame.pose(record.links[self.link]) if self.link in record.links else record.pose(frame)

    def on_frame(self, frame: Frame) -> None:
        if self._missing is not None:
            self.update(self._page.world)
        self._show()

    def gizmo(self, on: bool, snap: float = 0.0, snap_angle: float = 0.0) -> None:
        """Show the handles to move and rotate with, or hide them (``on`` is False); ``snap`` m, ``snap_angle`` rad of roll, pitch and yaw,
        0 = none. Drawing thread.
        """
        self._gizmo_wanted, self._snap, self._snap_angle = on, snap, snap_angle
        self._show()

    def _show(self) -> None:
        pose = self.pose()
        self._frame.visible = pose is not None
        movable = pose is not None and self._gizmo_wanted
        self._gizmo.visible = movable
        if pose is not None:
            self._frame.position, self._frame.wxyz = pose.p, wxyz(pose.q)
            record, frame = self.record, self._page.frame
            whole = record.pose(frame) if record is not None and frame is not None else pose
            if self._dragged is None:
                self._gizmo.position, self._gizmo.wxyz = whole.p, wxyz(whole.q)

    # ------------------------------------------------------------------------------------------ acting

    async def _on_drag(self, event: Any) -> None:
        """In the order of the hand: the event loop calls it, the work is done in the drawing thread.

        Of places on the way only the newest is gone to.
        """
        position = vec3(event.target.position)
        w, x, y, z = (float(v) for v in event.target.wxyz)
        update = (event, Pose(position, (x, y, z, w)), event.phase)
        with self._lock:
            waiting = bool(self._updates)
            if waiting and self._updates[-1][2] == "update":
                self._updates.pop()
            self._updates.append(update)
        if not waiting:
            self._page.later(self._do_updates)

    def _do_updates(self) -> None:
        with self._lock:
            updates, self._updates = self._updates, []
        for update in updates:
            self._drag(*update)

    def _drag(self, event: Any, pose: Pose, phase: str) -> None:
        if phase == "start" or self._dragged is None:
            self._dragged = self._whole()
        if self._snap > 0.0:
            pose = replace(pose, p=_on_grid(pose.p, self._snap))
        if self._snap_angle > 0.0:
            pose = replace(pose, q=quat_from_rpy(*_on_grid(quat_to_rpy(pose.q), self._snap_angle)))
        begin, name = self._dragged, self.model or self.light
        if begin is not None:
            self._page.attempt(event, lambda: self._put_named(name, pose))
            if phase == "end" and pose != begin:
                self.history.note(f"move {name}", lambda: self._put_named(name, pose), lambda: self._put_named(name, begin))
        if phase == "end":
            self._dragged = None

    def _whole(self) -> Pose | None:
        """X_W of the model or light that is picked."""
        record, frame, light = self.record, self._page.frame, self.light_record
        if light is not None:
            return light.pose
        return record.pose(frame) if record is not None and frame is not None else None

    def _put_named(self, name: str, pose: Pose) -> None:
        light = self._light(name)
        if self._page.world.model(name) is not None or light is None:
            self._page.simulation.set_pose(name, pose)
        else:
            self._put_light(replace(light, pose=pose))

    def move(self, pose: Pose, typed: bool = False) -> None:
        """Put what is picked at ``pose``; a model as a whole.

        :param typed: see :meth:`History.do`
        :raises Refused: nothing is picked
        """
        begin, name = self._whole(), self.model or self.light
        if begin is None:
            raise Refused("Pick a model or light first.")
        self.history.do(f"move {name}", lambda: self._put_named(name, pose), lambda: self._put_named(name, begin), typed)

    def delete(self) -> None:
        """:raises Refused: nothing is picked."""
        name, text, pose = self._text()
        simulation = self._page.simulation
        self.history.do(f"delete {name}", lambda: simulation.delete(name), lambda: simulation.insert(name, text, pose))

    def copy(self) -> str:
        """Put a copy beside it; its name.

        :raises Refused: nothing is picked
        """
        name, text, pose = self._text()
        return self.insert(name.rstrip("0123456789").rstrip("_") or name, text, replace(pose, p=(pose.p[0] + 1.0, pose.p[1], pose.p[2])))

    def insert(self, wanted: str, text: str, pose: Pose) -> str:
        """A model or light from ``text`` at X_W ``pose``, under a free name like ``wanted``; the name."""
        world, simulation = self._page.world, self._page.simulation
        with self.history.alone():
            taken = {model.name for model in world.models} | {light.name for light in world.lights} | self._given
            name = free_name(wanted, taken)
            self.history.do(f"insert {name}", lambda: simulation.insert(name, text, pose), lambda: simulation.delete(name))
            self._given.add(name)
        return name

    def _text(self) -> tuple[str, str, Pose]:
        """(name, SDF text about the origin, pose) of what is picked."""
        record, frame, light = self.record, self._page.frame, self.light_record
        if light is not None:
            return light.name, light_text(replace(light, pose=Pose())), light.pose
        if record is None or frame is None:
            raise Refused("Pick a model or light first: click on it, or on its name in the tree.")
        description = replace(record.description, name=record.name, static=record.static, pose=Pose())
        return record.name, model_text(description), record.pose(frame)

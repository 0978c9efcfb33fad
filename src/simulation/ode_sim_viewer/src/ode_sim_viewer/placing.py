"""Putting something new into the world by hand: it is seen under the pointer, and put there by a click."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from ode_sim.description import model as d
from ode_sim.math3 import Pose, compose
from ode_sim_rendering.assets import Assets

from ode_sim_viewer.drawing import rgb255, take_away, wxyz
from ode_sim_viewer.pointer import Pointer, Ray, on_plane

_ALPHA = 0.55
_LAMP = (255, 220, 80)
_COARSE = 1.0  # m, with Ctrl, as in Gazebo's window
_COARSE_KEY = "cmd/ctrl"
_ECHO = 0.5  # wall s in which the same click may also come from what is behind


class Thing(NamedTuple):
    """What is to be inserted: the name it would like, its SDF, X of its origin above the place that is pointed at, and
    its description for the preview (None: a lamp)."""

    name: str
    text: str
    lift: Pose
    model: d.Model | None = None


class Placing:
    """One thing at a time, by the page that chose it; the others' clicks are what they always are.

    :param say: where a line for people goes, '' when there is none
    """

    def __init__(self, page: Any):
        self._page = page
        self._assets = Assets()
        self._thing: Thing | None = None
        self._client_id: int | None = None
        self._pointer: Pointer | None = None
        self._last: tuple[int | None, float] = (None, 0.0)  # the page that put something down, and when
        self._nodes: list[Any] = []
        self._listening: list[Callable] = []
        self.say: Callable[[str], None] = lambda line: None

    def begin(self, event: Any, thing: Thing) -> None:
        """From now on ``thing`` hangs at the pointer of the page that ``event`` came from. Drawing thread."""
        self.end()
        self._thing, self._client_id = thing, event.client_id
        scene = self._page.server.scene
        for modifier in (None, _COARSE_KEY):

            async def on_click(click: Any, step: float = _COARSE if modifier else 0.0) -> None:
                self._page.later(lambda: self._click(click, step))

            self._listening.append(scene.on_click(modifier=modifier)(on_click))
        self._pointer = Pointer(
            event.client, lambda ray: self._page.later(lambda: self._show(thing, ray)), lambda: self._page.later(lambda: self._leave(thing))
        )
        self.say(f"{thing.name}: click where it shall stand; Esc leaves it")

    def end(self) -> None:
        """Nothing hangs at the pointer any more. Drawing thread."""
        if self._pointer is not None:
            self._pointer.end()
        for f in self._listening:
            self._page.server.scene.remove_click_callback(f)
        for node in reversed(self._nodes):
            take_away(node)
        self._thing = self._client_id = self._pointer = None
        self._listening, self._nodes = [], []

    def takes(self, event: Any) -> bool:
        """Whether the click ``event`` puts something down: then nothing is picked by it."""
        who = getattr(event, "client_id", None)
        return who is not None and (who == self._client_id or who == self._last[0] and time.monotonic() - self._last[1] < _ECHO)

    # ------------------------------------------------------------------------------------------ the hand

    def _leave(self, thing: Thing) -> None:
        if thing is self._thing:
            self.end()
            self.say("")

    def _show(self, thing: Thing, ray: Ray) -> None:
        if thing is not self._thing:
            return
        place = on_plane(ray)
        if not self._nodes and place is not None:
            with self._page.server.atomic():
                self._nodes = self._draw(thing)
        if self._nodes:
            self._nodes[0].visible = place is not None
        if place is not None:
            pose = self._pose(thing, place)
            self._nodes[0].position, self._nodes[0].wxyz = pose.p, wxyz(pose.q)
            self.say(f"{thing.name} at {place[0]:.2f}, {place[1]:.2f} m: click puts it there; Esc leaves it")

    def _click(self, event: Any, step: float) -> None:
        thing = self._thing
        if thing is None or event.client_id != self._client_id:
            return
        place = on_plane((event.ray_origin, event.ray_direction))
        if place is None:
            self._page.tell(event, "Click on the ground: this place is above the horizon.")
            return
        if step > 0.0:
            place = round(place[0] / step) * step, round(place[1] / step) * step
        self._last = (event.client_id, time.monotonic())
        self.end()
        name = self._page.attempt(event, lambda: self._page.selection.insert(thing.name, thing.text, self._pose(thing, place)))
        self.say(f"{name} is at {place[0]:.2f}, {place[1]:.2f} m" if name else "")

    @staticmethod
    def _pose(thing: Thing, place: tuple[float, float]) -> Pose:
        return compose(Pose((*place, 0.0)), thing.lift)

    # ------------------------------------------------------------------------------------------ the preview

    def _draw(self, thing: Thing) -> list[Any]:
        """The first node carries the others."""
        scene = self._page.server.scene
        nodes = [scene.add_frame("/ghost", show_axes=thing.model is None, axes_length=0.3, axes_radius=0.008)]
        if thing.model is None:
            nodes.append(scene.add_icosphere("/ghost/lamp", radius=0.1, color=_LAMP, opacity=_ALPHA, cast_shadow=False))
            return nodes
        for number, link in enumerate(thing.model.links):
            # what is spawned stands at the pose that its text gives, seen from the place it is put to
            pose = compose(thing.model.pose, link.pose)
            frame = scene.add_frame(f"/ghost/{number}", show_axes=False, position=pose.p, wxyz=wxyz(pose.q))
            nodes.append(frame)
            for at, visual in enumerate(link.visuals):
                for part_number, part in enumerate(self._assets.parts(replace(visual, cast_shadows=False), thing.name)):
                    mesh = self._assets.meshes[part.key]
                    nodes.append(
                        scene.add_mesh_simple(
                            f"{frame.name}/{at}_{part_number}",
                            np.asarray(mesh.vertices, np.float32),
                            np.asarray(mesh.triangles, np.uint32),
                            color=rgb255(part.look.diffuse),
                            opacity=_ALPHA,
                            side="double",
                            scale=tuple(float(s) for s in part.scale),
                            position=part.pose.p,
                            wxyz=wxyz(part.pose.q),
                            cast_shadow=False,
                            receive_shadow=False,
                        )
                    )
        self._assets.problems.clear()  # said when it is in the world
        return nodes

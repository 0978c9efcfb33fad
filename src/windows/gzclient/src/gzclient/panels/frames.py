"""The frames of TF, where they are in the world."""
from __future__ import annotations

import threading
from typing import Any, Dict, List, Optional, Tuple

import numpy as np
import rospy
from ode_sim.math3 import Pose, compose, inverse
from ode_sim.viewer.panels.base import Panel, note
from ode_sim.viewer.simulation import Frame, WorldRecord
from tf2_msgs.msg import TFMessage

_MOST = 200  # frames
_SIZE = 0.15  # m

Transforms = Dict[str, Tuple[str, Pose]]  # child -> (parent, X_PC)


def name_of(frame: str) -> str:
    return frame.strip("/")


def place_frames(transforms: Transforms, links: Dict[str, Pose]) -> Dict[str, Pose]:
    """X_WF of every frame: each tree hangs on the first of its frames that is a link of the world, else on the origin.

    :param links: name -> X_WL
    """
    in_tree: Dict[str, Dict[str, Pose]] = {}  # root -> frame -> X_RF
    for frame in {name for child, (parent, _) in transforms.items() for name in (child, parent)}:
        chain, here = Pose(), frame
        for _ in range(len(transforms) + 1):  # a loop ends somewhere
            if here not in transforms:
                break
            here, step = transforms[here]
            chain = compose(step, chain)
        in_tree.setdefault(here, {})[frame] = chain
    placed: Dict[str, Pose] = {}
    for frames in in_tree.values():
        anchor = next((frame for frame in sorted(frames) if frame in links), None)
        x_wr = compose(links[anchor], inverse(frames[anchor])) if anchor else Pose()
        placed.update({frame: compose(x_wr, x_rf) for frame, x_rf in frames.items()})
    return placed


class FramesPanel(Panel):
    """Subscribes while its box is checked."""

    title = "TF"

    def __init__(self, page: Any):
        super().__init__(page)
        self._lock = threading.Lock()
        self._transforms: Transforms = {}
        self._subscribers: List[rospy.Subscriber] = []
        self._axes: Optional[Any] = None
        self._labels: Dict[str, Any] = {}
        self._named = self.gui.add_checkbox("Names", True)
        self._on = self.gui.add_checkbox("TF frames", False)
        self._note = self.gui.add_html(note("each tree hangs on the first of its frames that is a link of the world"))
        self.on_update(self._on, self._switch)

    def _switch(self, on: bool) -> None:
        if on and not self._subscribers:
            self._subscribers = [rospy.Subscriber(topic, TFMessage, self._take, queue_size=100)
                                 for topic in ("/tf", "/tf_static")]
        elif not on:
            for subscriber in self._subscribers:
                subscriber.unregister()
            self._subscribers = []
            with self._lock:
                self._transforms = {}
            self.page.later(lambda: self._draw({}))

    def _take(self, message: TFMessage) -> None:
        with self._lock:
            for stamped in message.transforms:
                t, q = stamped.transform.translation, stamped.transform.rotation
                numbers = (t.x, t.y, t.z, q.x, q.y, q.z, q.w)
                child, parent = name_of(stamped.child_frame_id), name_of(stamped.header.frame_id)
                if np.isfinite(numbers).all() and child != parent and len(self._transforms) < _MOST:
                    self._transforms[child] = (parent, Pose(numbers[:3], numbers[3:]))

    def on_frame(self, frame: Frame) -> None:
        if self._subscribers and frame.revision == self.page.world.revision:
            with self._lock:
                transforms = dict(self._transforms)
            self._draw(place_frames(transforms, links_of(self.page.world, frame)))

    def _draw(self, placed: Dict[str, Pose]) -> None:
        scene = self.page.server.scene
        names = sorted(placed)
        positions = np.array([placed[name].p for name in names], np.float32).reshape(-1, 3)
        turns = np.array([(q[3], q[0], q[1], q[2]) for q in (placed[name].q for name in names)],
                         np.float32).reshape(-1, 4)
        if self._axes is not None and len(self._axes.batched_positions) != len(names):
            self._axes.remove()
            self._axes = None
        if self._axes is None and names:
            self._axes = scene.add_batched_axes("/tf", turns, positions, axes_length=_SIZE, axes_radius=_SIZE / 30)
        elif self._axes is not None:
            self._axes.batched_positions, self._axes.batched_wxyzs = positions, turns
        shown = names if self._named.value else []
        for name in [name for name in self._labels if name not in shown]:
            self._labels.pop(name).remove()
        for name in shown:
            if name not in self._labels:
                self._labels[name] = scene.add_label(f"/tf_name_{abs(hash(name))}", name)
            self._labels[name].position = placed[name].p


def links_of(world: WorldRecord, frame: Frame) -> Dict[str, Pose]:
    """Link name -> X_WL; the first model that has it."""
    found: Dict[str, Pose] = {}
    for model in world.models:
        for name, row in model.links.items():
            found.setdefault(name.rpartition("::")[2], frame.pose(row))
    return found

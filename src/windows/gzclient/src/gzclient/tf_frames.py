"""The frames of TF, and where they are in the world of the simulator."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np
import rospy
from ode_sim.math3 import Pose, compose, inverse
from ode_sim_viewer.simulation import Frame, WorldRecord
from tf2_msgs.msg import TFMessage

_MOST = 200  # frames
Transforms = dict[str, tuple[str, Pose]]  # child -> (parent, X_PC)


def name_of(frame: str) -> str:
    return frame.strip("/")


def place_frames(transforms: Transforms, links: dict[str, Pose]) -> dict[str, Pose]:
    """X_WF of every frame: each tree hangs on the first of its frames that is a link of the world, else on the origin.

    :param transforms: child frame -> (parent frame, X_PC)
    :param links: name -> X_WL
    """
    in_tree: dict[str, dict[str, Pose]] = {}  # root -> frame -> X_RF
    for frame in {name for child, (parent, _) in transforms.items() for name in (child, parent)}:
        chain, here = Pose(), frame
        for _ in range(len(transforms) + 1):  # a loop ends somewhere
            if here not in transforms:
                break
            here, step = transforms[here]
            chain = compose(step, chain)
        in_tree.setdefault(here, {})[frame] = chain
    placed: dict[str, Pose] = {}
    for frames in in_tree.values():
        anchor = next((frame for frame in sorted(frames) if frame in links), None)
        x_wr = compose(links[anchor], inverse(frames[anchor])) if anchor else Pose()
        placed.update({frame: compose(x_wr, x_rf) for frame, x_rf in frames.items()})
    return placed


def links_of(world: WorldRecord, frame: Frame) -> dict[str, Pose]:
    """Link name -> X_WL in ``frame``, a state of ``world``; of the first model that has it."""
    found: dict[str, Pose] = {}
    for model in world.models:
        for name, row in model.links.items():
            found.setdefault(name.rpartition("::")[2], frame.pose(row))
    return found


class TfFrames:
    """The newest transforms, from :meth:`listen` to :meth:`end`. Any thread."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._transforms: Transforms = {}
        self._subscribers: list[Any] = []

    @property
    def listening(self) -> bool:
        return bool(self._subscribers)

    def listen(self) -> None:
        if not self._subscribers:
            self._subscribers = [rospy.Subscriber(topic, TFMessage, self.take, queue_size=100) for topic in ("/tf", "/tf_static")]

    def end(self) -> None:
        for subscriber in self._subscribers:
            subscriber.unregister()
        self._subscribers = []
        with self._lock:
            self._transforms = {}

    def take(self, message: TFMessage) -> None:
        with self._lock:
            for stamped in message.transforms:
                t, q = stamped.transform.translation, stamped.transform.rotation
                numbers = (t.x, t.y, t.z, q.x, q.y, q.z, q.w)
                child, parent = name_of(stamped.child_frame_id), name_of(stamped.header.frame_id)
                if np.isfinite(numbers).all() and child != parent and (child in self._transforms or len(self._transforms) < _MOST):
                    self._transforms[child] = (parent, Pose(numbers[:3], numbers[3:]))

    def placed(self, world: WorldRecord, frame: Frame) -> dict[str, Pose]:
        """X_WF of each of them, by the places of the links of ``world`` in ``frame``."""
        with self._lock:
            transforms = dict(self._transforms)
        return place_frames(transforms, links_of(world, frame))

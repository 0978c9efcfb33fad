"""Markers of the topics that are chosen, in the world."""

from __future__ import annotations

import queue
from functools import partial
from typing import Any

import rosgraph
import rospy
from ode_sim.math3 import Pose
from ode_sim_viewer.panels.base import Panel, note
from ode_sim_viewer.simulation import Frame, Refused, WorldRecord
from visualization_msgs.msg import Marker, MarkerArray

from gzclient.markers import Markers, Unfit
from gzclient.tf_frames import TfFrames, links_of, name_of

_TYPES = {Marker._type: Marker, MarkerArray._type: MarkerArray}
_FIXED = ("world", "map", "odom")  # frames that are the world's own where nobody says otherwise
_MOST_WAITING = 1000  # messages that are kept until they are drawn
_MOST_AT_ONCE = 500  # markers that are drawn in one frame


class _Topic:
    """One that is shown; its messages come in a thread of ROS, and wait for the one that draws."""

    def __init__(self, name: str, cls: type, markers: Markers):
        self.name, self.markers = name, markers
        self.waiting: queue.Queue = queue.Queue(_MOST_WAITING)
        self._subscriber = rospy.Subscriber(name, cls, self._take, queue_size=100)

    def _take(self, message: Any) -> None:
        for marker in message.markers if isinstance(message, MarkerArray) else (message,):
            try:
                self.waiting.put_nowait(marker)
            except queue.Full:
                return

    def end(self) -> None:
        self._subscriber.unregister()
        self.markers.clear()


class MarkersPanel(Panel):
    title = "Markers"

    def __init__(self, page: Any):
        super().__init__(page)
        self._boxes: dict[str, Any] = {}
        self._topics: dict[str, _Topic] = {}
        self._frames = TfFrames()
        self._serial = 0
        self._said = ""
        self.on_click(self.gui.add_button("Look for markers"), self._look)
        self._folder = self.gui.add_folder("Topics of markers")
        with self._folder:
            self._note = self.gui.add_html(note("not asked yet"))

    # ------------------------------------------------------------------------------------------ choosing

    def _look(self) -> None:
        """Ask, in the thread of the click."""
        try:
            found = {name: _TYPES[kind] for name, kind in rosgraph.Master(rospy.get_name()).getPublishedTopics("") if kind in _TYPES}
        except (OSError, rosgraph.MasterException) as error:
            raise Refused(f"the ROS master does not answer: {error}") from error
        self.page.later(lambda: self.list(found))

    def list(self, found: dict[str, type]) -> None:
        """A box for each topic. Drawing thread."""
        for name in [name for name in self._boxes if name not in found and name not in self._topics]:
            self._boxes.pop(name).remove()
        with self._folder:
            for name in sorted(found):
                if name not in self._boxes:
                    self._boxes[name] = self.gui.add_checkbox(name, False)
                    self.on_update(self._boxes[name], partial(self._wish, name, found[name]))
        self._say("" if self._boxes else "no topic has markers")

    def _wish(self, name: str, cls: type, on: bool) -> None:
        self.page.later(lambda: self._switch(name, cls, on))

    def _switch(self, name: str, cls: type, on: bool) -> None:
        if on and name not in self._topics:
            self._serial += 1
            finder = self.simulation.finder()
            self._topics[name] = _Topic(
                name,
                cls,
                Markers(self.page.server.scene, f"/markers{self._serial}", finder.find if finder is not None else lambda uri: None),
            )
            self._frames.listen()
        elif not on and name in self._topics:
            self._topics.pop(name).end()
            if not self._topics:
                self._frames.end()
                self._say("")

    # ------------------------------------------------------------------------------------------ drawing

    def on_move(self, frame: Frame) -> None:
        if not self._topics or frame.revision != self.page.world.revision:
            return
        drawn = [self._draw(topic, frame.sim_time) for topic in list(self._topics.values())]
        trouble = [line for line in drawn if line]
        places = self._places(self.page.world, frame)
        with self.page.server.atomic():
            unknown = [name for topic in self._topics.values() for name in topic.markers.place(places, frame.sim_time)]
        if unknown:
            trouble.append(f"nobody says where the frame '{unknown[0]}' is")
        if trouble or not unknown and self._said.startswith("nobody"):
            self._say(trouble[0] if trouble else "")

    @staticmethod
    def _draw(topic: _Topic, now: float) -> str | None:
        """What came since the last frame; the last trouble with it."""
        trouble = None
        for _ in range(_MOST_AT_ONCE):
            try:
                topic.markers.take(topic.waiting.get_nowait(), now)
            except queue.Empty:
                break
            except Unfit as error:
                trouble = f"{topic.name}: {error}"
        return trouble

    def _places(self, world: WorldRecord, frame: Frame) -> dict[str, Pose]:
        """Frame -> X_WF; of a robot's links as the simulator has them, of the others as TF says."""
        return {
            **{name: Pose() for name in _FIXED},
            **self._frames.placed(world, frame),
            **{name_of(name): pose for name, pose in links_of(world, frame).items()},
        }

    def _say(self, line: str) -> None:
        if line != self._said or line == "":
            self._said = line
            self._note.content = note(line)
            self._note.visible = bool(line)

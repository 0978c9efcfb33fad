"""What the sensors see and feel, drawn in the world where they are."""

from __future__ import annotations

from functools import partial
from typing import Any

import rosgraph
import rospy
from ode_sim.math3 import Pose
from ode_sim_viewer.arrows import Forces
from ode_sim_viewer.drawing import take_away
from ode_sim_viewer.panels.base import Panel, note
from ode_sim_viewer.simulation import Frame, Refused, WorldRecord

from gzclient.sensor_drawing import KINDS, Place, View
from gzclient.sensor_frames import find_frame


class _Source:
    """The newest message of one topic, and the node that shows it."""

    def __init__(self, topic: str, cls: type):
        self.topic = topic
        self.message: Any = None
        self.fresh = False
        self.node: Any = None
        self.forces: Forces | None = None
        self._subscriber = rospy.Subscriber(topic, cls, self._take, queue_size=1, buff_size=1 << 24)

    def name(self, parent: str) -> str:
        """Of a scene node below ``parent``; a topic's own name has slashes."""
        return f"{parent}/sensor{abs(hash(self.topic)) % 1_000_000}"

    def _take(self, message: Any) -> None:
        self.message, self.fresh = message, True

    def end(self) -> None:
        self._subscriber.unregister()
        self.hide()

    def hide(self) -> None:
        if self.forces is not None:
            self.forces.hide()
            self.forces = None
        if self.node is not None:
            take_away(self.node)
            self.node = None


class SensorsPanel(Panel):
    title = "Sensors"

    def __init__(self, page: Any):
        super().__init__(page)
        self._sources: dict[str, dict[str, _Source]] = {}
        for kind in KINDS:
            box = self.gui.add_checkbox(kind, False)
            self.on_update(box, partial(self._switch, kind))
        self._note = self.gui.add_html("")

    def on_world(self, world: WorldRecord) -> None:
        for sources in self._sources.values():
            for source in sources.values():  # the nodes that they hung on may have gone
                source.hide()
                source.fresh = source.message is not None

    def on_frame(self, frame: Frame) -> None:
        for kind, sources in list(self._sources.items()):
            for source in list(sources.values()):
                if source.fresh:
                    source.fresh = False
                    self._show(kind, source)

    def _switch(self, kind: str, on: bool) -> None:
        """In the thread of the click."""
        wanted = KINDS[kind]
        found: dict[str, _Source] = {}
        if on:
            try:
                topics = sorted(
                    topic for topic, type_name in rosgraph.Master(rospy.get_name()).getPublishedTopics("") if type_name == wanted.type_name
                )
            except (OSError, rosgraph.MasterException) as error:
                raise Refused(f"the ROS master does not answer: {error}") from error
            found = {topic: _Source(topic, wanted.cls) for topic in topics[: wanted.most]}
        self.page.later(lambda: self._replace(kind, found, on))

    def _replace(self, kind: str, found: dict[str, _Source], on: bool) -> None:
        for source in self._sources.pop(kind, {}).values():
            source.end()
        if on:
            self._sources[kind] = found
            self._say(f"{kind}: {', '.join(found) or 'no topic has them'}")

    def _say(self, line: str) -> None:
        self._note.content = note(line)

    def _show(self, kind: str, source: _Source) -> None:
        page, frame = self.page, self.page.frame
        if frame is None or frame.revision != page.world.revision:
            source.fresh = True
            return
        place = Place("", Pose(), "", "") if KINDS[kind].in_world else self._place(source)
        if place is None:
            source.hide()
            return
        try:
            KINDS[kind].draw(View(page.server.scene, page.world, frame, page.overlays.force_scale), source, place)
        except ValueError as error:
            source.hide()
            self._say(f"{source.topic}: {error}")

    def _place(self, source: _Source) -> Place | None:
        frame_id = source.message.header.frame_id
        found = find_frame(self.page.world, frame_id)
        if found is None:
            self._say(f"{source.topic}: no link or sensor has the frame '{frame_id}'")
            return None
        model, link, pose = found
        drawn, record = self.page.drawing.model_root(model), self.page.world.model(model)
        if drawn is None or record is None or record.links.get(link) not in drawn.links:
            return None
        return Place(drawn.links[record.links[link]].name, pose, model, link)

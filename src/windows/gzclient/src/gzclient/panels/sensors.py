"""What the sensors see, drawn in the world: laser scans, sonar cones, cameras with their live picture."""
from __future__ import annotations

import math
from typing import Any, Callable, Dict, Optional, Tuple

import numpy as np
import rosgraph
import rospy
from ode_sim.viewer.drawing import wxyz
from ode_sim.viewer.panels.base import Panel, escaped
from ode_sim.viewer.simulation import Frame, Refused, WorldRecord
from sensor_msgs.msg import Image, LaserScan, Range

from gzclient.images import picture_of
from gzclient.sensor_frames import field_of_view, find_frame, optical, range_cone, scan_points

_KINDS = {"Laser scans": ("sensor_msgs/LaserScan", LaserScan), "Sonars": ("sensor_msgs/Range", Range),
          "Cameras": ("sensor_msgs/Image", Image)}
_MOST_CAMERAS = 4
_SMALL = 160  # pixels along a side of a picture in a frustum


class _Source:
    """The newest message of one topic, and the node that shows it."""

    def __init__(self, topic: str, cls: type):
        self.topic = topic
        self.message: Any = None
        self.fresh = False
        self.node: Any = None
        self.place: Optional[Tuple] = None
        self._subscriber = rospy.Subscriber(topic, cls, self._take, queue_size=1, buff_size=1 << 24)

    def _take(self, message: Any) -> None:
        self.message, self.fresh = message, True

    def end(self) -> None:
        self._subscriber.unregister()
        self.hide()

    def hide(self) -> None:
        if self.node is not None:
            self.node.remove()
            self.node = None


class SensorsPanel(Panel):
    title = "Sensors"

    def __init__(self, page: Any):
        super().__init__(page)
        self._sources: Dict[str, Dict[str, _Source]] = {}
        self._draw: Dict[str, Callable[[_Source], None]] = {
            "Laser scans": self._draw_scan, "Sonars": self._draw_cone, "Cameras": self._draw_camera}
        for kind in _KINDS:
            box = self.gui.add_checkbox(kind, False)
            self.on_update(box, lambda on, kind=kind: self._switch(kind, on))
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
                    self._draw[kind](source)

    def _switch(self, kind: str, on: bool) -> None:
        """In the thread of the click."""
        name, cls = _KINDS[kind]
        found: Dict[str, _Source] = {}
        if on:
            try:
                topics = sorted(topic for topic, type_name in rosgraph.Master(rospy.get_name()).getPublishedTopics("")
                                if type_name == name)
            except (OSError, rosgraph.MasterException) as error:
                raise Refused(f"the ROS master does not answer: {error}") from error
            found = {topic: _Source(topic, cls) for topic in (topics[:_MOST_CAMERAS] if kind == "Cameras" else topics)}
        self.page.later(lambda: self._replace(kind, found, on))

    def _replace(self, kind: str, found: Dict[str, _Source], on: bool) -> None:
        for source in self._sources.pop(kind, {}).values():
            source.end()
        if on:
            self._sources[kind] = found
            self._say(f"{kind}: {', '.join(found) or 'no topic has them'}")

    def _say(self, line: str) -> None:
        self._note.content = f"<div style='padding:0 0.6em;font-size:0.8em'>{escaped(line)}</div>"

    # ------------------------------------------------------------------------------------------ drawing

    def _place(self, source: _Source) -> Optional[Tuple]:
        """(name of the node that carries the sensor, X_LS, model, link)."""
        found = find_frame(self.page.world, source.message.header.frame_id)
        if found is None:
            self._say(f"{source.topic}: no link or sensor has the frame '{source.message.header.frame_id}'")
            return None
        model, link, pose = found
        drawn, record = self.page.drawing.model_root(model), self.page.world.model(model)
        if drawn is None or record is None or record.links.get(link) not in drawn.links:
            return None
        return drawn.links[record.links[link]].name, pose, model, link

    def _node(self, place: Tuple, source: _Source) -> str:
        return f"{place[0]}/sensor{abs(hash(source.topic)) % 1_000_000}"  # a topic's name has slashes

    def _draw_scan(self, source: _Source) -> None:
        place = self._place(source)
        points = scan_points(source.message)
        if place is None or not len(points):
            source.hide()
            return
        if source.node is None:
            source.node = self.page.server.scene.add_point_cloud(
                self._node(place, source), points, colors=(30, 60, 255), point_size=0.03, precision="float32",
                position=place[1].p, wxyz=wxyz(place[1].q))
        else:
            source.node.points = points

    def _draw_cone(self, source: _Source) -> None:
        place = self._place(source)
        if place is None:
            source.hide()
            return
        rim = range_cone(source.message)
        apex = np.zeros_like(rim)
        lines = np.concatenate([np.stack([apex, rim], 1), np.stack([rim[:-1], rim[1:]], 1)])
        if source.node is None:
            source.node = self.page.server.scene.add_line_segments(
                self._node(place, source), lines, colors=(255, 140, 0), thickness=0.008, position=place[1].p,
                wxyz=wxyz(place[1].q))
        else:
            source.node.points = lines

    def _draw_camera(self, source: _Source) -> None:
        place = self._place(source)
        if place is None:
            source.hide()
            return
        try:
            picture = picture_of(source.message)
        except ValueError as error:
            self._say(f"{source.topic}: {error}")
            return
        step = -(-max(picture.shape[:2]) // _SMALL)
        picture = np.ascontiguousarray(picture[::step, ::step])
        if source.node is None:
            aspect = picture.shape[1] / picture.shape[0]
            wide = field_of_view(self.page.world, place[2], place[3], source.message.header.frame_id)
            pose = optical(place[1])
            source.node = self.page.server.scene.add_camera_frustum(
                self._node(place, source), fov=2 * math.atan(math.tan(min(wide, 3.0) / 2) / aspect), aspect=aspect,
                scale=0.3, image=picture, format="jpeg", position=pose.p, wxyz=wxyz(pose.q), cast_shadow=False)
        else:
            source.node.image = picture

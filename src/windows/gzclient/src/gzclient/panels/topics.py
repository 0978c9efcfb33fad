"""Topics: their text, images, and plots of their numbers; laser scans in the world."""

from __future__ import annotations

import time
from collections import deque
from typing import Any

import genpy
import numpy as np
import rosgraph
import roslib.message
import rospy
from ode_sim_viewer.panels.base import Panel, escaped, note
from ode_sim_viewer.simulation import Frame, Refused

from gzclient.images import picture_of

_NONE = "(choose Look for topics)"
_LONGEST = 3000  # characters of a message that are shown
_MOST_POINTS = 600  # of a plot
_IMAGES = ("sensor_msgs/Image", "sensor_msgs/CompressedImage")


class TopicsPanel(Panel):
    """One topic at a time; it is subscribed to only while it is chosen and somebody looks."""

    title = "Topics"

    def __init__(self, page: Any):
        super().__init__(page)
        self._subscriber: rospy.Subscriber | None = None
        self._topic, self._type = "", ""
        self._message: Any = None
        self._count = 0
        self._drawn = 0
        self._points: deque[tuple[float, float]] = deque(maxlen=_MOST_POINTS)
        self._path = ""
        self._plot: Any = None
        self.on_click(self.gui.add_button("Look for topics"), self._find)
        self._search = self.gui.add_text("Search", "")
        self._chosen = self.gui.add_dropdown("Topic", (_NONE,))
        self._field = self.gui.add_text("Plot", "", hint="a number of the message, as in pose[0].position.x")
        self._why = self.gui.add_html("", visible=False)  # there is no plot
        self._state = self.gui.add_html(note("no topic"))
        self._picture = self.gui.add_folder("Picture", visible=False)
        self._image: Any = None
        self._text = self.gui.add_html("", visible=False)
        self._plots = self.gui.add_folder("Plot", visible=False)
        self._topics: tuple[str, ...] = ()
        self._search.on_update(lambda event: self._narrow())
        self.on_update(self._chosen, self._choose)
        self.on_update(self._field, self._plot_field)

    # ------------------------------------------------------------------------------------------ choosing

    def _find(self) -> None:
        try:
            published = rosgraph.Master(rospy.get_name()).getPublishedTopics("")
        except (OSError, rosgraph.MasterException) as error:
            raise Refused(f"the ROS master does not answer: {error}") from error
        self._topics = tuple(sorted(name for name, _ in published))
        self._narrow()

    def _narrow(self) -> None:
        wanted = self._search.value.lower()
        self._chosen.options = (_NONE, *(name for name in self._topics if wanted in name.lower()))

    def _choose(self, topic: str) -> None:
        if self._subscriber is not None:
            self._subscriber.unregister()
            self._subscriber = None
        self._topic, self._message, self._count, self._drawn = topic, None, 0, 0
        self._points.clear()
        self._picture.visible = self._text.visible = self._why.visible = self._plots.visible = False
        if topic == _NONE:
            self._state.content = note("no topic")
            return
        kinds = dict(rosgraph.Master(rospy.get_name()).getTopicTypes())
        self._type = kinds.get(topic, "")
        cls = roslib.message.get_message_class(self._type) if self._type else None
        if cls is None:
            raise Refused(f"{topic}: its type {self._type or '(unknown)'} is not built here; source the workspace that has it")
        self._subscriber = rospy.Subscriber(topic, cls, self._take, queue_size=1, buff_size=1 << 24)
        self._state.content = note(f"{topic}: waiting for a message of {self._type}")

    def _plot_field(self, path: str) -> None:
        self._path = path.strip().lstrip("/")
        self._points.clear()
        self._why.visible = self._plots.visible = False
        self._drawn = -1  # the message that is there already is looked at again

    def _take(self, message: Any) -> None:
        self._message = message
        self._count += 1
        if self._path:
            try:
                self._points.append((time.monotonic(), number_at(message, self._path)))
            except Refused:
                pass  # said where it is drawn

    # ------------------------------------------------------------------------------------------ showing

    def on_frame(self, frame: Frame) -> None:
        message = self._message
        if message is None or self._count == self._drawn:
            return
        self._drawn = self._count
        self._state.content = note(f"{self._topic} ({self._type}), {self._count} messages")
        if self._type in _IMAGES:
            try:
                self._show_image(picture_of(message))
            except ValueError as error:
                self._state.content = note(f"{self._topic}: {error}")
        else:
            self._show_text(message)
        if self._path:
            self._show_plot(message)

    def _show_image(self, picture: np.ndarray) -> None:
        if self._image is None:
            with self._picture:
                self._image = self.gui.add_image(picture, format="jpeg")
        else:
            self._image.image = picture
        self._picture.visible = True

    def _show_text(self, message: Any) -> None:
        text = genpy.message.strify_message(message, fixed_numeric_width=None)
        more = f"\n... {len(text) - _LONGEST} characters more" if len(text) > _LONGEST else ""
        self._text.content = (
            f"<pre style='font-size:0.7em;max-height:22em;overflow:auto;margin:0 0.6em'>{escaped(text[:_LONGEST] + more)}</pre>"
        )
        self._text.visible = True

    def _show_plot(self, message: Any) -> None:
        try:
            number_at(message, self._path)
        except Refused as error:
            self._why.content = note(str(error))
            self._why.visible = True
            self._plots.visible = False
            return
        self._why.visible = False
        self._plots.visible = True
        points: list[tuple[float, float]] = list(self._points)
        if len(points) < 2:
            return
        values = np.array(points).T
        data = (values[0] - values[0][-1], values[1])
        if self._plot is None:
            from viser import uplot

            with self._plots:
                self._plot = self.gui.add_uplot(
                    data,
                    (uplot.Series(label="s"), uplot.Series(label="value", stroke="#1c7ed6", width=2)),
                    scales={"x": uplot.Scale(time=False, auto=True), "y": uplot.Scale(auto=True)},
                    aspect=1.6,
                )
        else:
            self._plot.data = data


def number_at(message: Any, path: str) -> float:
    """The number at the ``path`` ``a.b[2].c`` of a ``message``; times and durations in s.

    :raises Refused: there is none
    """
    value, walked = message, ""
    for part in path.replace("/", ".").replace("[", ".[").split("."):
        if not part:
            continue
        try:
            value = value[int(part[1:-1])] if part.startswith("[") else getattr(value, part) if part in value.__slots__ else _missing(part)
        except (AttributeError, IndexError, KeyError, TypeError, ValueError) as error:
            raise Refused(f"there is no {part} {('in ' + walked) if walked else 'in the message'}") from error
        walked = f"{walked}.{part}".strip(".").replace(".[", "[")
    if isinstance(value, (bool, int, float)):
        return float(value)
    if isinstance(value, (genpy.Time, genpy.Duration)):
        return value.to_sec()
    raise Refused(f"{path} is no number but {type(value).__name__}")


def _missing(part: str) -> Any:
    raise AttributeError(part)

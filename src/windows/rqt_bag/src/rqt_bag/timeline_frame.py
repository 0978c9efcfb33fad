"""The picture of the time line: a row per topic, the playhead, the marked region; and the mouse on it."""

from __future__ import annotations

import math
import time

import genpy
import numpy as np
from python_qt_binding.QtCore import QPointF, QRectF, QSize, Qt, Signal
from python_qt_binding.QtGui import QColor, QFont, QFontMetrics, QPainter, QPolygonF, QTextOption
from python_qt_binding.QtWidgets import QSizePolicy, QWidget

from rqt_bag.loading import load_plugins, views_of

_MARGIN = 4
_TIME_HEIGHT = 28  # of the strip above the rows
_ROW_HEIGHT = 16
_COMBINE = 1.5  # px: messages that are closer are one bar
_MOST_NAME_WIDTH = 0.35  # of the window
_CLOSEST, _FARTHEST = 1e-7, 1.2  # s per pixel at least; spans of all messages at most
_ZOOM = 0.8  # per notch of the wheel: 20 % nearer
_DIVISIONS = [base * 10.0**power for power in range(-9, 1) for base in (1, 2, 5)] + [
    15.0,
    30.0,
    60.0,
    300.0,
    900.0,
    1800.0,
    3600.0,
    10800.0,
    21600.0,
    43200.0,
    86400.0,
    604800.0,
]
_TYPE_COLORS = {
    "sensor_msgs/Image": QColor(0, 77, 77),
    "sensor_msgs/CompressedImage": QColor(0, 120, 120),
    "sensor_msgs/LaserScan": QColor(153, 0, 0),
    "sensor_msgs/PointCloud2": QColor(128, 0, 128),
    "tf2_msgs/TFMessage": QColor(0, 153, 0),
    "tf/tfMessage": QColor(0, 153, 0),
    "sensor_msgs/JointState": QColor(180, 100, 0),
    "rosgraph_msgs/Log": QColor(110, 110, 110),
}


def type_color(datatype: str | None) -> QColor:
    """The colour of a type; types of one package have neighbouring hues."""
    if datatype in _TYPE_COLORS:
        return _TYPE_COLORS[datatype]
    package, _, name = (datatype or "").partition("/")
    hue = (sum(map(ord, package)) * 37 + sum(map(ord, name)) * 3) % 360
    return QColor.fromHsv(hue, 200, 150)


class TimelineFrame(QWidget):
    """Draws a BagTimeline.

    :ivar _history_left: x of the left end of the rows, pixels, as renderers of others ask for it.
    """

    menu_wanted = Signal(object, object)  #: place on the screen, topic or None
    region_selected = Signal()

    def __init__(self, timeline, parent=None):
        super().__init__(parent)
        self.setObjectName("timeline")
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.MinimumExpanding)
        self._timeline = timeline
        timeline._timeline_frame = self
        self._views, renderers = load_plugins()
        self._timeline_renderers = {kind: renderer(self) for kind, renderer in renderers.items()}
        self._rendered_topics: set = set()
        self._playhead: genpy.Time | None = None
        self._start: genpy.Time | None = None
        self._end: genpy.Time | None = None
        self._left, self._right = 0.0, 1.0  # s at the ends of the rows
        self._region: tuple[float, float] | None = None
        self._drag: tuple | None = None
        self._rows: list[tuple[str, int, int]] = []  # topic, y, height
        self._history_left, self._history_right, self._history_top = 0, 1, _TIME_HEIGHT

    def scene(self):
        """The BagTimeline, as renderers of others ask for it."""
        return self._timeline

    # Times

    @property
    def start_stamp(self) -> genpy.Time | None:
        return self._start

    @property
    def end_stamp(self) -> genpy.Time | None:
        return self._end

    @property
    def play_region(self) -> tuple[genpy.Time | None, genpy.Time | None]:
        """The marked region, or all."""
        if self._region:
            return tuple(genpy.Time.from_sec(max(0.0, edge)) for edge in self._region)
        return self._start, self._end

    @property
    def has_selected_region(self) -> bool:
        return self._region is not None

    def select_region(self, begin: float | None, end: float | None = None) -> None:
        """Mark from ``begin`` to ``end`` (s); None marks nothing."""
        if begin is None or end is None or self._start is None or self._end is None:
            self._region = None
        else:
            low, high = self._start.to_sec(), self._end.to_sec()
            self._region = tuple(sorted(min(max(edge, low), high) for edge in (begin, end)))
        self._timeline.selected_region_changed.emit(*self.play_region)
        self.update()

    @property
    def playhead(self) -> genpy.Time | None:
        return self._playhead

    @playhead.setter
    def playhead(self, stamp: genpy.Time) -> None:
        self.move_playhead(stamp, False)

    def move_playhead(self, stamp: genpy.Time, playing: bool) -> None:
        """Move the playhead to ``stamp``, within the bags; the window scrolls along.

        :param playing: all that it passes is published.
        """
        if self._start is None or stamp is None:
            return
        before, self._playhead = self._playhead, min(max(stamp, self._start), self._end)
        if self._playhead == before:
            return
        at, width = self._playhead.to_sec(), self._right - self._left
        if at > self._right:
            self._left, self._right = at - 0.75 * width, at + 0.25 * width
        elif at < self._left:
            self._left, self._right = at - 0.25 * width, at + 0.75 * width
        self._timeline.playhead_moved(before, self._playhead, playing)
        self.update()

    def bags_changed(self) -> None:
        """Bags were added."""
        begin, end = self._timeline._get_start_stamp(), self._timeline._get_end_stamp()
        first = self._start is None
        self._start, self._end = begin, end
        if begin is not None:
            if first or self._left > begin.to_sec() or self._right < end.to_sec():
                self.reset_zoom()
            if self._playhead is None:
                self.playhead = begin
        self._layout()
        self.update()

    def recording_grew(self) -> None:
        """Messages were recorded that no closed bag has yet."""
        stamps = [stamp for stamps in list(self._timeline._live.values()) for stamp in (stamps[0], stamps[-1])]
        if not stamps:
            return
        low = min(stamps) if self._start is None else min(min(stamps), self._start.to_sec())
        self._start, self._end = genpy.Time.from_sec(low), genpy.Time.from_sec(max(stamps))
        self.reset_zoom()
        self._layout()
        self.update()

    # View

    def map_x_to_stamp(self, x: float, clamp_to_visible: bool = True) -> float:
        """s at the pixel column ``x``.

        :param clamp_to_visible: beside the rows it is the time at their end
        """
        share = (x - self._history_left) / max(1, self._history_right - self._history_left)
        if clamp_to_visible:
            share = min(max(share, 0.0), 1.0)
        return self._left + share * (self._right - self._left)

    def map_dx_to_dstamp(self, dx: float) -> float:
        return dx * (self._right - self._left) / max(1, self._history_right - self._history_left)

    def map_stamp_to_x(self, stamp: float, clamp_to_visible: bool = True) -> float:
        """Pixel column of ``stamp`` (s).

        :param clamp_to_visible: a time that is not shown has the column at the rows' end
        """
        share = (stamp - self._left) / (self._right - self._left)
        if clamp_to_visible:
            share = min(max(share, 0.0), 1.0)
        return self._history_left + share * (self._history_right - self._history_left)

    def map_dstamp_to_dx(self, dstamp: float) -> float:
        return dstamp * (self._history_right - self._history_left) / (self._right - self._left)

    def map_y_to_topic(self, y: float) -> str | None:
        return next((topic for topic, top, height in self._rows if top <= y < top + height), None)

    def set_timeline_view(self, left: float, right: float) -> None:
        """Show from ``left`` to ``right``, s."""
        self._left, self._right = left, right
        self.update()

    def reset_zoom(self) -> None:
        """Show all."""
        if self._start is not None and self._end is not None:
            begin, end = self._start.to_sec(), self._end.to_sec()
            room = 0.02 * (end - begin) or 0.5
            self.set_timeline_view(begin - room, end + room)

    def reset_timeline(self) -> None:
        """Show all, mark nothing, go to the beginning."""
        self.reset_zoom()
        self.select_region(None)
        if self._start is not None:
            self.playhead = self._start

    def zoom_timeline(self, factor: float, center: float | None = None) -> None:
        """Show a span ``factor`` times as long, ``center`` (s) stays in place."""
        if self._start is None or self._end is None:
            return
        center = (self._playhead.to_sec() if self._playhead else self._left) if center is None else center
        width = self._right - self._left
        longest = max(_FARTHEST * (self._end.to_sec() - self._start.to_sec()), 2.0)
        wanted = min(max(width * factor, _CLOSEST * max(1, self.width())), longest)
        share = (center - self._left) / width
        self.set_timeline_view(center - share * wanted, center + (1 - share) * wanted)

    def zoom_in(self) -> None:
        self.zoom_timeline(0.5)

    def zoom_out(self) -> None:
        self.zoom_timeline(2.0)

    def translate_timeline(self, dstamp: float) -> None:
        self.set_timeline_view(self._left + dstamp, self._right + dstamp)

    def translate_timeline_left(self) -> None:
        self.translate_timeline(-0.05 * (self._right - self._left))

    def translate_timeline_right(self) -> None:
        self.translate_timeline(0.05 * (self._right - self._left))

    # Renderers

    def get_viewer_types(self, datatype: str) -> list[type]:
        return views_of(self._views, datatype)

    def get_renderers(self) -> list[tuple[str, object]]:
        """(topic, renderer) of the topics that can have thumbnails."""
        found = ((topic, self._timeline_renderers.get(self._timeline.get_datatype(topic))) for topic in self._timeline.topics)
        return [(topic, renderer) for topic, renderer in found if renderer is not None]

    def is_renderer_active(self, topic: str) -> bool:
        return topic in self._rendered_topics

    def set_renderer_active(self, topic: str, active: bool) -> None:
        """Draw the messages of ``topic`` with its renderer while ``active``, else as plain bars."""
        (self._rendered_topics.add if active else self._rendered_topics.discard)(topic)
        self._timeline.update()

    def set_renderers_active(self, active: bool) -> None:
        for topic, _ in self.get_renderers():
            self.set_renderer_active(topic, active)

    def toggle_renderers(self) -> None:
        self.set_renderers_active(not self._rendered_topics)

    def _renderer(self, topic: str):
        return self._timeline_renderers.get(self._timeline.get_datatype(topic)) if topic in self._rendered_topics else None

    def handle_close(self) -> None:
        for renderer in self._timeline_renderers.values():
            renderer.close()

    # Drawing

    def _layout(self) -> None:
        metrics = QFontMetrics(self.font())
        topics = self._timeline.topics
        widest = max((metrics.boundingRect(topic).width() for topic in topics), default=60) + 3 * _MARGIN
        self._history_left = int(min(widest, _MOST_NAME_WIDTH * self.width())) + _MARGIN
        self._history_right = max(self._history_left + 10, self.width() - 2 * _MARGIN)
        y, self._rows = _TIME_HEIGHT, []
        for topic in topics:
            renderer = self._renderer(topic)
            height = (renderer.get_segment_height(topic) if renderer else None) or max(_ROW_HEIGHT, metrics.height() + 2)
            self._rows.append((topic, y, height))
            y += height + 1
        if self.minimumHeight() != y + _MARGIN:
            self.setMinimumHeight(y + _MARGIN)

    def sizeHint(self) -> QSize:
        return QSize(600, 200)

    def paintEvent(self, _event) -> None:
        self._layout()
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor("white"))
        bottom = self._rows[-1][1] + self._rows[-1][2] if self._rows else _TIME_HEIGHT
        if self._start is not None:
            self._draw_region(painter, bottom)
            self._draw_times(painter, bottom, self._start.to_sec())
        for number, (topic, y, height) in enumerate(self._rows):
            self._draw_row(painter, topic, y, height, number)
        if self._playhead is not None:
            self._draw_playhead(painter, bottom, self._playhead.to_sec())
        painter.end()

    def _draw_row(self, painter: QPainter, topic: str, y: int, height: int, number: int) -> None:
        datatype = self._timeline.get_datatype(topic)
        if number % 2 == 0:
            painter.fillRect(QRectF(0, y, self.width(), height), QColor(0, 0, 0, 12))
        painter.setPen(QColor("black"))
        font = QFont(self.font())
        font.setBold(self._timeline.is_publishing(topic))
        painter.setFont(font)
        width = self._history_left - 3 * _MARGIN
        name = QFontMetrics(font).elidedText(topic, Qt.TextElideMode.ElideMiddle, width)
        painter.drawText(QRectF(_MARGIN, y, width, height), name, QTextOption(Qt.AlignmentFlag.AlignVCenter))
        renderer = self._renderer(topic)
        for begin, end in self._segments(topic, _COMBINE):
            x, right = self.map_stamp_to_x(begin), self.map_stamp_to_x(end)
            painter.fillRect(QRectF(x, y + 2, max(1.0, right - x), height - 4), type_color(datatype))
        for begin, end in self._segments(topic, renderer.msg_combine_px) if renderer else ():
            x, right = self.map_stamp_to_x(begin), self.map_stamp_to_x(end)
            if not self._draw_by(renderer, painter, topic, begin, end, x, y, right - x, height):
                break

    def _draw_by(
        self, renderer, painter: QPainter, topic: str, begin: float, end: float, x: float, y: int, width: float, height: int
    ) -> bool:
        painter.save()
        try:
            renderer.draw_timeline_segment(painter, topic, begin, end, int(x), y, max(1, int(width)), height)
            return True
        except Exception as error:  # renderers of others: one that fails must not fail forty times a second
            self._rendered_topics.discard(topic)
            self._timeline.problem.emit(f"thumbnails of {topic} are switched off: {type(error).__name__}: {error}")
            return False
        finally:
            painter.restore()

    def _segments(self, topic: str, combine: float) -> list[tuple[float, float]]:
        """Stretches of messages that are seen and lie closer than ``combine`` pixels."""
        stamps = np.asarray(self._timeline.stamps(topic))
        begin, end = np.searchsorted(stamps, self._left - 1e-9), np.searchsorted(stamps, self._right + 1e-9)
        stamps = stamps[begin:end]
        if not len(stamps):
            return []
        breaks = np.flatnonzero(np.diff(stamps) > self.map_dx_to_dstamp(combine))
        return list(zip(stamps[np.concatenate(([0], breaks + 1))], stamps[np.concatenate((breaks, [len(stamps) - 1]))]))

    def _draw_times(self, painter: QPainter, bottom: int, origin: float) -> None:
        painter.setFont(self.font())
        wanted = self.map_dx_to_dstamp(90)
        step = next((division for division in _DIVISIONS if division >= wanted), _DIVISIONS[-1])
        number = math.ceil((self._left - origin) / step)
        while origin + number * step <= self._right:
            x = self.map_stamp_to_x(origin + number * step)
            painter.setPen(QColor(0, 0, 0, 60))
            painter.drawLine(QPointF(x, _TIME_HEIGHT - 6), QPointF(x, bottom))
            painter.setPen(QColor("black"))
            painter.drawText(QPointF(x + 2, _TIME_HEIGHT - 10), elapsed_text(number * step, step))
            number += 1

    def _draw_region(self, painter: QPainter, bottom: int) -> None:
        if self._region:
            left, right = (self.map_stamp_to_x(edge) for edge in self._region)
            painter.fillRect(QRectF(left, _TIME_HEIGHT - 8, right - left, bottom - _TIME_HEIGHT + 8), QColor(0, 179, 0, 50))
            painter.fillRect(QRectF(left, _TIME_HEIGHT - 8, right - left, 8), QColor(0, 140, 0, 160))

    def _draw_playhead(self, painter: QPainter, bottom: int, stamp: float) -> None:
        x = self.map_stamp_to_x(stamp, False)
        if self._history_left <= x <= self._history_right:
            painter.setPen(QColor("red"))
            painter.setBrush(QColor("red"))
            painter.drawLine(QPointF(x, _TIME_HEIGHT - 8), QPointF(x, bottom))
            painter.drawPolygon(
                QPolygonF([QPointF(x - 5, _TIME_HEIGHT - 12), QPointF(x + 5, _TIME_HEIGHT - 12), QPointF(x, _TIME_HEIGHT - 3)])
            )

    # Mouse

    def _region_part(self, x: float) -> str:
        """Which part of the marked region is at a column: ``begin``, ``end``, ``inside`` or ````."""
        if not self._region:
            return ""
        left, right = (self.map_stamp_to_x(edge, False) for edge in self._region)
        if abs(x - left) < 5:
            return "begin"
        return "end" if abs(x - right) < 5 else "inside" if left < x < right else ""

    def mousePressEvent(self, event) -> None:
        x, y = event.pos().x(), event.pos().y()
        self.setFocus()
        panning = event.button() == Qt.MouseButton.MiddleButton or (
            event.button() == Qt.MouseButton.LeftButton and event.modifiers() & Qt.KeyboardModifier.ShiftModifier
        )
        if event.button() == Qt.MouseButton.RightButton:
            self.menu_wanted.emit(self.mapToGlobal(event.pos()), self.map_y_to_topic(y))
        elif self._start is None:
            return
        elif panning:
            self._drag = "pan", x, y, None
        elif event.button() == Qt.MouseButton.LeftButton:
            stamp = self.map_x_to_stamp(x)
            if y < _TIME_HEIGHT:
                self._drag = "region", stamp, self._region_part(x) or "new", self._region
            elif x >= self._history_left:
                self._drag = "playhead", x, y, None
                self.playhead = genpy.Time.from_sec(max(0.0, stamp))

    def mouseMoveEvent(self, event) -> None:
        x, y = event.pos().x(), event.pos().y()
        if self._drag is None:
            part = self._region_part(x) if y < _TIME_HEIGHT else ""
            self.setCursor(
                {"begin": Qt.CursorShape.SizeHorCursor, "end": Qt.CursorShape.SizeHorCursor, "inside": Qt.CursorShape.OpenHandCursor}.get(
                    part, Qt.CursorShape.ArrowCursor
                )
            )
            return
        kind, begin, second, region = self._drag
        stamp = self.map_x_to_stamp(x)
        if kind == "playhead":
            self.playhead = genpy.Time.from_sec(max(0.0, stamp))
        elif kind == "pan":
            self.translate_timeline(-self.map_dx_to_dstamp(x - begin))
            self.zoom_timeline(1.01 ** (second - y), self.map_x_to_stamp(x))
            self._drag = "pan", x, y, None
        elif second == "new":
            self.select_region(begin, stamp)
        else:
            low, high = region
            shift = stamp - begin
            self.select_region(low + shift * (second != "end"), high + shift * (second != "begin"))

    def mouseReleaseEvent(self, event) -> None:
        if self._drag is not None:
            self.mouseMoveEvent(event)
        if self._drag is not None and self._drag[0] == "region" and self._drag[2] == "new":
            if self.map_dstamp_to_dx(abs(self.map_x_to_stamp(event.pos().x()) - self._drag[1])) < 3:
                self.select_region(None)  # a click beside the region
        self._drag = None

    def wheelEvent(self, event) -> None:
        notches = event.angleDelta().y() / 120
        position = event.position() if hasattr(event, "position") else event.posF()
        self.zoom_timeline(_ZOOM**notches, self.map_x_to_stamp(position.x()))
        event.accept()

    def contextMenuEvent(self, event) -> None:
        event.accept()  # the press has opened it


def elapsed_text(seconds: float, step: float) -> str:
    """A time since the beginning, ``seconds``, as finely as the divisions of ``step`` seconds are."""
    sign, seconds = ("-", -seconds) if seconds < 0 else ("", seconds)
    if step >= 1.0:
        seconds = round(seconds)
        hours, minutes = seconds // 3600, seconds // 60 % 60
        return sign + (f"{hours}:{minutes:02d}:{seconds % 60:02d}" if hours else f"{minutes}:{seconds % 60:02d}")
    return f"{sign}{seconds:.{max(1, math.ceil(-math.log10(step)))}f}s"


def date_text(stamp: genpy.Time) -> str:
    """Date and time of a stamp."""
    return time.strftime("%b %d %Y %H:%M:%S", time.localtime(stamp.secs)) + f".{stamp.nsecs // 1_000_000:03d}"

"""One plot drawn by pyqtgraph: axes that can show times, the mouse, the cursor. It knows no ROS."""

from __future__ import annotations

import math
import time
from typing import Any

import numpy as np
from python_qt_binding.QtCore import QPointF, Qt, Signal
from python_qt_binding.QtGui import QColor, QPen
from rqt_plot.graphics import pyqtgraph as pg

from rqt_multiplot.config import ColorType, Curve, Orientation, StyleType, automatic_color
from rqt_multiplot.points import Points

_EPOCH = 1e8  # s: times below are those of a simulation, and short enough to be read


class Axis(pg.AxisItem):
    """An axis of numbers, or of times: seconds since its first value, whose date the title says."""

    def __init__(self, orientation: str):
        super().__init__(orientation)
        self.offset = 0.0
        self.enableAutoSIPrefix(False)

    def set_times_from(self, first: float | None) -> bool:
        """Show times since ``first`` (s since 1970); None shows numbers. :returns: whether that changed."""
        offset = float(math.floor(first)) if first is not None and first > _EPOCH else 0.0
        changed, self.offset = offset != self.offset, offset
        if changed:
            self.picture = None
            self.update()
        return changed

    def suffix(self) -> str:
        """What the title has to say about the offset."""
        return time.strftime(" [s since %Y-%m-%d %H:%M:%S]", time.localtime(self.offset)) if self.offset else ""

    def tickValues(self, low, high, size):
        """As pyqtgraph asks: (step, values) of the ticks from ``low`` to ``high``, round where the offset is taken off.

        :param size: length of the axis, pixels
        """
        return [
            (step, [value + self.offset for value in values])
            for step, values in super().tickValues(low - self.offset, high - self.offset, size)
        ]

    def tickStrings(self, values, scale, spacing):
        """As pyqtgraph asks: texts of ``values``, less the offset; ``scale`` and ``spacing`` are those of the base class."""
        return super().tickStrings([value - self.offset for value in values], scale, spacing)


class Canvas(pg.ViewBox):
    """Left drag pans, wheel and right drag magnify. A double click begins a rubber band that the next click ends; a right
    click shows all again."""

    home = Signal()

    def __init__(self):
        super().__init__(enableMenu=False)
        self._corner: QPointF | None = None

    def mouseDoubleClickEvent(self, event) -> None:
        event.accept()

    def mouseClickEvent(self, event) -> None:
        if event.button() == Qt.MouseButton.RightButton:
            event.accept()
            self._end_band()
            self.home.emit()
        elif event.button() == Qt.MouseButton.LeftButton and event.double():
            event.accept()
            self._corner = event.pos()
        elif event.button() == Qt.MouseButton.LeftButton and self._corner is not None:
            event.accept()
            corner, other = (self.mapToView(point) for point in (self._corner, event.pos()))
            self._end_band()
            if corner.x() != other.x() and corner.y() != other.y():
                self.setRange(xRange=sorted((corner.x(), other.x())), yRange=sorted((corner.y(), other.y())), padding=0)
                self.sigRangeChangedManually.emit(self.state["mouseEnabled"])

    def band_to(self, position: QPointF) -> None:
        """Draw the rubber band, if there is one, to a place in this item."""
        if self._corner is not None:
            self.updateScaleBox(self._corner, position)
            self.rbScaleBox.show()

    def _end_band(self) -> None:
        self._corner = None
        self.rbScaleBox.hide()


class PlotView(pg.PlotWidget):
    """The drawing of one plot."""

    cursor_moved = Signal(object)  #: (x, y) below the mouse, or None
    range_chosen = Signal(object)  #: ((x low, high), (y low, high)) that the user has moved to
    home_wanted = Signal()

    def __init__(self, parent=None):
        self.canvas = Canvas()
        self.x_axis, self.y_axis = Axis("bottom"), Axis("left")
        super().__init__(parent, viewBox=self.canvas, axisItems={"bottom": self.x_axis, "left": self.y_axis})
        self.plotItem.hideButtons()
        self.plotItem.disableAutoRange()
        self.plotItem.showGrid(True, True, 0.15)
        self.legend = self.plotItem.addLegend(offset=(-10, 10))
        self.track_points = False
        self._items: list[Any] = []
        self._colors: list[QColor] = []
        self._foreground, self._background = QColor("black"), QColor("white")
        self._build_cursor()
        self.canvas.home.connect(self.home_wanted)
        self.canvas.sigRangeChangedManually.connect(lambda *_: self.range_chosen.emit(self.shown_range()))
        self.scene().sigMouseMoved.connect(self._mouse_moved)
        self.setMouseTracking(True)

    def _build_cursor(self) -> None:
        self._lines = [pg.InfiniteLine(angle=90), pg.InfiniteLine(angle=0)]
        self._label = pg.TextItem(anchor=(0, 1))
        self._tracked = pg.ScatterPlotItem(size=7)
        self._track_label = pg.TextItem(anchor=(0, 0))
        for item in (*self._lines, self._label, self._tracked, self._track_label):
            item.setZValue(100)
            self.plotItem.addItem(item, ignoreBounds=True)
            item.hide()

    # Look

    def set_colors(self, background: QColor, foreground: QColor) -> None:
        """Draw axes, cursor and texts in ``foreground`` on ``background``."""
        self._background, self._foreground = background, foreground
        self.setBackground(background)
        for axis in (self.x_axis, self.y_axis):
            axis.setPen(foreground)
            axis.setTextPen(foreground)
        for line in self._lines:
            line.setPen(QPen(foreground, 0, Qt.PenStyle.DashLine))
        for label in (self._label, self._track_label):
            label.setColor(foreground)
            label.fill = pg.mkBrush(background)
        self.legend.setLabelTextColor(foreground)
        for _sample, label in self.legend.items:
            label.setText(label.text)

    def set_titles(self, x: str, y: str) -> None:
        """Titles of the axes, ``x`` and ``y``; long ones are cut."""
        for axis, text in ((self.x_axis, x), (self.y_axis, y)):
            shown = text + axis.suffix() if text or axis.offset else ""
            if shown != axis.labelText:
                # A long title must not make its plot wide.
                axis.setLabel((shown if len(shown) <= 90 else shown[:87] + "...").strip())

    def set_curves(self, curves: list[Curve], legend: bool) -> None:
        """Draw ``curves`` from now on; each is empty until :meth:`draw`. ``legend``: show their names, if there are any."""
        self.legend.clear()
        for item in self._items:
            self.plotItem.removeItem(item)
        self._items, self._colors = [], []
        for index, curve in enumerate(curves):
            color = QColor(*automatic_color(index)) if curve.color.type == ColorType.AUTO else QColor(curve.color.custom_color)
            pen = pg.mkPen(color, width=curve.style.pen_width, style=Qt.PenStyle(int(curve.style.pen_style)))
            if curve.style.type == StyleType.POINTS:
                item = pg.ScatterPlotItem(
                    pen=None, brush=color, size=curve.style.pen_width + 2, antialias=curve.style.render_antialias, name=curve.title
                )
            else:
                item = pg.PlotCurveItem(
                    pen=pen,
                    antialias=curve.style.render_antialias,
                    name=curve.title,
                    connect="pairs" if curve.style.type == StyleType.STICKS else "finite",
                )
            self.plotItem.addItem(item)
            self._items.append(item)
            self._colors.append(color)
        self.legend.setVisible(legend and bool(curves))

    def draw(self, index: int, curve: Curve, points: Points) -> None:
        """Draw what is to be seen of a ``curve``, the one with the number ``index`` of :meth:`set_curves`, of which ``points`` are kept."""
        (x_range, y_range), columns, rows = self.shown_range(), max(64, self.width()), max(64, self.height())
        x, y = points.picture(x_range, y_range, columns, rows)
        style = curve.style
        if style.type == StyleType.STICKS:
            x, y = sticks(x, y, style.sticks_baseline, style.sticks_orientation)
        elif style.type == StyleType.STEPS:
            x, y = steps(x, y, style.steps_invert)
        elif style.type == StyleType.LINES and style.lines_interpolate and len(x) < columns:
            x, y = smooth(x, y)
        self._items[index].setData(x, y)

    # Range

    def shown_range(self) -> tuple[list[float], list[float]]:
        """((x low, high), (y low, high)) that is shown."""
        x, y = self.viewRange()
        return list(x), list(y)

    def show_range(self, x: tuple[float, float] | None, y: tuple[float, float] | None) -> None:
        """Show these values, ``x`` and ``y`` as (from, to); None leaves an axis. What has no extent is shown with one."""
        ranges = {}
        for name, limits in (("xRange", x), ("yRange", y)):
            if limits is not None and all(map(math.isfinite, limits)):
                low, high = sorted(limits)
                room = 0.5 if low == high else 0.0
                ranges[name] = (low - room, high + room)
        if ranges:
            self.setRange(padding=0, **ranges)

    # Cursor

    def _mouse_moved(self, position) -> None:
        if self.canvas.sceneBoundingRect().contains(position):
            inside = self.canvas.mapSceneToView(position)
            self.canvas.band_to(self.canvas.mapFromScene(position))
            self.cursor_moved.emit((inside.x(), inside.y()))
        else:
            self.cursor_moved.emit(None)

    def leaveEvent(self, event) -> None:
        super().leaveEvent(event)
        self.cursor_moved.emit(None)

    def show_cursor(self, place: tuple[float, float] | None, curves: dict[str, Points] | None = None) -> None:
        """Draw the cross at ``place``, (x, y), and with :attr:`track_points` the points of ``curves`` nearest to it; None hides all.

        :param curves: name -> points
        """
        tracked = {}
        if place is not None and self.track_points:
            tracked = {
                name: point for name, point in ((name, points.nearest(place[0])) for name, points in (curves or {}).items()) if point
            }
        for item in (*self._lines, self._label):
            item.setVisible(place is not None)
        self._tracked.setVisible(bool(tracked))
        self._track_label.setVisible(bool(tracked))
        if place is None:
            return
        for line, value in zip(self._lines, place):
            line.setPos(value)
        self._label.setText(f"{place[0] - self.x_axis.offset:.6g}, {place[1] - self.y_axis.offset:.6g}")
        self._label.setPos(*place)
        if tracked:
            points = list(tracked.values())
            self._tracked.setData([p[0] for p in points], [p[1] for p in points], brush=self._foreground)
            self._track_label.setText(
                "\n".join(f"{name}: {x - self.x_axis.offset:.6g}, {y - self.y_axis.offset:.6g}" for name, (x, y) in tracked.items())
            )
            self._track_label.setPos(*place)


def sticks(x: np.ndarray, y: np.ndarray, baseline: float, orientation: Orientation) -> tuple[np.ndarray, np.ndarray]:
    """Pairs of points: from the ``baseline`` to each point of ``x`` and ``y``, (n,).

    :param orientation: VERTICAL: the baseline is a value of y, else of x
    :returns: x and y, (2 n,) each
    """
    x, y = np.repeat(x, 2), np.repeat(y, 2)
    (y if orientation == Orientation.VERTICAL else x)[0::2] = baseline
    return x, y


def steps(x: np.ndarray, y: np.ndarray, inverted: bool) -> tuple[np.ndarray, np.ndarray]:
    """Corners of a stair through ``x`` and ``y``, (n,): the old value up to the next x, or ``inverted`` the new one from the last x.

    :returns: x and y, (2 n - 1,) each
    """
    x, y = np.repeat(x, 2), np.repeat(y, 2)
    return (x[:-1], y[1:]) if inverted else (x[1:], y[:-1])


def smooth(x: np.ndarray, y: np.ndarray, pieces: int = 8) -> tuple[np.ndarray, np.ndarray]:
    """Cubic pieces through all points, with the slope of the neighbours' chord at each.

    :param x, y: (n,); fewer than three points come back as they are
    :param pieces: straight ones between two points
    """
    if len(x) < 3:
        return x, y
    t = np.linspace(0, 1, pieces, endpoint=False)[None, :]
    result = []
    for values in (x, y):
        slope = np.gradient(values)
        a, b, ma, mb = (part[:, None] for part in (values[:-1], values[1:], slope[:-1], slope[1:]))
        curve = (2 * t**3 - 3 * t**2 + 1) * a + (t**3 - 2 * t**2 + t) * ma + (-2 * t**3 + 3 * t**2) * b + (t**3 - t**2) * mb
        result.append(np.append(curve.ravel(), values[-1]))
    return result[0], result[1]

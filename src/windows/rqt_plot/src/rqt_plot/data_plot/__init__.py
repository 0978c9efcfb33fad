"""A plot of named curves that other windows embed: `DataPlot`."""

from __future__ import annotations

from typing import Any, Optional

from python_qt_binding.QtCore import QSize, Signal, qWarning
from python_qt_binding.QtGui import QColor
from python_qt_binding.QtWidgets import QHBoxLayout, QWidget
from qt_gui.errors import WindowError
from qt_gui_py_common.simple_settings_dialog import SimpleSettingsDialog
from rqt_py_common.ini_helper import pack, unpack

from rqt_plot.data_plot.backends import BACKENDS
from rqt_plot.series import CAPACITY, Series, decimate, limits, visible

#: in the order in which curves get them, then from the first again
COLORS = [QColor(name) for name in ("blue", "red", "cyan", "magenta", "green", "#808000", "black", "darkcyan", "darkred", "gray")]


class DataPlotException(WindowError):
    """No way of drawing is installed, or a curve is not there."""


class _Curve(Series):
    def __init__(self, name: str, color: QColor, markers_on: bool, capacity: int | None):
        super().__init__(capacity)
        self.name, self.color, self.markers_on = name, color, markers_on


class DataPlot(QWidget):
    """Curves over a common x axis.

    Values are given at any time, from any thread where a signal is named for it, and drawn by :meth:`redraw`. What lies
    outside the window, or is finer than its columns, costs nothing to draw.

    :param capacity: samples kept of each curve, the oldest go first; None keeps all.
    :raises DataPlotException: neither pyqtgraph nor matplotlib is installed.
    """

    RED, GREEN, BLUE = (255, 0, 0), (0, 255, 0), (0, 0, 255)
    #: modes of the y axis: all data, what is in the window; EXTEND never shrinks
    SCALE_ALL, SCALE_VISIBLE, SCALE_EXTEND = 1, 2, 4

    _data_plot_widget: Any  # of a class that a backend brings

    limits_changed = Signal()
    _redraw = Signal()
    _add_curve = Signal(str, str, object, bool)

    def __init__(self, parent: QWidget | None = None, capacity: int | None = CAPACITY):
        super().__init__(parent)
        self.plot_types = [backend.describe() for backend in BACKENDS]
        if not any(kind["enabled"] for kind in self.plot_types):
            raise DataPlotException("nothing to plot with: install python3-pyqtgraph")
        self._layout = QHBoxLayout(self)
        self._layout.setContentsMargins(0, 0, 0, 0)
        self._curves: dict[str, _Curve] = {}
        self._capacity = capacity
        self._color_index = 0
        self._markers_on = False
        self._autoscroll = False
        self._autoscale_x, self._autoscale_y = True, DataPlot.SCALE_ALL
        self._fresh = True  # y limits are nobody's choice yet
        self._vline: tuple[float, Any] | None = None
        self._plot_index = -1
        self._data_plot_widget = None
        self._switch_data_plot_widget(0)
        self._redraw.connect(self._do_redraw)
        self._add_curve.connect(lambda *curve: self._data_plot_widget.add_curve(*curve))

    def sizeHint(self) -> QSize:
        return QSize(640, 400)

    # How it is drawn

    def _switch_data_plot_widget(self, index: int, markers_on: bool | None = None) -> None:
        markers_on = self._markers_on if markers_on is None else markers_on
        if not 0 <= index < len(BACKENDS) or not self.plot_types[index]["enabled"]:
            index = next(i for i, kind in enumerate(self.plot_types) if kind["enabled"])
        if index == self._plot_index and markers_on == self._markers_on:
            return
        self._plot_index, self._markers_on = index, markers_on
        old, x_limits, y_limits = self._data_plot_widget, [0.0, 10.0], [0.0, 1.0]
        if old is not None:
            x_limits, y_limits = self.get_xlim(), self.get_ylim()
            self._layout.removeWidget(old)
            old.close()
            old.deleteLater()
        new = self._data_plot_widget = BACKENDS[index].create(self)
        self._layout.addWidget(new)
        new.set_xlim(x_limits)
        new.set_ylim(y_limits)
        new.limits_changed.connect(self.limits_changed)
        for curve_id, curve in self._curves.items():
            curve.markers_on = markers_on
            new.add_curve(curve_id, curve.name, curve.color, markers_on)
        if self._vline:
            new.vline(*self._vline)
        if self._curves:
            self.redraw()

    def getTitle(self) -> str:
        """Name of the library that draws."""
        return self.plot_types[self._plot_index]["title"]

    def doSettingsDialog(self) -> None:
        """Let the user choose what draws, and markers."""
        dialog = SimpleSettingsDialog(title="Plot Options")
        dialog.add_exclusive_option_group(title="Plot Type", options=self.plot_types, selected_index=self._plot_index)
        dialog.add_checkbox_group(
            title="Plot Markers",
            options=[
                {
                    "title": "Show Plot Markers",
                    "description": "A dot at each sample; slower to draw.",
                    "enabled": True,
                    "selected_by_default": False,
                }
            ],
            selected_indexes=[0] if self._markers_on else [],
        )
        chosen = dialog.get_settings()
        if chosen is None or len(chosen) != 2 or None in chosen:
            return
        kind, markers = chosen
        if kind.get("selected_index") is not None:
            self._switch_data_plot_widget(kind["selected_index"], 0 in (markers.get("selected_indexes") or ()))

    def save_settings(self, plugin_settings, instance_settings) -> None:
        """Store plot type and limits in ``instance_settings``; ``plugin_settings`` are left alone."""
        instance_settings.set_value("plot_type", self._plot_index)
        instance_settings.set_value("x_limits", pack([float(x) for x in self.get_xlim()]))
        instance_settings.set_value("y_limits", pack([float(y) for y in self.get_ylim()]))

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        """Take back what :meth:`save_settings` stored in ``instance_settings``; ``plugin_settings`` are not read."""
        try:
            self._switch_data_plot_widget(int(instance_settings.value("plot_type", 0)))
        except (TypeError, ValueError):
            qWarning("rqt_plot: the saved plot type is no number; the first one is taken")
        for key, setter in (("x_limits", self.set_xlim), ("y_limits", self.set_ylim)):
            saved = unpack(instance_settings.value(key, []))
            if saved:
                try:
                    setter([float(value) for value in saved])
                except (TypeError, ValueError):
                    qWarning(f"rqt_plot: the saved {key} are not two numbers; they are not restored")

    # Curves

    def add_curve(self, curve_id: str, curve_name: str, data_x, data_y) -> None:
        """Add a curve. It may be called from any thread.

        :param curve_id: by which the other methods know it
        :param curve_name: in the legend
        :param data_x: (n,) first values, in ascending order.
        :param data_y: (n,)
        """
        curve_id = str(curve_id)
        if curve_id in self._curves:
            qWarning(f"DataPlot: curve {curve_id} is there already")
            return
        color = COLORS[self._color_index % len(COLORS)]
        self._color_index += 1
        curve = _Curve(str(curve_name), color, self._markers_on, self._capacity)
        curve.extend(data_x, data_y)
        self._curves[curve_id] = curve
        self._add_curve.emit(curve_id, curve.name, color, self._markers_on)

    def remove_curve(self, curve_id: str) -> None:
        """Remove a curve; one that is not there is no error."""
        if self._curves.pop(str(curve_id), None) is not None:
            self._data_plot_widget.remove_curve(str(curve_id))
        if not self._curves:
            self._color_index = 0

    def _get_curve(self, curve_id: str) -> _Curve:
        if str(curve_id) not in self._curves:
            raise DataPlotException(f"no curve named {curve_id} in this plot")
        return self._curves[str(curve_id)]

    def update_values(self, curve_id: str, values_x, values_y, sort_data: bool = True) -> None:
        """Append values to the curve ``curve_id``; they are drawn by the next :meth:`redraw`.

        :param values_x: (n,)
        :param values_y: (n,)
        :param sort_data: put values that come late in their place.
        :raises DataPlotException: no such curve.
        """
        self._get_curve(curve_id).extend(values_x, values_y, sort_data)

    def clear_values(self, curve_id: str | None = None) -> None:
        """Forget the values of one curve, or of all."""
        for curve in list(self._curves.values()) if curve_id is None else [self._get_curve(curve_id)]:
            curve.clear()
        self._fresh = True

    def vline(self, x: float, color=RED) -> None:
        """Draw a vertical line at ``x``, in place of the last one. :param color: (r, g, b), 0..255"""
        self._vline = (x, color)
        self._data_plot_widget.vline(x, color)

    # Limits

    def autoscroll(self, enabled: bool = True) -> None:
        """Whether the window follows the newest sample."""
        self._autoscroll = enabled

    def set_autoscale(self, x: bool | None = None, y: int | None = None) -> None:
        """Change how limits follow the data: x wholly or not; y a combination of SCALE_..., or 0; None leaves it."""
        if x is not None:
            self._autoscale_x = x
        if y is not None:
            self._autoscale_y = y

    def redraw(self) -> None:
        """Draw all values given so far. It may be called from any thread."""
        self._redraw.emit()

    def _do_redraw(self) -> None:
        low, high = self._new_xlim()
        widget = self._data_plot_widget
        columns = max(64, widget.width())
        extents = []
        for curve_id, curve in list(self._curves.items()):
            shown = visible(curve, low, high)
            x, y = decimate(curve.x[shown], curve.y[shown], columns, curve.dropped + shown.start)
            extent = limits(y if self._autoscale_y & DataPlot.SCALE_VISIBLE else curve.y)
            extents += [extent] if extent else []
            widget.set_values(curve_id, x, y)
        if [low, high] != self.get_xlim():
            widget.set_xlim([low, high])
        self._follow_y(extents)
        widget.redraw()

    def _new_xlim(self) -> list[float]:
        """Limits of x after the data that came: all of it, the newest, or where they are."""
        low, high = self.get_xlim()
        ends = [(curve.x[0], curve.x[-1]) for curve in self._curves.values() if len(curve)]
        if not ends or not (self._autoscale_x or self._autoscroll):
            return [low, high]
        newest = float(max(end for _, end in ends))
        oldest = float(min(begin for begin, _ in ends)) if self._autoscale_x else newest - (high - low)
        return [oldest, newest if newest > oldest else oldest + 1.0]

    def _follow_y(self, extents) -> None:
        if not self._autoscale_y or not extents:
            return
        low, high = min(extent[0] for extent in extents), max(extent[1] for extent in extents)
        shown = self.get_ylim()
        extending = self._autoscale_y & DataPlot.SCALE_EXTEND and not self._fresh
        self._fresh = False
        if extending:
            low, high = min(low, shown[0]), max(high, shown[1])
        # Room beside the data, of the sides that moved alone: what grows must not grow by itself.
        room = 0.05 * (high - low) or 0.05 * abs(high) or 0.5
        new = [low if extending and low == shown[0] else low - room, high if extending and high == shown[1] else high + room]
        if new != shown:
            self._data_plot_widget.set_ylim(new)

    def get_xlim(self) -> list[float]:
        return list(self._data_plot_widget.get_xlim())

    def set_xlim(self, limits) -> None:
        self._data_plot_widget.set_xlim(list(limits))

    def get_ylim(self) -> list[float]:
        return list(self._data_plot_widget.get_ylim())

    def set_ylim(self, limits) -> None:
        self._fresh = False
        self._data_plot_widget.set_ylim(list(limits))

"""Curves drawn by pyqtgraph."""

from __future__ import annotations

from python_qt_binding.QtCore import Signal
from python_qt_binding.QtGui import QColor
from python_qt_binding.QtWidgets import QVBoxLayout, QWidget

from rqt_plot.graphics import pyqtgraph
from rqt_plot.series import limits


class _Curve(pyqtgraph.PlotCurveItem):
    """A curve that is told its extent: to search it for that, once per axis and change of view, takes as long as to draw it."""

    extent = ((0.0, 1.0), (0.0, 1.0))

    def set_values(self, x, y) -> None:
        x_limits, y_limits = limits(x), limits(y)
        if x_limits and y_limits:
            self.extent = x_limits, y_limits
        self.setData(x, y)

    def dataBounds(self, ax, frac=1.0, orthoRange=None):
        return self.extent[ax]


class PyQtGraphDataPlot(QWidget):
    """A white plot with a grid and a legend."""

    limits_changed = Signal()

    def __init__(self, parent=None):
        super().__init__(parent)
        self._plot_widget = pyqtgraph.PlotWidget(self, background="w")
        item = self._plot_widget.getPlotItem()
        self._legend = item.addLegend(pen="#c0c0c0", brush="#ffffffc0", labelTextColor="k")
        self._legend.hide()  # empty, it would be a small box
        item.showGrid(True, True, 0.2)
        item.disableAutoRange()
        item.hideButtons()
        for side in ("left", "bottom"):
            item.getAxis(side).setPen("k")
            item.getAxis(side).setTextPen("k")
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self._plot_widget)
        item.sigRangeChanged.connect(lambda *_: self.limits_changed.emit())
        self._curves: dict[str, pyqtgraph.GraphicsObject] = {}
        self._current_vline = None

    def add_curve(self, curve_id: str, curve_name: str, curve_color: QColor = QColor("blue"), markers_on: bool = False) -> None:
        """An empty curve, ``curve_id``, which the legend calls ``curve_name``.

        :param curve_color: of its line
        :param markers_on: mark each sample
        """
        pen = pyqtgraph.mkPen(curve_color, width=1)  # wider lines are drawn many times slower
        if markers_on:
            item = pyqtgraph.PlotDataItem(name=curve_name, pen=pen, symbol="o", symbolSize=4, symbolPen=None, symbolBrush=curve_color)
        else:
            item = _Curve(name=curve_name, pen=pen, connect="finite")
        self._curves[curve_id] = item
        self._plot_widget.addItem(item)
        self._legend.show()

    def remove_curve(self, curve_id: str) -> None:
        curve = self._curves.pop(curve_id, None)
        if curve is not None:
            self._plot_widget.removeItem(curve)
            self._legend.setVisible(bool(self._curves))

    def set_values(self, curve_id: str, x, y) -> None:
        """Let the curve ``curve_id`` have these samples only; ``x`` and ``y``: (n,)."""
        curve = self._curves.get(curve_id)
        if isinstance(curve, _Curve):
            curve.set_values(x, y)
        elif curve is not None:
            curve.setData(x, y)

    def redraw(self) -> None:
        """Nothing to do: values repaint by themselves."""

    def vline(self, x: float, color) -> None:
        """Draw a vertical line at ``x``, in place of the last one. ``color``: (r, g, b), 0..255"""
        if self._current_vline is not None:
            self._plot_widget.removeItem(self._current_vline)
        self._current_vline = self._plot_widget.addLine(x=x, pen=color)

    def set_xlim(self, limits: list[float]) -> None:
        self._plot_widget.setXRange(limits[0], limits[1], padding=0)

    def set_ylim(self, limits: list[float]) -> None:
        self._plot_widget.setYRange(limits[0], limits[1], padding=0)

    def get_xlim(self) -> list[float]:
        return list(self._plot_widget.viewRange()[0])

    def get_ylim(self) -> list[float]:
        return list(self._plot_widget.viewRange()[1])

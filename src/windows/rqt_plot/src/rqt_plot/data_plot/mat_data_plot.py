"""Curves drawn by matplotlib."""

from __future__ import annotations

from typing import Any

from matplotlib.backends.backend_qtagg import FigureCanvasQTAgg, NavigationToolbar2QT
from matplotlib.figure import Figure
from python_qt_binding.QtCore import Signal
from python_qt_binding.QtGui import QColor
from python_qt_binding.QtWidgets import QVBoxLayout, QWidget


class MatDataPlot(QWidget):
    """A plot with matplotlib's tool bar."""

    limits_changed = Signal()

    def __init__(self, parent=None):
        super().__init__(parent)
        self._canvas = FigureCanvasQTAgg(Figure(layout="constrained"))
        self._axes = self._canvas.figure.add_subplot(111)
        self._axes.grid(True, alpha=0.3)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(NavigationToolbar2QT(self._canvas, self))
        layout.addWidget(self._canvas)
        self._axes.callbacks.connect("xlim_changed", lambda _axes: self.limits_changed.emit())
        self._axes.callbacks.connect("ylim_changed", lambda _axes: self.limits_changed.emit())
        self._curves: dict[str, Any] = {}
        self._current_vline = None

    def add_curve(self, curve_id: str, curve_name: str, curve_color: QColor = QColor("blue"), markers_on: bool = False) -> None:
        """An empty curve, ``curve_id``, which the legend calls ``curve_name``.

        :param curve_color: of its line
        :param markers_on: mark each sample
        """
        (self._curves[curve_id],) = self._axes.plot(
            [], [], label=curve_name, color=curve_color.name(), linewidth=1, marker="o" if markers_on else None, markersize=3
        )
        self._axes.legend(loc="upper left")

    def remove_curve(self, curve_id: str) -> None:
        curve = self._curves.pop(curve_id, None)
        if curve is not None:
            curve.remove()
            self._axes.legend(loc="upper left")
            self.redraw()

    def set_values(self, curve_id: str, x, y) -> None:
        """Let the curve ``curve_id`` have these samples only; ``x`` and ``y``: (n,)."""
        if curve_id in self._curves:
            self._curves[curve_id].set_data(x, y)

    def redraw(self) -> None:
        self._canvas.draw_idle()

    def vline(self, x: float, color) -> None:
        """Draw a vertical line at ``x``, in place of the last one. ``color``: (r, g, b), 0..255"""
        if self._current_vline is not None:
            self._current_vline.remove()
        self._current_vline = self._axes.axvline(x, color=[part / 255 for part in color])
        self.redraw()

    def set_xlim(self, limits: list[float]) -> None:
        self._axes.set_xlim(*limits)
        self.redraw()

    def set_ylim(self, limits: list[float]) -> None:
        self._axes.set_ylim(*limits)
        self.redraw()

    def get_xlim(self) -> list[float]:
        return [float(value) for value in self._axes.get_xlim()]

    def get_ylim(self) -> list[float]:
        return [float(value) for value in self._axes.get_ylim()]

"""What can draw a `DataPlot`, in the order in which the settings dialog lists it. The libraries load when they are used."""

from __future__ import annotations

import importlib
from importlib.util import find_spec
from typing import NamedTuple


class Backend(NamedTuple):
    title: str
    needs: str
    debian_package: str
    module: str
    widget: str
    description: str

    def describe(self) -> dict:
        """An option for a SimpleSettingsDialog."""
        enabled = find_spec(self.needs) is not None
        missing = "" if enabled else f" Not installed: {self.debian_package}."
        return {"title": self.title, "enabled": enabled, "description": self.description + missing}

    def create(self, parent):
        """A widget with add_curve, remove_curve, set_values, redraw, vline, get_xlim ... set_ylim and limits_changed."""
        return getattr(importlib.import_module(self.module), self.widget)(parent)


BACKENDS = (
    Backend(
        "PyQtGraph",
        "pyqtgraph",
        "python3-pyqtgraph",
        "rqt_plot.data_plot.pyqtgraph_data_plot",
        "PyQtGraphDataPlot",
        "Fast; drag pans, wheel and right drag zoom, right click exports.",
    ),
    Backend(
        "MatPlot",
        "matplotlib",
        "python3-matplotlib",
        "rqt_plot.data_plot.mat_data_plot",
        "MatDataPlot",
        "Slower; a tool bar to pan, zoom and save.",
    ),
)

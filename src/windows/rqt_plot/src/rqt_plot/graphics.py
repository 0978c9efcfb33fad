"""pyqtgraph on the Qt of the container: by itself it takes the newest Qt installed, and two in a process do not work."""

import os

from python_qt_binding import QT_BINDING
from python_qt_binding.QtCore import qVersion

os.environ.setdefault(
    "PYQTGRAPH_QT_LIB",
    {"pyqt": "PyQt", "pyside": "PySide"}[QT_BINDING]
    + (qVersion().split(".")[0] if QT_BINDING == "pyqt" else {"5": "2", "6": "6"}[qVersion().split(".")[0]]),
)
import pyqtgraph  # noqa: E402  (after the choice above)

__all__ = ["pyqtgraph"]

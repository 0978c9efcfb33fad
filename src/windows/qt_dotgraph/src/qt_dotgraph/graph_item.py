"""What nodes and edges have in common."""

from python_qt_binding.QtGui import QColor, QFont
from python_qt_binding.QtWidgets import QGraphicsItemGroup


class GraphItem(QGraphicsItemGroup):
    """``highlight_level`` 1: nothing but itself changes under the mouse; 2: its edges too; 3: and what they lead to."""

    _COLOR_BLACK = QColor(0, 0, 0)
    _COLOR_BLUE = QColor(0, 0, 204)
    _COLOR_GREEN = QColor(0, 170, 0)
    _COLOR_ORANGE = QColor(255, 165, 0)
    _COLOR_RED = QColor(255, 0, 0)
    _COLOR_TEAL = QColor(0, 170, 170)

    def __init__(self, highlight_level, parent=None):
        super().__init__(parent)
        self._highlight_level = highlight_level
        self._label_font = QFont("sans")
        self._label_font.setPixelSize(12)  # Graphviz measures its labels at 14 points of 1/72 inch, a scene unit each

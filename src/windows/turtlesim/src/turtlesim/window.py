"""The window with the turtles and what they have drawn."""

import math
from collections.abc import Iterable

from python_qt_binding.QtCore import QPointF
from python_qt_binding.QtGui import QColor, QImage, QPainter, QPen
from python_qt_binding.QtWidgets import QFrame

from .pictures import draw_all
from .world import METRE, PIXELS, SIZE, Line, Point, World

_FAR = 10 * SIZE  # m; a line that ends beyond is drawn to there: Qt takes its time with huge numbers


class TurtleWindow(QFrame):
    """Shows a World. The owner steps it, and hands the lines that were drawn to :meth:`draw`."""

    def __init__(self, world: World):
        super().__init__()
        self._world = world
        self._pictures = draw_all()
        self._paths = QImage(PIXELS, PIXELS, QImage.Format.Format_RGB32)
        self.setFixedSize(PIXELS, PIXELS)
        self.setWindowTitle("TurtleSim")

    @property
    def picture_count(self) -> int:
        return len(self._pictures)

    def clear(self, red: int, green: int, blue: int) -> None:
        """Forget all lines, and fill with the colour (red, green, blue); of each number the lowest byte counts."""
        self._paths.fill(QColor(red & 0xFF, green & 0xFF, blue & 0xFF))
        self.update()

    def draw(self, lines: Iterable[Line]) -> None:
        painter = QPainter(self._paths)
        for line in lines:
            painter.setPen(QPen(QColor(*line.pen.color), line.pen.width))
            painter.drawLine(_pixel(line.start), _pixel(line.end))
        painter.end()
        self.update()

    def color_at(self, point: Point) -> tuple[int, int, int]:
        """Red, green and blue of the paper below a point of the world."""
        color = self._paths.pixelColor(_pixel(point).toPoint())
        return color.red(), color.green(), color.blue()

    def paintEvent(self, _event) -> None:
        painter = QPainter(self)
        painter.drawImage(0, 0, self._paths)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        for turtle in self._world.turtles.values():
            picture = self._pictures[turtle.picture]
            painter.save()
            painter.translate(_pixel((turtle.x, turtle.y)))
            painter.rotate(90 - math.degrees(turtle.theta))
            painter.drawImage(QPointF(-picture.width() / 2, -picture.height() / 2), picture)
            painter.restore()
        painter.end()


def _pixel(point: Point) -> QPointF:
    x, y = (min(max(value, -_FAR), _FAR) for value in point)
    return QPointF(x * METRE, (SIZE - y) * METRE)

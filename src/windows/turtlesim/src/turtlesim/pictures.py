"""The fourteen turtles, drawn with ellipses: each METRE pixels high, looking up."""

from typing import NamedTuple

from python_qt_binding.QtCore import QPointF, QRectF, Qt
from python_qt_binding.QtGui import QColor, QImage, QPainter, QPen, QPolygonF

from .world import METRE


class Looks(NamedTuple):
    """Colours of shell, of its pattern, of skin, and the pattern: rings, plates, stripes, cross or diamond."""

    name: str
    shell: str
    pattern: str
    skin: str
    kind: str


TURTLES = (
    Looks("box-turtle", "#7a5a2f", "#d9b45b", "#5f7a3a", "plates"),
    Looks("robot-turtle", "#8d99a6", "#39424e", "#c3ccd6", "cross"),
    Looks("sea-turtle", "#2f7f79", "#9fd8c9", "#6fb59b", "plates"),
    Looks("diamondback", "#4c4a3d", "#c7c19a", "#8d8f74", "diamond"),
    Looks("electric", "#e8d21d", "#3b3b3b", "#f4ee9a", "cross"),
    Looks("fuerte", "#b5372c", "#f1c9a5", "#d98a58", "rings"),
    Looks("groovy", "#8a4fb0", "#f39ad0", "#5fc4c1", "rings"),
    Looks("hydro", "#2b6fb8", "#bfe0f7", "#4fa3d9", "stripes"),
    Looks("indigo", "#3f2a8c", "#a99be8", "#6a5bd0", "plates"),
    Looks("jade", "#1f8f57", "#b7ecc9", "#57c07f", "diamond"),
    Looks("kinetic", "#e0752b", "#ffe1b8", "#f2a65e", "stripes"),
    Looks("lunar", "#5b6475", "#f2f0da", "#9aa5b8", "rings"),
    Looks("melodic", "#c2557a", "#fbd7e3", "#e08fa9", "cross"),
    Looks("noetic", "#3c8f3a", "#e3f2b2", "#86bd5b", "plates"),
)
_SHELL = QRectF(9, 11, 27, 29)


def draw_all() -> list[QImage]:
    """A picture per entry of TURTLES."""
    return [draw(looks) for looks in TURTLES]


def draw(looks: Looks) -> QImage:
    image = QImage(METRE, METRE, QImage.Format.Format_ARGB32_Premultiplied)
    image.fill(Qt.GlobalColor.transparent)
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    _limbs(painter, QColor(looks.skin))
    painter.setPen(QPen(QColor(looks.shell).darker(160), 1.2))
    painter.setBrush(QColor(looks.shell))
    painter.drawEllipse(_SHELL)
    painter.setPen(QPen(QColor(looks.pattern), 1.8))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    _PATTERNS[looks.kind](painter, _SHELL.center())
    painter.end()
    return image


def _limbs(painter: QPainter, skin: QColor) -> None:
    painter.setPen(QPen(skin.darker(150), 1))
    painter.setBrush(skin)
    for sign in (-1, 1):
        for y, angle in ((15, 35), (36, -35)):
            painter.save()
            painter.translate(22.5 + sign * 14, y)
            painter.rotate(sign * angle)
            painter.drawEllipse(QRectF(-4, -7, 8, 14))
            painter.restore()
    painter.drawPolygon(QPolygonF([QPointF(20.5, 38), QPointF(24.5, 38), QPointF(22.5, 44.5)]))
    painter.drawEllipse(QRectF(17, 0.5, 11, 14))
    painter.setBrush(QColor("#101010"))
    for sign in (-1, 1):
        painter.drawEllipse(QPointF(22.5 + sign * 3, 4.5), 0.9, 0.9)


def _rings(painter: QPainter, centre: QPointF) -> None:
    for radius in (4, 9):
        painter.drawEllipse(centre, radius, radius * 1.1)


def _plates(painter: QPainter, centre: QPointF) -> None:
    corners = [QPointF(x, y) + centre for x, y in ((0, -8), (6, -4), (6, 4), (0, 8), (-6, 4), (-6, -4))]
    painter.drawPolygon(QPolygonF(corners))
    for corner in corners:
        painter.drawLine(corner, centre + (corner - centre) * 1.55)


def _stripes(painter: QPainter, centre: QPointF) -> None:
    for x, half in ((-7, 8), (0, 12), (7, 8)):
        painter.drawLine(centre + QPointF(x, -half), centre + QPointF(x, half))


def _cross(painter: QPainter, centre: QPointF) -> None:
    painter.drawLine(centre + QPointF(0, -13), centre + QPointF(0, 13))
    painter.drawLine(centre + QPointF(-12, 0), centre + QPointF(12, 0))
    painter.drawEllipse(centre, 5, 5)


def _diamond(painter: QPainter, centre: QPointF) -> None:
    for size in (5, 11):
        painter.drawPolygon(QPolygonF([centre + QPointF(x, y) for x, y in ((0, -size), (size, 0), (0, size), (-size, 0))]))


_PATTERNS = {"rings": _rings, "plates": _plates, "stripes": _stripes, "cross": _cross, "diamond": _diamond}

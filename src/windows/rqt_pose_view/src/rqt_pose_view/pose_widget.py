"""Draws the box, and turns the view with the mouse. It knows no ROS."""

from __future__ import annotations

import numpy as np
from python_qt_binding.QtCore import QPointF, QRectF, QSize, Qt
from python_qt_binding.QtGui import QColor, QPainter, QPen, QPolygonF, QTextOption
from python_qt_binding.QtWidgets import QMenu, QWidget

from rqt_pose_view.poses import FACES, Camera, face_corners

_GRID = 5  # m, half of it
_AXES = (((1, 0, 0), "#e62828"), ((0, 1, 0), "#28b428"), ((0, 0, 1), "#3250f0"))


class PoseWidget(QWidget):
    """A box in space. Left drag turns the view, the wheel zooms, the right button offers to reset."""

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setObjectName("pose")
        self.setMinimumSize(120, 120)
        self.camera = Camera()
        self._rotation = np.eye(3)
        self._text = ""
        self._last: QPointF | None = None

    def sizeHint(self) -> QSize:
        return QSize(480, 400)

    def set_rotation(self, rotation: np.ndarray | None, text: str = "") -> None:
        """Turn the box; None leaves it.

        :param rotation: (3, 3), from the box's axes to the world's
        :param text: shown below.
        """
        if rotation is not None:
            self._rotation = rotation
        self._text = text
        self.update()

    def _points(self, points) -> list:
        projected = self.camera.project(np.asarray(points, float))
        half = min(self.width(), self.height()) / 2
        return [QPointF(self.width() / 2 + x * half, self.height() / 2 - y * half) for x, y, _ in projected]

    def paintEvent(self, _event) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(self.rect(), QColor("#303030"))
        painter.setPen(QPen(QColor("#707070"), 1))
        for i in range(-_GRID, _GRID + 1):
            for line in (((i, -_GRID, 0), (i, _GRID, 0)), ((-_GRID, i, 0), (_GRID, i, 0))):
                painter.drawLine(*self._points(line))
        for axis, color in _AXES:
            painter.setPen(QPen(QColor(color), 3))
            painter.drawLine(*self._points(((0, 0, 0), 2.5 * np.array(axis))))
        self._draw_box(painter)
        painter.setPen(QColor("white"))
        painter.drawText(QRectF(self.rect().adjusted(8, 8, -8, -8)), self._text, QTextOption(Qt.AlignmentFlag.AlignBottom))
        painter.end()

    def _draw_box(self, painter: QPainter) -> None:
        eye = self.camera.position
        painter.setPen(QPen(QColor("black"), 1))
        for normal, color in FACES:
            corners = face_corners(normal) @ self._rotation.T
            outward = self._rotation @ np.array(normal, float)
            if outward @ (eye - corners.mean(axis=0)) > 0:  # of a convex body what faces the eye hides nothing that does
                painter.setBrush(QColor(*color))
                painter.drawPolygon(QPolygonF(self._points(corners)))

    def mousePressEvent(self, event) -> None:
        self._last = event.pos()

    def mouseMoveEvent(self, event) -> None:
        if self._last is not None and event.buttons() & Qt.MouseButton.LeftButton:
            move = event.pos() - self._last
            self.camera.turn(0.01 * move.x(), 0.01 * move.y())
            self._last = event.pos()
            self.update()

    def wheelEvent(self, event) -> None:
        self.camera.zoom(0.9 ** (event.angleDelta().y() / 120))
        self.update()

    def contextMenuEvent(self, event) -> None:
        menu = QMenu(self)
        menu.addAction("Reset view").triggered.connect(lambda _checked=False: self.reset_view())
        menu.popup(event.globalPos())

    def reset_view(self) -> None:
        self.camera.reset()
        self.update()

"""The area of a window that shows a picture."""

from __future__ import annotations

import cv2
import numpy as np
from python_qt_binding.QtCore import QRectF, QSize, Qt, Signal
from python_qt_binding.QtGui import QImage, QPainter, QTextOption
from python_qt_binding.QtWidgets import QSizePolicy, QWidget

from rqt_image_view.pictures import invert_grid, rotated, unrotated_point


def to_qimage(picture: np.ndarray) -> QImage:
    """A QImage with a copy of (h, w) or (h, w, 3) RGB pixels, in the format that Qt draws without converting it."""
    change = cv2.COLOR_GRAY2BGRA if picture.ndim == 2 else cv2.COLOR_RGB2BGRA
    pixels = cv2.cvtColor(np.ascontiguousarray(picture), change)
    image = QImage(pixels.data, pixels.shape[1], pixels.shape[0], pixels.strides[0], QImage.Format.Format_RGB32)
    image.pixels = pixels  # QImage does not own them
    return image


class Canvas(QWidget):
    """Shows a picture as large as fits, its shape kept. A click tells the pixel of the picture before it was rotated."""

    clicked = Signal(int, int)  #: x, y in pixels
    shown = Signal()  #: the picture has been drawn

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setObjectName("image_frame")
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.picture: np.ndarray | None = None
        self.message = ""  #: shown instead of a picture
        self.smooth, self.grid_lines, self.quarters, self.original_size = False, 0, 0, False
        self._scaled: QImage | None = None

    def sizeHint(self) -> QSize:
        return QSize(640, 480)

    def set_picture(self, picture: np.ndarray | None, message: str = "") -> None:
        """Show a picture, or a message in place of one."""
        self.picture, self.message = picture, message
        self.changed()

    def changed(self) -> None:
        """Draw again, after a change of picture or settings."""
        self._scaled = None
        height, width = self._rotated_shape() if self.original_size else (80, 80)
        if self.minimumSize() != QSize(width, height):
            self.setMinimumSize(width, height)
        self.update()

    def final_picture(self) -> np.ndarray | None:
        """The picture with all its pixels, rotated, with the grid."""
        if self.picture is None:
            return None
        return self._final(self.picture)

    def _final(self, picture: np.ndarray) -> np.ndarray:
        picture = rotated(picture, self.quarters)
        return invert_grid(picture, self.grid_lines) if self.grid_lines else picture

    def _rotated_shape(self):
        if self.picture is None:
            return 80, 80
        height, width = self.picture.shape[:2]
        return (width, height) if self.quarters % 2 else (height, width)

    def _target(self):
        """Place of the picture: left, top, width, height, in pixels of the widget."""
        height, width = self._rotated_shape()
        scale = 1.0 if self.original_size else min(self.width() / width, self.height() / height)
        shown_width, shown_height = max(1, round(width * scale)), max(1, round(height * scale))
        return (self.width() - shown_width) // 2, (self.height() - shown_height) // 2, shown_width, shown_height

    def paintEvent(self, _event) -> None:
        painter = QPainter(self)
        if self.picture is None:
            painter.drawText(QRectF(self.rect()), self.message, QTextOption(Qt.AlignmentFlag.AlignCenter))
        else:
            left, top, width, height = self._target()
            if self._scaled is None or (self._scaled.width(), self._scaled.height()) != (width, height):
                self._scaled = to_qimage(self._scale(self._final(self.picture), width, height))
            painter.drawImage(left, top, self._scaled)
        painter.end()
        self.shown.emit()

    def _scale(self, picture: np.ndarray, width: int, height: int) -> np.ndarray:
        if picture.shape[:2] == (height, width):
            return picture
        way = cv2.INTER_NEAREST
        if self.smooth:
            way = cv2.INTER_AREA if width < picture.shape[1] else cv2.INTER_LINEAR
        return cv2.resize(np.ascontiguousarray(picture), (width, height), interpolation=way)

    def mousePressEvent(self, event) -> None:
        if event.button() == Qt.MouseButton.LeftButton and self.picture is not None:
            pixel = self.pixel_at(event.pos().x(), event.pos().y())
            if pixel:
                self.clicked.emit(*pixel)
        super().mousePressEvent(event)

    def pixel_at(self, x: int, y: int):
        """Pixel (x, y) of the unrotated picture below a place of the widget, or None beside the picture."""
        if self.picture is None:
            return None
        left, top, width, height = self._target()
        rotated_height, rotated_width = self._rotated_shape()
        column, row = (x - left) * rotated_width // width, (y - top) * rotated_height // height
        if not (0 <= column < rotated_width and 0 <= row < rotated_height):
            return None
        whole_height, whole_width = self.picture.shape[:2]
        return unrotated_point(column, row, whole_height, whole_width, self.quarters)

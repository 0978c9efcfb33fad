"""A view of a scene that is moved by dragging and zoomed by the wheel."""

from python_qt_binding.QtCore import QEvent, Qt, Signal
from python_qt_binding.QtWidgets import QGraphicsView


class InteractiveGraphicsView(QGraphicsView):
    """The wheel zooms by 20 % a notch about the place under the mouse."""

    tool_tip_wanted = Signal(object, object)  # the item under the mouse, the place on the screen

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setObjectName("InteractiveGraphicsView")
        self._last_pan_point = None
        self.setTransformationAnchor(QGraphicsView.ViewportAnchor.AnchorUnderMouse)

    def mousePressEvent(self, mouse_event):
        self._last_pan_point = mouse_event.pos()
        self.setCursor(Qt.CursorShape.ClosedHandCursor)

    def mouseReleaseEvent(self, mouse_event):
        self._last_pan_point = None
        self.setCursor(Qt.CursorShape.OpenHandCursor)

    def mouseMoveEvent(self, mouse_event):
        if self._last_pan_point is not None:
            moved = mouse_event.pos() - self._last_pan_point
            self._last_pan_point = mouse_event.pos()
            for bar, way in ((self.horizontalScrollBar(), moved.x()), (self.verticalScrollBar(), moved.y())):
                bar.setValue(bar.value() - way)
        super().mouseMoveEvent(mouse_event)

    def wheelEvent(self, wheel_event):
        if wheel_event.modifiers() != Qt.KeyboardModifier.NoModifier:
            super().wheelEvent(wheel_event)
            return
        factor = 1 + 0.2 * max(min(wheel_event.angleDelta().y(), 480), -480) / 120.0
        if factor <= 0:
            factor = 0.2
        if 0.005 < self.transform().m11() * factor < 200:
            self.scale(factor, factor)
        wheel_event.accept()

    def viewportEvent(self, event):
        if event.type() == QEvent.Type.ToolTip:
            item = self.itemAt(event.pos())
            while item is not None and item.parentItem() is not None:
                item = item.parentItem()
            if item is not None:
                self.tool_tip_wanted.emit(item, event.globalPos())
        return super().viewportEvent(event)

"""An edge of a graph: curve, arrow head, label."""

import math

from python_qt_binding.QtCore import QPointF, Qt
from python_qt_binding.QtGui import QBrush, QColor, QPainterPath, QPainterPathStroker, QPen, QPolygonF
from python_qt_binding.QtWidgets import QGraphicsPathItem, QGraphicsPolygonItem, QGraphicsSimpleTextItem

from qt_dotgraph.graph_item import GraphItem

_ARROW = 8.0  # length of an arrow head
_STYLES = {"dashed": Qt.PenStyle.DashLine, "dotted": Qt.PenStyle.DotLine}


class EdgeItem(GraphItem):
    """Under the mouse it and its ends change colour, and so do the edges that bear the same label.

    :param spline: DOT's ``pos``: points of Bezier curves, y upwards, with ``e,x,y`` for the tip of an arrow
    :param label_center: ``QPointF`` in the scene
    """

    def __init__(
        self, highlight_level, spline, label_center, label, from_node, to_node, parent=None, penwidth=1, edge_color=None, style="solid"
    ):
        super().__init__(highlight_level, parent)
        self.from_node, self.to_node = from_node, to_node
        from_node.add_outgoing_edge(self)
        to_node.add_incoming_edge(self)
        self._default_edge_color = QColor(edge_color) if edge_color is not None else QColor(self._COLOR_BLACK)
        self._default_text_color = QColor(self._COLOR_BLACK)
        self._sibling_edges = set()
        self._brush = QBrush(self._default_edge_color)
        self._pen_width = max(float(penwidth), 1.0)
        self._style = _STYLES.get(style, Qt.PenStyle.SolidLine)
        path, tip = _curve(spline)
        self._path = QGraphicsPathItem(path)
        self.addToGroup(self._path)
        self._arrow = None
        if tip is not None:
            self._arrow = QGraphicsPolygonItem(_arrow_head(path, tip, _ARROW + self._pen_width))
            self.addToGroup(self._arrow)
        self._label = None
        if label:
            self._label = QGraphicsSimpleTextItem(label)
            self._label.setFont(self._label_font)
            rect = self._label.boundingRect()
            rect.moveCenter(label_center if label_center is not None else path.pointAtPercent(0.5))
            self._label.setPos(rect.x(), rect.y())
            self.addToGroup(self._label)
        self.set_node_color()
        self.setAcceptHoverEvents(True)

    def add_to_scene(self, scene):
        scene.addItem(self)

    def add_sibling_edge(self, edge):
        """An edge that is highlighted with this one."""
        self._sibling_edges.add(edge)

    def text(self):
        return self._label.text() if self._label is not None else ""

    def color(self):
        """The colour that it has now."""
        return self._brush.color()

    def shape(self):
        """The curve, somewhat wider than it is drawn, and the label: not the whole box around them."""
        stroker = QPainterPathStroker()
        stroker.setWidth(self._pen_width + 4)
        shape = stroker.createStroke(self._path.path())
        if self._label is not None:
            shape.addRect(self._label.sceneBoundingRect() if self.scene() is not None else self._label.boundingRect())
        return shape

    def set_node_color(self, color=None):
        """Draw the curve in a colour, or again in its own."""
        self._brush.setColor(self._default_edge_color if color is None else color)
        pen = QPen(self._brush, self._pen_width, self._style)
        self._path.setPen(pen)
        if self._arrow is not None:
            self._arrow.setBrush(self._brush)
            self._arrow.setPen(QPen(self._brush, 1.0))

    def set_label_color(self, color=None):
        """Draw the label in a colour, or again in its own."""
        if self._label is not None:
            self._label.setBrush(QBrush(self._default_text_color if color is None else color))

    def hoverEnterEvent(self, event):
        self._paint(self._COLOR_RED, self._COLOR_BLUE, self._COLOR_GREEN, self._COLOR_TEAL, self._COLOR_ORANGE)

    def hoverLeaveEvent(self, event):
        self._paint(None, None, None, None, None)

    def _paint(self, own, source, target, loop, sibling):
        self.set_node_color(own)
        self.set_label_color(own)
        if self._highlight_level > 1:
            if self.from_node is self.to_node:
                self.from_node.set_node_color(loop)
            else:
                self.from_node.set_node_color(source)
                self.to_node.set_node_color(target)
        if self._highlight_level > 2:
            for edge in self._sibling_edges:
                edge.set_node_color(sibling)
                edge.set_label_color(sibling)


def _curve(spline):
    """The path in the scene (y downwards), and the tip of its arrow or None."""
    tip, points = None, []
    for part in spline.split(";")[0].split():
        at_end = part.startswith("e,")
        x, y = part.split(",")[-2:]
        point = QPointF(float(x), -float(y))
        if at_end:
            tip = point
        elif not part.startswith("s,"):
            points.append(point)
    path = QPainterPath(points[0])
    for index in range(1, len(points) - 2, 3):
        path.cubicTo(*points[index : index + 3])
    return path, tip


def _arrow_head(path, tip, length):
    """A triangle from the end of the path to the tip."""
    end = path.currentPosition()
    dx, dy = tip.x() - end.x(), tip.y() - end.y()
    distance = math.hypot(dx, dy)
    if distance < 1e-6:  # a path that goes up to the tip itself: its direction there
        before = path.pointAtPercent(0.95)
        dx, dy = tip.x() - before.x(), tip.y() - before.y()
        distance = math.hypot(dx, dy) or 1.0
    ux, uy = dx / distance, dy / distance
    base = QPointF(tip.x() - ux * length, tip.y() - uy * length)
    side = QPointF(-uy * length * 0.4, ux * length * 0.4)
    return QPolygonF([tip, base + side, base - side])

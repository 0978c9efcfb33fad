"""A node of a graph, or the box of a cluster."""

from python_qt_binding.QtCore import QPointF, QRectF
from python_qt_binding.QtGui import QBrush, QColor, QPainterPath, QPen, QPolygonF
from python_qt_binding.QtWidgets import (
    QGraphicsEllipseItem,
    QGraphicsPathItem,
    QGraphicsPolygonItem,
    QGraphicsRectItem,
    QGraphicsSimpleTextItem,
)

from qt_dotgraph.graph_item import GraphItem

_FOLD = 6.0  # depth of a box3d


class NodeItem(GraphItem):
    """Under the mouse it is red, what goes in blue, what goes out green, what does both teal.

    :param bounding_box: ``QRectF`` in the scene
    :param shape: ``ellipse``, ``box``, ``box3d``, ``diamond``; others are drawn as boxes
    :param label_pos: ``QPointF`` of the middle of the label; the middle of the box without
    """

    def __init__(self, highlight_level, bounding_box, label, shape, color=None, parent=None, label_pos=None, tooltip=None):
        super().__init__(highlight_level, parent)
        self._default_color = QColor(color) if color is not None else QColor(self._COLOR_BLACK)
        self._incoming_edges, self._outgoing_edges = set(), set()
        self._brush = QBrush(self._default_color)
        self._graphics_item = self.parse_shape(shape, bounding_box)
        self._label = QGraphicsSimpleTextItem(label)
        self._label.setFont(self._label_font)
        rect = self._label.boundingRect()
        rect.moveCenter(bounding_box.center() if label_pos is None else label_pos)
        self._label.setPos(rect.x(), rect.y())
        for item in (self._graphics_item, self._label):
            self.addToGroup(item)
        self._hovershape = None
        self.set_node_color()
        self.setAcceptHoverEvents(True)
        if tooltip is not None:
            self.setToolTip(tooltip)

    def parse_shape(self, shape, bounding_box):
        """The outline as a graphics item.

        :param shape: its name in DOT; one that is not known is a box
        :param bounding_box: ``QRectF`` in the scene
        """
        if shape in ("ellipse", "circle", "oval", "point"):
            return QGraphicsEllipseItem(bounding_box)
        if shape == "diamond":
            middle = bounding_box.center()
            return QGraphicsPolygonItem(
                QPolygonF(
                    [
                        QPointF(middle.x(), bounding_box.top()),
                        QPointF(bounding_box.right(), middle.y()),
                        QPointF(middle.x(), bounding_box.bottom()),
                        QPointF(bounding_box.left(), middle.y()),
                    ]
                )
            )
        if shape == "box3d":
            return QGraphicsPathItem(_box3d(bounding_box))
        return QGraphicsRectItem(bounding_box)

    def set_hovershape(self, newhovershape):
        """Only this ``QRectF`` of it listens to the mouse."""
        self._hovershape = newhovershape

    def shape(self):
        path = QPainterPath()
        path.addRect(self._graphics_item.boundingRect() if self._hovershape is None else self._hovershape)
        return path

    def add_incoming_edge(self, edge):
        self._incoming_edges.add(edge)

    def add_outgoing_edge(self, edge):
        self._outgoing_edges.add(edge)

    def text(self):
        return self._label.text()

    def color(self):
        """The colour that it has now."""
        return self._brush.color()

    def set_node_color(self, color=None):
        """Draw it in a colour, or again in its own."""
        self._brush.setColor(self._default_color if color is None else color)
        self._label.setBrush(self._brush)
        self._graphics_item.setPen(QPen(self._brush, 1.0))

    def hoverEnterEvent(self, event):
        self.set_node_color(self._COLOR_RED)
        self._paint_neighbours(self._COLOR_BLUE, self._COLOR_GREEN, self._COLOR_TEAL)

    def hoverLeaveEvent(self, event):
        self.set_node_color()
        self._paint_neighbours(None, None, None)

    def _paint_neighbours(self, incoming, outgoing, both):
        if self._highlight_level < 2:
            return
        sources = {edge.from_node for edge in self._incoming_edges}
        targets = {edge.to_node for edge in self._outgoing_edges}
        for edges, color in ((self._incoming_edges, incoming), (self._outgoing_edges, outgoing)):
            for edge in edges:
                edge.set_node_color(color)
                edge.set_label_color(color)
        if self._highlight_level > 2:
            for nodes, color in ((sources, incoming), (targets, outgoing), (sources & targets, both)):
                for node in nodes - {self}:
                    node.set_node_color(color)


def _box3d(box: QRectF) -> QPainterPath:
    path = QPainterPath()
    front = box.adjusted(0, _FOLD, -_FOLD, 0)
    path.addRect(front)
    path.addPolygon(
        QPolygonF(
            [
                front.topLeft(),
                box.topLeft() + QPointF(_FOLD, 0),
                box.topRight(),
                box.bottomRight() - QPointF(0, _FOLD),
                front.bottomRight(),
                front.topRight(),
            ]
        )
    )
    path.moveTo(front.topRight())
    path.lineTo(box.topRight())
    return path

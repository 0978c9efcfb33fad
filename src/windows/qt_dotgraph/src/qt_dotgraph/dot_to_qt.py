"""DOT text to items of a QGraphicsScene."""

from typing import Any

from python_qt_binding.QtCore import QPointF, QRectF
from python_qt_binding.QtGui import QColor

from qt_dotgraph.edge_item import EdgeItem
from qt_dotgraph.layout import Layout, layout
from qt_dotgraph.node_item import NodeItem

LABEL_HEIGHT = 30  # of a cluster: the strip of it that listens to the mouse, the rest being its nodes'


def get_unquoted(item, name):
    """The value of the attribute ``name`` of ``item``, a pydot object, without its quotes; None when it has none."""
    value = item.get(name)
    return value.strip('"\n') if isinstance(value, str) else value


class DotToQtGenerator:
    """``nodes, edges = DotToQtGenerator().dotcode_to_qt_items(dotcode, highlight_level=3, scene=scene)``."""

    def dotcode_to_qt_items(self, dotcode, highlight_level, same_label_siblings=False, scene=None):
        """Lay out DOT text and make items.

        :param dotcode: None gives no items
        :param highlight_level: what the mouse lights up, 1 to 3, as of :class:`qt_dotgraph.graph_item.GraphItem`
        :param same_label_siblings: edges with the same label are highlighted together
        :param scene: put them there; without one, add nodes by ``scene.addItem`` and edges by ``edge.add_to_scene``
        :return: name -> NodeItem, and name of an edge -> list of EdgeItem
        :raises qt_dotgraph.layout.LayoutError: the text is not DOT.
        """
        if dotcode is None:
            return {}, {}
        return self.layout_to_qt_items(layout(dotcode), highlight_level, same_label_siblings, scene)

    def layout_to_qt_items(self, graph: Layout, highlight_level, same_label_siblings=False, scene=None):
        """As :meth:`dotcode_to_qt_items`, of a ``graph`` that is laid out.

        ``highlight_level``, ``same_label_siblings`` and ``scene`` are the same there.
        """
        nodes = {cluster.name: self._cluster_item(cluster, highlight_level) for cluster in graph.clusters}
        nodes.update((node.name, self._node_item(node, highlight_level)) for node in graph.nodes)
        edges: dict[str, list[Any]] = {}
        by_label: dict[str, list[Any]] = {}
        for edge in graph.edges:
            if edge.tail not in nodes or edge.head not in nodes or len(edge.points) < 4:
                continue
            item = self._edge_item(edge, nodes, highlight_level)
            name = f"{edge.tail}_TO_{edge.head}" + (f"_{edge.label}" if edge.label else "")
            edges.setdefault(name, []).append(item)
            by_label.setdefault(edge.label or name, []).append(item)
        if same_label_siblings:
            for items in by_label.values():
                for item in items:
                    for sibling in items:
                        if sibling is not item:
                            item.add_sibling_edge(sibling)
        if scene is not None:
            for item in (*nodes.values(), *(edge for items in edges.values() for edge in items)):
                scene.addItem(item)
        return nodes, edges

    def _cluster_item(self, cluster, highlight_level):
        box = QRectF(cluster.corner[0], -cluster.corner[1] - cluster.size[1], *cluster.size)
        label = cluster.label_center
        middle = QPointF(label[0], -label[1]) if label else QPointF(box.center().x(), box.top() + LABEL_HEIGHT / 2)
        item = NodeItem(highlight_level, box, cluster.label, "box", _color(cluster.attributes), label_pos=middle)
        item.set_hovershape(QRectF(box.x(), box.y(), box.width(), LABEL_HEIGHT))
        item.setZValue(-1)
        return item

    def _node_item(self, node, highlight_level):
        width, height = node.size[0] - 1, node.size[1] - 1  # edges end at the outline, not within
        box = QRectF(node.center[0] - width / 2, -node.center[1] - height / 2, width, height)
        return NodeItem(
            highlight_level,
            box,
            node.label,
            node.attributes.get("shape", "ellipse"),
            _color(node.attributes),
            tooltip=node.attributes.get("tooltip"),
        )

    def _edge_item(self, edge, nodes, highlight_level):
        attributes = edge.attributes
        color = _color(attributes)
        if {"colorR", "colorG", "colorB"} <= set(attributes):
            color = QColor(*(int(float(attributes[name])) for name in ("colorR", "colorG", "colorB")))
        center = QPointF(edge.label_center[0], -edge.label_center[1]) if edge.label_center else None
        item = EdgeItem(
            highlight_level,
            attributes["pos"],
            center,
            edge.label,
            nodes[edge.tail],
            nodes[edge.head],
            penwidth=float(attributes.get("penwidth") or 1),
            edge_color=color,
            style=attributes.get("style"),
        )
        if attributes.get("tooltip"):
            item.setToolTip(attributes["tooltip"])
        return item


def _color(attributes):
    color = QColor(attributes["color"]) if attributes.get("color") else None
    return color if color is not None and color.isValid() else None

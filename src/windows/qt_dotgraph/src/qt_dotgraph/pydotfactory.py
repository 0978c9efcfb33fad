"""Graphs made with pydot, for plugins that build theirs piece by piece."""

import os
from urllib.parse import quote

import pydot

_KEYWORDS = ("graph", "subgraph", "node", "edge")


class PydotFactory:
    """Makes graphs, nodes, clusters and edges, and their DOT text with positions."""

    def escape_label(self, name):
        return f"{name}_" if name in _KEYWORDS else name

    def escape_name(self, name):
        """A name that DOT takes, the same for the same name."""
        return self.escape_label(quote(name.strip()).replace("/", "__").replace("%", "_").replace("-", "_"))

    def get_graph(self, graph_type="digraph", rank="same", simplify=True, rankdir="TB", ranksep=0.2, compound=True):
        """An empty graph.

        :param graph_type: ``digraph`` or ``graph``
        :param rank, rankdir, ranksep, compound: attributes of DOT
        :param simplify: of several edges between two nodes one is written
        """
        graph = pydot.Dot("graphname", graph_type=graph_type, rank=rank, rankdir=rankdir, simplify=simplify)
        graph.set_ranksep(ranksep)
        graph.set_compound(compound)
        return graph

    def add_node_to_graph(self, graph, nodename, nodelabel=None, shape="box", color=None, url=None, tooltip=None):
        """A node of ``graph`` whose tool tip is ``tooltip``, or else ``url``.

        :param nodename: how edges name it
        :param nodelabel: the text in it; None: its name
        :param shape, color: attributes of DOT
        :raises ValueError: no name.
        """
        if not nodename:
            raise ValueError("Empty Node name")
        node = pydot.Node(self.escape_name(nodename), shape=shape, label=_quoted(self.escape_label(nodelabel or nodename)))
        if tooltip is not None or url is not None:
            node.set_tooltip(_quoted(url if tooltip is None else tooltip))
        if url is not None:
            node.set_URL(self.escape_name(url))
        if color is not None:
            node.set_color(color)
        graph.add_node(node)

    def add_subgraph_to_graph(
        self,
        graph,
        subgraphname,
        rank="same",
        simplify=True,
        rankdir="TB",
        ranksep=0.2,
        compound=True,
        color=None,
        shape="box",
        style="bold",
        subgraphlabel=None,
    ):
        """A cluster in ``graph``, which is returned; give it to the other methods in the place of the graph.

        :param subgraphlabel: the text above it; None: ``subgraphname``
        :param rank, rankdir, ranksep, compound, color, style: attributes of DOT
        :param simplify: as of :meth:`get_graph`, for its edges
        :param shape: not used: a cluster is a box
        :raises ValueError: no name.
        """
        if not subgraphname:
            raise ValueError("Empty subgraph name")
        cluster = pydot.Cluster(
            self.escape_name(subgraphname), rank=rank, rankdir=rankdir, simplify=simplify, style=style, ranksep=ranksep, compound=compound
        )
        label = self.escape_label(subgraphname if subgraphlabel is None else subgraphlabel)
        if label:
            cluster.set("label", _quoted(label))
        if color is not None:
            cluster.set("color", color)
        graph.add_subgraph(cluster)
        return cluster

    def add_edge_to_graph(self, graph, nodename1, nodename2, label=None, url=None, simplify=True, style=None, penwidth=1, color=None):
        """An edge of ``graph`` from ``nodename1`` to ``nodename2``; ``color`` is (red, green, blue) from 0 to 255.

        :param label: the text beside it; empty or None: none
        :param url, style, penwidth: attributes of DOT
        :param simplify: not used
        """
        edge = pydot.Edge(self.escape_name(nodename1), self.escape_name(nodename2), penwidth=str(penwidth))
        if label:
            edge.set_label(_quoted(label))
        if url is not None:
            edge.set_URL(self.escape_name(url))
        if style is not None:
            edge.set_style(style)
        if color is not None:
            for name, value in zip(("colorR", "colorG", "colorB"), color):
                edge.get_attributes()[name] = str(value)
        graph.add_edge(edge)

    def create_dot(self, graph):
        """DOT text with positions."""
        dot = graph.create_dot()
        text = dot.decode() if isinstance(dot, bytes) else dot
        return text.replace("\\" + os.linesep, "").replace("\\\n", "")


def _quoted(text):
    """A label of several words or with a line break goes into DOT in quotes; pydot adds them only when it sees the need."""
    text = str(text)
    return text if text[:1] == text[-1:] == '"' and len(text) > 1 else '"' + text.replace('"', '\\"') + '"'

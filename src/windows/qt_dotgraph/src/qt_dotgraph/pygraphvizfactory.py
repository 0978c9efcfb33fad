"""The same as PydotFactory with pygraphviz (Debian package python3-pygraphviz), for plugins that ask for it."""

import pygraphviz


class PygraphvizFactory:
    """See :class:`qt_dotgraph.pydotfactory.PydotFactory`."""

    def get_graph(self, graph_type="digraph", rank="same", simplify=True, rankdir="TB", ranksep=0.2, compound=True):
        """An empty graph.

        :param graph_type: ``digraph``, or anything else for one without directions
        :param rank, simplify, rankdir, ranksep, compound: attributes of DOT
        """
        graph = pygraphviz.AGraph(
            directed=graph_type == "digraph", ranksep=ranksep, rankdir=rankdir, rank=rank, compound=compound, simplify=simplify
        )
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
        options = {"URL": url, "tooltip": url if tooltip is None else tooltip, "color": color}
        graph.add_node(
            nodename, label=str(nodelabel or nodename), shape=shape, **{key: value for key, value in options.items() if value is not None}
        )

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
        """A cluster in ``graph``, which is returned.

        :param subgraphlabel: the text above it; None: ``subgraphname``
        :param rank, rankdir, ranksep, compound, color, style: attributes of DOT
        :param simplify, shape: not used
        :raises ValueError: no name.
        """
        if not subgraphname:
            raise ValueError("Empty subgraph name")
        options = {"color": color} if color is not None else {}
        return graph.add_subgraph(
            name=f"cluster_{subgraphname}",
            rank=rank,
            rankdir=rankdir,
            ranksep=ranksep,
            compound=compound,
            style=style,
            label=str(subgraphname if subgraphlabel is None else subgraphlabel),
            **options,
        )

    def add_edge_to_graph(self, graph, nodename1, nodename2, label=None, url=None, simplify=True, style=None, penwidth=1, color=None):
        """An edge of ``graph`` from ``nodename1`` to ``nodename2``; ``color`` is (red, green, blue) from 0 to 255.

        :param label, url, style, penwidth: attributes of DOT; None: not set
        :param simplify: not used
        """
        options = {"label": label, "URL": url, "style": style, "penwidth": penwidth}
        if color is not None:
            options.update(zip(("colorR", "colorG", "colorB"), map(str, color)))
        graph.add_edge(nodename1, nodename2, **{key: value for key, value in options.items() if value is not None})

    def create_dot(self, graph):
        graph.layout("dot")
        return graph.string().replace("\\\n", "")

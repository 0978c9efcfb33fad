"""DOT text laid out and drawn."""

import pytest
from python_qt_binding.QtWidgets import QGraphicsScene
from qt_dotgraph.dot_to_qt import DotToQtGenerator
from qt_dotgraph.layout import LayoutError, layout, render
from qt_dotgraph.pydotfactory import PydotFactory
from qt_dotgraph.pygraphvizfactory import PygraphvizFactory
from rqt_testing.in_process import application

DOT = r"""digraph g { rankdir=LR;
  subgraph cluster_ns { label="/ns"; a [label="/ns/a" tooltip="tip of a"]; t [label="/ns/t" shape=box3d color=red]; }
  b [label="/b\nsecond line" shape=box]; gone [style=invis];
  a -> t; t -> b [label="/topic" penwidth=3 colorR=255 colorG=0 colorB=9]; b -> a [label="/topic"]; a -> a; }"""


@pytest.fixture(autouse=True)
def app():
    return application()


def test_layout_has_everything():
    graph = layout(DOT)
    nodes = {node.name: node for node in graph.nodes}
    assert set(nodes) == {"a", "t", "b"} and nodes["b"].label == "/b\nsecond line" and nodes["t"].attributes["shape"] == "box3d"
    assert nodes["a"].center[0] < nodes["t"].center[0] < nodes["b"].center[0]  # from left to right
    assert [c.label for c in graph.clusters] == ["/ns"] and graph.size[0] > 100
    assert sorted((e.tail, e.head, e.label) for e in graph.edges) == [
        ("a", "a", ""),
        ("a", "t", ""),
        ("b", "a", "/topic"),
        ("t", "b", "/topic"),
    ]
    assert all(len(e.points) % 3 == 1 and e.end_tip for e in graph.edges)


def test_items_are_where_graphviz_put_them_and_light_up():
    scene = QGraphicsScene()
    nodes, edges = DotToQtGenerator().dotcode_to_qt_items(DOT, highlight_level=3, same_label_siblings=True, scene=scene)
    assert set(nodes) == {"a", "t", "b", "cluster_ns"} and len(scene.items()) > 10
    assert set(edges) == {"a_TO_t", "t_TO_b_/topic", "b_TO_a_/topic", "a_TO_a"}
    assert nodes["a"].toolTip() == "tip of a" and nodes["t"].color().name() == "#ff0000"
    assert nodes["cluster_ns"].sceneBoundingRect().contains(nodes["a"].sceneBoundingRect())
    assert edges["t_TO_b_/topic"][0].color().getRgb()[:3] == (255, 0, 9)
    nodes["b"].hoverEnterEvent(None)
    assert [nodes[n].color().name() for n in "bta"] == ["#ff0000", "#0000cc", "#00aa00"]  # itself, what goes in, what goes out
    assert edges["b_TO_a_/topic"][0].color().name() == "#00aa00" and edges["a_TO_t"][0].color().name() == "#000000"
    nodes["b"].hoverLeaveEvent(None)
    assert [nodes[n].color().name() for n in "bta"] == ["#000000", "#ff0000", "#000000"]
    edges["b_TO_a_/topic"][0].hoverEnterEvent(None)
    assert edges["t_TO_b_/topic"][0].color().name() == "#ffa500"  # the other edge of that topic
    edges["a_TO_a"][0].hoverEnterEvent(None)
    assert nodes["a"].color().name() == "#00aaaa"


def test_both_directions_are_teal():
    nodes, _ = DotToQtGenerator().dotcode_to_qt_items("digraph { a -> b; b -> a }", 3)
    nodes["a"].hoverEnterEvent(None)
    assert nodes["b"].color().name() == "#00aaaa"


def test_without_highlighting_the_neighbours_stay():
    nodes, edges = DotToQtGenerator().dotcode_to_qt_items("digraph { a -> b }", 1)
    nodes["a"].hoverEnterEvent(None)
    assert nodes["b"].color().name() == edges["a_TO_b"][0].color().name() == "#000000"


@pytest.mark.parametrize("factory", (PydotFactory(), PygraphvizFactory()), ids=("pydot", "pygraphviz"))
def test_factories_and_their_text_with_positions(factory):
    graph = factory.get_graph(rankdir="LR")
    cluster = factory.add_subgraph_to_graph(graph, "/my ns")
    factory.add_node_to_graph(cluster, "/my-node/a%", 'a "quoted" label', shape="ellipse", url="topic:/x", color="orange")
    factory.add_node_to_graph(graph, "node")
    factory.add_edge_to_graph(graph, "/my-node/a%", "node", label="line one\\nline two", color=[1, 2, 3], penwidth=2)
    with pytest.raises(ValueError, match="Empty Node name"):
        factory.add_node_to_graph(graph, "")
    with pytest.raises(ValueError, match="Empty subgraph name"):
        factory.add_subgraph_to_graph(graph, "")
    text = factory.create_dot(graph)
    assert "pos=" in text
    nodes, edges = DotToQtGenerator().dotcode_to_qt_items(text, 3)
    labels = {node.text(): node for node in nodes.values()}
    node = labels['a "quoted" label']
    assert node.toolTip() == "topic:/x" and node.color().name() == "#ffa500" and {"/my ns"} < set(labels)
    assert labels["/my ns"].sceneBoundingRect().contains(node.sceneBoundingRect())
    assert (factory.escape_name("node") if hasattr(factory, "escape_name") else "node") in nodes
    (edge,) = next(iter(edges.values()))
    assert edge.text() == "line one\nline two" and edge.color().getRgb()[:3] == (1, 2, 3)


def test_text_with_positions_keeps_them():
    """A graph that somebody has arranged by hand: b stands far to the left of a, as dot would never put it."""
    text = 'digraph { graph [bb="0,0,700,100"]; a [pos="600,50", width=1, height=0.5]; b [pos="50,50", width=1, height=0.5]; }'
    nodes, _ = DotToQtGenerator().dotcode_to_qt_items(text, 3)
    difference = nodes["a"].sceneBoundingRect().center() - nodes["b"].sceneBoundingRect().center()
    assert abs(difference.x() - 550) < 2 and abs(difference.y()) < 2


@pytest.mark.parametrize(
    "text, said",
    [
        ("", "not a graph in DOT"),
        ("<html>", "not a graph in DOT"),
        ("digraph { a -> ", "syntax error"),
        ("digraph { a [label=\x00", "refuses|syntax"),
    ],
)
def test_what_is_not_dot(text, said):
    with pytest.raises(LayoutError, match=said) as caught:
        layout(text)
    assert "\n" not in str(caught.value)


def test_comments_before_the_graph_and_no_nodes():
    assert layout("/* made\n by hand */ // x\nstrict digraph { }").nodes == []


def test_pictures():
    assert render(DOT, "svg").startswith(b"<?xml") and render(DOT, "png").startswith(b"\x89PNG")


def test_large_graph_with_clusters_and_labels_on_which_dot_gives_up():
    """dot 2.42 ends with "trouble in init_rank" here."""
    names = sorted(f"/ns{i % 5}/node_{i}" for i in range(50))
    clusters = "".join(
        f"subgraph cluster_{k} {{ " + "".join(f'"{name}"; ' for name in names if f"ns{k}/" in name) + "}\n" for k in range(5)
    )
    edges = "".join(f'"{names[i % 50]}" -> "{names[(i * 7 + i // 50 + 1) % 50]}" [label="topic_{i}"];\n' for i in range(300))
    graph = layout("digraph { rankdir=LR; compound=true;\n" + clusters + edges + "}")
    assert len(graph.nodes) == 50 and len(graph.edges) == 300

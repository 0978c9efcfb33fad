"""Filters, groups and clusters of the graph, as DOT text."""

import re

import pytest
from rqt_graph.dotcode import (
    NODE_NODE_GRAPH,
    NODE_TOPIC_ALL_GRAPH,
    NODE_TOPIC_GRAPH,
    Options,
    Statistics,
    generate_dot,
    matches_any,
    select,
    split_filter,
)
from rqt_graph.ros_state import State


def system(*links, bad=None, nodes=()):
    """A state from links "publisher > topic > subscriber", either end of which may be missing."""
    state = State(bad=bad or {})
    for link in links:
        start, topic, end = (part.strip() for part in link.split(">"))
        if start:
            state.publishers.setdefault(topic, []).append(start)
            state.active.add((start, topic, True))
        if end:
            state.subscribers.setdefault(topic, []).append(end)
            state.active.add((end, topic, False))
        if start and end:
            state.connections.add((start, topic, end))
        state.nodes |= {start, end} - {""}
    state.nodes |= set(nodes)
    return state


EVERYTHING = dict(hide_dead_sinks=False, hide_leaf_topics=False, hide_debug=False, hide_unreachable=False, hide_params=False)


@pytest.mark.parametrize(
    "text, expected",
    [
        ("", ([".*"], [])),
        ("/", ([".*"], [])),
        ("-/tf", ([".*"], ["/tf"])),
        ("/a, /b.*", (["/a", "/b.*"], [])),
        ("/a,-/a/b , -.*x", (["/a"], ["/a/b", ".*x"])),
        (" , ", ([".*"], [])),
    ],
)
def test_filter_texts(text, expected):
    assert split_filter(text) == expected


def test_names_and_expressions():
    assert matches_any("/arm", ["/arm"]) and not matches_any("/arm2", ["/arm"])  # a plain name is the whole name
    assert matches_any("/arm2", ["/arm.*"]) and not matches_any("/my/arm2", ["/arm.*"])
    assert not matches_any("/arm", ["(", "*"]) and matches_any("/arm", ["(", "/a.*"])  # being typed


def test_nodes_only_has_an_edge_for_each_topic():
    state = system("/a > /x > /b", "/a > /y > /b", "/a > /nobody >")
    graph = select(state, Options())
    assert graph.node_edges == {("/a", "/b", "/x"), ("/a", "/b", "/y")} and graph.topics == {}
    dot = generate_dot(state, Options())
    assert dot.startswith("digraph graphname {\nrankdir=LR;") and '"n_/a" -> "n_/b" [tooltip="topic:/x" label="/x"];' in dot


def test_filters_of_nodes_and_topics():
    state = system("/a > /x > /b", "/a > /y > /b", "/c > /x > /d", nodes=["/alone"])
    graph = select(state, Options(node_filter="-/c", topic_filter="-/y"))
    assert graph.nodes == {"/a", "/b", "/d", "/alone"} and graph.node_edges == {("/a", "/b", "/x")}


def test_debugging_is_hidden_by_parts_of_names():
    state = system(
        "/a > /rosout > /rosout",
        "/rosout > /rosout_agg > /rqt_gui_py_node_7",
        "/gazebo > /clock > /a",
        "/my_monitor > /x > /a",
        "/b/monitor > /y > /a",
    )
    assert select(state, Options()).nodes == {"/a", "/gazebo", "/my_monitor"}
    assert select(state, Options()).node_edges == {("/my_monitor", "/a", "/x")}
    assert len(select(state, Options(hide_debug=False)).node_edges) == 5
    topics = select(system("/a > /clock > /b", "/a > /statistics > /b", "/a > /x > /b"), Options(NODE_TOPIC_GRAPH)).topics
    assert set(topics) == {"/x"}


def test_active_has_what_is_connected_and_all_what_is_registered():
    state = system("/a > /x > /b")
    state.publishers["/quiet"], state.subscribers["/quiet"] = ["/a"], ["/b"]
    assert set(select(state, Options(NODE_TOPIC_GRAPH)).topics) == {"/x"}
    assert set(select(state, Options(NODE_TOPIC_ALL_GRAPH)).topics) == {"/x", "/quiet"}


def test_dead_sinks_and_leaf_topics():
    state = system("/a > /unheard >", "/b > /unheard >", " > /unspoken > /a", "/a > /x > /b")
    show = lambda **o: set(select(state, Options(NODE_TOPIC_ALL_GRAPH, **{**EVERYTHING, **o})).topics)  # noqa: E731
    assert show() == {"/unheard", "/unspoken", "/x"}
    assert show(hide_dead_sinks=True) == {"/unspoken", "/x"}
    assert show(hide_leaf_topics=True) == {"/unheard", "/x"}
    assert show(hide_leaf_topics=True, hide_dead_sinks=True) == {"/x"}


def test_actions_are_one_topic():
    parts = ("goal", "cancel", "status", "feedback", "result")
    links = [f"/client > /arm/follow/{part} > /server" for part in parts[:2]] + [
        f"/server > /arm/follow/{part} > /client" for part in parts[2:]
    ]
    graph = select(system(*links, "/a > /half/feedback > /b"), Options(NODE_TOPIC_GRAPH))
    assert graph.topics == {"/arm/follow/action_topics": True, "/half/feedback": False}
    assert {link for link in graph.topic_edges if "follow" in link[1]} == {
        (node, "/arm/follow/action_topics", out) for node in ("/client", "/server") for out in (True, False)
    }
    assert len(select(system(*links), Options(NODE_TOPIC_GRAPH, group_actions=False)).topics) == 5
    assert "shape=box3d" in generate_dot(system(*links), Options(NODE_TOPIC_GRAPH))


def test_tf_and_images_are_one_topic_each():
    state = system(
        "/a > /tf > /b",
        "/a > /tf_static > /b",
        "/cam > /image > /b",
        "/cam > /image/compressed > /b",
        "/cam > /image/theora > /b",
        "/cam > /other > /b",
        "/cam > /other/compressed > /b",
    )
    graph = select(state, Options(NODE_TOPIC_GRAPH))
    assert graph.topics == {"/tf": True, "/image/image_topics": True, "/other": False, "/other/compressed": False}
    assert set(select(state, Options(NODE_TOPIC_GRAPH, group_tf=False)).topics) >= {"/tf", "/tf_static"}
    assert not {"/tf", "/tf_static"} & set(select(state, Options(NODE_TOPIC_GRAPH, hide_tf=True)).topics)
    assert ("/a", "/b", "/tf") not in select(state, Options(hide_tf=True)).node_edges


def test_parameter_topics_go_in_pairs():
    state = system("/a > /s/parameter_descriptions > /b", "/a > /s/parameter_updates > /b", "/a > /t/parameter_updates > /b")
    assert set(select(state, Options(NODE_TOPIC_GRAPH)).topics) == {"/t/parameter_updates"}
    assert len(select(state, Options(NODE_TOPIC_GRAPH, hide_params=False)).topics) == 3


def test_nodes_that_do_not_answer():
    state = system("/a > /x > /b", bad={"/b": "DEAD", "/w": "WONKY"}, nodes=["/w"])
    assert select(state, Options()).nodes == {"/a"}
    dot = generate_dot(state, Options(hide_unreachable=False))
    assert 'tooltip="/b (DEAD)" color=red' in dot and 'tooltip="/w (WONKY)" color=orange' in dot


def test_clusters_are_nested_up_to_a_level():
    state = system("/a/b/c/n > /a/b/t > /n")
    dot = generate_dot(state, Options(NODE_TOPIC_GRAPH))
    assert re.findall(r'subgraph \w+ {\nlabel="([^"]*)"', dot) == ["/a", "/a/b"]
    assert "subgraph" not in generate_dot(state, Options(NODE_TOPIC_GRAPH, namespaces=0))
    assert re.findall(r'label="(/[^"]*)"; style', generate_dot(state, Options(namespaces=9))) == ["/a", "/a/b", "/a/b/c"]


def test_statistics_label_colour_and_width():
    state = system("/a > /x > /b", "/c > /x > /b")
    statistics = {("/a", "/x", "/b"): Statistics(10.04, 0.2, 20000), ("/c", "/x", "/b"): Statistics(0, 0.0, 100)}
    dot = generate_dot(state, Options(), statistics)
    assert 'penwidth=5 color="#ff0000" label="/x\\n10.0 Hz // 200 ms"' in dot
    assert 'penwidth=1 color="#000000" label="/x\\n? Hz"' in dot
    assert '"t_/x" -> "n_/b" [penwidth=5 color="#ff0000" label="(2 connections)"];' in generate_dot(
        state, Options(NODE_TOPIC_GRAPH), statistics
    )


def test_names_that_dot_must_not_take_for_its_own():
    from qt_dotgraph.layout import layout

    names = {'/quote"d', "/back\\slash", "/ünïcode", "/node", "/{brace}|<", "/a->b;"}
    graph = layout(generate_dot(system(nodes=names), Options(namespaces=0)))
    assert {node.label for node in graph.nodes} == names


def test_fifty_nodes_and_three_hundred_topics_take_no_time():
    import time

    links = [f"/ns{i % 5}/node_{i % 50} > /ns{i % 5}/topic_{i} > /ns{(i * 7) % 5}/node_{(i * 7 + 3) % 50}" for i in range(300)]
    state, start = system(*links), time.process_time()
    dot = generate_dot(state, Options(NODE_TOPIC_ALL_GRAPH))
    assert dot.count("->") == 600 and time.process_time() - start < 2


class Factory:
    """Notes what a generator draws, under the names of qt_dotgraph's factories."""

    def __init__(self):
        self.nodes, self.edges, self.clusters = {}, set(), []

    def get_graph(self, rank, ranksep, simplify, rankdir):
        self.rankdir = rankdir
        return "graph"

    def add_subgraph_to_graph(self, graph, name, rank, rankdir, simplify):
        self.clusters.append((graph, name))
        return name

    def add_node_to_graph(self, graph, nodename, nodelabel, shape, url, color):
        self.nodes[nodename] = graph, nodelabel, shape, url, color

    def add_edge_to_graph(self, graph, start, end, label, url, penwidth, color):
        self.edges.add((start, end, label, url, penwidth, color and tuple(color)))


@pytest.fixture
def ros_graph():
    """What rosgraph finds for two nodes in a namespace, a dead one, an action and a console."""
    from rosgraph.impl.graph import BadNode, Edge, Graph

    graph = Graph()
    graph.nn_nodes = {"/ns/talker", "/ns/listener", "/gone", "/rosout"}
    graph.bad_nodes = {"/gone": BadNode("/gone", BadNode.DEAD, "no answer")}
    graph.nn_edges.add(Edge("/ns/talker", "/ns/listener", "/ns/chatter"))
    action = [f"/ns/do/{part}" for part in ("goal", "cancel", "status", "feedback", "result")]
    for topic in ["/ns/chatter", "/rosout", *action]:
        graph.nt_nodes.add(" " + topic)
        for edge in (Edge("/ns/talker", " " + topic), Edge(" " + topic, "/rosout" if topic == "/rosout" else "/ns/listener")):
            graph.nt_edges.add(edge)
            graph.nt_all_edges.add(edge)
    graph.nt_nodes.add(" /ns/unheard")
    graph.nt_all_edges.add(Edge("/ns/talker", " /ns/unheard"))
    return graph


def generator():
    from rqt_graph.dotcode import RosGraphDotcodeGenerator
    from rqt_testing.in_process import rospy_without_master

    rospy_without_master()
    return RosGraphDotcodeGenerator()


def test_generator_for_other_packages(ros_graph):
    factory, made = Factory(), generator()
    assert (
        made.generate_dotgraph(ros_graph, "/", "/", NODE_NODE_GRAPH, factory, cluster_namespaces_level=1, quiet=True, orientation="TB")
        == "graph"
    )
    assert factory.rankdir == "TB" and factory.clusters == [("graph", "/ns")]
    assert factory.nodes == {
        "n_/ns/talker": ("/ns", "/ns/talker", "ellipse", "/ns/talker", None),
        "n_/ns/listener": ("/ns", "/ns/listener", "ellipse", "/ns/listener", None),
        "n_/gone": ("graph", "/gone", "ellipse", "/gone (DEAD)", "red"),
    }
    assert factory.edges == {("n_/ns/talker", "n_/ns/listener", "/ns/chatter", "topic:/ns/chatter", 1, None)}
    factory = Factory()
    made.generate_dotgraph(ros_graph, "/", "-/rosout", NODE_TOPIC_GRAPH, factory, unreachable=True)
    assert set(factory.nodes) == {"n_/ns/talker", "n_/ns/listener", "n_/rosout", "t_/ns/chatter", "t_/ns/do/action_topics"}
    assert factory.nodes["t_/ns/do/action_topics"][2] == "box3d"
    factory = Factory()
    made.generate_dotgraph(ros_graph, "-/rosout", "/", NODE_TOPIC_ALL_GRAPH, factory, accumulate_actions=False)
    assert {"t_/ns/unheard", "t_/ns/do/goal"} < set(factory.nodes)
    assert ("n_/ns/talker", "t_/ns/unheard", None, None, 1, None) in factory.edges


def test_generator_shows_traffic_and_writes_text(ros_graph):
    import genpy
    from qt_dotgraph.pydotfactory import PydotFactory
    from rosgraph_msgs.msg import TopicStatistics

    made = generator()
    made.statistics_callback(
        TopicStatistics(
            topic="/ns/chatter",
            node_pub="/ns/talker",
            node_sub="/ns/listener",
            traffic=1000000,
            window_stop=genpy.Time(1),
            period_mean=genpy.Duration(0, 100000000),
        )
    )
    factory = Factory()
    made.generate_dotgraph(ros_graph, "/", "/", NODE_NODE_GRAPH, factory)
    assert [edge[2:5] for edge in factory.edges] == [("/ns/chatter\\n10.0 Hz", "topic:/ns/chatter", 5)]
    text = made.generate_dotcode(ros_graph, "/", "/", NODE_TOPIC_GRAPH, PydotFactory(), quiet=True)
    assert "pos=" in text and 'label="/ns/listener"' in text and "/rosout" not in text
    assert made.generate_namespaces(ros_graph, NODE_NODE_GRAPH) == ["/", "/ns/"]


def test_names_that_other_packages_import():
    from rqt_graph.dotcode import QUIET_NAMES, NodeConnections, _conv

    assert "/rosout" in QUIET_NAMES + ["/mine"] and NodeConnections().incoming == []
    assert _conv("/a") == "n_/a" and _conv(" /a") == "t_/a"

"""The graph of a system as DOT text: filters, groups, clusters.

:func:`generate_dot` works on what :mod:`rqt_graph.ros_state` has read; :class:`RosGraphDotcodeGenerator` is the interface that
other packages import, on a ``rosgraph.impl.graph.Graph``. No Qt in here.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import rosgraph.names

from rqt_graph.ros_state import DEAD, WONKY, State

NODE_NODE_GRAPH = "node_node"
NODE_TOPIC_GRAPH = "node_topic"
NODE_TOPIC_ALL_GRAPH = "node_topic_all"

#: Parts of the names of nodes and topics that are there in every system and tell little.
QUIET_NAMES = [
    "/diag_agg",
    "/runtime_logger",
    "/pr2_dashboard",
    "/rviz",
    "/rosout",
    "/cpu_monitor",
    "/monitor",
    "/hd_monitor",
    "/rxloggerlevel",
    "/clock",
    "/rqt",
    "/statistics",
]
_QUIET_TOPICS = ("/time", "/clock", "/rosout", "/statistics")
_TF = ("/tf", "/tf_static")
_ACTION = ("goal", "cancel", "status", "feedback", "result")
_IMAGE = ("compressed", "compressedDepth", "theora")


@dataclass
class Options:
    """What to show; the defaults are those of the window."""

    mode: str = NODE_NODE_GRAPH
    node_filter: str = "/"
    topic_filter: str = "/"
    namespaces: int = 2
    group_actions: bool = True
    group_tf: bool = True
    group_images: bool = True
    hide_dead_sinks: bool = True
    hide_leaf_topics: bool = True
    hide_debug: bool = True
    hide_tf: bool = False
    hide_unreachable: bool = True
    hide_params: bool = True


@dataclass(frozen=True)
class Statistics:
    """Of one connection: frequency in Hz, mean age of messages in s, traffic in bytes/s (of the window measured)."""

    frequency: float
    age: float
    traffic: float

    @staticmethod
    def of(message) -> Statistics:
        """What a rosgraph_msgs/TopicStatistics says."""
        period = message.period_mean.to_sec()
        window = (message.window_stop - message.window_start).to_sec()
        return Statistics(
            1 / period if period > 0 else 0.0, message.stamp_age_mean.to_sec(), message.traffic / window if window > 0 else 0.0
        )


def split_filter(text: str) -> tuple[list[str], list[str]]:
    """A comma list as (names or expressions to include, those to exclude); nothing and ``/`` include everything."""
    words = [word.strip() for word in text.split(",")]
    excluded = [word[1:] for word in words if word.startswith("-")]
    included = [word for word in words if word and not word.startswith("-")]
    return (included if included and included != ["/"] else [".*"]), excluded


def matches_any(name: str, patterns: Iterable[str]) -> bool:
    """Whether ``name`` is one of ``patterns``, or begins as one of these regular expressions says; one that is malformed fits none."""
    for pattern in patterns:
        if name == pattern:
            return True
        if re.fullmatch(r"[a-zA-Z0-9_/]+", pattern) is None:
            try:
                if re.match(pattern, name):
                    return True
            except re.error:
                continue
    return False


def passes(name: str, text: str) -> bool:
    """Whether a filter, ``text``, lets ``name`` through."""
    included, excluded = split_filter(text)
    return matches_any(name, included) and not matches_any(name, excluded)


@dataclass
class Graph:
    """What is shown. ``topics``: name -> whether it stands for several; edges are (start, end, label, statistics)."""

    nodes: set[str] = field(default_factory=set)
    topics: dict[str, bool] = field(default_factory=dict)
    node_edges: set[tuple[str, str, str]] = field(default_factory=set)  # (publisher, subscriber, topic)
    topic_edges: set[tuple[str, str, bool]] = field(default_factory=set)  # (node, topic, whether it publishes)


def select(state, options: Options) -> Graph:
    """The part of ``state``, a :class:`rqt_graph.ros_state.State`, that ``options`` show."""
    nodes = {
        node
        for node in state.nodes
        if passes(node, options.node_filter)
        and not (options.hide_debug and _quiet(node))
        and not (options.hide_unreachable and node in state.bad)
    }
    every_topic = set(state.publishers) | set(state.subscribers)
    params = _parameter_topics(every_topic) if options.hide_params else set()

    def shown(topic):
        return passes(topic, options.topic_filter) and topic not in params and not (options.hide_tf and topic in _TF)

    if options.mode == NODE_NODE_GRAPH:
        edges = {
            (start, end, topic)
            for start, topic, end in state.connections
            if start in nodes and end in nodes and shown(topic) and not (options.hide_debug and topic in _QUIET_TOPICS)
        }
        return Graph(nodes, {}, edges)
    links = state.registered() if options.mode == NODE_TOPIC_ALL_GRAPH else set(state.active)
    links = {
        (node, topic, out) for node, topic, out in links if node in nodes and shown(topic) and not (options.hide_debug and _quiet(topic))
    }
    links = _without_leaves(links, options)
    topics = {topic: False for _, topic, _ in links}
    links, topics = _grouped(links, topics, options)
    return Graph(nodes, topics, set(), links)


def _quiet(name: str) -> bool:
    return any(quiet in name for quiet in QUIET_NAMES)


def _parameter_topics(topics) -> set[str]:
    servers = {topic[: -len("/parameter_descriptions")] for topic in topics if topic.endswith("/parameter_descriptions")}
    return {
        f"{server}/{kind}"
        for server in servers
        if f"{server}/parameter_updates" in topics
        for kind in ("parameter_descriptions", "parameter_updates")
    }


def _without_leaves(links, options: Options):
    count: dict[str, int] = {}
    heard = {topic for _, topic, out in links if not out}
    for _, topic, _ in links:
        count[topic] = count.get(topic, 0) + 1
    return {
        (node, topic, out)
        for node, topic, out in links
        if not (options.hide_dead_sinks and topic not in heard) and not (options.hide_leaf_topics and count[topic] < 2)
    }


def _grouped(links, topics, options: Options):
    """Links and topics with those of an action, of tf, of an image in the place of their parts."""
    stands_for: dict[str, str] = {}
    if options.group_actions:
        for topic in topics:
            server = topic[: -len("/feedback")] if topic.endswith("/feedback") else None
            if server is not None and all(f"{server}/{part}" in topics for part in _ACTION):
                stands_for.update({f"{server}/{part}": f"{server}/action_topics" for part in _ACTION})
    if options.group_images:
        for topic in topics:
            parts = [f"{topic}/{part}" for part in _IMAGE if f"{topic}/{part}" in topics]
            if len(parts) >= 2:
                stands_for.update({part: f"{topic}/image_topics" for part in [topic, *parts]})
    if options.group_tf and not options.hide_tf and any(topic in topics for topic in _TF):
        stands_for.update({topic: "/tf" for topic in _TF})
    links = {(node, stands_for.get(topic, topic), out) for node, topic, out in links}
    groups = set(stands_for.values())
    return links, {topic: topic in groups for _, topic, _ in links}


def generate_dot(state, options: Options, statistics: dict | None = None) -> str:
    """DOT text of what ``options`` show of ``state``, a :class:`rqt_graph.ros_state.State`.

    :param statistics: (publisher, topic, subscriber) -> :class:`Statistics`
    """
    writer = _Writer()
    _draw(state, options, statistics or {}, writer)
    return writer.text()


def _draw(state, options: Options, statistics: dict, writer) -> None:
    """Give what the options show to a writer: ``node(namespaces, key, label, shape, tooltip, color)`` with the clusters from the
    outermost inwards, and ``edge(start, end, label, look, tooltip)`` with (text, pen width, colour) of its traffic or None."""
    graph, traffic = select(state, options), _Traffic(statistics)

    def clusters(name):
        parts = name.split("/")
        return ["/".join(parts[:depth]) for depth in range(2, min(2 + options.namespaces, len(parts)))]

    for node in sorted(graph.nodes):
        bad = state.bad.get(node)
        color = {None: None, WONKY: "orange"}.get(bad, "red")
        writer.node(clusters(node), "n_" + node, node, "ellipse", f"{node} ({bad})" if bad else node, color)
    for topic, group in sorted(graph.topics.items()):
        writer.node(clusters(topic), "t_" + topic, topic, "box3d" if group else "box", f"topic:{topic}", None)
    for start, end, topic in sorted(graph.node_edges):
        writer.edge("n_" + start, "n_" + end, topic, traffic.look(topic, end, start), f"topic:{topic}")
    for node, topic, out in sorted(graph.topic_edges):
        if out:
            writer.edge("n_" + node, "t_" + topic, "", None, None)
        else:
            writer.edge("t_" + topic, "n_" + node, "", traffic.look(topic, node), None)


def quoted(text: str) -> str:
    """A string of DOT: quotes and backslashes of the text stay what they are; ``\\n`` breaks a line."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'


class _Traffic:
    """How thick and how hot connections are, beside the busiest and the slowest one."""

    def __init__(self, statistics: dict):
        self._statistics = statistics
        self._most_traffic = max([10000.0, *(s.traffic for s in statistics.values())])
        self._oldest = max([0.1, *(s.age for s in statistics.values())])

    def look(self, topic, subscriber, publisher=None):
        """(text, pen width, colour) of a connection, or of all that lead from a topic to a node; None without statistics."""
        found = [s for (p, t, n), s in self._statistics.items() if t == topic and n == subscriber and publisher in (None, p)]
        if not found:
            return None
        age, traffic = max(s.age for s in found), sum(s.traffic for s in found)
        width = max(1, int(traffic / self._most_traffic * 5))
        if len(found) > 1:
            return f"({len(found)} connections)", width, _heat(age / self._oldest)
        text = f"{found[0].frequency:.1f} Hz" if found[0].frequency > 0 else "? Hz"
        return text + (f" // {round(age * 1000)} ms" if age > 0 else ""), width, _heat(age / self._oldest)


class _Writer:
    """Collects lines of DOT, nodes in the clusters of their namespaces."""

    def __init__(self):
        self._root: tuple[dict[str, Any], list[str]] = ({}, [])  # clusters within: name -> the same pair; lines
        self._edges: list[str] = []

    def node(self, namespaces, key, label, shape, tooltip, color) -> None:
        clusters, lines = self._root
        for namespace in namespaces:
            clusters, lines = clusters.setdefault(namespace, ({}, []))
        lines.append(
            f"{quoted(key)} [label={quoted(label)} shape={shape} tooltip={quoted(tooltip)}" + (f" color={color}" if color else "") + "];"
        )

    def edge(self, start, end, label, look, tooltip) -> None:
        attributes = [f"tooltip={quoted(tooltip)}"] if tooltip else []
        if look is not None:
            text, width, color = look
            label = f"{label}\n{text}" if label else text
            attributes += [f"penwidth={width}", f'color="#{color[0]:02x}{color[1]:02x}{color[2]:02x}"']
        if label:
            attributes.append(f"label={quoted(label)}")
        self._edges.append(f"{quoted(start)} -> {quoted(end)}" + (f" [{' '.join(attributes)}]" if attributes else "") + ";")

    def text(self) -> str:
        return "\n".join(
            ["digraph graphname {", "rankdir=LR; ranksep=0.2; compound=true;", *_lines(self._root, [0]), *self._edges, "}", ""]
        )


def _lines(cluster, counter) -> list[str]:
    clusters, lines = cluster
    result = list(lines)
    for name, inner in sorted(clusters.items()):
        counter[0] += 1
        result += [f"subgraph cluster_{counter[0]} {{", f"label={quoted(name)}; style=bold;", *_lines(inner, counter), "}"]
    return result


def _heat(part: float) -> tuple[int, int, int]:
    """Green for 0, yellow in the middle, red for 1; black when there is no age."""
    if part <= 0:
        return 0, 0, 0
    part = min(part, 1.0)
    return (int(part * 2 * 255), 255, 0) if part <= 0.5 else (255, 255 - int((part - 0.5) * 2 * 255), 0)


# The interface that other packages import.


def _conv(name: str) -> str:
    """The name of a node or, with a space before it, of a topic as a name in DOT."""
    return "t_" + name[1:] if name.startswith(" ") else "n_" + name


class NodeConnections:
    """Edges that lead to and away from a node of the graph."""

    def __init__(self, incoming=None, outgoing=None):
        self.incoming = incoming or []
        self.outgoing = outgoing or []


class RosGraphDotcodeGenerator:
    """Draws a ``rosgraph.impl.graph.Graph`` with a factory of :mod:`qt_dotgraph`; traffic is added when nodes publish
    ``/statistics``."""

    def __init__(self):
        import rospy
        from rosgraph_msgs.msg import TopicStatistics

        self.edges: dict[str, dict] = {}  # subscriber -> topic -> publisher -> message
        self.stats_sub = rospy.Subscriber("/statistics", TopicStatistics, self.statistics_callback)

    def statistics_callback(self, msg) -> None:
        self.edges.setdefault(msg.node_sub, {}).setdefault(msg.topic, {})[msg.node_pub] = msg

    def quiet_filter_topic_edge(self, edge) -> bool:
        """Whether an edge tells more than every system's debugging."""
        return edge.label not in _QUIET_TOPICS and not _quiet(edge.start) and not _quiet(edge.end)

    def generate_namespaces(self, graph, graph_mode, quiet=False) -> list[str]:
        """Namespaces of the nodes, and with topics of these too, that a mode of the graph shows; each with / at its end.

        :param graph: a ``rosgraph.impl.graph.Graph``
        :param graph_mode: as of :meth:`generate_dotgraph`
        :param quiet: leave names of debugging out
        """
        names = list(graph.nn_nodes)
        if graph_mode != NODE_NODE_GRAPH:
            names += [topic.strip() for topic in graph.nt_nodes]
        return sorted({rosgraph.names.namespace(name) for name in names if not (quiet and name in QUIET_NAMES)})

    def generate_dotgraph(
        self,
        rosgraphinst,
        ns_filter,
        topic_filter,
        graph_mode,
        dotcode_factory,
        hide_single_connection_topics=False,
        hide_dead_end_topics=False,
        cluster_namespaces_level=0,
        accumulate_actions=True,
        orientation="LR",
        rank="same",
        ranksep=0.2,
        rankdir="TB",
        simplify=True,
        quiet=False,
        unreachable=False,
        hide_tf_nodes=False,
        group_tf_nodes=False,
        group_image_nodes=False,
        hide_dynamic_reconfigure=False,
    ):
        """The graph of ``rosgraphinst``, a ``rosgraph.impl.graph.Graph``, by ``dotcode_factory``. ``quiet``: no nodes of debugging.

        :param ns_filter: which nodes: names or regular expressions between commas, a leading - excludes. :param topic_filter: topics.
        :param graph_mode: NODE_NODE_GRAPH, NODE_TOPIC_GRAPH or NODE_TOPIC_ALL_GRAPH. :param cluster_namespaces_level: 0: no boxes.
        :param hide_single_connection_topics, hide_dead_end_topics, hide_tf_nodes, hide_dynamic_reconfigure: leave these out.
        :param accumulate_actions, group_tf_nodes, group_image_nodes: draw those as one. :param unreachable: hide who does not answer.
        :param orientation: LR or TB, the way in which it grows; ``rankdir`` is not used. :param rank, ranksep, simplify: as the factory.
        """
        options = Options(
            graph_mode,
            ns_filter,
            topic_filter,
            cluster_namespaces_level,
            accumulate_actions,
            group_tf_nodes,
            group_image_nodes,
            hide_dead_end_topics,
            hide_single_connection_topics,
            quiet,
            hide_tf_nodes,
            unreachable,
            hide_dynamic_reconfigure,
        )
        graph = dotcode_factory.get_graph(rank=rank, ranksep=ranksep, simplify=simplify, rankdir=orientation)
        statistics = {
            (publisher, topic, node): Statistics.of(message)
            for node, topics in self.edges.items()
            for topic, publishers in topics.items()
            for publisher, message in publishers.items()
        }
        _draw(
            _state_of(rosgraphinst),
            options,
            statistics,
            _FactoryWriter(dotcode_factory, graph, {"rank": rank, "rankdir": orientation, "simplify": simplify}),
        )
        return graph

    def generate_dotcode(self, rosgraphinst, ns_filter, topic_filter, graph_mode, dotcode_factory, *rest, **options) -> str:
        """As :meth:`generate_dotgraph`, as DOT text with positions; ``dotcode_factory`` writes it.

        ``rosgraphinst``, ``ns_filter``, ``topic_filter``, ``graph_mode`` and all further arguments are the same there.
        """
        graph = self.generate_dotgraph(rosgraphinst, ns_filter, topic_filter, graph_mode, dotcode_factory, *rest, **options)
        return dotcode_factory.create_dot(graph)


class _FactoryWriter:
    """Hands nodes, clusters and edges to a factory of :mod:`qt_dotgraph`."""

    def __init__(self, factory, graph, look: dict):
        self._factory, self._graph, self._look = factory, graph, look
        self._clusters: dict[str, object] = {}

    def node(self, namespaces, key, label, shape, tooltip, color) -> None:
        place = self._graph
        for namespace in namespaces:
            if namespace not in self._clusters:
                self._clusters[namespace] = self._factory.add_subgraph_to_graph(place, namespace, **self._look)
            place = self._clusters[namespace]
        self._factory.add_node_to_graph(place, nodename=key, nodelabel=label, shape=shape, url=tooltip, color=color)

    def edge(self, start, end, label, look, tooltip) -> None:
        text, width, color = look or ("", 1, None)
        label = "\\n".join(part for part in (label, text) if part) or None
        self._factory.add_edge_to_graph(self._graph, start, end, label=label, url=tooltip, penwidth=width, color=color)


def _state_of(graph) -> State:
    """A rosgraph.impl.graph.Graph as what :func:`select` works on; its topics are named with a space before them."""
    state = State(set(graph.nn_nodes), bad={node: (DEAD, WONKY)[bad.type == 1] for node, bad in graph.bad_nodes.items()})
    state.connections = {(edge.start, edge.label, edge.end) for edge in graph.nn_edges}
    for edges, active in ((graph.nt_all_edges, False), (graph.nt_edges, True)):
        for edge in edges:
            out = edge.end.startswith(" ")
            node, topic = (edge.start, edge.end) if out else (edge.end, edge.start)
            table = state.publishers if out else state.subscribers
            if node not in table.setdefault(topic.strip(), []):
                table[topic.strip()].append(node)
            if active:
                state.active.add((node, topic.strip(), out))
    return state

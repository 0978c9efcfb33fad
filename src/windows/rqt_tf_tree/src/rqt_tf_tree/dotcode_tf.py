"""The frames that a tf buffer knows, as DOT text. No Qt in here.

:class:`RosTfTreeDotcodeGenerator` is what other packages import.
"""

from __future__ import annotations

import time as clock
from typing import Any

import yaml
from qt_gui.errors import WindowError
from rqt_graph.dotcode import quoted

_FIELDS = (
    ("Broadcaster", "broadcaster"),
    ("Average rate", "rate"),
    ("Buffer length", "buffer_length"),
    ("Most recent transform", "most_recent_transform"),
    ("Oldest transform", "oldest_transform"),
)


class FramesError(WindowError):
    """What the buffer says of its frames cannot be read; one line."""


def parse(text: str) -> dict[str, dict[str, Any]]:
    """Frame -> what is known of it, from the YAML of ``tf2_frames``; empty when there are none.

    :raises FramesError: the names of frames are such that the text is no YAML.
    """
    try:
        frames = yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise FramesError(f"a frame has a name that cannot be listed ({str(error).splitlines()[0]})") from error
    return {str(name): values for name, values in frames.items()} if isinstance(frames, dict) else {}


def _label(values: dict[str, Any], line_break: str) -> str:
    return line_break.join(f"{title}: {values.get(key)}" for title, key in _FIELDS)


def generate_dot(frames: dict[str, dict[str, Any]], time: float) -> str:
    """DOT text of the tree of ``frames``, as :func:`parse` returns them.

    :param time: of the recording, s
    """
    if not frames:
        return 'digraph graphname { "none" [label="No tf data received" shape=box]; }\n'
    lines = ["digraph graphname {", "rankdir=TB; ranksep=0.2;"]
    names = set(frames) | {str(values["parent"]) for values in frames.values()}
    lines += [f"{quoted('f_' + name)} [label={quoted(name)} shape=ellipse tooltip={quoted(name)}];" for name in sorted(names)]
    for name, values in sorted(frames.items()):
        label = _label(values, "\n")
        lines.append(f"{quoted('f_' + str(values['parent']))} -> {quoted('f_' + name)} [label={quoted(label)}];")
    lines.append(f"recorded [label={quoted(f'Recorded at time: {time}')} shape=box];")
    roots = sorted(names - set(frames)) or sorted(names)[:1]
    lines += [f"recorded -> {quoted('f_' + root)} [style=invis];" for root in roots]
    return "\n".join([*lines, "}", ""])


class RosTfTreeDotcodeGenerator:
    """Draws the tree with a factory of :mod:`qt_dotgraph`.

    :param initial_listen_duration: s before the first question.
    """

    def __init__(self, initial_listen_duration: float = 1):
        self.listen_duration = initial_listen_duration
        self.dotcode: str | None = None
        self.dotcode_factory: Any = None
        self.graph: Any = None
        self._look: dict[str, Any] = {}

    def generate_dotcode(
        self, dotcode_factory, tf2_frame_srv, timer=None, yaml_parser=yaml, rank="same", ranksep=0.2, rankdir="TB", force_refresh=False
    ) -> str:
        """DOT text with positions; the last one unless that is refused or the look is another.

        :param tf2_frame_srv: called without arguments, returns a tf2_msgs/FrameGraphResponse.
        :param timer: with ``now()``; rospy.Time without.
        :param dotcode_factory: of :mod:`qt_dotgraph`.
        :param yaml_parser: with ``safe_load()``.
        :param rank, ranksep, rankdir: attributes of DOT.
        :param force_refresh: refuse the last one.
        """
        look = {"rank": rank, "rankdir": rankdir, "ranksep": ranksep}
        dotcode = self.dotcode
        if force_refresh or dotcode is None or (dotcode_factory, look) != (self.dotcode_factory, self._look):
            self.dotcode_factory, self._look = dotcode_factory, look
            clock.sleep(self.listen_duration)
            self.listen_duration = 0
            if timer is None:
                import rospy

                timer = rospy.Time
            self.graph = self.generate(yaml_parser.safe_load(tf2_frame_srv().frame_yaml), timer.now().to_sec())
            dotcode = self.dotcode = dotcode_factory.create_dot(self.graph)
        return dotcode

    def generate(self, data, timestamp: float):
        """The factory's graph of frames, ``data``, as :func:`parse` returns them.

        :param timestamp: of the recording, s
        """
        factory = self.dotcode_factory
        graph = factory.get_graph(**self._look)
        if not data:
            factory.add_node_to_graph(graph, "No tf data received")
            return graph
        legend = f"Recorded at time: {timestamp}"
        factory.add_node_to_graph(graph, legend)
        for name in sorted({*map(str, data), *(str(values["parent"]) for values in data.values())}):
            factory.add_node_to_graph(graph, name, shape="ellipse")
            if name not in data:
                factory.add_edge_to_graph(graph, legend, name, style="invis")
        for name, values in sorted(data.items()):
            factory.add_edge_to_graph(graph, str(values["parent"]), str(name), label=_label(values, "\\n"))
        return graph

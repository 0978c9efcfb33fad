"""The frames that a tf buffer knows, as DOT text. No ROS and no Qt in here."""
from __future__ import annotations

from typing import Any, Dict

import yaml
from rqt_graph.dotcode import quoted

_FIELDS = (("Broadcaster", "broadcaster"), ("Average rate", "rate"), ("Buffer length", "buffer_length"),
           ("Most recent transform", "most_recent_transform"), ("Oldest transform", "oldest_transform"))


class FramesError(Exception):
    """What the buffer says of its frames cannot be read; one line."""


def parse(text: str) -> Dict[str, Dict[str, Any]]:
    """Frame -> what is known of it, from the YAML of ``tf2_frames``; empty when there are none.

    :raises FramesError: the names of frames are such that the text is no YAML.
    """
    try:
        frames = yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise FramesError(f"a frame has a name that cannot be listed ({str(error).splitlines()[0]})") from error
    return {str(name): values for name, values in frames.items()} if isinstance(frames, dict) else {}


def generate_dot(frames: Dict[str, Dict[str, Any]], time: float) -> str:
    """DOT text of the tree.

    :param time: of the recording, s
    """
    if not frames:
        return 'digraph graphname { "none" [label="No tf data received" shape=box]; }\n'
    lines = ["digraph graphname {", "rankdir=TB; ranksep=0.2;"]
    names = set(frames) | {str(values["parent"]) for values in frames.values()}
    lines += [f"{quoted('f_' + name)} [label={quoted(name)} shape=ellipse tooltip={quoted(name)}];" for name in sorted(names)]
    for name, values in sorted(frames.items()):
        label = "\n".join(f"{title}: {values.get(key)}" for title, key in _FIELDS)
        lines.append(f"{quoted('f_' + str(values['parent']))} -> {quoted('f_' + name)} [label={quoted(label)}];")
    lines.append(f"recorded [label={quoted(f'Recorded at time: {time}')} shape=box];")
    roots = sorted(names - set(frames)) or sorted(names)[:1]
    lines += [f"recorded -> {quoted('f_' + root)} [style=invis];" for root in roots]
    return "\n".join([*lines, "}", ""])

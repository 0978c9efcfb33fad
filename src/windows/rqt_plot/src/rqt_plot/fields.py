"""Paths into messages, as ``/odom/pose/pose/position/x`` or ``/joint_states/position[0]``. Needs message classes, but no node.

A *field path* is what follows the topic: steps separated by ``/``; an index is ``[0]`` behind a step, or a step of digits.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from typing import NamedTuple

import genpy
import roslib.message
import roslib.msgs
from qt_gui.errors import WindowError

Step = str | int

_FLOATS = ("float32", "float64")
_INTEGERS = ("int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "byte", "char")
_TIMES = ("time", "duration")
_STEP = re.compile(r"([A-Za-z]\w*)((?:\[\d+\])*)$")


class FieldError(WindowError, ValueError):
    """A path that leads to no number; the text says why, in one line."""


class Slot(NamedTuple):
    """What a field path leads to."""

    type: str  #: base type without brackets, as ``float64`` or ``geometry_msgs/Point``
    is_array: bool
    length: int | None  #: of a fixed-size array

    @property
    def kind(self) -> str:
        """``numeric``, ``boolean``, ``time``, ``text`` or ``message``."""
        if self.type in _FLOATS or self.type in _INTEGERS:
            return "numeric"
        return {"bool": "boolean", "string": "text"}.get(self.type, "time" if self.type in _TIMES else "message")


def parse_path(path: str) -> list[Step]:
    """Steps of a field path: names and indices.

    :raises FieldError: a step that is neither.
    """
    steps: list[Step] = []
    for part in filter(None, path.split("/")):
        match = _STEP.match(part)
        if part.isdigit():
            steps.append(int(part))
        elif match:
            steps.append(match.group(1))
            steps += [int(index) for index in re.findall(r"\d+", match.group(2))]
        else:
            raise FieldError(f"'{part[:60]}' is no field; write name or name[index]")
    return steps


def slot_of(message_class, path: str) -> Slot:
    """Where ``path`` leads in messages of the class ``message_class``.

    :raises FieldError: nowhere; the text names the fields that there are.
    """
    slot = Slot(message_class._type, False, None)
    for step in parse_path(path):
        if isinstance(step, int):
            if not slot.is_array:
                raise FieldError(f"{slot.type} is no array: [{step}] means nothing in {path}")
            if slot.length is not None and step >= slot.length:
                raise FieldError(f"index {step} is outside the {slot.length} elements in {path}")
            slot = Slot(slot.type, False, None)
            continue
        owner = roslib.message.get_message_class(slot.type) if "/" in slot.type and not slot.is_array else None
        if owner is None:
            reason = f"is an array: say {slot.type}[index]" if slot.is_array else "has no fields"
            raise FieldError(f"no field {step}: what is before it in {path} {reason}")
        if step not in owner.__slots__:
            raise FieldError(f"no field {step} in {owner._type}; it has {', '.join(owner.__slots__)}")
        base, is_array, length = roslib.msgs.parse_type(owner._slot_types[owner.__slots__.index(step)])
        slot = Slot("std_msgs/Header" if base == "Header" else base, is_array, length)
    return slot


def number_paths(message_class, path: str = "") -> tuple[list[str], str]:
    """Paths below ``path`` in ``message_class`` that are plotted when it is named, and a sentence on what is there.

    A number is itself; a fixed-size array each of its elements; a message its numbers at the top level, or the Bool of
    ``std_msgs/Bool``. An array of variable size gives nothing without an index.
    """
    try:
        slot = slot_of(message_class, path)
    except FieldError as error:
        return [], str(error)
    if slot.kind in ("numeric", "boolean", "time"):
        kind = f"{slot.kind} array" if slot.is_array else slot.kind
        if not slot.is_array:
            return [path], f"is {kind}"
        if slot.length is None:
            return [], f"is a variable-size {kind}: give an index, as {path}[0]"
        return [f"{path}[{i}]" for i in range(slot.length)], f"is a fixed-size {kind}"
    if slot.kind == "text" or slot.is_array:
        return [], f"is not numeric but {slot.type}{'[]: give an index' if slot.is_array else ''}"
    owner = roslib.message.get_message_class(slot.type)
    if owner is None:
        return [], f"has the type {slot.type}, which is not built here"
    plain = [
        name
        for name, kind in zip(owner.__slots__, owner._slot_types)
        if kind in _FLOATS or kind in _INTEGERS or (kind == "bool" and len(owner.__slots__) == 1)
    ]
    return [f"{path}/{name}" for name in plain], f"has {len(plain) or 'no'} plottable fields"


def getter(path: str) -> Callable[[object], float]:
    """A function that takes the number at ``path`` out of a message; times and durations in seconds.

    It raises IndexError where an array is shorter, AttributeError or TypeError where there is no number.
    """
    expression = "m"
    for step in parse_path(path):
        expression += f"[{step}]" if isinstance(step, int) else f".{step}"
    # Compiled, for it runs once per curve and message; the steps are names and whole numbers by parse_path.
    read = eval(f"lambda m: {expression}", {"__builtins__": {}})

    def number(message) -> float:
        value = read(message)
        if type(value) is float:
            return value
        if isinstance(value, bytes):  # an element of char[] or uint8[] would be an int; the whole of it is no number
            raise TypeError(f"{path} is an array")
        return value.to_sec() if isinstance(value, genpy.TVal) else float(value)

    return number


def split_topic(name: str, types: dict[str, str]) -> tuple[str | None, str]:
    """The topic that ``name`` begins with (the longest one known), and the field path behind it.

    :param types: topic -> type of its messages
    :returns: (None, "") when no topic fits.
    """
    fitting = [topic for topic in types if name == topic or name.startswith((topic + "/", topic + "["))]
    topic = max(fitting, key=len, default=None)
    return (None, "") if topic is None else (topic, name[len(topic) :])


def expand(name: str, types: dict[str, str]) -> tuple[list[str] | None, str]:
    """Full names of the curves that ``name`` stands for, and a sentence for a tool tip.

    :param types: topic name -> message type, of the topics that there are.
    :returns: None instead of names while no such topic exists; an empty list when nothing in it can be plotted.
    """
    topic, path = split_topic(name, types)
    if topic is None:
        return None, f"topic {name} does not exist"
    message_class = roslib.message.get_message_class(types[topic]) if "/" in types[topic] else None
    if message_class is None:
        return [], f"type {types[topic]} of topic {topic} is unknown: build its package and source the workspace"
    paths, reason = number_paths(message_class, path)
    return [topic + found for found in paths], f"{name} {reason}" if paths else f"{name}: {reason}"


def split_arguments(arguments: Iterable[str]) -> list[str]:
    """Names from a command line: commas separate, ``/pose/x:y`` is short for ``/pose/x`` and ``/pose/y``.

    :raises FieldError: a colon without a topic and a field before it.
    """
    names: list[str] = []
    for part in (part for argument in arguments for part in argument.split(",") if part):
        first, *others = part.split(":")
        if others and "/" not in first:
            raise FieldError(f"{part} must contain a topic and field name")
        names += [first] + [f"{first[: first.rfind('/')]}/{other}" for other in others if other]
    return names

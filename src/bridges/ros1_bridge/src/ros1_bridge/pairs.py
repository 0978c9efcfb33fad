"""Types of both sides that belong together, with what translates them; each is looked for once, and what is missing is said once."""

from __future__ import annotations

import io
import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import roslib.message

from ros1_bridge.errors import MappingError
from ros1_bridge.line import PARTS
from ros1_bridge.link import Link
from ros1_bridge.types import Types, candidates, candidates_of_ros1, fields_of_ros1, fields_of_ros2
from ros1_bridge.wire import Pair


def bytes_of(message: Any) -> bytes:
    out = io.BytesIO()
    message.serialize(out)
    return out.getvalue()


def message_class(name: str, get: Callable[[str], Any] = roslib.message.get_message_class) -> Any:
    """What ``get``, roslib's function, finds by ``name``; None where no package of ROS 1 defines it."""
    try:
        return get(name)
    except (ValueError, ImportError, AttributeError):
        return None


def service_class(name: str) -> Any:
    return message_class(name, roslib.message.get_service_class)


def classes(form: str, name: str) -> dict[str, Any]:
    """Those of ROS 1 by the parts of ``name``, which is by ``form`` a "msg", "srv" or "action"; {} where no package defines it."""
    if form == "srv":
        kind = service_class(name)
        return {"Request": kind._request_class, "Response": kind._response_class} if kind is not None else {}
    kinds = {part: message_class(name + part) for part in PARTS[form]}
    return {} if None in kinds.values() else kinds


def types_of_ros1(kind: Any, name: str, found: Types | None = None) -> Types:
    """``kind``, a class called ``name``, and all that it consists of, added to ``found``."""
    found = {} if found is None else found
    found[name] = fields_of_ros1(kind.__slots__, kind._slot_types)
    for field in found[name]:
        if "/" in field.kind and field.kind not in found:
            inner = message_class(field.kind)
            if inner is not None:
                types_of_ros1(inner, field.kind, found)
    return found


@dataclass(frozen=True, eq=False)
class Match:
    """A type of ROS 1 and one of ROS 2, package/Name, that belong together. ``kinds`` and ``pairs`` are by part."""

    ros1: str
    ros2: str
    kinds: dict[str, Any]
    pairs: dict[str, Pair]

    def message(self, part: str, data: Any) -> Any:
        """ROS 1's message of the ``part`` that ``data``, bytes of ROS 2, are; one of zeros where ``data`` is None."""
        message = self.kinds[part]()
        if data is not None:
            message.deserialize(bytes(self.pairs[part].to_ros1(data)))
        return message

    def data(self, part: str, message: Any) -> bytearray:
        """The bytes of ROS 2 for ``message``, ROS 1's of the ``part``."""
        return self.pairs[part].to_ros2(bytes_of(message))


class Pairs:
    """:param describe: gives by name and form the fields of a type of ROS 2 and of all that it consists of, {} where it has none
    :param say: is told in one line what has no counterpart, once each
    """

    def __init__(self, describe: Callable[[str, str], dict[str, dict[str, str]]], say: Callable[[str], None]) -> None:
        self._describe, self._say = describe, say
        self._found: dict[tuple[str, str, str | None], Match | None] = {}
        self._told: set[str] = set()
        self._lock = threading.RLock()

    def find(self, form: str, of_ros1: str, of_ros2: str | None = None) -> Match | None:
        """The match of the types ``of_ros1`` and ``of_ros2`` (None: the one that it is there), by ``form`` "msg", "srv" or "action"; None
        where there is none, which has been said.
        """
        with self._lock:
            if (form, of_ros1, of_ros2) not in self._found:
                self._found[form, of_ros1, of_ros2] = self._look(form, of_ros1, of_ros2)
            return self._found[form, of_ros1, of_ros2]

    def counterpart(self, form: str, of_ros2: str) -> Match | None:
        """The match of ``of_ros2``, a type of ROS 2, by ``form`` "msg", "srv" or "action"; None as for :meth:`find`."""
        one = self.of_ros2(form, of_ros2)
        return self.find(form, one, of_ros2) if one is not None else None

    def of_ros2(self, form: str, of_ros2: str) -> str | None:
        """The type of ROS 1 that ``of_ros2`` is; ``form``: "msg", "srv" or "action"."""
        known = [one for one in candidates_of_ros1(of_ros2) if classes(form, one)]
        if not known:
            self.once(f"{of_ros2} of ROS 2 has no counterpart in ROS 1: what has this type is not bridged")
        return known[0] if known else None

    def once(self, line: str) -> None:
        with self._lock:
            if line in self._told:
                return
            self._told.add(line)
        self._say(line)

    def _look(self, form: str, of_ros1: str, of_ros2: str | None) -> Match | None:
        reasons: list[str] = []
        allowed = candidates(of_ros1)
        for two in [of_ros2] if of_ros2 is not None else allowed:
            try:
                if two not in allowed:
                    raise MappingError(f"{of_ros1} of ROS 1 and {two} of ROS 2 are no pair")
                # Perhaps found before, with its type of ROS 2 or without: a bridge stays as it is.
                found = self._found.get((form, of_ros1, two)) or self._make(form, of_ros1, two)
            except MappingError as error:
                reasons.append(str(error))
                continue
            if found is not None:
                self._found[form, of_ros1, two] = found
                return found
        self.once(f"{of_ros1} has no counterpart in ROS 2: what has this type is not bridged{''.join(': ' + one for one in reasons[:1])}")
        return None

    def _make(self, form: str, one: str, two: str) -> Match | None:
        kinds, described = classes(form, one), self._describe(two, form)
        if not kinds or not described:
            return None
        types = {name: fields_of_ros2(fields) for name, fields in described.items()}
        pairs = {part: Pair(one + part, types_of_ros1(kind, one + part), two + part, types) for part, kind in kinds.items()}
        return Match(one, two, kinds, pairs)


class Bridged:
    """What one side offers by ``name`` with the types ``match``, made known to the other.

    The other side is told nothing before ``open()``: it may answer at once, and then this must be where the answer is handed on.
    """

    def __init__(self, name: str, match: Match, link: Link, pairs: Pairs) -> None:
        self.name, self.match, self._link, self._pairs = name, match, link, pairs

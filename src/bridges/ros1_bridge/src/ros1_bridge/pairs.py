"""Types of both sides that belong together, with what translates them; each is looked for once, and what is missing is said once."""

from __future__ import annotations

import io
import threading
from collections.abc import Callable
from typing import Any

import roslib.message

from ros1_bridge.errors import MappingError
from ros1_bridge.types import Types, candidates, candidates_of_ros1, fields_of_ros1, fields_of_ros2
from ros1_bridge.wire import Pair


def bytes_of(message: Any) -> bytes:
    out = io.BytesIO()
    message.serialize(out)
    return out.getvalue()


def message_class(name: str) -> Any:
    """None where no package of ROS 1 defines it."""
    try:
        return roslib.message.get_message_class(name)
    except (ValueError, ImportError, AttributeError):
        return None


def service_class(name: str) -> Any:
    try:
        return roslib.message.get_service_class(name)
    except (ValueError, ImportError, AttributeError):
        return None


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


class Pairs:
    """:param describe: fields of a type of ROS 2 (:meth:`ros1_bridge.link.Link.describe`)
    :param say: is told in one line what has no counterpart, once each
    """

    def __init__(self, describe: Callable[[str, str], dict[str, dict[str, str]]], say: Callable[[str], None]) -> None:
        self._describe, self._say = describe, say
        self._found: dict[tuple[str, ...], Any] = {}
        self._told: set[str] = set()
        self._lock = threading.RLock()

    def message(self, of_ros1: str, of_ros2: str | None = None) -> Pair | None:
        """The pair of the type ``of_ros1`` and ``of_ros2`` (None: the one that it is there); None where there is none, which has been
        said.
        """
        return self._one(("msg", of_ros1, of_ros2 or ""), of_ros1, of_ros2, lambda two: self._message(of_ros1, two))

    def service(self, of_ros1: str, of_ros2: str | None = None) -> tuple[str, Pair, Pair] | None:
        """The type of ROS 2 for ``of_ros1``, request and response; ``of_ros2`` as for :meth:`message`."""
        return self._one(("srv", of_ros1, of_ros2 or ""), of_ros1, of_ros2, lambda two: self._service(of_ros1, two))

    def action(self, of_ros1: str, of_ros2: str | None = None) -> tuple[str, Pair, Pair, Pair] | None:
        """The type of ROS 2 for ``of_ros1``, goal, result and feedback; ``of_ros2`` as for :meth:`message`."""
        return self._one(("action", of_ros1, of_ros2 or ""), of_ros1, of_ros2, lambda two: self._action(of_ros1, two))

    def of_ros2(self, form: str, of_ros2: str) -> str | None:
        """The type of ROS 1 that ``of_ros2`` is; ``form``: "msg", "srv" or "action"."""
        tests = {"msg": message_class, "srv": service_class, "action": lambda name: message_class(name + "Goal")}
        known = [one for one in candidates_of_ros1(of_ros2) if tests[form](one) is not None]
        if not known:
            self.once(f"{of_ros2} of ROS 2 has no counterpart in ROS 1: what has this type is not bridged")
        return known[0] if known else None

    def once(self, line: str) -> None:
        with self._lock:
            if line in self._told:
                return
            self._told.add(line)
        self._say(line)

    def _one(self, key: tuple[str, ...], of_ros1: str, of_ros2: str | None, make: Callable[[str], Any]) -> Any:
        with self._lock:
            if key not in self._found:
                self._found[key] = None
                reasons: list[str] = []
                allowed = candidates(of_ros1)
                for two in [of_ros2] if of_ros2 is not None else allowed:
                    same = (key[0], of_ros1, two)
                    if self._found.get(same) is not None:  # looked for before, with its type of ROS 2 or without: a bridge stays as it is
                        self._found[key] = self._found[same]
                        break
                    try:
                        if two not in allowed:
                            raise MappingError(f"{of_ros1} of ROS 1 and {two} of ROS 2 are no pair")
                        self._found[key] = make(two)
                    except MappingError as error:
                        reasons.append(str(error))
                    if self._found[key] is not None:
                        self._found[same] = self._found[key]
                        break
                else:
                    reason = f": {reasons[0]}" if reasons else ""
                    self.once(f"{of_ros1} has no counterpart in ROS 2: what has this type is not bridged{reason}")
            return self._found[key]

    def _message(self, one: str, two: str) -> Pair | None:
        kind, described = message_class(one), self._describe(two, "msg")
        return _pair(kind, one, described, two) if kind is not None and described else None

    def _service(self, one: str, two: str) -> tuple[str, Pair, Pair] | None:
        kind, described = service_class(one), self._describe(two, "srv")
        if kind is None or not described:
            return None
        request = _pair(kind._request_class, one + "Request", described, two + "_Request")
        return two, request, _pair(kind._response_class, one + "Response", described, two + "_Response")

    def _action(self, one: str, two: str) -> tuple[str, Pair, Pair, Pair] | None:
        described = self._describe(two, "action")
        kinds = [message_class(one + part) for part in ("Goal", "Result", "Feedback")]
        if None in kinds or not described:
            return None
        parts = zip(kinds, ("Goal", "Result", "Feedback"))
        goal, result, feedback = [_pair(kind, one + part, described, f"{two}_{part}") for kind, part in parts]
        return two, goal, result, feedback


def _pair(kind: Any, one: str, described: dict[str, dict[str, str]], two: str) -> Pair:
    return Pair(one, types_of_ros1(kind, one), two, {name: fields_of_ros2(types) for name, types in described.items()})

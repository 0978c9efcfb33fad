"""Upstream's options and parameters, and the whitelists of the launch file."""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ros1_bridge.errors import BridgeError

_LIVELINESS: dict[Any, int] = {"SYSTEM_DEFAULT": 0, "AUTOMATIC": 1, "MANUAL_BY_TOPIC": 3}


def _one_of(*names: str) -> tuple[Callable[[Any], Any], str]:
    return dict(zip(names, names)).__getitem__, " is {}, and may be " + " or ".join(names)


def _depth(value: Any) -> int:
    if not isinstance(value, int) or value < 1:
        raise ValueError
    return value


def _liveliness(value: Any) -> int:
    numbers = {**_LIVELINESS, **{number: number for number in _LIVELINESS.values()}}
    return numbers[value if isinstance(value, int) else str(value).upper().removeprefix("LIVELINESS_")]


_UNKNOWN: tuple[Callable[[Any], Any], str] = {}.__getitem__, ": {} is not known"
_SPAN: tuple[Callable[[Any], Any], str] = lambda value: int(value["secs"]) * 10**9 + int(value["nsecs"]), " needs secs and nsecs"
#: The words of qos: what makes of a value in upstream's form one for the other side, and what is said of a value that it cannot take.
_QUALITY = {
    "reliability": _one_of("best_effort", "reliable"),
    "durability": _one_of("transient_local", "volatile"),
    "history": _one_of("keep_all", "keep_last"),
    "depth": (_depth, _UNKNOWN[1]),
    "deadline": _SPAN,
    "lifespan": _SPAN,
    "liveliness_lease_duration": _SPAN,
    "liveliness": (_liveliness, " is {}, and may be " + ", ".join("LIVELINESS_" + name for name in _LIVELINESS)),
}


class SettingError(BridgeError):
    """A parameter that cannot be used, in one line."""


@dataclass(frozen=True)
class Options:
    """Of ``dynamic_bridge``."""

    all_1to2: bool = False
    all_2to1: bool = False
    print_pairs: bool = False
    introspection: bool = False
    topic_whitelist: tuple[str, ...] = (".*",)
    service_whitelist: tuple[str, ...] = (".*",)
    action_whitelist: tuple[str, ...] = (".*",)


def options(words: list[str], get: Callable[[str, Any], Any]) -> Options:
    """What ``words`` of the command line and the private parameters say.

    :param get: value of a private parameter, or a default
    :raises SettingError: a value cannot be used
    """
    parser = argparse.ArgumentParser(prog="dynamic_bridge", description="Bridge what both ROS 1 and ROS 2 know.")
    parser.add_argument("--bridge-all-topics", action="store_true", help="bridge all topics in both directions")
    parser.add_argument("--bridge-all-1to2-topics", action="store_true", help="bridge all ROS 1 topics to ROS 2")
    parser.add_argument("--bridge-all-2to1-topics", action="store_true", help="bridge all ROS 2 topics to ROS 1")
    parser.add_argument("--print-pairs", action="store_true", help="print the pairs of types and end")
    parser.add_argument("--show-introspection", action="store_true", help="print what each side sees")
    parser.add_argument("--multi-threads", action="store_true", help="taken for upstream's sake")
    read = parser.parse_args(words)
    lists = {name: patterns(name, get(name, [".*"])) for name in ("topic_whitelist", "service_whitelist", "action_whitelist")}
    return Options(
        read.bridge_all_topics or read.bridge_all_1to2_topics,
        read.bridge_all_topics or read.bridge_all_2to1_topics,
        read.print_pairs,
        read.show_introspection,
        **lists,
    )


def patterns(name: str, value: Any) -> tuple[str, ...]:
    """``value`` of the parameter ``name``, a regular expression or a list of them. :raises SettingError: it is something else"""
    words = [value] if isinstance(value, str) else value
    if not isinstance(words, (list, tuple)) or not all(isinstance(word, str) for word in words):
        raise SettingError(f"~{name} should be a list of texts, not {value!r}")
    for word in words:
        try:
            re.compile(word)
        except re.error as error:
            raise SettingError(f"~{name}: {word!r} is no regular expression: {error}") from None
    return tuple(words)


def allowed(name: str, words: tuple[str, ...]) -> bool:
    """Whether ``name`` fits one of ``words``, regular expressions, whole."""
    return any(re.fullmatch(word, name) for word in words)


def quality(words: Any, say: Callable[[str], None]) -> dict[str, Any]:
    """``qos`` of a topic, ``words``, in upstream's form; what is wrong in it is told to ``say`` and left out."""
    found: dict[str, Any] = {"depth": 10}
    if not isinstance(words, dict):
        say("qos should be a dictionary; it is left out")
        return found
    for name, value in words.items():
        read, wrong = _QUALITY.get(name, _UNKNOWN)
        try:
            found[name] = read(value)
        except (TypeError, KeyError, ValueError):
            say(f"qos: {name}{wrong.format(repr(value))}; it is left out")
    if words.get("history") == "keep_last" and "depth" not in words:
        say("qos: history: keep_last needs depth, too; it is 10")
    return found


def entries(parameter: str, value: Any, key: str, say: Callable[[str], None]) -> list[dict[str, Any]]:
    """Entries of ``value``, that of ``topics``, ``services_1_to_2`` or ``services_2_to_1``, that can be used.

    :param parameter: its name, for messages. :param key: what an entry names, "topic" or "service". :param say: is told what is wrong
    """
    if not isinstance(value, list):
        say(f"The parameter '{parameter}' either doesn't exist or isn't an array")
        return []
    found = []
    for number, one in enumerate(value):
        if not isinstance(one, dict) or not isinstance(one.get(key), str) or not isinstance(one.get("type"), str):
            say(f"{parameter}[{number}] needs '{key}' and 'type', both texts; it is left out")
            continue
        kind = f"{one['package']}/{one['type']}" if one.get("package") else one["type"]
        package, _, rest = kind.partition("/")
        if not package or not rest:
            say(f"{parameter}[{number}]: the type '{kind}' should be package/Name or package/{'msg' if key == 'topic' else 'srv'}/Name")
            continue
        queue = one.get("queue_size", 100)
        found.append(
            {**one, "type": f"{package}/{rest.rpartition('/')[2]}", "queue_size": queue if isinstance(queue, int) and queue > 0 else 100}
        )
    return found

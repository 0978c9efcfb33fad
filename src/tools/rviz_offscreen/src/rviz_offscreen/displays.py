"""What RViz's displays say of themselves: the properties that its Displays panel shows. Runs in RViz's own process."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import rosgraph

_RVIZ = rosgraph.names.make_caller_id("rviz")  # relative topics are relative to this node's namespace


@dataclass(frozen=True)
class State:
    """An enabled display, or RViz's global status."""

    name: str
    level: str  # 'Ok', 'Warn' or 'Error'
    silent: bool = False  # it reports Ok though no message has come yet
    topics: tuple[str, ...] = ()  # resolved names; '' for one that is not set

    @property
    def drawn(self) -> bool:
        return self.level.lower() == "ok" and not self.silent

    @property
    def problem(self) -> str:
        return f"no message on {', '.join(self.topics)} yet" if self.silent else self.level


def _children(prop) -> dict[str, Any]:
    return {str(prop.childAt(number).getName()): prop.childAt(number) for number in range(prop.numChildren())}


def _status(children: dict[str, Any]) -> tuple[str, dict[str, str]]:
    """Level, and the lines below it."""
    for name, prop in children.items():
        if name.startswith(("Status: ", "Global Status: ")):
            return name.rpartition(": ")[2], {key: str(line.getValue()) for key, line in _children(prop).items()}
    return "Ok", {}


def _state(display) -> State:
    children = _children(display)
    level, lines = _status(children)
    topics = [str(prop.getValue()) for name, prop in children.items() if name.endswith("Topic")]
    silent = False
    if "Queue Size" in children:  # a display of messages with a frame: Ok as soon as it has subscribed
        if "Namespaces" in children:  # markers
            silent = not children["Namespaces"].numChildren()
        elif "Topic" in children:
            silent = lines.get("Topic") == "OK"  # later '5 messages received'
    return State(
        str(display.getName()), level, silent, tuple(rosgraph.names.resolve_name(topic, _RVIZ) if topic else "" for topic in topics)
    )


def _enabled(group) -> Iterator:
    for number in range(group.numDisplays()):
        display = group.getDisplayAt(number)
        if not display.getValue():
            continue
        inner = group.getGroupAt(number)
        if inner is None:
            yield display
        else:
            yield from _enabled(inner)


def states(manager) -> Iterator[State]:
    """The global status and each enabled display, also those in groups.

    :param manager: RViz's VisualizationManager.
    """
    root = manager.getRootDisplayGroup()
    yield State("Global Status", _status(_children(root))[0])
    yield from map(_state, _enabled(root))


@dataclass(frozen=True)
class Robot:
    """An enabled RobotModel: name of its description's parameter, and where RViz has its links, in the fixed frame."""

    parameter: str
    links: dict[str, tuple[tuple[float, ...], tuple[float, ...]]]  # name -> position (3,) m, orientation (4,) x y z w


def robots(manager) -> Iterator[Robot]:
    """Those that RViz shows."""

    def numbers(prop) -> tuple[float, ...]:
        return tuple(float(word) for word in str(prop.getValue()).split(";"))

    for display in _enabled(manager.getRootDisplayGroup()):
        children = _children(display)
        if "Robot Description" not in children or "Links" not in children:
            continue
        links = {name: _children(prop) for name, prop in _children(children["Links"]).items()}
        yield Robot(
            str(children["Robot Description"].getValue()),
            {
                name: (numbers(inner["Position"]), numbers(inner["Orientation"]))
                for name, inner in links.items()
                if "Position" in inner and "Orientation" in inner
            },
        )


def published_topics() -> frozenset:
    """Names of topics that somebody publishes, as the master knows them."""
    return frozenset(name for name, _ in rosgraph.Master(_RVIZ).getSystemState()[0])


def nobody_publishes(state: State, published: frozenset) -> bool:
    """True if no topic of the display in ``state`` is among ``published``. An image may be sent compressed only: a topic below its name.

    What RViz itself (1.14.25, Debian 13) publishes below an image's name, the clicks on it, is no image.
    """
    return bool(state.topics) and not any(
        topic and any(name == topic or name.startswith(topic + "/") and name != topic + "/mouse_click" for name in published)
        for topic in state.topics
    )

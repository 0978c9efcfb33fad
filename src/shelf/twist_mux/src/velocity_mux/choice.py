"""Who drives: sources and locks with priorities. No ROS in it; times are seconds of one clock."""

import math
from dataclasses import dataclass

from node_signals.parameters import is_number


@dataclass
class Input:
    """A topic that is listened to.

    ``timeout``: s without a message after which it counts as silent; 0 means never. ``priority``: 0 to 255.
    """

    name: str
    topic: str
    timeout: float
    priority: int
    stamp: float = -math.inf

    def silent(self, now: float) -> bool:
        """Whether too long passed at ``now`` (s) since its last message."""
        return self.timeout > 0 and not 0 <= now - self.stamp <= self.timeout  # below 0: the clock was set back


@dataclass
class Source(Input):
    """Velocity commands."""

    def masked(self, lock_priority: int, now: float) -> bool:
        """Whether it may not drive ``now`` (s): silent, or its priority is below ``lock_priority``."""
        return self.silent(now) or self.priority < lock_priority


@dataclass
class Lock(Input):
    """A Bool that stops all sources of lower priority while it is true, or when its publisher has fallen silent."""

    closed: bool = False

    def locked(self, now: float) -> bool:
        """Whether it stops others at ``now`` (s)."""
        return self.closed or self.silent(now)


def lock_priority(locks: list[Lock], now: float) -> int:
    """The highest priority among the ``locks`` that are closed ``now`` (s); 0 if none is."""
    return max([0, *(lock.priority for lock in locks if lock.locked(now))])


def chosen(sources: list[Source], locks: list[Lock], now: float) -> Source | None:
    """The one of ``sources`` that drives ``now`` (s): of those that no lock masks the one of highest priority, the first of equals.

    A source of priority 0 never drives, and one without a timeout counts as speaking from the start, as in twist_mux.

    :param locks: whose priorities mask sources while they are closed
    """
    lock = lock_priority(locks, now)
    free = [source for source in sources if source.priority > 0 and not source.masked(lock, now)]
    return max(free, key=lambda source: source.priority, default=None)


def read_inputs(value, kind, parameter: str) -> list:
    """Sources or locks from the list of a YAML file.

    :param value: list of {name, topic, timeout (s), priority (0 to 255)}
    :param kind: Source or Lock
    :param parameter: its name, for messages
    :raises ValueError: says which entry is wrong and what it must be
    """
    if not isinstance(value, list):
        raise ValueError(f"parameter {parameter} must be a list of entries with name, topic, timeout and priority, but is {value!r:.60}")
    inputs: dict[str, Input] = {}
    for index, entry in enumerate(value):
        made = _read_input(entry, kind, f"entry {index + 1} of parameter {parameter}")
        if made.name in inputs:
            raise ValueError(f"parameter {parameter} names {made.name!r:.60} twice")
        inputs[made.name] = made
    return list(inputs.values())


def _read_input(entry, kind, place: str) -> Input:
    if not isinstance(entry, dict):
        raise ValueError(f"{place} must have name, topic, timeout and priority, but is {entry!r:.60}")
    missing = [key for key in ("name", "topic", "timeout", "priority") if key not in entry]
    if missing:
        raise ValueError(f"{place} lacks {' and '.join(missing)}")
    name, topic, timeout, priority = (entry[key] for key in ("name", "topic", "timeout", "priority"))
    if not isinstance(topic, str) or not topic:
        raise ValueError(f"{place}: topic must be a name, but is {topic!r:.60}")
    if not is_number(timeout, least=0):
        raise ValueError(f"{place}: timeout must be seconds, 0 or more, but is {timeout!r:.60}")
    if type(priority) is not int:
        raise ValueError(f"{place}: priority must be a whole number from 0 to 255, but is {priority!r:.60}")
    return kind(str(name), topic, float(timeout), min(max(priority, 0), 255))

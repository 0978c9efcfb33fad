"""Several bag files as one: which messages there are, when, and their contents. No Qt in here."""

from __future__ import annotations

import os
import tempfile
import threading
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import genpy
import numpy as np
import rosbag
from qt_gui.errors import WindowError

Topics = str | Sequence[str] | None


class BagError(WindowError, ValueError):
    """A file that is not shown; one line that says why and what to do."""


class _Index(NamedTuple):
    """All messages of one topic in the order of their stamps."""

    stamps: np.ndarray  #: (n,) s
    nanoseconds: np.ndarray  #: (n,) int64
    entries: list[tuple[rosbag.Bag, Any]]


_EMPTY = _Index(np.empty(0), np.empty(0, np.int64), [])


def open_bag(name: str) -> rosbag.Bag:
    """An MCAP file of ROS 1 messages becomes a bag that is gone when it is closed.

    :raises BagError: a file that is no bag, cut short, or of a version that rosbag does not read
    """
    if name.endswith(".mcap"):
        return _open_mcap(name)
    try:
        return rosbag.Bag(name)
    except rosbag.ROSBagUnindexedException:
        raise BagError(f"{name} has no index, as after a crash: run 'rosbag reindex {name}'") from None
    except (rosbag.ROSBagException, OSError) as error:
        raise BagError(f"{name} cannot be read: {getattr(error, 'strerror', None) or error}") from None
    except Exception as error:  # a header that is damaged raises whatever its bytes lead to
        raise BagError(f"{name} is no bag, or damaged: {type(error).__name__}; 'rosbag check' tells more") from None


def _open_mcap(name: str) -> rosbag.Bag:
    from bag_tools import files
    from bag_tools.convert import convert

    with tempfile.TemporaryDirectory(prefix="rqt_bag_") as folder:
        try:
            convert(Path(name), Path(folder, "whole.bag"))
        except files.BagError as error:
            raise BagError(str(error)) from None
        return rosbag.Bag(str(Path(folder, "whole.bag")))  # it stays open when the folder goes


class Bags:
    """Bag files side by side. Look-ups may come from any thread; reading waits for :attr:`lock`."""

    def __init__(self):
        self.lock = threading.RLock()
        self.bags: list[rosbag.Bag] = []
        self._indexes: dict[str, _Index] = {}
        self._types: dict[str, str] = {}

    def add(self, bag: rosbag.Bag) -> None:
        """Take in an open bag."""
        found: dict[str, list[tuple[rosbag.Bag, Any]]] = {}
        for connection in bag._get_connections():
            self._types.setdefault(connection.topic, connection.datatype)
            entries = found.setdefault(connection.topic, [])
            entries += [(bag, entry) for entry in bag._connection_indexes.get(connection.id, ())]
        indexes = dict(self._indexes)
        for topic, entries in found.items():
            indexes[topic] = _merged(indexes.get(topic, _EMPTY), entries)
        self.bags.append(bag)
        self._indexes = indexes  # replaced as a whole: others may be reading

    def close(self) -> None:
        with self.lock:
            for bag in self.bags:
                bag.close()
            self.bags, self._indexes, self._types = [], {}, {}

    @property
    def topics(self) -> list[str]:
        return sorted(self._indexes)

    @property
    def file_size(self) -> int:
        """Bytes of all files."""
        return sum(os.path.getsize(bag.filename) for bag in self.bags if bag.filename and os.path.exists(bag.filename))

    def datatype(self, topic: str) -> str | None:
        return self._types.get(topic)

    def stamps(self, topic: str) -> np.ndarray:
        """(n,) s, ascending."""
        return self._indexes.get(topic, _EMPTY).stamps

    def span(self) -> tuple[genpy.Time, genpy.Time] | None:
        """First and last stamp; None without messages."""
        ends = [(int(index.nanoseconds[0]), int(index.nanoseconds[-1])) for index in self._indexes.values() if index.entries]
        if not ends:
            return None
        return _time(min(first for first, _ in ends)), _time(max(last for _, last in ends))

    def _chosen(self, topics: Topics) -> list[_Index]:
        names = self._indexes if topics is None else [topics] if isinstance(topics, str) else topics
        return [self._indexes[name] for name in names if name in self._indexes]

    def entries(self, topics: Topics, start, end) -> Iterator[tuple[rosbag.Bag, Any]]:
        """(bag, index entry) of ``topics`` with start <= stamp <= end (Times), in the order of their stamps."""
        parts, keys = [], []
        for index in self._chosen(topics):
            low = int(np.searchsorted(index.nanoseconds, start.to_nsec(), "left"))
            high = int(np.searchsorted(index.nanoseconds, end.to_nsec(), "right"))
            parts += index.entries[low:high]
            keys.append(index.nanoseconds[low:high])
        if len(keys) <= 1:
            return iter(parts)
        return (parts[i] for i in np.argsort(np.concatenate(keys), kind="stable"))

    def _neighbour(self, t, topics: Topics, after: bool):
        best = None
        for index in self._chosen(topics):
            at = int(np.searchsorted(index.nanoseconds, t.to_nsec(), "right")) - (not after)
            if 0 <= at < len(index.entries):
                stamp = int(index.nanoseconds[at])
                if best is None or (stamp < best[0] if after else stamp > best[0]):
                    best = stamp, index.entries[at]
        return best[1] if best else (None, None)

    def entry(self, t, topics: Topics = None):
        """(bag, entry) of the last message of ``topics`` (None: of all) at or before ``t``; (None, None) if there is none."""
        return self._neighbour(t, topics, False)

    def entry_after(self, t, topics: Topics = None):
        """(bag, entry) of the first message of ``topics`` (None: of all) after ``t``; (None, None) if there is none."""
        return self._neighbour(t, topics, True)

    def read(self, bag: rosbag.Bag, position, raw: bool = False):
        """(topic, message, stamp) at ``position``, that of an entry of ``bag``.

        :param raw: the message is rosbag's tuple with its bytes
        :raises BagError: bytes that are damaged, or a message whose definition makes no sense.
        """
        with self.lock:
            try:
                return bag._read_message(position, raw)
            except Exception as error:  # rosbag passes on whatever genpy and the decompression raise
                raise BagError(f"{bag.filename}: a message cannot be read: {type(error).__name__}: {str(error)[:80]}") from None


def _merged(index: _Index, more: list[tuple[rosbag.Bag, Any]]) -> _Index:
    entries = index.entries + more
    nanoseconds = np.concatenate((index.nanoseconds, np.array([entry.time.to_nsec() for _, entry in more], np.int64)))
    order = np.argsort(nanoseconds, kind="stable")
    nanoseconds = nanoseconds[order]
    return _Index(nanoseconds * 1e-9, nanoseconds, [entries[i] for i in order])


def _time(nanoseconds: int) -> genpy.Time:
    return genpy.Time(nanoseconds // 1_000_000_000, nanoseconds % 1_000_000_000)


def copy_region(bags: Bags, name: str, start, end, progress=lambda share: True) -> int:
    """Copy the messages of ``bags`` from ``start`` to ``end`` (Times) into a new bag file, ``name``.

    :param progress: called with 0..1 now and then; returns False to stop.
    :returns: how many.
    :raises BagError: it cannot be written.
    """
    entries = list(bags.entries(None, start, end))
    try:
        with rosbag.Bag(name, "w") as out:
            for count, (bag, entry) in enumerate(entries):
                topic, message, stamp = bags.read(bag, entry.position, raw=True)
                header = next((c.header for c in bag._get_connections(topic)), None)
                out.write(topic, message, stamp, raw=True, connection_header=header)
                if count % 500 == 0 and not progress(count / len(entries)):
                    return count
    except (OSError, rosbag.ROSBagException) as error:
        raise BagError(f"{name} cannot be written: {getattr(error, 'strerror', None) or error}") from None
    return len(entries)

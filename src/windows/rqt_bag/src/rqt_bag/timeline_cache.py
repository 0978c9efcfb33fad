"""Pictures or the like for a time line, loaded in another thread and kept while they are used."""

from __future__ import annotations

import bisect
import queue
import threading
from collections import OrderedDict
from collections.abc import Callable


class TimelineCache(threading.Thread):
    """Items by topic and stamp.

    :param loader: called with topic, stamp (s) and details; returns (stamp as a Time, item), or two None.
    :param listener: called with topic, stamp and item when one has been loaded. :param max_cache_size: items kept per topic.
    """

    def __init__(self, loader: Callable, listener: Callable | None = None, max_cache_size: int = 100):
        super().__init__(daemon=True)
        self.loader, self.listener, self.max_cache_size = loader, listener, max_cache_size
        self.lock = threading.RLock()
        self.items: dict[str, OrderedDict] = {}  # topic -> stamp -> item, the least used first
        self._stamps: dict[str, list] = {}  # topic -> the same stamps, ascending
        self._waiting: set = set()
        self.queue: queue.Queue = queue.Queue()
        self.stop_flag = False
        self.start()

    def run(self) -> None:
        while True:
            entry = self.queue.get()
            if self.stop_flag:
                return
            topic, stamp, threshold, details = entry
            if self.get_item(topic, stamp, threshold) is None:
                found, item = self.loader(topic, stamp, details)
                if item is not None:
                    self.cache_item(topic, found, item)
                    if self.listener:
                        self.listener(topic, found, item)
            with self.lock:
                self._waiting.discard((topic, stamp))

    def enqueue(self, entry) -> None:
        """Ask for an item: (topic, stamp in s, how far from it in s, details for the loader)."""
        with self.lock:
            if entry[:2] in self._waiting:
                return
            self._waiting.add(entry[:2])
        self.queue.put(entry)

    def cache_item(self, topic: str, t, item) -> None:
        """Keep ``item``, of ``topic``.

        :param t: its stamp, a Time
        """
        with self.lock:
            items, stamps = self.items.setdefault(topic, OrderedDict()), self._stamps.setdefault(topic, [])
            stamp = t.to_sec()
            if stamp not in items:
                bisect.insort(stamps, stamp)
            items[stamp] = item
            items.move_to_end(stamp)
            while len(items) > self.max_cache_size:
                oldest, _ = items.popitem(last=False)
                del stamps[bisect.bisect_left(stamps, oldest)]

    def get_item(self, topic: str, stamp: float, time_threshold: float):
        """The item of ``topic`` nearest to ``stamp`` (s), if it is not more than ``time_threshold`` s away; else None."""
        with self.lock:
            stamps = self._stamps.get(topic, [])
            at = bisect.bisect_left(stamps, stamp)
            near = min(stamps[max(0, at - 1) : at + 1], key=lambda other: abs(other - stamp), default=None)
            if near is None or abs(near - stamp) > time_threshold:
                return None
            self.items[topic].move_to_end(near)
            return self.items[topic][near]

    def stop(self) -> None:
        self.stop_flag = True
        self.queue.put(None)

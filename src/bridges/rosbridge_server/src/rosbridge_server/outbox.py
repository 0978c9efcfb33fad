"""What waits for a client to read it."""

from __future__ import annotations

import asyncio
import threading
from collections import deque
from collections.abc import Awaitable, Callable

Frame = str | bytes  # of text, of bytes

ROOM = 16 * 1024 * 1024  # bytes of messages of topics that wait; beyond, the oldest of the same topic goes
LIMIT = 128 * 1024 * 1024  # bytes of all that waits; a client that lets it grow so far is gone


class _Item:
    def __init__(self, frames: list[Frame], topic: str | None) -> None:
        self.frames, self.topic = frames, topic
        self.size = sum(map(len, frames))


class Outbox:
    """
    Frames of one client in their order; :meth:`put` never waits.

    :param loop: whose thread writes
    :param write: of one frame; done when the client's computer has taken it
    :param overflow: is called, once, when a client reads nothing any more
    :param delay: s between frames
    """

    def __init__(
        self, loop: asyncio.AbstractEventLoop, write: Callable[[Frame], Awaitable[None]], overflow: Callable[[], object], delay: float
    ) -> None:
        self._loop, self._write, self._overflow, self.delay = loop, write, overflow, delay
        self._lock = threading.Lock()
        self._items: deque[_Item] = deque()
        self._by_topic: dict[str, deque[_Item]] = {}
        self._size = 0
        self._running = self.closed = False
        self._empty = threading.Event()
        self._empty.set()

    def put(self, frames: list[Frame], topic: str | None = None) -> int:
        """Have ``frames`` written after those that wait.

        :param topic: whose message it is; None: an answer, which always goes out
        :return: how many older messages of the topic went
        """
        item, dropped = _Item(frames, topic), 0
        with self._lock:
            if self.closed:
                return 0
            if topic is not None:
                older = self._by_topic.setdefault(topic, deque())
                while older and self._size + item.size > ROOM:
                    old = older.popleft()
                    self._size -= old.size
                    old.frames = []
                    dropped += 1
                older.append(item)
            self._size += item.size
            self._items.append(item)
            self._empty.clear()
            full = self._size > LIMIT
            start, self._running = not self._running, True
        if full:
            self.close()
            self._overflow()
        elif start:
            self._loop.call_soon_threadsafe(lambda: self._loop.create_task(self._drain()))
        return dropped

    def wait_until_empty(self, seconds: float) -> bool:
        """Wait up to ``seconds``; whether it is empty. Not from the loop's thread."""
        return self._empty.wait(seconds)

    def close(self) -> None:
        with self._lock:
            self.closed = True
            self._items.clear()
            self._by_topic.clear()
            self._size = 0
            self._empty.set()

    def _next(self) -> _Item | None:
        with self._lock:
            if not self._items:
                self._running = False
                self._empty.set()
                return None
            item = self._items.popleft()
            if item.topic is not None and item.frames:
                self._by_topic[item.topic].popleft()
            self._size -= item.size if item.frames else 0
            return item

    async def _drain(self) -> None:
        while True:
            item = self._next()
            if item is None:
                return
            for frame in item.frames:
                try:
                    await self._write(frame)
                except Exception:  # the client is gone; the websocket says so by itself
                    self.close()
                    return
                if self.delay:
                    await asyncio.sleep(self.delay)

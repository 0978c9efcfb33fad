"""Messages that wait for something that comes later, such as the transform of their moment: what tf2's MessageFilter is in C++.

::

    held = Held(5, ready=lambda cloud: buffer.can_transform(...), take=work, dropped=complain)
    held.add(cloud)     # from the subscriber
    held.look()         # something new has come: who is ready now?

A message that is ready is taken at once, in a thread of its own; the others wait, and where more wait than there may be, the oldest
goes. Knows no ROS.
"""

from __future__ import annotations

import sys
import threading
from collections import deque
from collections.abc import Callable
from typing import Any


class Held:
    """At most ``size`` waiting messages.

    :param size: how many may wait.
    :param ready: whether a message can be worked on now.
    :param take: works on it; what it raises goes to the thread's excepthook, and the next message has its turn.
    :param dropped: is told of a message that went without having been ready.
    """

    def __init__(self, size: int, ready: Callable[[Any], bool], take: Callable[[Any], None], dropped: Callable[[Any], None]):
        self._ready, self._take, self._dropped = ready, take, dropped
        self._size = max(size, 1)
        self._waiting: deque[Any] = deque()
        self._changed = threading.Condition()
        self._news = False
        self._closed = False
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def add(self, message: Any) -> None:
        """Hold ``message``, whose turn comes when it is ready."""
        gone = []
        with self._changed:
            self._waiting.append(message)
            while len(self._waiting) > self._size:
                gone.append(self._waiting.popleft())
            self._news = True
            self._changed.notify()
        for one in gone:
            self._dropped(one)

    def look(self) -> None:
        """Something has come that messages may wait for."""
        with self._changed:
            self._news = True
            self._changed.notify()

    def clear(self) -> None:
        """Forget what waits."""
        with self._changed:
            self._waiting.clear()

    def close(self) -> None:
        """End the thread, and what waits with it."""
        with self._changed:
            self._closed = True
            self._waiting.clear()
            self._changed.notify()

    def _run(self) -> None:
        while not self._closed:
            with self._changed:
                self._changed.wait_for(lambda: self._news or self._closed)
                self._news = False
                candidates = list(self._waiting)
            for message in candidates:
                self._try(message)

    def _try(self, message: Any) -> None:
        try:
            if self._ready(message) and self._claim(message):
                self._take(message)
        except Exception:  # noqa: BLE001  of this message alone
            self._claim(message)
            threading.excepthook(threading.ExceptHookArgs((*sys.exc_info(), threading.current_thread())))

    def _claim(self, message: Any) -> bool:
        """Whether ``message`` still waits; it does no longer."""
        with self._changed:
            for i, other in enumerate(self._waiting):
                if other is message:
                    del self._waiting[i]
                    return True
        return False

"""Lock-step as far as the subscribers: the simulation goes on when they have what it published.

rospy gives each subscriber a queue as long as the publisher said, often of one message, and drops the oldest when that is full. A
simulation that waits for its cameras but not for those who look at them loses pictures on the way. Here no queue drops anything,
no step begins while one is not empty, and a request for steps ends when the subscribers' machines have all of it. What a subscriber
drops in a queue of its own cannot be known here. One that takes nothing at all for half a minute is not waited for until it reads on:
a node that hangs must not hold the others' world for ever.
"""

from __future__ import annotations

import fcntl
import struct
import termios
import threading
import time
from collections.abc import Iterator
from typing import Any

import realtime_tools.prompt
import rospy
import rospy.topics
from rospy.impl.tcpros_pubsub import QueuedConnection

_TOLD_AFTER, _TOLD_AGAIN = 5.0, 60.0  # wall s that one subscriber held the simulation up
_HANGS_AFTER = 30.0  # wall s without a byte taken


class Delivery:
    """What has been published and not yet been taken.

    :param left_out: topics of which nothing is waited for: the log, the window's streams
    """

    def __init__(self, left_out: set[str]):
        self._left_out = left_out
        self._busy: set[_Kept] = set()
        self._changed = threading.Condition()
        self._waited: dict[_Kept, float] = {}
        self._left: tuple[int, float] = (0, 0.0)  # bytes that were not received when it was last looked, and since when that is so

    def install(self) -> None:
        """From now on every connection to a subscriber is kept account of; for the start of the process."""

        def connect(connection: Any, queue_size: int) -> Any:
            return QueuedConnection(connection, queue_size) if connection.name in self._left_out else _Kept(self, connection)

        for module in (rospy.topics, realtime_tools.prompt):
            vars(module)["QueuedConnection"] = connect

    @property
    def pending(self) -> bool:
        """Something waits to be sent. Asked before every step."""
        return bool(self._busy)

    def wait(self, seconds: float) -> None:
        """Until nothing waits to be sent, at most ``seconds`` of wall time; who holds the simulation up for long is told in the log."""
        began = time.monotonic()
        with self._changed:
            if self._changed.wait_for(lambda: not self._busy, seconds):
                return
            slow = list(self._busy)
        for kept in slow:
            if kept.done:  # it was closed while something was published
                self._closed(kept)
                continue
            if kept.hangs():
                with self._changed:
                    kept.given_up = True
                    self._busy.discard(kept)
                rospy.logwarn(
                    "lock-step: %s has taken nothing of %s for %.0f s and is not waited for any more; it misses what is "
                    "published until it reads on",
                    kept.who,
                    kept.name,
                    _HANGS_AFTER,
                )
                continue
            before = self._waited.get(kept, 0.0)
            now = self._waited[kept] = before + time.monotonic() - began
            if before < _TOLD_AFTER <= now or int(before / _TOLD_AGAIN) != int(now / _TOLD_AGAIN):
                rospy.logwarn(
                    "lock-step: the simulation stood still for %.0f s by now because %s takes %s more slowly than it is "
                    "published; end it, or have it ask for less",
                    now,
                    kept.who,
                    kept.name,
                )

    def taken(self) -> bool:
        """The systems on which the subscribers run have received all that was sent; asked again and again until it is so."""
        if self._busy:
            return False
        left, now = sum(map(_unreceived, self._sockets())), time.monotonic()
        if left != self._left[0]:
            self._left = left, now
        return not left or now - self._left[1] > _HANGS_AFTER

    def _sockets(self) -> Iterator[Any]:
        for publisher in list(rospy.topics.get_topic_manager().pubs.values()):
            if publisher.resolved_name not in self._left_out:
                for connection in publisher.connections or ():
                    if not getattr(connection, "given_up", False):
                        yield connection.socket

    def _begun(self, kept: _Kept) -> None:
        with self._changed:
            if not kept.count:
                kept.moved = (0, 0), time.monotonic()
            kept.count += 1
            if not kept.given_up:
                self._busy.add(kept)

    def _ended(self, kept: _Kept, count: int, dropped: bool = False) -> None:
        with self._changed:
            kept.count -= count
            if kept.given_up and not dropped:  # it reads on
                kept.given_up = False
                self._busy.add(kept)
            if kept.count <= 0:
                self._busy.discard(kept)
                self._changed.notify_all()

    def _closed(self, kept: _Kept) -> None:
        with self._changed:
            self._busy.discard(kept)
            self._waited.pop(kept, None)
            self._changed.notify_all()


class _Kept(QueuedConnection):
    """A connection to a subscriber whose queue has no end; how much is in it, the :class:`Delivery` knows."""

    _queue: list[bytes]  # of rospy's class

    def __init__(self, delivery: Delivery, connection: Any):
        self._delivery = delivery
        self.count = 0
        self.given_up = False
        self.moved = (0, 0), 0.0  # what has got through, and since when no more has
        self.who = _caller(connection)
        super().__init__(connection, 0)  # starts _run

    def write_data(self, data: bytes) -> bool:
        if not self._connection.done:
            self._delivery._begun(self)
        if self.given_up:
            self._forget_the_oldest()
        return bool(super().write_data(data))

    def hangs(self) -> bool:
        """Nothing has got through for long. Asked while it is waited for."""
        now, through = time.monotonic(), (self.count, _unreceived(self._connection.socket))
        if through != self.moved[0]:
            self.moved = through, now
        return now - self.moved[1] > _HANGS_AFTER

    def _forget_the_oldest(self) -> None:
        with self._lock:
            dropped = len(self._queue)
            self._queue.clear()
        if dropped:
            self._delivery._ended(self, dropped, dropped=True)

    def _run(self) -> None:
        connection = self._connection
        while not connection.done:
            with self._lock:
                while not self._queue and not connection.done:
                    self._cond_data_available.wait()
                queue, self._queue = self._queue, []
            for data in queue:
                try:
                    connection.write_data(data)
                except Exception as error:  # raised by the next write_data, as rospy does it
                    with self._lock:
                        self._error = error
                self._delivery._ended(self, 1)
        self._delivery._closed(self)


def _caller(connection: Any) -> str:
    """``/node``, or what else is known of who is at the other end."""
    return str(getattr(connection, "endpoint_id", None) or "an unknown subscriber")


def _unreceived(socket: Any) -> int:
    """Bytes that the other end has not acknowledged; none of one that is closed."""
    try:
        return int(struct.unpack("i", fcntl.ioctl(socket.fileno(), termios.TIOCOUTQ, b"\0\0\0\0"))[0])
    except (AttributeError, OSError, ValueError):
        return 0

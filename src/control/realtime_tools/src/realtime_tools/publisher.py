"""A publisher for control loops, and the gate that makes it publish at a rate."""
from __future__ import annotations

import queue
import threading
from typing import Any

import rospy

_jobs: "queue.SimpleQueue[tuple]" = queue.SimpleQueue()
_start = threading.Lock()
_worker: "threading.Thread | None" = None


def _work() -> None:
    while True:
        publisher, message = _jobs.get()
        publisher._send(message)


def _ensure_worker() -> None:
    """One thread serves all publishers of the process: rospy queues per connection, so none holds up another."""
    global _worker
    with _start:
        if _worker is None or not _worker.is_alive():
            _worker = threading.Thread(target=_work, name="realtime_publisher", daemon=True)
            _worker.start()


class RealtimePublisher:
    """Serialises and sends in another thread; ``publish`` costs the loop about a microsecond and never waits.

    A message handed over belongs to the publisher until ``ready`` is true again: fill a fresh one, or reuse the same
    one only while ``ready``. Without subscribers nothing is serialised at all.

    :param nh: NodeHandle (anything with ``publisher(name, type, queue_size)``).
    :param topic: name relative to ``nh``.
    :param queue_size: per subscriber connection.
    """

    def __init__(self, nh: Any, topic: str, message_type: type, queue_size: int = 4):
        self._publisher = nh.publisher(topic, message_type, queue_size=queue_size)
        self._pending = False
        _ensure_worker()

    @property
    def ready(self) -> bool:
        """True when the last message has been handed to the connections."""
        return not self._pending

    @property
    def has_subscribers(self) -> bool:
        return bool(self._publisher.impl and self._publisher.impl.connections)

    def publish(self, message: Any) -> bool:
        """Send ``message`` unless the last one is still being sent. :return: False if it was not taken; try again."""
        if self._pending:
            return False
        implementation = self._publisher.impl
        if implementation is None or not implementation.connections:
            return True
        self._pending = True
        _jobs.put((self, message))
        return True

    def _send(self, message: Any) -> None:
        try:
            self._publisher.publish(message)
        except rospy.ROSException:  # unregistered or shut down between publish() and now: nobody is left to tell
            rospy.logdebug("publisher of %s is gone", self._publisher.name)
        except Exception as error:  # a wrong field type must not end the thread that serves every other topic
            rospy.logerr_throttle(5.0, f"message on {self._publisher.name} cannot be published: {error}")
        finally:
            self._pending = False


class RateGate:
    """Opens ``rate`` times a second, as every ros_control controller gates its topics.

    The next opening is counted from the last one that was due, so the mean rate is exact; after a stall the gate stays
    open every cycle until it has caught up. Like upstream's it opens strictly after the due time.

    :param rate: Hz; 0 or less never opens.
    """

    __slots__ = ("_period", "_start", "_count", "_next", "_jumped")

    #: s; keeps rounding of float times from deciding whether a cycle at the due time itself is late
    _TOLERANCE = 1e-6

    def __init__(self, rate: float, time: float = 0.0):
        self._period = 1.0 / rate if rate > 0.0 else float("inf")
        self.restart(time)

    def restart(self, time: float) -> None:
        """Count from ``time`` (s)."""
        self._start = time
        self._count = 0
        self._schedule()

    def _schedule(self) -> None:
        last = self._start + self._count * self._period if self._count else self._start
        self._next = last + self._period + self._TOLERANCE
        self._jumped = last - self._TOLERANCE

    def due(self, time: float) -> bool:
        """True if ``time`` (s) is past the next opening. Call ``passed`` once the message has really been taken.

        Time that goes backwards (a simulation was reset) starts the count anew.
        """
        if time > self._next:
            return True
        if time < self._jumped:
            self.restart(time)
        return False

    def passed(self) -> None:
        self._count += 1
        self._schedule()

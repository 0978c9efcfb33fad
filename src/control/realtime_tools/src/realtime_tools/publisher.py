"""A publisher for control loops, and the gate that makes it publish at a rate."""
from __future__ import annotations

from typing import Any

import rospy

from .prompt import make_prompt


class RealtimePublisher:
    """Serialises and sends at once; ``publish`` costs the loop some ten microseconds and never waits for a subscriber.

    A thread of its own would cost the loop more: in Python the two would take turns. Without subscribers nothing is
    serialised at all.

    :param nh: NodeHandle (anything with ``publisher(name, type, queue_size)``).
    :param topic: name relative to ``nh``.
    :param queue_size: per subscriber that has fallen behind.
    """

    def __init__(self, nh: Any, topic: str, message_type: type, queue_size: int = 4):
        self._publisher = make_prompt(nh.publisher(topic, message_type, queue_size=queue_size), queue_size)

    @property
    def has_subscribers(self) -> bool:
        return bool(self._publisher.impl and self._publisher.impl.connections)

    def publish(self, message: Any) -> None:
        """Send ``message``, which may be filled anew afterwards."""
        if not self.has_subscribers:
            return
        try:
            self._publisher.publish(message)
        except rospy.ROSException:  # unregistered or shut down meanwhile: nobody is left to tell
            rospy.logdebug("publisher of %s is gone", self._publisher.name)
        except Exception as error:  # a wrong field type must not abort the controller
            rospy.logerr_throttle(5.0, f"message on {self._publisher.name} cannot be published: {error}")


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

    def resume(self, time: float) -> None:
        """Go on at ``time`` (s) after a pause: the openings missed meanwhile are lost, the next one is in the first cycle.

        A pause shorter than a period changes nothing, so that the rate holds through a stop and a start.
        """
        if time > self._next:
            self.restart(max(time - 1.001 * self._period, 0.0))

    def _schedule(self) -> None:
        last = self._start + self._count * self._period if self._count else self._start
        self._next = last + self._period + self._TOLERANCE
        self._jumped = last - self._TOLERANCE

    def due(self, time: float) -> bool:
        """True, once per opening, if ``time`` (s) is past the next one.

        Time that goes backwards (a simulation was reset) starts the count anew.
        """
        if time > self._next:
            self._count += 1
            self._schedule()
            return True
        if time < self._jumped:
            self.restart(time)
        return False

"""Messages of bags onto topics again, in a thread of its own."""

from __future__ import annotations

import threading

import genpy
import rospy
from rosgraph_msgs.msg import Clock

from rqt_bag.bags import BagError, Bags

_MOST_BEHIND = 2000  # messages of one step: a jump of hours must not flood the topics


class Player:
    """Publishes the messages that a playhead passes.

    :param clock: publish the playhead's time on /clock, too. :param problem: takes a line; called in another thread.
    """

    def __init__(self, bags: Bags, clock: bool, problem=lambda text: None):
        self._bags, self._problem = bags, problem
        self._publishers: dict[str, rospy.Publisher | None] = {}
        self._clock = rospy.Publisher("/clock", Clock, queue_size=1) if clock else None
        self._wanted: tuple[genpy.Time, genpy.Time, bool] | None = None
        self._condition = threading.Condition()
        self._busy = self._over = False
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    @property
    def topics(self):
        """Names of the topics that are published."""
        return set(self._publishers)

    @property
    def busy(self) -> bool:
        """Whether messages passed are still to be published."""
        return self._busy or self._wanted is not None

    def start_publishing(self, topic: str) -> None:
        self._publishers.setdefault(topic, None)

    def stop_publishing(self, topic: str) -> None:
        publisher = self._publishers.pop(topic, None)
        if publisher is not None:
            publisher.unregister()

    def passed(self, begin, end, playing: bool) -> None:
        """The playhead went from ``begin`` to ``end``.

        :param playing: publish all that it passed, else only the last message of each topic, as after a jump.
        """
        if not self._publishers and self._clock is None:
            return
        with self._condition:
            if self._wanted is not None and playing and self._wanted[2]:
                begin = min(begin, self._wanted[0])  # a step that was not begun yet: both together
            self._wanted = begin, end, playing
            self._condition.notify()

    def close(self) -> None:
        with self._condition:
            self._over = True
            self._condition.notify()
        self._thread.join(5)
        for topic in list(self._publishers):
            self.stop_publishing(topic)
        if self._clock is not None:
            self._clock.unregister()

    def _run(self) -> None:
        while True:
            with self._condition:
                self._busy = False
                self._condition.wait_for(lambda: self._wanted is not None or self._over)
                if self._over or self._wanted is None:
                    return
                (begin, end, playing), self._wanted, self._busy = self._wanted, None, True
            self._publish(begin, end, playing)

    def _publish(self, begin, end, playing: bool) -> None:
        topics = list(self._publishers)
        if playing and begin < end:
            passed = list(self._bags.entries(topics, begin + genpy.Duration(0, 1), end))[-_MOST_BEHIND:]
        else:
            passed = [pair for pair in (self._bags.entry(end, topic) for topic in topics) if pair[1] is not None]
            passed.sort(key=lambda pair: pair[1].time)
        for bag, entry in passed:
            if self._over:
                return
            try:
                topic, message, stamp = self._bags.read(bag, entry.position)
                self._send(topic, message, stamp)
            except BagError as error:
                self._problem(str(error))
            except (rospy.ROSException, ValueError, genpy.MessageException) as error:
                self._problem(f"{topic} is not published: {error}")
                self.stop_publishing(topic)
        if self._clock is not None:
            self._clock.publish(Clock(end))

    def _send(self, topic: str, message, stamp) -> None:
        if self._clock is not None:
            self._clock.publish(Clock(stamp))
        if topic in self._publishers:
            publisher = self._publishers[topic]
            if publisher is None:
                publisher = self._publishers[topic] = rospy.Publisher(topic, type(message), queue_size=100)
            publisher.publish(message)

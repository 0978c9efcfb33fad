"""Where messages come from: topics, one subscription for all curves of a topic, or a bag file."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable

import rosbag
import roslib.message
import rospy
from qt_gui.errors import WindowError

from rqt_multiplot.sampling import Sampler


class BagError(WindowError, ValueError):
    """A bag that gives nothing; one line that says why."""


class Topics:
    """Hands messages of topics to samplers. Topics need not exist yet, and may be of any type that is built here."""

    def __init__(self):
        self._lock = threading.Lock()
        self._samplers: dict[str, list[Sampler]] = {}
        self._subscribers: dict[str, rospy.Subscriber] = {}

    def add(self, sampler: Sampler) -> None:
        """Begin to feed a sampler."""
        for topic in sampler.topics:
            with self._lock:
                samplers = self._samplers.setdefault(topic, [])
                if sampler not in samplers:
                    self._samplers[topic] = samplers + [sampler]  # a new list: another thread may go through the old one
                fresh = topic not in self._subscribers
            if fresh:
                queue_size = sampler.curve.subscriber_queue_size or None
                self._subscribers[topic] = rospy.Subscriber(
                    topic, rospy.AnyMsg, lambda raw, topic=topic: self._receive(topic, raw), queue_size=queue_size
                )

    def remove(self, sampler: Sampler) -> None:
        """Feed it no longer; the last sampler of a topic takes the subscription along."""
        for topic in sampler.topics:
            with self._lock:
                left = self._samplers[topic] = [other for other in self._samplers.get(topic, ()) if other is not sampler]
                subscriber = self._subscribers.pop(topic, None) if not left else None
            if subscriber is not None:
                subscriber.unregister()

    def close(self) -> None:
        with self._lock:
            subscribers, self._subscribers, self._samplers = list(self._subscribers.values()), {}, {}
        for subscriber in subscribers:
            subscriber.unregister()

    def _receive(self, topic: str, raw) -> None:
        samplers = self._samplers.get(topic, ())
        kind = raw._connection_header["type"]
        message_class = roslib.message.get_message_class(kind)
        if message_class is None:
            for sampler in samplers:
                sampler.problem = f"{topic} is of type {kind}, which is not built here: build it and source its workspace"
            return
        try:
            message = message_class().deserialize(raw._buff)
        except Exception as error:  # genpy raises many kinds for bytes that are cut short
            for sampler in samplers:
                sampler.problem = f"{topic}: broken message: {str(error)[:80]}"
            return
        now = rospy.get_time()
        for sampler in samplers:
            sampler.add(topic, message, now)


def read_bag(name: str, samplers: Iterable[Sampler], progress: Callable[[float], bool] = lambda share: True) -> tuple[int, list[str]]:
    """Feed ``samplers`` from the bag file ``name``; the time of receipt is that of recording.

    :param progress: called with 0..1 now and then; returns False to stop.
    :returns: number of messages read, topics that are wanted and not in the bag.
    :raises BagError: no bag, an old or broken one, or one with none of the topics.
    """
    by_topic: dict[str, list[Sampler]] = {}
    for sampler in samplers:
        for topic in sampler.topics:
            by_topic.setdefault(topic, []).append(sampler)
    if not by_topic:
        raise BagError(f"{name} is not read: no curve has a topic and fields yet; configure curves first")
    count = 0
    try:
        with rosbag.Bag(name) as bag:
            there = bag.get_type_and_topic_info().topics
            missing = sorted(set(by_topic) - set(there))
            if len(missing) == len(by_topic):
                raise BagError(f"{name} has none of {', '.join(missing)}; it has {', '.join(sorted(there)) or 'no messages'}")
            begin, end = bag.get_start_time(), bag.get_end_time()
            for topic, message, stamp in bag.read_messages(topics=list(by_topic)):
                for sampler in by_topic[topic]:
                    sampler.add(topic, message, stamp.to_sec())
                count += 1
                if count % 500 == 0 and not progress((stamp.to_sec() - begin) / ((end - begin) or 1.0)):
                    break
    except (OSError, rosbag.ROSBagException, rosbag.bag.ROSBagFormatException) as error:
        hint = "; run rosbag reindex on it" if isinstance(error, rosbag.ROSBagUnindexedException) else ""
        raise BagError(f"{name} cannot be read: {str(error) or type(error).__name__}{hint}") from None
    return count, missing

"""Messages of topics into a bag file, as they arrive."""

from __future__ import annotations

import threading
from collections.abc import Callable

import genpy.dynamic
import rosbag
import rosgraph
import roslib.message
import rospy

from rqt_bag.bags import BagError


class Recorder:
    """Records until :meth:`stop`.

    :param topics: names, or None for all that there are and that will come. :param recorded: called in other threads with
        topic, raw message and stamp of each message written.
    :raises BagError: the file cannot be written.
    """

    PERIOD = 1.0  # s, between looks for new topics

    def __init__(self, name: str, topics: list[str] | None = None, recorded: Callable = lambda topic, raw, stamp: None):
        try:
            self.bag = rosbag.Bag(name, "w")
        except (OSError, rosbag.ROSBagException) as error:
            raise BagError(f"{name} cannot be written: {getattr(error, 'strerror', None) or error}") from None
        self.name = name
        self.problem = ""
        self.counts: dict[str, int] = {}
        self._recorded = recorded
        self._lock = threading.Lock()
        self._subscribers: dict[str, rospy.Subscriber] = {}
        self._classes: dict[str, type | None] = {}
        self._over = threading.Event()
        for topic in topics or ():
            self._subscribe(topic)
        if topics is None:
            threading.Thread(target=self._look, daemon=True).start()

    def _look(self) -> None:
        while not self._over.is_set():
            try:
                for topic, _kind in rosgraph.Master("/rqt_bag").getPublishedTopics("/"):
                    if topic not in self._subscribers and not self._over.is_set():
                        self._subscribe(topic)
            except (rosgraph.MasterException, OSError):
                pass  # the master may come back
            self._over.wait(self.PERIOD)

    def _subscribe(self, topic: str) -> None:
        self._subscribers[topic] = rospy.Subscriber(topic, rospy.AnyMsg, lambda raw: self._write(topic, raw))

    def _write(self, topic: str, raw) -> None:
        header, stamp = raw._connection_header, rospy.Time.now()
        kind = header["type"]
        with self._lock:
            if self._over.is_set():
                return
            if kind not in self._classes:
                self._classes[kind] = _class_of(kind, header.get("message_definition", ""))
            if self._classes[kind] is None:
                self.problem = f"{topic} is not recorded: its type {kind} is not built here"
                return
            try:
                self.bag.write(topic, (kind, raw._buff, header["md5sum"], self._classes[kind]), stamp, raw=True, connection_header=header)
            except (OSError, ValueError, rosbag.ROSBagException) as error:
                self.problem = f"{self.name} cannot be written: {getattr(error, 'strerror', None) or error}"
                return
            self.counts[topic] = self.counts.get(topic, 0) + 1
        self._recorded(topic, raw, stamp)

    def stop(self) -> None:
        """Close the file; it can be read then."""
        self._over.set()
        for subscriber in list(self._subscribers.values()):
            subscriber.unregister()
        with self._lock:
            self.bag.close()


def _class_of(kind: str, definition: str) -> type | None:
    """The class of a type that is built here, else one made of the publisher's definition."""
    found = roslib.message.get_message_class(kind)
    if found is None and definition:
        try:
            found = genpy.dynamic.generate_dynamic(kind, definition).get(kind)
        except Exception:  # a definition that makes no sense raises many kinds
            return None
    return found

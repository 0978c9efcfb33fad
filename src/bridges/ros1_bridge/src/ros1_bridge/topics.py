"""Topics, one way each. Listening starts when somebody on the other side listens."""

from __future__ import annotations

import threading
from collections import deque
from typing import Any

import rospy

from ros1_bridge.errors import MappingError
from ros1_bridge.link import Link
from ros1_bridge.pairs import Bridged, Match, Pairs, bytes_of

Words = dict[str, Any]  # quality of service, or what is seen of a topic in ROS 2's graph
BUFFER = 16 * 1024 * 1024  # bytes that are read at once, of pictures and clouds
#: Types that sensors of ROS 2 publish as best effort.
SENSORS = {
    "sensor_msgs/" + name
    for name in ("CompressedImage", "FluidPressure", "Image", "Imu", "LaserScan", "MagneticField", "MultiEchoLaserScan", "NavSatFix")
    + ("PointCloud", "PointCloud2", "Range", "RelativeHumidity", "Temperature", "Illuminance", "CameraInfo")
}


def promised(topic: str, type_name: str) -> Words:
    """The quality of service of ``topic``, of ``type_name``, that has not been told one."""
    if topic in ("/tf", "/tf_static"):
        return {"depth": 100, **({"durability": "transient_local"} if topic == "/tf_static" else {})}
    return {"depth": 5, "reliability": "best_effort"} if type_name in SENSORS else {"depth": 10}


class ToRos2(Bridged):
    """A topic of ROS 1, published in ROS 2."""

    def __init__(self, name: str, match: Match, link: Link, pairs: Pairs, words: Words | None = None, queue: int = 100) -> None:
        """:param words: what a parameter says the quality of service is"""
        super().__init__(name, match, link, pairs)
        self._queue, self._told = queue, words is not None
        self.words = words or promised(name, match.ros1)
        self._lock = threading.Lock()
        self._subscriber: rospy.Subscriber | None = None

    def open(self) -> None:
        self._link.tell("advertise", self.name, self.match.ros2, self.words)

    def matched(self, count: int, _: Any = None) -> None:
        """:param count: who listens in ROS 2"""
        with self._lock:
            if count and self._subscriber is None:
                self._subscriber = rospy.Subscriber(
                    self.name, rospy.AnyMsg, self._take, queue_size=self._queue, buff_size=BUFFER, tcp_nodelay=True
                )
            elif not count and self._subscriber is not None:
                self._subscriber.unregister()
                self._subscriber = None

    def unequal(self, policy: str, words: Words, _: Any) -> None:
        """A subscriber asks for more of ``policy`` than is promised, which was ``words``: it is promised, unless a parameter says what
        is to be.
        """
        more = {"DURABILITY": ("durability", "transient_local"), "RELIABILITY": ("reliability", "reliable")}.get(policy)
        if self._told or more is None:
            self._pairs.once(f"{self.name}: a subscriber of ROS 2 asks for another {policy.lower()} than this topic's, and gets nothing")
        elif words == self.words:
            self._promise({**self.words, more[0]: more[1]})

    def close(self) -> None:
        self.matched(0)
        self._link.tell("forget", "publisher", self.name)

    def _promise(self, words: Words) -> None:
        self.words = words
        self.open()
        with self._lock:
            old, self._subscriber = self._subscriber, None
        if old is not None:  # what is latched comes once more
            old.unregister()

    def _take(self, message: rospy.AnyMsg) -> None:
        header = message._connection_header
        if header.get("callerid") == rospy.get_name():
            return  # what this bridge itself has brought from ROS 2
        if header.get("type") not in (self.match.ros1, "*"):
            self._pairs.once(
                f"{self.name}: {header.get('callerid')} publishes {header.get('type')}, not {self.match.ros1}; it is not bridged"
            )
            return
        if header.get("latching") == "1" and not self._told and self.words.get("durability") != "transient_local":
            self.words = {**self.words, "durability": "transient_local"}
            self.open()
        try:
            # rospy reads a topic once in a process: /clock comes as its own message
            data = message._buff if isinstance(message, rospy.AnyMsg) else bytes_of(message)
            self._link.tell("publish", self.name, data=self.match.pairs[""].to_ros2(data))
        except MappingError as error:
            self._pairs.once(f"{self.name}: a message of {header.get('callerid')} is not bridged: {error}")


def packed(kind: Any) -> Any:
    """A class that rospy publishes and receives as ``kind``, whose messages are their bytes."""

    class Packed(rospy.AnyMsg):
        _md5sum, _type, _has_header, _full_text = kind._md5sum, kind._type, False, kind._full_text
        _slot_types: list = []

        def serialize(self, buff: Any) -> None:
            buff.write(self._buff)

    return Packed


class ToRos1(Bridged, rospy.SubscribeListener):
    """A topic of ROS 2, published in ROS 1."""

    def __init__(
        self, name: str, match: Match, link: Link, pairs: Pairs, seen: Words, words: Words | None = None, queue: int = 100
    ) -> None:
        """:param words: what a parameter says the quality of service is"""
        super().__init__(name, match, link, pairs)
        self._queue, self._given = queue, words
        self.words = words or self.wanted(seen)
        self._latched = self.words.get("durability") == "transient_local"
        self._old: deque = deque(maxlen=100 if name == "/tf_static" else 1)
        self._listening, self._lock = False, threading.Lock()
        self._class = packed(match.kinds[""])
        self.publisher: Any = None

    def open(self) -> None:
        self.publisher = rospy.Publisher(self.name, self._class, self, queue_size=self._queue, latch=self._latched)
        if self._latched or self.publisher.get_num_connections():
            self._listen()

    def wanted(self, seen: Words) -> Words:
        """What all publishers in ROS 2 can give."""
        return {
            "depth": 100 if self.name in ("/tf", "/tf_static") else 10,
            **({"reliability": "best_effort"} if seen.get("best_effort") else {}),
            **({"durability": "transient_local"} if seen.get("latched") else {}),
        }

    def look(self, seen: Words) -> None:
        """Publishers have come or gone."""
        words = self._given or self.wanted(seen)
        if words != self.words:
            self.words = words
            if self._listening:
                self._link.tell("subscribe", self.name, self.match.ros2, words)

    def unequal(self, policy: str, _: Any) -> None:
        """A publisher of ROS 2 gives less of ``policy`` than is asked for."""
        self._pairs.once(f"{self.name}: a publisher of ROS 2 gives less {policy.lower()} than this topic's, and is not heard")

    def peer_subscribe(self, topic_name: str, topic_publish: Any, peer_publish: Any) -> None:
        """rospy tells of a subscriber to ``topic_name``: ``topic_publish`` and ``peer_publish`` send to all and to it."""
        if self.publisher is not None:  # a message may come at once
            self._listen()
        for message in list(self._old)[:-1] if self._latched else []:  # rospy itself gives the last
            peer_publish(message)

    def peer_unsubscribe(self, topic_name: str, num_peers: int) -> None:
        """rospy tells that a subscriber to ``topic_name`` has gone, and ``num_peers`` are left."""
        if not num_peers and not self._latched:
            with self._lock:
                self._listening = False
            self._link.tell("forget", "subscriber", self.name)

    def message(self, data: Any) -> None:
        try:
            message = self._class()
            message._buff = bytes(self.match.pairs[""].to_ros1(data))
        except MappingError as error:
            self._pairs.once(f"{self.name}: a message from ROS 2 is not bridged: {error}")
            return
        if self._latched:
            self._old.append(message)
        self.publisher.publish(message)

    def close(self) -> None:
        self._link.tell("forget", "subscriber", self.name)
        self.publisher.unregister()

    def _listen(self) -> None:
        with self._lock:
            if self._listening:
                return
            self._listening = True
        self._link.tell("subscribe", self.name, self.match.ros2, self.words)

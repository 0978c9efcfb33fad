"""Topics as channels: the bytes of their messages as they are, with their definition; and topics that a client publishes."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any

import foxglove
import roslib.message
import rospy

BUFFER = 16 * 1024 * 1024  # bytes that are read at once, of pictures and clouds


def schema(kind: Any, name: str) -> foxglove.Schema:
    """The definition of the message class ``kind``, called ``name``, as ros1msg."""
    return foxglove.Schema(name=name, encoding="ros1msg", data=kind._full_text.encode())


def now_ns() -> int:
    """Of the simulation where there is one; the wall's before its clock comes."""
    return int(rospy.Time.now().to_nsec()) or time.time_ns()


class Topic:
    """One channel; it listens to its topic while a client reads it."""

    def __init__(self, name: str, type_name: str, kind: Any, context: foxglove.Context) -> None:
        self.name, self.type = name, type_name
        self.channel = foxglove.Channel(name, message_encoding="ros1", schema=schema(kind, type_name), context=context)
        self._lock = threading.Lock()
        self._readers: set[int] = set()  # clients
        self._subscriber: rospy.Subscriber | None = None
        self._latched = False

    def read_by(self, client: int) -> None:
        """``client`` reads it. What is latched comes once more for who comes later: a subscriber is told it when it connects."""
        with self._lock:
            self._readers.add(client)
            if self._subscriber is not None and not self._latched:
                return
            old, self._subscriber = (
                self._subscriber,
                rospy.Subscriber(self.name, rospy.AnyMsg, self._take, queue_size=100, buff_size=BUFFER, tcp_nodelay=True),
            )
            if old is not None:
                old.unregister()

    def left_by(self, client: int) -> None:
        """``client`` does not read it any more."""
        with self._lock:
            self._readers.discard(client)
            if not self._readers and self._subscriber is not None:
                self._subscriber.unregister()
                self._subscriber = None

    def close(self) -> None:
        with self._lock:
            if self._subscriber is not None:
                self._subscriber.unregister()
                self._subscriber = None
        self.channel.close()

    def _take(self, message: rospy.AnyMsg) -> None:
        self._latched = message._connection_header.get("latching") == "1"
        self.channel.log(message._buff, log_time=now_ns())


class Topics:
    """All channels, by topic."""

    def __init__(self, context: foxglove.Context) -> None:
        self._context = context
        self._lock = threading.Lock()
        self._topics: dict[str, Topic] = {}
        self._by_channel: dict[int, Topic] = {}
        self._told: set[str] = set()  # types that are not here

    def are(self, types: dict[str, str]) -> None:
        """Topics come and go. ``types``: name -> package/Type"""
        with self._lock:
            gone = [topic for name, topic in self._topics.items() if types.get(name) != topic.type]
            for topic in gone:
                del self._topics[topic.name], self._by_channel[topic.channel.id()]
            new = {name: type_name for name, type_name in types.items() if name not in self._topics}
        for topic in gone:
            topic.close()
        for name, type_name in sorted(new.items()):
            kind = self._class_of(type_name)
            if kind is None:
                continue
            with self._lock:
                topic = self._topics[name] = Topic(name, type_name, kind, self._context)
                self._by_channel[topic.channel.id()] = topic

    def by_channel(self, channel: int) -> Topic | None:
        """The topic of ``channel``, its number, or None."""
        with self._lock:
            return self._by_channel.get(channel)

    def _class_of(self, type_name: str) -> Any:
        kind = message_class(type_name)
        if kind is None and type_name not in self._told:
            self._told.add(type_name)
            rospy.logwarn("topics of type %s are not shown: no package here defines it", type_name)
        return kind


def message_class(type_name: str) -> Any:
    """The class of ``type_name``, package/Name; None where it is not here."""
    try:
        return roslib.message.get_message_class(type_name)
    except (ValueError, ImportError, AttributeError):
        return None


class Published:
    """Topics that clients publish."""

    def __init__(self, allowed: Callable[[str], bool], complain: Callable[[str], None]) -> None:
        self._allowed, self._complain = allowed, complain
        self._publishers: dict[tuple[int, int], rospy.Publisher] = {}  # by client and its number of the channel

    def advertise(self, client: int, channel: Any) -> None:
        """``client`` (its number) is going to publish on the topic of ``channel``; what keeps it from that is complained of."""
        kind = message_class(channel.schema_name)
        if not self._allowed(channel.topic):
            self._complain(f"{channel.topic}: ~client_topic_whitelist does not allow to publish it")
        elif channel.encoding != "ros1":
            self._complain(f"{channel.topic}: messages should be encoded as ros1, not {channel.encoding}")
        elif kind is None:
            self._complain(f"{channel.topic}: no package here defines {channel.schema_name}")
        else:
            try:
                self._publishers[client, channel.id] = rospy.Publisher(channel.topic, kind, queue_size=10)
            except (rospy.ROSException, ValueError) as error:
                self._complain(f"{channel.topic}: {error}")

    def unadvertise(self, client: int, channel: int) -> None:
        """``client`` does not publish on ``channel`` (numbers) any more."""
        publisher = self._publishers.pop((client, channel), None)
        if publisher is not None:
            publisher.unregister()

    def message(self, client: int, channel: int, data: bytes) -> None:
        """Publish ``data``, the bytes of a message of ROS 1, which ``client`` sends on ``channel`` (numbers)."""
        publisher = self._publishers.get((client, channel))
        if publisher is None:
            return
        message = publisher.data_class()
        try:
            message.deserialize(data)
        except Exception as error:  # genpy raises whatever its struct does
            self._complain(f"{publisher.name}: {len(data)} bytes are no {message._type}: {' '.join(str(error).split())[:100]}")
            return
        publisher.publish(message)

"""How often sensors speak, by their own stamps if they have any, and whether they say something."""

from __future__ import annotations

import math
import struct

import numpy as np
import rospy
from roslib.message import get_message_class

_LEFT_OUT = {"CameraInfo", "CompressedImage", "Joy", "JoyFeedback", "JoyFeedbackArray"}
_ALSO = {"nav_msgs/Odometry", "geometry_msgs/WrenchStamped", "gazebo_msgs/ContactsState"}


def is_sensor(kind: str) -> bool:
    package, _, name = kind.partition("/")
    return package == "sensor_msgs" and name not in _LEFT_OUT or kind in _ALSO


class Ear:
    """Listens to topics without taking the messages apart: only the stamp is read, the last message is kept."""

    def __init__(self, topics: list[tuple[str, str]]):
        """:param topics: (name, message type), each a message that begins with a header."""
        self._kinds = dict(topics)
        self._stamps: dict[str, list[float]] = {topic: [] for topic in self._kinds}
        self._last: dict[str, bytes] = {}
        self._subscribers = [
            rospy.Subscriber(topic, rospy.AnyMsg, self._hear, topic, queue_size=100, buff_size=1 << 24) for topic in self._kinds
        ]

    def _hear(self, message: rospy.AnyMsg, topic: str) -> None:
        _, seconds, nanoseconds = struct.unpack_from("<III", message._buff)
        self._stamps[topic].append(seconds + nanoseconds * 1e-9)
        self._last[topic] = message._buff

    def forget(self) -> None:
        for stamps in self._stamps.values():
            stamps.clear()

    def close(self, seconds: float) -> list[dict]:
        """What was heard since :meth:`forget`: topic, kind, rate in Hz (None: not two messages) and what it says.

        :param seconds: of simulation since then
        """
        for subscriber in self._subscribers:
            subscriber.unregister()
        return [
            {"topic": topic, "kind": self._kinds[topic], "rate": rate(stamps, seconds), "says": self._says(topic)}
            for topic, stamps in sorted(self._stamps.items())
        ]

    def _says(self, topic: str) -> str:
        kind = self._kinds[topic]
        cls = get_message_class(kind)
        if topic not in self._last or cls is None:
            return "silent" if topic not in self._last else ""
        try:
            return contents(kind, cls().deserialize(self._last[topic]))
        except Exception as error:  # of messages that are not what their type says
            return f"unreadable: {error}"


def rate(stamps: list[float], seconds: float) -> float | None:
    """Mean rate, Hz, of stamps in s: None where there are not two. Where all were left at 0, as many messages came within ``seconds``."""
    if len(stamps) > 1 and not any(stamps):
        return len(stamps) / seconds
    stamps = sorted(set(stamps))
    return (len(stamps) - 1) / (stamps[-1] - stamps[0]) if len(stamps) > 1 else None


def contents(kind: str, message) -> str:
    """What is in ``message``, of type ``kind``, in a few words: how much of a scan hit something, whether a picture has one colour only,
    what an IMU weighs.
    """
    if kind == "sensor_msgs/LaserScan":
        return f"{int(np.isfinite(message.ranges).sum())} of {len(message.ranges)} hit"
    if kind == "sensor_msgs/Image":
        data = np.frombuffer(message.data, np.uint8)
        return f"{message.width}x{message.height}{', one colour' if not data.size or data.min() == data.max() else ''}"
    if kind == "sensor_msgs/PointCloud2":
        return f"{message.width * message.height} points"
    if kind == "sensor_msgs/Imu":
        a = message.linear_acceleration
        return f"{math.hypot(a.x, a.y, a.z):.2f} m/s2"
    if kind == "sensor_msgs/Range":
        return f"{message.range:.2f} m"
    if kind == "sensor_msgs/JointState":
        return f"{len(message.name)} joints"
    return ""

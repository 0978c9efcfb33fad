"""The newest message of a topic, for a thread that waits for it."""

from __future__ import annotations

import threading
from typing import Any

import rospy
from sensor_msgs.msg import CompressedImage, Image

_BUFFER = 1 << 24  # bytes that are read at once: a message that waits in the connection is an old one


def published() -> dict[str, str]:
    """Types by topic."""
    return dict(rospy.get_published_topics())


class Latest:
    """Subscribed to a topic as long as it is open; a context manager. Messages that nobody takes in time are dropped.

    :param compressed: the topic is a CompressedImage's
    """

    def __init__(self, topic: str, compressed: bool):
        self._news = threading.Condition()
        self._message: Any = None
        self._subscriber = rospy.Subscriber(topic, CompressedImage if compressed else Image, self._take, queue_size=1, buff_size=_BUFFER)

    def __enter__(self) -> Latest:
        return self

    def __exit__(self, *_: Any) -> None:
        self._subscriber.unregister()

    def _take(self, message: Any) -> None:
        with self._news:
            self._message = message
            self._news.notify()

    def next(self, seconds: float) -> Any | None:
        """A message that was not given before, or None if none comes within ``seconds`` of wall time."""
        with self._news:
            self._news.wait_for(lambda: self._message is not None, seconds)
            message, self._message = self._message, None
            return message

"""What is known of one topic while it is listened to."""

import threading
import time
from collections import deque
from typing import Any

import rospy
from rqt_py_common.topic_helpers import get_type_class

WINDOW = 100  # messages that rate and bandwidth are taken from


class TopicInfo:
    """Listens between :meth:`start_monitoring` and :meth:`stop_monitoring`. Messages are counted as they come, raw, and decoded
    only when somebody asks for the last one.

    ``error`` says why it cannot be listened to.
    """

    def __init__(self, topic_name: str, topic_type: str):
        self.topic_name, self.type_name = topic_name, topic_type
        self.message_class = get_type_class(topic_type)
        self.error = None if self.message_class else f'can not get message class for type "{topic_type}"'
        self.monitoring = False
        self._subscriber = None
        self._lock = threading.Lock()
        self._arrivals: deque[tuple[float, int]] = deque(maxlen=WINDOW)  # (s, bytes)
        self._newest: bytes | None = None

    def toggle_monitoring(self) -> None:
        (self.stop_monitoring if self.monitoring else self.start_monitoring)()

    def start_monitoring(self) -> None:
        if self.message_class is not None and not self.monitoring:
            self.monitoring = True
            self._subscriber = rospy.Subscriber(self.topic_name, rospy.AnyMsg, self.message_callback)

    def stop_monitoring(self) -> None:
        self.monitoring = False
        if self._subscriber is not None:
            self._subscriber.unregister()
            self._subscriber = None
        with self._lock:
            self._arrivals.clear()
            self._newest = None

    def message_callback(self, message: rospy.AnyMsg) -> None:
        """In rospy's thread."""
        with self._lock:
            self._arrivals.append((time.monotonic(), len(message._buff)))
            self._newest = message._buff

    def last_message(self) -> Any:
        """None before the first.

        :raises genpy.DeserializationError: what came is something else
        """
        raw = self._newest
        return self.message_class().deserialize(raw) if raw is not None else None

    def get_hz(self) -> float | None:
        """Messages a second; None if there are not enough to tell."""
        with self._lock:
            arrivals = list(self._arrivals)
        return _per_second(arrivals, len(arrivals))

    def get_bw(self) -> tuple[float | None, int | None]:
        """Bytes a second, and bytes of the last message."""
        with self._lock:
            arrivals = list(self._arrivals)
        return _per_second(arrivals, sum(size for _, size in arrivals)), arrivals[-1][1] if arrivals else None


def _per_second(arrivals, amount) -> float | None:
    """Over the time from the first arrival to now, or to the last one if the next is not due yet."""
    if len(arrivals) < 2:
        return None
    first, last, now = arrivals[0][0], arrivals[-1][0], time.monotonic()
    period = (last - first) / (len(arrivals) - 1)
    span = (last - first) if now - last < 2 * period else now - first
    share = (len(arrivals) - 1) / len(arrivals)
    return amount * share / span if span > 0 else None

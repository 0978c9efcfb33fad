"""~ready: for whoever waits for the simulator."""

from __future__ import annotations

import threading

import rospy
from std_msgs.msg import Bool


class Ready:
    """Latched true once the world, its plugins and all services are there."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._set = False
        self._publisher: rospy.Publisher | None = None

    def set(self) -> None:
        with self._lock:
            self._set = True
            if self._publisher is not None:
                self._publisher.publish(True)

    def publisher(self) -> rospy.Publisher:
        """Somebody waits: the topic from now on."""
        with self._lock:
            self._publisher = rospy.Publisher("~ready", Bool, queue_size=1, latch=True)
            if self._set:
                self._publisher.publish(True)
            return self._publisher

    def gone(self) -> None:
        with self._lock:
            self._publisher = None

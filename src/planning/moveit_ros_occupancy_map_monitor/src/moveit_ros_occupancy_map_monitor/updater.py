"""The base of octomap updaters: what turns a sensor's messages into occupied space.

A package that depends on ``moveit_ros_occupancy_map_monitor`` exports its updaters with
``<export><moveit_ros_occupancy_map_monitor plugin="${prefix}/plugins.xml"/></export>``; ``sensor_plugin`` of an entry in
``~sensors`` (sensors_3d.yaml) names the one.
"""

from __future__ import annotations

import threading
from abc import ABC, abstractmethod
from typing import Any

import motion
import rospy
from moveit_core.errors import MoveItError
from node_signals.parameters import is_number
from node_signals.rates import Spaced

#: points of one message that are looked at; of more, every second, third ... is taken
MOST_POINTS = 60000


class UpdaterError(MoveItError):
    """An updater cannot be made, or a message cannot be used; one line."""


class OccupancyMapUpdater(ABC):
    """Listens to a sensor. Messages are worked on in a thread of its own, one at a time; those that come meanwhile are
    forgotten but for the newest, so that no flood of messages piles up.

    :param monitor: the OccupancyMapMonitor.
    :param settings: the entry of ``~sensors``.
    :raises UpdaterError: the settings cannot be used.
    """

    def __init__(self, monitor, settings: dict[str, Any]):
        self.monitor = monitor
        self._settings = settings
        self._gate = Spaced(self.number("max_update_rate", 0.0), strict=True)
        self._newest = None
        self._news = threading.Condition()
        self._stopped = False
        self._thread = threading.Thread(target=self._run, name=f"octomap from {self.topic}", daemon=True)

    @property
    @abstractmethod
    def topic(self) -> str:
        """The sensor's topic."""

    @abstractmethod
    def work(self, message) -> None:
        """Put what ``message`` shows into the map.

        :raises UpdaterError: it cannot be used.
        """

    def start(self) -> None:
        """Begin to work."""
        self._thread.start()

    def stop(self) -> None:
        """End; waits a little for what is being worked on."""
        with self._news:
            self._stopped = True
            self._news.notify_all()
        self._thread.join(2.0)

    def number(self, key: str, default: float) -> float:
        """The number ``key`` of the settings, or ``default``.

        :raises UpdaterError: it is none.
        """
        value = self._settings.get(key, default)
        if not is_number(value, finite=False):
            raise UpdaterError(f"{key} is {str(value)[:40]!r}, not a number")
        return float(value)

    def text(self, key: str, default: str = "") -> str:
        """The text ``key`` of the settings, or ``default``."""
        return str(self._settings.get(key, default))

    def put(self, message) -> None:
        """Hand over a message: the callback of subscribers."""
        with self._news:
            self._newest = message
            self._news.notify_all()

    def _run(self) -> None:
        while True:
            with self._news:
                while self._newest is None and not self._stopped:
                    self._news.wait()
                if self._stopped:
                    return
                message, self._newest = self._newest, None
            if self._gate.due(rospy.Time.now().to_nsec()):
                self._try(message)
            del message

    def _try(self, message) -> None:
        problem = self._problem(message)
        if problem:
            rospy.logerr_throttle(5, f"octomap from {self.topic}: {problem}")

    def _problem(self, message) -> str:
        """Work on a message; what is wrong with it.

        Not logged here: rospy looks at the locals of whoever logs, and an exception among them would keep the message and all
        that was computed from it until the next round of garbage collection.
        """
        try:
            self.work(message)
        except (UpdaterError, motion.MotionError) as error:
            return str(error)
        except rospy.ROSException:
            return ""  # shutting down
        except Exception as error:  # whatever a sensor sends, the node lives on
            return f"{type(error).__name__}: {' '.join(str(error).split())[:120]}"
        return ""

"""The cmd_vel topic of a base, with its watchdog."""
from __future__ import annotations

import math
from typing import Callable, Tuple

import rospy
from controller_interface import NodeHandle
from geometry_msgs.msg import Twist

_NONE = (0.0, 0.0, -math.inf)  # linear m/s, angular rad/s, when it came


class VelocityCommand:
    """Keeps the last command of ``cmd_vel`` and forgets it after parameter ``cmd_vel_timeout`` seconds.

    Commands are dated with the time of the control loop, so that no clock has to agree with another.

    :param on_conflict: called (in a thread of rospy) when a second publisher appears although
        ``allow_multiple_cmd_vel_publishers`` is false
    """

    def __init__(self, nh: NodeHandle, on_conflict: Callable[[], None], multiple_allowed: bool = True):
        self._name = nh.namespace
        self._timeout = nh.param("cmd_vel_timeout", 0.5)
        self._multiple = nh.param("allow_multiple_cmd_vel_publishers", multiple_allowed)
        self._on_conflict = on_conflict
        self._running = False
        self._now = 0.0
        self._command = _NONE
        self._subscriber = nh.subscriber("cmd_vel", Twist, self._receive, queue_size=1)

    def start(self, time: float) -> None:
        self._now = time
        self._command = _NONE
        self._running = True

    def stop(self) -> None:
        self._running = False

    def at(self, time: float) -> Tuple[float, float]:
        """(linear x m/s, angular z rad/s) to be done at ``time``. Realtime safe."""
        self._now = time
        linear, angular, stamp = self._command
        if stamp > time:  # from before a simulation was reset
            self._command = _NONE
        return (linear, angular) if 0.0 <= time - stamp <= self._timeout else (0.0, 0.0)

    @property
    def stamp(self) -> float:
        """When the last command came, s."""
        return self._command[2]

    def _receive(self, message: Twist) -> None:
        if not self._running:
            rospy.logerr_throttle(1.0, f"{self._name}: Can't accept new commands. Controller is not running.")
        elif not self._multiple and self._subscriber.get_num_connections() > 1:
            rospy.logerr_throttle(1.0, f"{self._name}: Detected {self._subscriber.get_num_connections()} publishers on "
                                       "cmd_vel. Only 1 publisher is allowed. Going to brake.")
            self._on_conflict()
        elif not (math.isfinite(message.linear.x) and math.isfinite(message.angular.z)):
            rospy.logwarn_throttle(1.0, f"{self._name}: Received NaN in velocity command. Ignoring.")
        else:
            self._command = (message.linear.x, message.angular.z, self._now)

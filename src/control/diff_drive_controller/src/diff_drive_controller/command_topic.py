"""Topics that tell a base how to move, with their watchdog."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import rospy
from controller_interface import NodeHandle
from geometry_msgs.msg import Twist

#: m/s, rad/s or rad; what is beyond is no command, and no odometry could follow it
_LARGEST = 1e12


class CommandTopic:
    """Keeps the last command of ``topic`` and forgets it after parameter ``cmd_vel_timeout`` seconds.

    Commands are dated with the time of the control loop, so that no clock has to agree with another.

    :param nh: namespace of the controller
    :param message_type: class of the commands
    :param values: takes the commanded numbers out of a message; those of an empty message are the base at rest
    :param what: what is commanded, for the log
    """

    def __init__(self, nh: NodeHandle, topic: str, message_type: type, values: Callable[[Any], tuple[float, ...]], what: str):
        self._name = nh.namespace
        self._timeout = nh.param("cmd_vel_timeout", 0.5)
        self._values = values
        self._what = what
        self._rest = values(message_type())
        self._none = (self._rest, -math.inf)
        self._last = self._none  # (values, when they came)
        self._running = False
        self._now = 0.0
        self._subscriber = nh.subscriber(topic, message_type, self._receive, queue_size=1)

    def start(self, time: float) -> None:
        """Take commands from ``time`` (s) on; earlier ones are forgotten."""
        self._now = time
        self._last = self._none
        self._running = True

    def stop(self) -> None:
        """Refuse commands."""
        self._running = False

    def at(self, time: float) -> tuple[float, ...]:
        """What is to be done at ``time`` (s). Realtime safe."""
        self._now = time
        values, stamp = self._last
        if stamp > time:  # from before a simulation was reset
            self._last = self._none
        return values if 0.0 <= time - stamp <= self._timeout else self._rest

    @property
    def stamp(self) -> float:
        """When the last command came, s; -inf without one."""
        return self._last[1]

    def accepts(self) -> bool:
        """Whether commands of whoever publishes now are obeyed; says why not."""
        return True

    def _receive(self, message: Any) -> None:
        values = self._values(message)
        if not self._running:
            rospy.logerr_throttle(1.0, f"{self._name}: Can't accept new commands. Controller is not running.")
        elif not self.accepts():
            return
        elif not all(abs(value) <= _LARGEST for value in values):
            rospy.logwarn_throttle(
                1.0,
                f"{self._name}: Received NaN in {self._what} command. Ignoring."
                if any(map(math.isnan, values))
                else f"{self._name}: {values} is no {self._what} command. Ignoring.",
            )
        else:
            self._last = (values, self._now)


class VelocityCommand(CommandTopic):
    """``cmd_vel``: linear x in m/s, angular z in rad/s.

    :param on_conflict: called (in a thread of rospy) when a second publisher appears although
        ``allow_multiple_cmd_vel_publishers`` is false
    :param nh: namespace of the controller
    """

    def __init__(self, nh: NodeHandle, on_conflict: Callable[[], None]):
        self._multiple = nh.param("allow_multiple_cmd_vel_publishers", True)
        self._on_conflict = on_conflict
        super().__init__(nh, "cmd_vel", Twist, lambda message: (message.linear.x, message.angular.z), "velocity")

    def accepts(self) -> bool:
        publishers = self._subscriber.get_num_connections()
        if self._multiple or publishers <= 1:
            return True
        rospy.logerr_throttle(
            1.0, f"{self._name}: Detected {publishers} publishers on cmd_vel. Only 1 publisher is allowed. Going to brake."
        )
        self._on_conflict()
        return False

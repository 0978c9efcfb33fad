"""The node draw_square: drives turtle1 along a square of 2 m by its pose, for ever."""

import math
from typing import Any

import node_signals
import rospy
from geometry_msgs.msg import Twist
from std_srvs.srv import Empty

from .msg import Pose

SIDE = 2.0  # m
SPEED, TURN = 1.0, 0.4  # m/s, rad/s
NEAR, ALIGNED, STILL = 0.1, 0.01, 0.0001  # m, rad, m/s and rad/s
PERIOD = 0.016  # s


class SquareDriver:
    """Goes ahead, stands, turns, stands, and again. One call of :meth:`twist` per period, with the newest pose."""

    def __init__(self, log):
        """:param log: takes a line of text"""
        self._log = log
        self._goal: tuple[float, float, float] | None = None  # x, y, theta
        self._moving = True  # False: waits until the turtle stands
        self._straight = True

    def twist(self, pose) -> tuple[float, float] | None:
        """(m/s, rad/s) to command now, or None."""
        if self._goal is None:
            self._aim_ahead(pose)
        if self._moving:
            if not self._reached(pose):
                return (SPEED, 0.0) if self._straight else (0.0, TURN)
            self._moving = False
            return 0.0, 0.0
        if not (pose.linear_velocity < STILL and abs(pose.angular_velocity) < STILL):
            return 0.0, 0.0
        self._log("Reached goal")
        self._moving, self._straight = True, not self._straight
        self._aim_ahead(pose) if self._straight else self._aim(pose.x, pose.y, pose.theta + math.pi / 2)
        return None

    def _aim_ahead(self, pose) -> None:
        self._aim(pose.x + SIDE * math.cos(pose.theta), pose.y + SIDE * math.sin(pose.theta), pose.theta)

    def _aim(self, x: float, y: float, theta: float) -> None:
        self._goal = x, y, math.remainder(theta, 2 * math.pi)
        self._log("New goal [%f %f, %f]" % self._goal)

    def _reached(self, pose) -> bool:
        assert self._goal is not None  # twist() has chosen one
        x, y, theta = self._goal
        return abs(pose.x - x) < NEAR and abs(pose.y - y) < NEAR and abs(math.remainder(pose.theta - theta, 2 * math.pi)) < ALIGNED


def main() -> None:
    node_signals.init_node("draw_square")
    driver = SquareDriver(rospy.loginfo)
    newest: list[Any] = []
    subscriber = rospy.Subscriber("turtle1/pose", Pose, lambda pose: newest.__setitem__(slice(None), [pose]), queue_size=1)
    publisher = rospy.Publisher("turtle1/cmd_vel", Twist, queue_size=1)
    try:
        rospy.ServiceProxy("reset", Empty)()
    except rospy.ServiceException as error:
        rospy.logwarn("there is no turtle to start anew yet (%s); waiting for %s", error, subscriber.resolved_name)

    def drive(_event):
        velocities = driver.twist(newest[0]) if newest else None
        if velocities is not None:
            twist = Twist()
            twist.linear.x, twist.angular.z = velocities
            publisher.publish(twist)

    rospy.Timer(rospy.Duration(PERIOD), drive, reset=True)
    node_signals.spin()

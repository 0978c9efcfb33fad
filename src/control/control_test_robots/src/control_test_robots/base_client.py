"""What tests of wheeled bases share: a base driven by cmd_vel and watched through its odometry."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from test_support import heading
from tf2_msgs.msg import TFMessage

from . import client


class Base:
    """The base of a running controller. Use in a ``with`` block after ``client.running``."""

    def __init__(self, controller: str):
        self.name = controller
        self.odometry = client.Topic(f"/{controller}/odom", Odometry)
        self.tf = client.Topic("/tf", TFMessage)
        self.command = client.publisher(f"/{controller}/cmd_vel", Twist)
        self._topics = [self.odometry, self.tf]
        self.odometry.next()

    def __enter__(self) -> Base:
        return self

    def __exit__(self, *_exception) -> None:
        self.command.unregister()
        for topic in self._topics:
            topic.close()

    def topic(self, name: str, message_type: type) -> client.Topic:
        """The topic ``name`` of the controller, of class ``message_type``, when a message has come on it."""
        topic = client.Topic(f"/{self.name}/{name}", message_type)
        self._topics.append(topic)
        topic.next()
        return topic

    def send(self, linear: float, angular: float) -> None:
        """Send one command: ``linear`` m/s forwards and ``angular`` rad/s to the left."""
        message = Twist()
        message.linear.x, message.angular.z = linear, angular
        self.command.publish(message)

    def drive(self, linear: float, angular: float, seconds: float, obeys: bool = True) -> list[Odometry]:
        """Command ``linear`` m/s and ``angular`` rad/s over and over, as :meth:`follow` does with ``obeys``.

        :return: odometry of ``seconds`` after it came into force
        """
        return self.follow(lambda: self.send(linear, angular), seconds, obeys)

    def follow(self, send: Callable[[], None], seconds: float, obeys: bool = True) -> list[Odometry]:
        """Call ``send``, which commands a motion, over and over. :return: odometry of ``seconds`` of that motion

        However late a command arrives, what the base did before does not count.

        :param obeys: the command changes the motion of the base; half a second of it is not counted, for it to be steady
        """
        before = self.odometry.next().twist.twist
        send()
        if obeys:
            client.wait_until(lambda: _differ(self.odometry.last.twist.twist, before), "the command to come into force")
        self._go_on(send, 0.5)
        self.odometry.clear()
        self._go_on(send, seconds)
        self.odometry.next()  # what came before it has arrived
        return list(self.odometry.messages)

    def wait_at_rest(self) -> None:
        """Until the base stands: the last command has run out."""
        client.wait_until(lambda: not _differ(self.odometry.next().twist.twist, Twist()), "the base to stop")

    @staticmethod
    def _go_on(send: Callable[[], None], seconds: float) -> None:
        end = client.advance() + seconds
        while client.advance() < end:
            send()
            client.sim_sleep(min(0.2, max(0.01, end - rospy.get_time())))

    def transforms(self) -> set:
        """(frame, child) of the transforms seen so far."""
        return {(t.header.frame_id, t.child_frame_id) for message in list(self.tf.messages) for t in message.transforms}


def _differ(a: Twist, b: Twist) -> bool:
    """Whether two motions in the plane differ by more than rounding."""
    return max(abs(a.linear.x - b.linear.x), abs(a.linear.y - b.linear.y), abs(a.angular.z - b.angular.z)) > 1e-4


def yaw(odometry: Odometry) -> float:
    """Heading of ``odometry``, rad."""
    return heading(odometry.pose.pose.orientation)


def duration(messages: list[Any]) -> float:
    """Between the first and the last stamp of ``messages``, s."""
    return (messages[-1].header.stamp - messages[0].header.stamp).to_sec()


def displacement(odometry: list[Odometry]) -> tuple:
    """(x, y) of the last pose of ``odometry`` in the frame of the first one, m."""
    first, last = odometry[0], odometry[-1]
    dx = last.pose.pose.position.x - first.pose.pose.position.x
    dy = last.pose.pose.position.y - first.pose.pose.position.y
    cosine, sine = math.cos(yaw(first)), math.sin(yaw(first))
    return cosine * dx + sine * dy, cosine * dy - sine * dx


def turned(odometry: list[Odometry]) -> float:
    """Sum of the small turns between the poses of ``odometry``, rad; several turns are counted."""
    return sum(math.remainder(yaw(b) - yaw(a), 2.0 * math.pi) for a, b in zip(odometry, odometry[1:]))

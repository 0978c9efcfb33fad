"""What tests of wheeled bases share: a base driven by cmd_vel and watched through its odometry."""
from __future__ import annotations

import math
from typing import Any, List

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
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

    def __enter__(self) -> "Base":
        return self

    def __exit__(self, *_exception) -> None:
        self.command.unregister()
        for topic in self._topics:
            topic.close()

    def topic(self, name: str, message_type: type) -> client.Topic:
        """A topic of the controller that is known to arrive."""
        topic = client.Topic(f"/{self.name}/{name}", message_type)
        self._topics.append(topic)
        topic.next()
        return topic

    def send(self, linear: float, angular: float) -> None:
        message = Twist()
        message.linear.x, message.angular.z = linear, angular
        self.command.publish(message)

    def drive(self, linear: float, angular: float, seconds: float) -> List[Odometry]:
        """Command a twist over and over. :return: odometry of the last ``seconds``, after it came into force"""
        self.send(linear, angular)
        client.sim_sleep(0.5)
        self.odometry.clear()
        end = rospy.get_time() + seconds
        while rospy.get_time() < end:
            self.send(linear, angular)
            client.sim_sleep(min(0.3, max(0.01, end - rospy.get_time())))
        return list(self.odometry.messages)

    def transforms(self) -> set:
        """(frame, child) of the transforms seen so far."""
        return {(t.header.frame_id, t.child_frame_id) for message in list(self.tf.messages) for t in message.transforms}


def yaw(odometry: Odometry) -> float:
    """rad"""
    q = odometry.pose.pose.orientation
    return 2.0 * math.atan2(q.z, q.w)


def duration(messages: List[Any]) -> float:
    """Between the first and the last stamp, s."""
    return (messages[-1].header.stamp - messages[0].header.stamp).to_sec()


def displacement(odometry: List[Odometry]) -> tuple:
    """(x, y) of the last pose in the frame of the first one, m."""
    first, last = odometry[0], odometry[-1]
    dx = last.pose.pose.position.x - first.pose.pose.position.x
    dy = last.pose.pose.position.y - first.pose.pose.position.y
    cosine, sine = math.cos(yaw(first)), math.sin(yaw(first))
    return cosine * dx + sine * dy, cosine * dy - sine * dx


def turned(odometry: List[Odometry]) -> float:
    """Sum of the small turns between the poses, rad; several turns are counted."""
    return sum(math.remainder(yaw(b) - yaw(a), 2.0 * math.pi) for a, b in zip(odometry, odometry[1:]))

"""What a mobile robot is told: the topic that it listens to, and messages that say a speed and a turn."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import lenient_xml
import rospy
from roslib.message import get_message_class

from .errors import MeasuringError


def _twist(message, speed: float, turn: float, aside: float) -> None:
    message.linear.x, message.linear.y, message.angular.z = speed, aside, turn


def _ackermann(message, speed: float, turn: float, _aside: float) -> None:
    message.speed, message.steering_angle = speed, turn


#: Message type to what fills it; ``.field`` says where in the message the command is.
KINDS: dict[str, tuple[str, Callable]] = {
    "geometry_msgs/Twist": ("", _twist),
    "geometry_msgs/TwistStamped": ("twist", _twist),
    "ackermann_msgs/AckermannDrive": ("", _ackermann),
    "ackermann_msgs/AckermannDriveStamped": ("drive", _ackermann),
}


def choose(heard: Sequence[tuple[str, str]], published: Sequence[str], wanted: str = "") -> tuple[str, str]:
    """The topic to send commands to, and its message type.

    Without a wish: the one named cmd_vel with the shortest name, rather one that nobody publishes (a multiplexer's input,
    not its output).

    :param heard: (topic, message type) that somebody subscribes to. :param published: topics that somebody publishes.
    :raises MeasuringError: nobody listens to speeds, or not on the wanted topic.
    """
    topics = dict(heard)
    if wanted:
        wanted = "/" + wanted.strip("/")
        if topics.get(wanted) not in KINDS:
            what = f"is of type {topics[wanted]}" if wanted in topics else "has no subscriber"
            raise MeasuringError(f"topic {wanted} {what}; speeds go to {_listed(heard)}")
        return wanted, topics[wanted]
    candidates = [topic for topic, kind in heard if kind in KINDS]
    if not candidates:
        raise MeasuringError(f"nobody listens to speeds ({', '.join(sorted(KINDS))})")
    best = min(candidates, key=lambda topic: (not topic.endswith("cmd_vel"), topic in published, topic.count("/"), len(topic), topic))
    return best, topics[best]


def _listed(heard: Sequence[tuple[str, str]]) -> str:
    return ", ".join(sorted(topic for topic, kind in heard if kind in KINDS)) or "none"


class Wheel:
    """Sends speeds to a topic. :param kind: one of :data:`KINDS`."""

    def __init__(self, topic: str, kind: str):
        self.topic, self.steers = topic, kind.startswith("ackermann_msgs")
        self._field, self._fill = KINDS[kind]
        self._class = get_message_class(kind)
        if self._class is None:
            raise MeasuringError(f"topic {topic}: messages of type {kind} are not built here")
        self._publisher = rospy.Publisher(topic, self._class, queue_size=1)

    def send(self, time: float, speed: float, turn: float, aside: float = 0.0) -> None:
        """:param time: of simulation, s. :param speed: m/s ahead. :param turn: rad/s, or rad of steering.
        :param aside: m/s to the left."""
        message = self._class()
        if hasattr(message, "header"):
            message.header.stamp = rospy.Time.from_sec(time)
        self._fill(getattr(message, self._field) if self._field else message, speed, turn, aside)
        self._publisher.publish(message)


def joint_limits(description: str) -> dict[str, tuple[float, float]]:
    """Limits of the joints of a URDF that have some, rad or m."""
    found: dict[str, tuple[float, float]] = {}
    for joint in lenient_xml.fromstring(description).iter("joint"):
        limit = joint.find("limit")
        if joint.get("type") in ("revolute", "prismatic") and limit is not None:
            found[joint.get("name", "")] = float(limit.get("lower", 0)), float(limit.get("upper", 0))
    return found


def nominal_rates(description: str) -> list[tuple[str, float]]:
    """(sensor, rate in Hz) of the sensors in a URDF that ask for one, on links that it has."""
    robot = lenient_xml.fromstring(description)
    links = {link.get("name") for link in robot.iter("link")}
    found = []
    for extension in robot.iter("gazebo"):
        for sensor in extension.iter("sensor") if extension.get("reference") in links else ():
            rates = [float(text.text) for text in sensor.iter("update_rate") if text.text and text.text.strip()]
            if rates and rates[0] > 0:
                found.append((sensor.get("name", ""), rates[0]))
    return found

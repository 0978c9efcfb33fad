"""``rosrun topic_tools transform`` and ``relay_field``: what one topic says, as another message on another topic."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from typing import Any

import genpy
import node_signals
import rospy
import rostopic
import yaml
from roslib.message import get_message_class
from std_msgs.msg import Header

from .expressions import ExpressionError, compute, fill, modules


def _parser(name: str, purpose: str, example: str) -> argparse.ArgumentParser:
    p = argparse.ArgumentParser(prog=name, description=purpose, epilog=f"Example: rosrun topic_tools {name} {example}")
    p.add_argument("input", help="topic, or a field of its messages (/imu/orientation)")
    p.add_argument("output_topic", help="topic to publish")
    p.add_argument("output_type", help="type of its messages (std_msgs/Float64)")
    p.add_argument("--wait-for-start", action="store_true", help="wait until somebody publishes the input")
    p.add_argument("--tcpnodelay", dest="tcp_nodelay", action="store_true", help="ask the publisher for TCP_NODELAY")
    return p


class Relay:
    """Subscribes to ``options.input``, publishes what ``make(value)`` answers: a message or its arguments."""

    def __init__(self, options: argparse.Namespace, make: Callable[[Any], Any], latch: bool = False):
        """:raises ExpressionError: nobody publishes the input, or the type of the output is unknown; one line."""
        self._make = make
        name = rospy.resolve_name(options.input)
        kind, topic, self._field = rostopic.get_topic_class(name, blocking=options.wait_for_start)
        if topic is None:
            raise ExpressionError(f"nobody publishes {name}, nor messages with that field; --wait-for-start waits")
        if kind is None:
            raise ExpressionError(f"the message type of {topic} is not built here")
        output = get_message_class(options.output_type)
        if output is None:
            raise ExpressionError(f"there is no message type {options.output_type}: write it as std_msgs/Float64")
        self._publisher = rospy.Publisher(options.output_topic, output, queue_size=1, latch=latch)
        rospy.Subscriber(topic, kind, self._take, tcp_nodelay=options.tcp_nodelay)

    def _take(self, message: Any) -> None:
        try:
            made = self._make(self._field(message) if self._field else message)
            self._publisher.publish(*(made if isinstance(made, (list, tuple)) else [made]))
        except (ExpressionError, genpy.MessageException, rospy.ROSException, TypeError) as error:
            rospy.logerr_throttle(5, "%s", " ".join(str(error).split()))


def _run(name: str, options: argparse.Namespace, make: Callable[[Any], Any], latch: bool = False) -> int | None:
    node_signals.init_node(name, anonymous=True)
    try:
        relay = Relay(options, make, latch)
    except (ExpressionError, rostopic.ROSTopicException) as error:
        print(f"ERROR: {error}", file=sys.stderr)
        return 1
    node_signals.spin()
    del relay
    return 0


def transform() -> int | None:
    """The node transform. :returns: exit code."""
    p = _parser(
        "transform",
        "Publishes the value of a Python expression on each message m.",
        "/imu/orientation /norm std_msgs/Float64 'numpy.sqrt(m.x**2 + m.y**2 + m.z**2 + m.w**2)'",
    )
    p.add_argument("expression", nargs="?", default="m", help="Python expression on m; a list gives the message's fields (default m)")
    p.add_argument("-i", "--import", dest="modules", nargs="+", default=["numpy"], help="modules to import (default numpy)")
    p.add_argument("--latch", action="store_true", help="latch the output")
    options = p.parse_args(rospy.myargv()[1:])
    names, absent = modules(options.modules)
    for module in absent:
        print(f"Failed to import module: {module}", file=sys.stderr)
    return _run("transform", options, lambda m: compute(options.expression, m, names), options.latch)


def relay_field() -> int | None:
    """The node relay_field. :returns: exit code, 1 too when its expression is no YAML."""
    p = _parser(
        "relay_field",
        "Publishes a message whose fields are Python expressions on each message m.",
        "/chatter /header std_msgs/Header '{seq: 0, stamp: now, frame_id: m.data}'",
    )
    p.add_argument("expression", help="the message as YAML, its texts Python expressions on m")
    options = p.parse_args(rospy.myargv()[1:])
    try:
        tree = yaml.safe_load(options.expression)
    except yaml.YAMLError as error:
        print(f"ERROR: the expression is no YAML: {' '.join(str(error).split())}", file=sys.stderr)
        return 1
    output = get_message_class(options.output_type)

    def make(m: Any) -> Any:
        now = rospy.get_rostime()
        message = output()
        genpy.message.fill_message_args(message, [fill(tree, m)], keys={"now": now, "auto": Header(stamp=now)})
        return message

    return _run("relay_field", options, make)

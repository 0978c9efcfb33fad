"""Nodes that say hello ten times a second on ``chatter``, and nodes that hear them."""

import contextlib
from collections.abc import Callable

import node_signals
import rospy
from std_msgs.msg import Header, String

from .msg import HeaderString

PERIOD = 0.1  # s


def _hello() -> str:
    said = f"hello world {rospy.get_time()}"
    rospy.loginfo(said)
    return said


def over_and_over(say: Callable[[], None], period: float = PERIOD) -> None:
    """Call ``say()`` every ``period`` s until the node ends."""
    rate = rospy.Rate(1 / period)
    with contextlib.suppress(rospy.ROSInterruptException):
        while not rospy.is_shutdown():
            say()
            rate.sleep()


def talk() -> None:
    """The node talker: a loop that sleeps."""
    publisher = rospy.Publisher("chatter", String, queue_size=10)
    node_signals.init_node("talker", anonymous=True)
    over_and_over(lambda: publisher.publish(_hello()))


def talk_by_timer() -> None:
    """The same by a timer."""
    publisher = rospy.Publisher("chatter", String, queue_size=10)
    node_signals.init_node("talker", anonymous=True)
    rospy.Timer(rospy.Duration(PERIOD), lambda _: publisher.publish(_hello()))
    node_signals.spin()


def talk_with_header() -> None:
    """The node talker_header, on ``chatter_header``: with a time; rospy counts the messages."""
    publisher = rospy.Publisher("chatter_header", HeaderString, queue_size=10)
    node_signals.init_node("talker_header")
    over_and_over(lambda: publisher.publish(Header(stamp=rospy.get_rostime()), _hello()))


def listen() -> None:
    """The node listener: logs what it hears and from whom it comes."""
    node_signals.init_node("listener", anonymous=True)
    rospy.Subscriber("chatter", String, lambda message: rospy.loginfo("%sI heard %s", rospy.get_caller_id(), message.data))
    node_signals.spin()


def listen_with_header() -> None:
    """The node listener_header."""

    def hear(message: HeaderString) -> None:
        header = message.header
        rospy.loginfo(
            "%s just heard %s, number %d, sent at %12f, %12f s ago",
            rospy.get_caller_id(),
            message.data,
            header.seq,
            header.stamp.to_sec(),
            (rospy.get_rostime() - header.stamp).to_sec(),
        )

    node_signals.init_node("listener_header")
    rospy.Subscriber("chatter_header", HeaderString, hear)
    node_signals.spin()

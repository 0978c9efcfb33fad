"""Starting the ROS side of the clients, which is rospy alone: there is no second node as with compiled clients."""

from __future__ import annotations

import time

import rospy

_arguments: list[str] | None = None


def roscpp_initialize(args: list[str]) -> None:
    """Accepted before or after ``rospy.init_node``, once or several times. Without any ``rospy.init_node``, the first
    client
    starts a node itself, with ``args``, words of a command line.
    """
    global _arguments
    _arguments = list(args)


def roscpp_shutdown() -> None:
    """Nothing is left to end: the node ends with ``rospy.signal_shutdown``, or with the program."""


class RosInitializer:
    """roscpp_initialize and roscpp_shutdown as a context."""

    def __init__(self, args: list[str]):
        roscpp_initialize(args)

    def __enter__(self) -> RosInitializer:
        return self

    def __exit__(self, *_error) -> None:
        roscpp_shutdown()


def ensure_node() -> None:
    """Start a node if the program has none yet. A later ``rospy.init_node`` is then accepted and changes nothing."""
    if rospy.core.is_initialized():
        return
    rospy.init_node(f"move_group_commander_wrappers_{int(time.time() * 1000)}", argv=_arguments, anonymous=True)

    def already(name, *_args, **_options) -> None:
        rospy.logwarn(
            "rospy.init_node('%s') comes after a client of move_group started the node %s, which is kept; call it first",
            name,
            rospy.get_name(),
        )

    rospy.init_node = already

"""Topics and services of a node in which many parts offer things, and two of them may choose the same name.

roscpp says so in one line and goes on, and the part that came second lives without. rospy raises an exception for a second
service, and lets a second type on a topic through until something is published. Here it is as in roscpp: who comes second gets a
stand-in that does nothing, and the log has one ERROR line that names both.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import rospy
from rospy.impl.registration import Registration
from rospy.topics import get_topic_manager


class _StandIn:
    """In the place of a service, publisher or subscriber whose name is taken: nobody ever comes."""

    def __init__(self, name: str):
        self.name = self.resolved_name = name

    def shutdown(self, reason: str = "") -> None:
        """Nothing to withdraw."""

    def unregister(self) -> None:
        """Nothing to withdraw."""

    def publish(self, *args: Any, **kwds: Any) -> None:
        """Nobody listens."""

    def get_num_connections(self) -> int:
        return 0


def service(name: str, kind: type, handler: Callable[[Any], Any]) -> Any:
    """A ``rospy.Service`` ``name`` of class ``kind``, answered by ``handler``.

    Where this node has one of that name already, a stand-in with ``shutdown()``.
    """
    try:
        return rospy.Service(name, kind, handler)
    except rospy.ServiceException as error:
        resolved = rospy.resolve_name(name)
        if "already registered" not in str(error):
            raise
        rospy.logerr(
            "Tried to advertise a service that is already advertised in this node [%s]; the first one answers. Give the "
            "second a name or a namespace of its own",
            resolved,
        )
        return _StandIn(resolved)


def publisher(name: str, kind: type, **more: Any) -> Any:
    """A ``rospy.Publisher`` on topic ``name``; where this node publishes another type there already, a stand-in without subscribers.

    :param kind: class of the messages
    :param more: as for ``rospy.Publisher``
    """
    if _of_another_type(name, kind, Registration.PUB, "advertise on"):
        return _StandIn(rospy.resolve_name(name))
    return rospy.Publisher(name, kind, **more)


def subscriber(name: str, kind: type, callback: Callable[[Any], None], **more: Any) -> Any:
    """A ``rospy.Subscriber`` of topic ``name``; where this node reads another type there already, a stand-in that never calls back.

    :param kind: class of the messages
    :param callback: is given each, in a thread of rospy
    :param more: as for ``rospy.Subscriber``
    """
    if _of_another_type(name, kind, Registration.SUB, "subscribe to"):
        return _StandIn(rospy.resolve_name(name))
    return rospy.Subscriber(name, kind, callback, **more)


def _of_another_type(name: str, kind: Any, side: str, verb: str) -> bool:
    resolved = rospy.resolve_name(name)
    there = get_topic_manager().get_impl(side, resolved)
    if there is None or there.data_class is None or there.data_class._type in (kind._type, "*"):
        return False
    if kind._type == "*":
        return False
    rospy.logerr(
        "Tried to %s topic [%s] with type [%s], but this node has it with type [%s] already; the second is left out. Give "
        "it a name or a namespace of its own",
        verb,
        resolved,
        kind._type,
        there.data_class._type,
    )
    return True

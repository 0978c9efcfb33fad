"""Whether the server of an action would hear a goal now, which rospy's actionlib cannot tell of a server that has died."""

from __future__ import annotations

import select
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import actionlib


def is_connected(client: actionlib.ActionClient) -> bool:
    """Whether all topics of the action of ``client`` are connected to one server that listens. Does not wait.

    A server that has died leaves its last status and, as rospy notices the end of a connection when it next writes, its subscriptions; a
    new one of the same name drops the goals that come before its first status.
    """
    status = client.last_status_msg
    if status is None or not any(link.header is status._connection_header for link in _links(client.status_sub)):
        return False
    server = status._connection_header["callerid"]
    reached = (any(link.endpoint_id == server for link in _links(topic)) for topic in (client.pub_goal, client.pub_cancel))
    # the header comes when the server has taken the subscription: what it published before is lost
    return all(reached) and all(any(link.header for link in _links(topic)) for topic in (client.result_sub, client.feedback_sub))


def _links(topic: Any) -> list:
    """The connections of a Publisher or Subscriber whose other end is there."""
    return [link for link in list(topic.impl.connections) if _is_open(link.socket)] if topic.impl is not None else []


def _is_open(place: Any) -> bool:
    """Whether the other end of a socket is still there; None is closed."""
    try:
        watch = select.poll()
        watch.register(place, select.POLLRDHUP)
        return not watch.poll(0)
    except (OSError, TypeError, ValueError):  # closed at this end, maybe at this moment
        return False

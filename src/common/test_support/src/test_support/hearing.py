"""Who hears whom, and how much, for tests that talk to nodes. Imports rospy, which nothing else here does."""

import xmlrpc.client
from collections.abc import Iterable
from typing import Any

import rosgraph
import rospy

from .waiting import wait_until


def _node(uri: str) -> Any:
    """The XML-RPC side of a node: what a call gives depends on the call."""
    return xmlrpc.client.ServerProxy(uri)


def heard(subscribers: Iterable[Any]) -> bool:
    """Whether every publisher of their topics, of which there is one at least, sends to this node. It is the publishers that are asked:
    a Subscriber's ``get_num_connections()`` counts a connection before it is made, and what is published until then is lost.

    :param subscribers: rospy.Subscribers of this node
    """
    master = rosgraph.Master(rospy.get_name())
    publishers = dict(master.getSystemState()[0])

    def sends(node: str, topic: str) -> bool:
        try:
            _, _, links = _node(master.lookupNode(node)).getBusInfo(rospy.get_name())
        except (rosgraph.MasterException, OSError):  # it has gone meanwhile
            return False
        return any(link[1] == rospy.get_name() and link[2] == "o" and link[4] == topic for link in links)

    return all(
        publishers.get(each.resolved_name) and all(sends(node, each.resolved_name) for node in publishers[each.resolved_name])
        for each in subscribers
    )


def _listening(publisher: Any) -> dict[str, int]:
    """How many messages of its topic each node that listens has received from this one, by the name of the node."""
    topic = publisher.resolved_name
    master = rosgraph.Master(rospy.get_name())
    found = {}
    for node in dict(master.getSystemState()[1]).get(topic, []):
        try:
            answer = _node(master.lookupNode(node)).getBusStats(rospy.get_name())
        except (rosgraph.MasterException, OSError):  # it has gone meanwhile
            answer = [[], [], []]
        statistics = answer[2] if isinstance(answer[0], int) else answer  # roscpp's has no code and no text before it
        links = dict(statistics[1]).get(topic, [])
        found[node] = sum(link[2] for link in links)
    return found


def received(publisher: Any, count: int) -> bool:
    """Whether every node that listens has received ``count`` messages from this one. rospy says that it has published a message while
    this is on its way, and a test that goes on by a service call overtakes it.

    :param publisher: a rospy.Publisher of this node, with one subscriber at least; ``count`` is what it has published since it has them
    """
    found = _listening(publisher)
    return bool(found) and all(each >= count for each in found.values())


def deliver(publisher: Any, message: Any) -> None:
    """Publish, and wait until every node that listens has received one message more.

    :param publisher: a rospy.Publisher of this node, with one subscriber at least
    :raises AssertionError: it does not come
    """
    before = _listening(publisher)
    publisher.publish(message)
    wait_until(
        lambda: all(each > before.get(node, 0) for node, each in _listening(publisher).items()), f"{publisher.resolved_name} to be heard"
    )

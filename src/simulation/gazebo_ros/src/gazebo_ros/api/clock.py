"""/clock."""

from __future__ import annotations

import rosgraph
import rospy
from node_signals import master_watch
from node_signals.rates import Spaced
from realtime_tools import make_prompt
from rosgraph_msgs.msg import Clock
from rospy.topics import get_topic_manager

from gazebo_ros.server import Server, WallLimit


def stand_as_subscriber() -> None:
    """Gazebo's node is among the subscribers of /clock, as every node in simulated time, and what shows the graph shows it so. This
    one takes its time from the world itself: master and bus info tell of a connection within the process, and no message is sent."""
    name, uri, topics = rospy.get_caller_id(), rospy.get_node_uri(), get_topic_manager()
    master = rosgraph.Master(name)
    own = [[0, other, direction, "INTRAPROCESS", "/clock", True] for other, direction in ((name, "o"), (uri, "i"))]
    others = topics.get_pub_sub_info
    topics.get_pub_sub_info = lambda: others() + own

    def register() -> None:
        master.registerSubscriber("/clock", Clock._type, uri)

    register()
    master_watch.on_return(register)
    rospy.on_shutdown(lambda: master.unregisterSubscriber("/clock", uri))


class ClockPublisher:
    """Publishes sim time before every step; after a run of steps ends, its last time.

    Latched, so that a node that starts while the simulation is paused sees the time (Gazebo's is not).

    :param frequency: Hz of sim time; 0 = every step
    """

    def __init__(self, server: Server, frequency: int = 0):
        self._server = server
        self._gate = Spaced(frequency)
        self._limit = WallLimit(server)
        self._message = Clock()
        self._published_ns = -1
        self._publisher = make_prompt(rospy.Publisher("/clock", Clock, queue_size=10, latch=True), 10)
        server.before_step(self._on_step)
        server.stepped.connect(self._publish)

    def _on_step(self) -> None:
        if self._gate.ready(self._server.now_ns) and self._limit.due():
            self._publish()

    def _publish(self) -> None:
        now_ns = self._server.now_ns
        if now_ns != self._published_ns:
            self._published_ns = now_ns
            self._gate.take(now_ns)
            self._message.clock = self._server.now()
            self._publisher.publish(self._message)

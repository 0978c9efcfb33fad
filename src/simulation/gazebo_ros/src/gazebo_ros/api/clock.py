"""/clock."""
from __future__ import annotations

import rospy
from realtime_tools import make_prompt
from rosgraph_msgs.msg import Clock

from gazebo_ros.server import Server, WallLimit


class ClockPublisher:
    """Publishes sim time before every step; after a run of steps ends, its last time.

    Latched, so that a node that starts while the simulation is paused sees the time (Gazebo's is not).

    :param frequency: Hz of sim time; 0 = every step
    """

    def __init__(self, server: Server, frequency: int = 0):
        self._server = server
        self._period_ns = round(1e9 / frequency) if frequency > 0 else 0
        self._limit = WallLimit(server)
        self._message = Clock()
        self._published_ns = -1
        self._publisher = make_prompt(rospy.Publisher("/clock", Clock, queue_size=10, latch=True), 10)
        server.before_step(self._on_step)
        server.stepped.connect(self._publish)

    def _on_step(self) -> None:
        elapsed = self._server.world.time_ns - self._published_ns
        if self._period_ns and self._published_ns >= 0 and 0 <= elapsed < self._period_ns:
            return
        if self._limit.passes():
            self._publish()

    def _publish(self) -> None:
        now_ns = self._server.world.time_ns
        if now_ns != self._published_ns:
            self._published_ns = now_ns
            self._message.clock = self._server.now()
            self._publisher.publish(self._message)

"""~performance_metrics: real-time factor and sensor rates, five times a wall second while somebody listens."""
from __future__ import annotations

import time
from typing import Dict, Tuple

import rospy
from gazebo_msgs.msg import PerformanceMetrics, SensorPerformanceMetric

from gazebo_ros.server import Server

_PERIOD_NS = 200_000_000
_RENDERED = ("camera", "depth", "depth_camera", "multicamera", "rgbd_camera", "wideanglecamera")


class MetricsPublisher:
    def __init__(self, server: Server):
        self._server = server
        self._publisher = rospy.Publisher("~performance_metrics", PerformanceMetrics, queue_size=10)
        self._wall_ns = time.monotonic_ns()
        self._sim_ns = server.world.time_ns
        self._counts: Dict[str, int] = {}
        server.after_step(self._on_step)
        server.stepped.connect(self._restart)  # a pause is no slow simulation

    def _on_step(self) -> None:
        if self._publisher.impl.connections and time.monotonic_ns() - self._wall_ns >= _PERIOD_NS:
            self._publish()

    def _publish(self) -> None:
        wall, sim = self._elapsed()
        message = PerformanceMetrics()
        message.header.stamp = self._server.now()
        message.real_time_factor = sim / wall
        for sensor in self._server.sensors:
            count = sensor.update_count - self._counts.get(sensor.scoped_name, sensor.update_count)
            self._counts[sensor.scoped_name] = sensor.update_count
            rate = count / wall
            message.sensors.append(SensorPerformanceMetric(
                f"{self._server.description.name}::{sensor.scoped_name}", count / sim if sim > 0 else 0.0, rate,
                rate if sensor.type in _RENDERED else -1.0))
        self._publisher.publish(message)

    def _restart(self) -> None:
        self._elapsed()

    def _elapsed(self) -> Tuple[float, float]:
        """(wall, sim) seconds since the last call."""
        wall_ns, sim_ns = time.monotonic_ns(), self._server.world.time_ns
        wall, sim = (wall_ns - self._wall_ns) / 1e9, max(sim_ns - self._sim_ns, 0) / 1e9
        self._wall_ns, self._sim_ns = wall_ns, sim_ns
        return wall, sim

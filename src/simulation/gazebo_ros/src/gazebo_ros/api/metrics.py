"""~performance_metrics: real-time factor and sensor rates, five times a wall second while somebody listens."""

from __future__ import annotations

import time

import rospy
from gazebo_msgs.msg import PerformanceMetrics, SensorPerformanceMetric

from gazebo_ros.sensors import Count
from gazebo_ros.server import Server

_NS = 1_000_000_000
_PERIOD_NS = 200_000_000
_LATE = 1.5  # periods without a measurement, after which a sensor is no longer taken to have its last rate
_RENDERED = ("camera", "depth", "depth_camera", "multicamera", "rgbd_camera", "wideanglecamera")


class _Rate:
    """Of one sensor: from the times of its measurements, so that it does not depend on where a message cuts them."""

    def __init__(self) -> None:
        self._before: Count | None = None
        self._rates = (0.0, 0.0)

    def read(self, now: Count, sim_ns: int) -> tuple[float, float]:
        """Hz of sim time and of wall time.

        :param now: what the sensor has counted. :param sim_ns: the time
        """
        before = self._before
        if before is None or now.number < before.number or now.sim_ns < before.sim_ns or not before.number:
            self._before, self._rates = now, (0.0, 0.0)
        elif now.number > before.number:
            made = (now.number - before.number) * _NS
            self._rates = (made / max(now.sim_ns - before.sim_ns, 1), made / max(now.wall_ns - before.wall_ns, 1))
            self._before = now
        elif (sim_ns - now.sim_ns) * self._rates[0] > _LATE * _NS:
            self._rates = (0.0, 0.0)
        return self._rates


class MetricsPublisher:
    """Rates of cameras are those of the pictures that were published: an update whose picture is left out does not count."""

    def __init__(self, server: Server):
        self._server = server
        self._publisher = rospy.Publisher("~performance_metrics", PerformanceMetrics, queue_size=10)
        self._wall_ns = time.monotonic_ns()
        self._sim_ns = server.world.time_ns
        self._rates: dict[str, _Rate] = {}
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
        for sensor in self._server.plugins.sensors:
            in_sim, in_wall = self._rates.setdefault(sensor.scoped_name, _Rate()).read(sensor.counted, self._sim_ns)
            message.sensors.append(
                SensorPerformanceMetric(
                    f"{self._server.description.name}::{sensor.scoped_name}", in_sim, in_wall, in_wall if sensor.type in _RENDERED else -1.0
                )
            )
        self._publisher.publish(message)

    def _restart(self) -> None:
        self._rates.clear()
        self._elapsed()

    def _elapsed(self) -> tuple[float, float]:
        """(wall, sim) seconds since the last call."""
        wall_ns, sim_ns = time.monotonic_ns(), self._server.world.time_ns
        wall, sim = (wall_ns - self._wall_ns) / 1e9, max(sim_ns - self._sim_ns, 0) / 1e9
        self._wall_ns, self._sim_ns = wall_ns, sim_ns
        return wall, sim

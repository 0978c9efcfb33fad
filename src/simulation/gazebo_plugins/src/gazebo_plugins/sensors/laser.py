"""libgazebo_ros_laser.so, libgazebo_ros_gpu_laser.so, _block_laser.so and _range.so: the same rays, three messages.

A ``gpu_ray`` sensor needs no GPU here: both kinds cast rays against collision shapes.
"""

from __future__ import annotations

import numpy as np
import rospy
from gazebo_ros import SdfElement, names
from gazebo_ros.plugin import PluginError, SensorPlugin
from geometry_msgs.msg import Point32
from node_signals.rates import Spaced
from ode_sim import math3
from sensor_msgs.msg import ChannelFloat32, LaserScan, PointCloud
from sensor_msgs.msg import Range as RangeMsg

from gazebo_plugins.ros_side import Topics, subscribed, told_namespace
from gazebo_plugins.sensors.noise import SdfNoise

_MOST_RAYS = 1_000_000


class _Scan:
    """``<scan>`` along one direction: ``samples`` values of ``resolution`` times as few rays."""

    def __init__(self, sdf: SdfElement | None, samples: int):
        self.samples = max(1, sdf.get("samples", samples)) if sdf else samples
        self.resolution = sdf.get("resolution", 1.0) if sdf else 1.0
        self.min_angle = sdf.get("min_angle", 0.0) if sdf else 0.0
        self.max_angle = sdf.get("max_angle", 0.0) if sdf else 0.0
        self.count = max(1, int(self.samples * self.resolution))  # values reported
        if self.resolution <= 0.0 or self.count * self.samples > _MOST_RAYS**2:
            raise PluginError(f"<samples>{self.samples}</samples> with <resolution>{self.resolution}</resolution> is not possible")

    def rays(self) -> np.ndarray:
        """(samples,) rad."""
        return np.linspace(self.min_angle, self.max_angle, self.samples)

    def reported(self) -> np.ndarray:
        """(count,) rad."""
        return np.linspace(self.min_angle, self.max_angle, self.count)

    @property
    def increment(self) -> float:
        """rad between reported values."""
        return (self.max_angle - self.min_angle) / (self.count - 1) if self.count > 1 else 0.0


def _directions(yaw: np.ndarray, pitch: np.ndarray) -> np.ndarray:
    """(V*H, 3) unit vectors in the sensor frame, row by row: of each of V pitch angles all H yaw angles."""
    yaw, pitch = (grid.ravel() for grid in np.meshgrid(yaw, pitch))
    return np.stack([np.cos(pitch) * np.cos(yaw), np.cos(pitch) * np.sin(yaw), np.sin(pitch)], axis=1)


class RayFan:
    """The ``<ray>`` block of a sensor: casts all rays from the sensor's pose.

    :raises PluginError: no ``<ray>``, or numbers that make no fan
    """

    def __init__(self, server, sensor):
        ray = SdfElement(sensor.description.element).child("ray")
        if ray is None:
            raise PluginError(f"sensor {sensor.scoped_name} of type '{sensor.type}' has no <ray> block")
        self.world, self.sensor = server.world, sensor
        scan, limits = ray.child("scan"), ray.child("range")
        self.horizontal = _Scan(scan and scan.child("horizontal"), 640)
        self.vertical = _Scan(scan and scan.child("vertical"), 1)
        self.min = limits.get("min", 0.0) if limits else 0.0
        self.max = limits.get("max", 0.0) if limits else 0.0
        if not 0.0 <= self.min < self.max:
            raise PluginError(f"sensor {sensor.scoped_name}: <range> min {self.min:g} must be below max {self.max:g}")
        if self.horizontal.samples * self.vertical.samples > _MOST_RAYS:
            raise PluginError(f"sensor {sensor.scoped_name}: more than {_MOST_RAYS} rays")
        self._noise = SdfNoise(ray.child("noise"), server.world.rng(sensor.scoped_name), usual="gaussian")
        self.directions_S = _directions(self.horizontal.rays(), self.vertical.rays())

    def reported_directions(self) -> np.ndarray:
        """(V*H, 3) unit vectors in the sensor frame, in the order of what :meth:`cast` returns."""
        return _directions(self.horizontal.reported(), self.vertical.reported())

    def cast(self, clipped: bool = False):
        """(ranges (V*H,) m, +inf beyond max and -inf up to min, REP-117; intensities (V*H,)), row by row from below.

        Within min the sensor sees other models only, not the robot it is built into.

        :param clipped: max and min instead of the infinities
        """
        pose = math3.compose(self.sensor.link.pose, self.sensor.description.pose)
        rotation = np.array(math3.quat_to_matrix(pose.q))
        directions = self.directions_S @ rotation.T
        # Rays start at the near limit, so that what stands inside it (the robot's own housing) does not hide the world.
        centres = np.broadcast_to(pose.p, directions.shape)
        distances, hits = self.world.cast_rays(centres + self.min * directions, directions, self.max - self.min)
        ranges = distances + self.min
        if self.min > 0.0:
            housing = [collision for link in self.sensor.model.links.values() for collision in link.collisions.values()]
            too_close, _ = self.world.cast_rays(centres, directions, self.min, housing)
            ranges[np.isfinite(too_close)] = -np.inf
        retro = self._retro(hits)
        ranges = self._resample(np.clip(ranges, self.min, self.max) if clipped else ranges)
        intensities = self._resample(retro, nearest=True)
        far, near = ranges >= self.max, ranges <= self.min
        if self._noise.active:  # of what is in range, and it stays there
            ranges = np.where(far | near, ranges, np.clip(self._noise(ranges), self.min, self.max))
        if not clipped:
            ranges = np.where(far, np.inf, np.where(near, -np.inf, ranges))
        return ranges, intensities

    def _retro(self, hits: np.ndarray) -> np.ndarray:
        """``<laser_retro>`` of what each ray hit; 0 where it hit nothing."""
        ids, places = np.unique(hits, return_inverse=True)
        collisions = [self.world.collision(index) for index in ids]
        return np.array([collision.laser_retro if collision else 0.0 for collision in collisions])[places]

    def _resample(self, values: np.ndarray, nearest: bool = False) -> np.ndarray:
        """From rays to reported values, when <resolution> is not 1: linear between neighbouring rays."""
        h, v = self.horizontal, self.vertical
        if h.count == h.samples and v.count == v.samples:
            return values
        grid: np.ndarray = values.reshape(v.samples, h.samples)
        for axis, scan in ((1, h), (0, v)):
            if scan.count == scan.samples:
                continue
            at = np.linspace(0.0, scan.samples - 1.0, scan.count)
            low = np.floor(at).astype(int)
            high = np.minimum(low + 1, scan.samples - 1)
            weight = np.round(at - low) if nearest else at - low
            weight = weight if axis == 1 else weight[:, None]
            a, b = np.take(grid, low, axis), np.take(grid, high, axis)
            with np.errstate(invalid="ignore"):
                grid = np.where(weight == 0.0, a, np.where(weight == 1.0, b, (1 - weight) * a + weight * b))
        return grid.ravel()


class Laser(SensorPlugin):
    """sensor_msgs/LaserScan at the sensor's rate, while somebody listens."""

    def load(self, server, sensor, sdf) -> None:
        self.fan = RayFan(server, sensor)
        self.topics = Topics(sdf, sensor.model.name, "B")
        given = told_namespace(sdf, sensor.model.name, "Laser")
        rospy.loginfo("Starting Laser Plugin (ns = %s)", given)
        kind = "GPU Laser" if sensor.type == "gpu_ray" else "Laser"
        rospy.loginfo('%s Plugin (ns = %s) <tf_prefix_>, set to "%s"', kind, given, names.tf_prefix(self.topics.namespace))
        message = self.message = LaserScan()
        message.header.frame_id = self.topics.frame(sdf.text_or("frameName", "/world"))
        scan = self.fan.horizontal
        message.angle_min, message.angle_max, message.angle_increment = scan.min_angle, scan.max_angle, scan.increment
        message.range_min, message.range_max = self.fan.min, self.fan.max
        self.publisher = self.topics.publisher(sdf.text_or("topicName", "/world"), LaserScan)
        sensor.connect(self.measure, subscribed(self.publisher))

    def measure(self, sensor) -> None:
        message = self.message
        message.header.stamp = sensor.measurement_time
        message.ranges, message.intensities = self.fan.cast()
        self.publisher.publish(message)

    def shutdown(self) -> None:
        self.topics.close()


class BlockLaser(SensorPlugin):
    """sensor_msgs/PointCloud of the hits in the sensor frame; a ray that hits nothing ends at max, one too short at min.
    ``<hokuyoMinIntensity>`` has no effect, upstream neither."""

    def load(self, server, sensor, sdf) -> None:
        self.fan = RayFan(server, sensor)
        self.topics = Topics(sdf, sensor.model.name, "C")
        self.frame = self.topics.frame(sdf.text_or("frameName", "/world"))
        self.directions_S = self.fan.reported_directions()
        self.sigma = sdf.get("gaussianNoise", 0.0)
        self.rng = server.world.rng(sensor.scoped_name + "/block_laser")
        self.publisher = self.topics.publisher(sdf.text_or("topicName", "/world"), PointCloud)
        sensor.connect(self.measure, subscribed(self.publisher))

    def measure(self, sensor) -> None:
        ranges, intensities = self.fan.cast(clipped=True)
        points = self.directions_S * ranges[:, None]
        if self.sigma:  # of what was hit, and of all intensities
            noise = self.sigma * self.rng.standard_normal(points.shape)
            points = points + np.where(ranges[:, None] < self.fan.max, noise, 0.0)
            intensities = intensities + self.sigma * self.rng.standard_normal(len(intensities))
        message = PointCloud()
        message.header.stamp, message.header.frame_id = sensor.measurement_time, self.frame
        message.points = [Point32(*map(float, point)) for point in points]
        message.channels = [ChannelFloat32("", intensities.tolist())]
        self.publisher.publish(message)

    def shutdown(self) -> None:
        self.topics.close()


class Range(SensorPlugin):
    """sensor_msgs/Range: the nearest of all rays; nothing in sight reads max_range."""

    def load(self, server, sensor, sdf) -> None:
        self.fan = RayFan(server, sensor)
        self.topics = Topics(sdf, sensor.model.name, "C")
        message = self.message = RangeMsg()
        message.header.frame_id = self.topics.frame(sdf.text_or("frameName", "/world"))
        ultrasound = (sdf.text_or("radiation", "ultrasound")) == "ultrasound"
        message.radiation_type = RangeMsg.ULTRASOUND if ultrasound else RangeMsg.INFRARED
        message.field_of_view = sdf.get("fov", 0.05)
        message.min_range, message.max_range = self.fan.min, self.fan.max
        self.sigma = sdf.get("gaussianNoise", 0.0)
        self.rng = server.world.rng(sensor.scoped_name + "/range")
        self.gate = Spaced(sdf.get("updateRate", 0.0))
        self.publisher = self.topics.publisher(sdf.text_or("topicName", "/range"), RangeMsg)
        sensor.connect(self.measure, subscribed(self.publisher))

    def measure(self, sensor) -> None:
        if not self.gate.due(sensor.measurement_ns):
            return
        ranges, _ = self.fan.cast()
        nearest = float(np.min(ranges))
        nearest = min(max(nearest, self.fan.min), self.fan.max)
        if nearest < self.fan.max and self.sigma:
            nearest = min(nearest + self.sigma * self.rng.standard_normal(), self.fan.max)
        self.message.header.stamp = sensor.measurement_time
        self.message.range = nearest
        self.publisher.publish(self.message)

    def shutdown(self) -> None:
        self.topics.close()

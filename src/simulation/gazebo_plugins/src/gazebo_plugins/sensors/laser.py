"""libgazebo_ros_laser.so, libgazebo_ros_gpu_laser.so, _block_laser.so and _range.so: the same rays, three messages.

A ``gpu_ray`` sensor needs no GPU here: both kinds cast rays against collision shapes. Where there is one, many rays of it are pictures.
"""

from __future__ import annotations

import numpy as np
import rospy
from gazebo_ros import SdfElement, names
from gazebo_ros.plugin import PluginError, SensorPlugin
from geometry_msgs.msg import Point32
from node_signals.rates import Spaced
from ode_sim import _core, math3
from ode_sim.errors import CameraError
from sensor_msgs.msg import ChannelFloat32, LaserScan, PointCloud
from sensor_msgs.msg import Range as RangeMsg

from gazebo_plugins.ros_side import Topics, sensor_element, subscribed, told_namespace
from gazebo_plugins.sensors import ray_pictures
from gazebo_plugins.sensors.noise import SdfNoise
from gazebo_plugins.sensors.ray_pictures import RayPictures
from gazebo_plugins.sensors.two_rates import tell_what_is_left


class RayFan:
    """The ``<ray>`` block of a sensor: casts all rays from the sensor's pose. The law is ``ray_fan.hpp`` of ode_sim.

    :raises PluginError: no ``<ray>``, or numbers that make no fan
    """

    def __init__(self, server, sensor):
        ray = sensor_element(sensor).child("ray")
        if ray is None:
            raise PluginError(f"sensor {sensor.scoped_name} of type '{sensor.type}' has no <ray> block")
        self.world, self.sensor = server.world, sensor
        scan, limits = ray.child("scan"), ray.child("range")
        self.min, self.max = (limits.get(tag, 0.0) if limits else 0.0 for tag in ("min", "max"))
        try:
            self.fan = _core.RayFan(_scan(scan, "horizontal", 640), _scan(scan, "vertical", 1), self.min, self.max)
        except ValueError as error:
            raise PluginError(f"sensor {sensor.scoped_name}: {error}") from error
        self.horizontal, self.vertical = self.fan.horizontal, self.fan.vertical
        self._pictures = self._by_pictures(server, sensor)
        self._noise = SdfNoise(ray.child("noise"), server.world.rng(sensor.scoped_name), usual="gaussian")

    def reported_directions(self) -> np.ndarray:
        """(V*H, 3) unit vectors in the sensor frame, in the order of what :meth:`cast` returns."""
        return self.fan.told_directions

    def cast(self, clipped: bool = False):
        """(ranges (V*H,) m, +inf beyond max and -inf up to min, REP-117; intensities (V*H,)), row by row from below.

        Within min the sensor sees other models only, not the robot it is built into.

        :param clipped: max and min instead of the infinities
        """
        rays, retros = self._measured()
        ranges, intensities = self.fan.between(rays), self.fan.mean(retros)
        told = self.fan.told(ranges)
        inside = np.isfinite(told)
        if self._noise.active:  # of what is in range, and it stays there
            ranges = np.where(inside, np.clip(self._noise(ranges), self.min, self.max), ranges)
        return ranges if clipped else np.where(inside, ranges, told), intensities

    def _measured(self) -> tuple[np.ndarray, np.ndarray]:
        """Of each ray: its range within [min, max], m, and the retro of what it hit."""
        pictured = self._pictures.cast() if self._pictures is not None else None
        if pictured is not None:
            return np.clip(pictured[0], self.min, self.max), pictured[1]
        pose = math3.compose(self.sensor.link.pose, self.sensor.description.pose)
        housing = [collision.id for link in self.sensor.model.links.values() for collision in link.collisions.values()]
        rays, hits = self.fan.cast(self.world.core, (*pose.p, *pose.q), housing)
        return rays, self._retro(hits)

    def _by_pictures(self, server, sensor) -> RayPictures | None:
        across, up = (_core.RayScan(scan.samples, 1.0, scan.min_angle, scan.max_angle) for scan in (self.horizontal, self.vertical))
        if not ray_pictures.wanted(sensor.type, across.samples * up.samples):
            return None
        rays = _core.RayFan(across, up, self.min, self.max).told_directions.reshape(up.samples, across.samples, 3)
        yaws, pitches = np.unwrap(np.arctan2(rays[0, :, 1], rays[0, :, 0])), np.arcsin(rays[:, 0, 2])
        try:
            return RayPictures(server, sensor, yaws, pitches, self.min, self.max)
        except CameraError as error:
            rospy.logwarn("sensor %s casts its rays against collisions: %s", sensor.scoped_name, error)
            return None

    def close(self) -> None:
        if self._pictures is not None:
            self._pictures.close()

    def _retro(self, hits: np.ndarray) -> np.ndarray:
        """``<laser_retro>`` of what each ray hit; 0 where it hit nothing."""
        ids, places = np.unique(hits, return_inverse=True)
        collisions = [self.world.collision(index) for index in ids]
        return np.array([collision.laser_retro if collision else 0.0 for collision in collisions])[places]


def _scan(scan: SdfElement | None, direction: str, samples: int) -> _core.RayScan:
    sdf = scan.child(direction) if scan else None
    if sdf is None:
        return _core.RayScan(samples, 1.0, 0.0, 0.0)
    count = min(max(sdf.get("samples", samples), 0), 2**31 - 1)
    return _core.RayScan(count, sdf.get("resolution", 1.0), sdf.get("min_angle", 0.0), sdf.get("max_angle", 0.0))


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
        message.angle_min, message.angle_max, message.angle_increment = scan.min_angle, scan.max_angle, scan.step
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
        self.fan.close()


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
        self.fan.close()


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
        rate = sdf.get("updateRate", 0.0)
        self.gate = Spaced(rate)
        tell_what_is_left(sensor, rate, "updateRate", server.world.dt)
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
        self.fan.close()

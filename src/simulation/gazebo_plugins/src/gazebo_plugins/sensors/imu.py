"""libgazebo_ros_imu.so (model plugin) and libgazebo_ros_imu_sensor.so (sensor plugin): sensor_msgs/Imu.

The two differ upstream and packages know it: the model plugin's acceleration is the bare derivative of velocity (0 at
rest), the sensor's includes the reaction to gravity (+9.8 along z at rest).
"""

from __future__ import annotations

import numpy as np
from gazebo_ros.plugin import ModelPlugin, SensorPlugin
from geometry_msgs.msg import Quaternion, Vector3
from node_signals.rates import Spaced
from ode_sim import math3
from ode_sim.description.urdf_extensions import given_offset, merged_at
from sensor_msgs.msg import Imu
from std_srvs.srv import Empty, EmptyResponse

from gazebo_plugins.ros_side import Noise, Topics, diagonal, find_link, required, sensor_element, subscribed
from gazebo_plugins.sensors.noise import SdfNoise, axis_noise
from gazebo_plugins.sensors.two_rates import tell_what_is_left


class Differentiator:
    """Acceleration of a point of a link in the world frame, by the difference of its velocity between two calls.

    :param at: the point in the link frame, m
    """

    def __init__(self, link, at=(0.0, 0.0, 0.0)):
        self._link, self._at = link, at
        self._last = None  # (time_ns, velocity)

    def __call__(self, time_ns: int) -> np.ndarray:
        """(3,) m/s^2; zero at the first call and after time went back."""
        velocity = np.array(self._link.velocity_at(math3.transform(self._link.pose, self._at)))
        last, self._last = self._last, (time_ns, velocity)
        if last is None or time_ns <= last[0]:
            return np.zeros(3)
        return (velocity - last[1]) / ((time_ns - last[0]) * 1e-9)


class ImuPlugin(ModelPlugin):
    """Orientation, rates and acceleration of one link, expressed as upstream does (see docs/differences.md)."""

    def load(self, server, model, sdf) -> None:
        self.server = server
        self.topics = Topics(sdf, model.name, "C")
        self.link = find_link(model, server.world, sdf)
        self.merged, given = merged_at(sdf.element, "bodyName"), given_offset(sdf.element)
        self.offset = math3.quat_from_rpy(*(given[1] if given else sdf.get("rpyOffset", (0.0, 0.0, 0.0))))
        sigma = sdf.get("gaussianNoise", 0.0)
        self.noise = Noise(server.world.rng(f"{model.name}/imu/{self.link.name}"), sigma)
        self.acceleration = Differentiator(self.link, self.merged.p)
        message = self.message = Imu()
        message.header.frame_id = sdf.get("frameName", "") or self.link.name
        for name in ("orientation_covariance", "angular_velocity_covariance", "linear_acceleration_covariance"):
            setattr(message, name, diagonal((sigma * sigma,) * 3))
        self.publisher = self.topics.publisher(sdf.text_or("topicName", "/default_imu"), Imu)
        service = sdf.get("serviceName", "/default_imu")
        if service:
            self.topics.service(service, Empty, lambda _: EmptyResponse())
        self.gate = Spaced(sdf.get("updateRate", 0.0))
        server.after_step(self.step)

    def step(self) -> None:
        now = self.server.now()
        if not self.publisher.get_num_connections() or not self.gate.due(now.to_nsec()):
            return
        q_WL = math3.quat_multiply(self.offset, math3.quat_multiply(self.link.pose.q, self.merged.q))
        q_LW = math3.quat_inverse(q_WL)
        message = self.message
        message.header.stamp = now
        message.orientation = Quaternion(*q_WL)
        message.angular_velocity = Vector3(*self.noise.vector(math3.quat_rotate(q_LW, self.link.angular_velocity())))
        acceleration = tuple(self.acceleration(now.to_nsec()))
        message.linear_acceleration = Vector3(*self.noise.vector(math3.quat_rotate(q_LW, acceleration)))
        self.publisher.publish(message)

    def shutdown(self) -> None:
        self.topics.close()


class ImuSensor(SensorPlugin):
    """Rates and accelerations in the sensor frame; orientation in the world frame, or relative to the first one."""

    def load(self, server, sensor, sdf) -> None:
        self.world, self.sensor = server.world, sensor
        self.topics = Topics(sdf, sensor.model.name, "D")
        rng = server.world.rng(sensor.scoped_name)
        imu = sensor_element(sensor).child("imu")
        groups = [imu and imu.child(tag) for tag in ("angular_velocity", "linear_acceleration")]
        self.axis_noise = [[SdfNoise(axis_noise(group, axis), rng) for axis in "xyz"] for group in groups]
        sigma = sdf.get("gaussianNoise", 0.0)
        self.noise = Noise(rng, sigma)
        self.offset = math3.quat_from_rpy(*sdf.get("rpyOffset", (0.0, 0.0, 0.0)))
        message = self.message = Imu()
        message.header.frame_id = required(sdf, "frameName")
        for name in ("orientation_covariance", "angular_velocity_covariance", "linear_acceleration_covariance"):
            setattr(message, name, diagonal((sigma * sigma,) * 3))
        self.reference = math3.quat_inverse(self._orientation()) if sdf.get("initialOrientationAsReference", False) else None
        self.acceleration = Differentiator(sensor.link, sensor.description.pose.p)
        self.last_ns = 0
        rate = sdf.get("updateRateHZ", 1.0)
        self.gate = Spaced(rate)
        tell_what_is_left(sensor, rate, "updateRateHZ", server.world.dt)
        self.publisher = self.topics.publisher(sdf.text_or("topicName", "imu_data"), Imu)
        sensor.connect(self.measure, subscribed(self.publisher))

    def _orientation(self):
        return math3.quat_multiply(self.sensor.link.pose.q, self.sensor.description.pose.q)

    def measure(self, sensor) -> None:
        now_ns = sensor.measurement_ns
        acceleration_W = self.acceleration(now_ns) - np.asarray(self.world.gravity)
        if not self.gate.due(now_ns):
            return
        dt, self.last_ns = (now_ns - self.last_ns) * 1e-9, now_ns
        q_WS = self._orientation()
        q_SW = math3.quat_inverse(q_WS)
        rates = math3.quat_rotate(q_SW, sensor.link.angular_velocity())
        acceleration = math3.quat_rotate(q_SW, tuple(acceleration_W))
        noisy_rates = [noise(value, dt) for noise, value in zip(self.axis_noise[0], rates)]
        noisy_acceleration = [noise(value, dt) for noise, value in zip(self.axis_noise[1], acceleration)]
        orientation = math3.quat_multiply(self.reference, q_WS) if self.reference else q_WS
        orientation = math3.quat_multiply(self.offset, orientation)
        message = self.message
        message.header.stamp = sensor.measurement_time
        message.orientation = Quaternion(*self.noise.vector(orientation))
        message.angular_velocity = Vector3(*self.noise.vector(noisy_rates))
        message.linear_acceleration = Vector3(*self.noise.vector(noisy_acceleration))
        self.publisher.publish(message)

    def shutdown(self) -> None:
        self.topics.close()

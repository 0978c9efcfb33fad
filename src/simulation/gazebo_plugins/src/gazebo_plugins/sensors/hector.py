"""The hector_gazebo_plugins that robot descriptions carry: IMU, GPS, sonar and magnetometer with drifting errors."""

from __future__ import annotations

import math

import numpy as np
from gazebo_ros.plugin import ModelPlugin, SensorPlugin
from geometry_msgs.msg import Quaternion, Vector3, Vector3Stamped
from node_signals.rates import PeriodAdded
from ode_sim import math3
from ode_sim.description.xmlsource import leading_numbers
from sensor_msgs.msg import Imu, MagneticField, NavSatFix, NavSatStatus
from sensor_msgs.msg import Range as RangeMsg
from std_srvs.srv import Empty, EmptyResponse

from gazebo_plugins.ros_side import Topics, diagonal, find_link, subscribed
from gazebo_plugins.sensors.imu import Differentiator
from gazebo_plugins.sensors.laser import RayFan

_EQUATOR, _ECCENTRICITY_SQUARED = 6378137.0, 6.69437999014e-3  # WGS 84, m


class DriftingError:
    """Offset, a slowly wandering drift (first-order Gauss-Markov process) and white noise on each axis.

    :param prefix: of the tags: ``accelDrift``, ``accelGaussianNoise`` ... or ``drift``, ``gaussianNoise`` with ''
    :param size: number of axes; one number in the file serves all
    """

    def __init__(self, sdf, prefix: str, size: int, rng):
        def read(name: str, default: float) -> np.ndarray:
            tag = prefix + name if prefix else name[0].lower() + name[1:]
            numbers = leading_numbers(sdf.get(tag, ""), size)
            return np.full(size, default) if not numbers else np.resize(np.array(numbers), size)

        self.offset, self.drift = read("Offset", 0.0), read("Drift", 0.0)
        self.frequency, self.sigma = read("DriftFrequency", 1.0 / 3600.0), read("GaussianNoise", 0.0)
        self._rng = rng
        self.current = self.drift * rng.standard_normal(size)

    def __call__(self, dt: float) -> np.ndarray:
        """(size,) error after ``dt`` seconds more."""
        decay = np.exp(-dt * self.frequency)
        step = np.sqrt(1 - decay * decay) * self.drift
        self.current = decay * self.current + step * self._rng.standard_normal(len(step))
        return self.offset + self.current + self.sigma * self._rng.standard_normal(len(self.sigma))


class _BodyPlugin(ModelPlugin):
    """Common start: namespace, link, rate."""

    def _start(self, server, model, sdf, rate: float) -> None:
        self.server = server
        self.topics = Topics(sdf, model.name, "C")
        self.link = find_link(model, server.world, sdf) if sdf.get("bodyName", "") else next(iter(model.links.values()))
        self.gate = PeriodAdded(sdf.get("updateRate", rate))
        server.after_step(self.step)

    def step(self) -> None:
        raise NotImplementedError

    def shutdown(self) -> None:
        self.topics.close()


class HectorImu(_BodyPlugin):
    """Rates and acceleration (with the reaction to gravity) in the body frame, orientation in the world's."""

    def load(self, server, model, sdf) -> None:
        self._start(server, model, sdf, 0.0)
        rng = server.world.rng(f"{model.name}/hector_imu/{self.link.name}")
        self.accel, self.rate, self.yaw = (DriftingError(sdf, prefix, n, rng) for prefix, n in (("accel", 3), ("rate", 3), ("yaw", 1)))
        if sdf.get("gaussianNoise", 0.0):
            self.accel.sigma = np.full(3, sdf.get("gaussianNoise", 0.0))
        self.offset = math3.quat_from_rpy(*sdf.get("rpyOffset", sdf.get("rpyOffsets", (0.0, 0.0, 0.0))))
        topic = sdf.text_or("topicName", "imu")
        self.publisher = self.topics.publisher(topic, Imu, 10)
        self.topics.service(sdf.text_or("serviceName", topic + "/calibrate"), Empty, self._calibrate)
        message = self.message = Imu()
        message.header.frame_id = sdf.get("frameId", self.link.name) or self.link.name
        message.angular_velocity_covariance = diagonal(self.rate.sigma**2)
        message.linear_acceleration_covariance = diagonal(self.accel.sigma**2)
        message.orientation_covariance = diagonal((self.accel.sigma[0] ** 2,) * 2 + (self.yaw.sigma[0] ** 2,))
        self.acceleration = Differentiator(self.link)

    def _calibrate(self, _) -> EmptyResponse:
        for error in (self.accel, self.rate, self.yaw):
            error.current = np.zeros_like(error.current)
        return EmptyResponse()

    def step(self) -> None:
        now = self.server.now()
        if not self.publisher.get_num_connections():
            return
        if not self.gate.due(now.to_nsec()):
            return
        dt = self.gate.elapsed
        q_WB = math3.quat_multiply(self.link.pose.q, self.offset)
        q_BW = math3.quat_inverse(q_WB)
        acceleration_W = self.acceleration(now.to_nsec()) - np.asarray(self.server.world.gravity)
        acceleration = math3.quat_rotate(q_BW, tuple(acceleration_W)) + self.accel(dt)
        rates = math3.quat_rotate(q_BW, self.link.angular_velocity()) + self.rate(dt)
        heading = math3.quat_from_rpy(0.0, 0.0, float(self.yaw(dt)[0]))
        message = self.message
        message.header.stamp = now
        message.orientation = Quaternion(*math3.quat_multiply(heading, q_WB))
        message.angular_velocity, message.linear_acceleration = Vector3(*rates), Vector3(*acceleration)
        self.publisher.publish(message)


class HectorGps(_BodyPlugin):
    """sensor_msgs/NavSatFix around a reference point, and the velocity (north, west, up)."""

    def load(self, server, model, sdf) -> None:
        self._start(server, model, sdf, 4.0)
        reference = [
            sdf.get("referenceLatitude", 49.9),
            sdf.get("referenceLongitude", 8.9),
            math.radians(sdf.get("referenceHeading", 0.0)),
            sdf.get("referenceAltitude", 0.0),
        ]
        if sdf.get("useWorldSphericalCoordinates", False):
            latitude, longitude, elevation, heading = server.description.spherical_coordinates
            reference = [latitude, longitude, math.pi / 2 - math.radians(heading), elevation]
        self.latitude, self.longitude, self.heading, self.altitude = reference
        sine = 1.0 - _ECCENTRICITY_SQUARED * math.sin(math.radians(self.latitude)) ** 2
        prime_vertical = _EQUATOR / math.sqrt(sine)
        self.radius_north = prime_vertical * (1.0 - _ECCENTRICITY_SQUARED) / sine
        self.radius_east = prime_vertical * math.cos(math.radians(self.latitude))
        rng = server.world.rng(f"{model.name}/hector_gps/{self.link.name}")
        self.position_error = DriftingError(sdf, "", 3, rng)
        self.velocity_error = DriftingError(sdf, "velocity", 3, rng)
        self.frame = sdf.text_or("frameId", "/world")
        self.fix = self.topics.publisher(sdf.text_or("topicName", "fix"), NavSatFix, 10)
        self.velocity = self.topics.publisher(sdf.text_or("velocityTopicName", "fix_velocity"), Vector3Stamped, 10)
        self.status = sdf.get("status", NavSatStatus.STATUS_FIX)
        self.service_code = sdf.get("service", NavSatStatus.SERVICE_GPS)

    def _north_west(self, x: float, y: float) -> tuple[float, float]:
        cos, sin = math.cos(self.heading), math.sin(self.heading)
        return cos * x + sin * y, cos * y - sin * x

    def step(self) -> None:
        now = self.server.now()
        if not self.gate.due(now.to_nsec()) or not (self.fix.get_num_connections() or self.velocity.get_num_connections()):
            return
        dt = self.gate.elapsed
        x, y, z = np.array(self.link.pose.p) + self.position_error(dt)
        north, west = self._north_west(x, y)
        message = NavSatFix()
        message.header.stamp, message.header.frame_id = now, self.frame
        message.status.status, message.status.service = self.status, self.service_code
        message.latitude = self.latitude + math.degrees(north / self.radius_north)
        message.longitude = self.longitude - math.degrees(west / self.radius_east)
        message.altitude = self.altitude + z
        error = self.position_error
        message.position_covariance = diagonal(error.drift**2 + error.sigma**2)
        message.position_covariance_type = NavSatFix.COVARIANCE_TYPE_DIAGONAL_KNOWN
        self.fix.publish(message)
        vx, vy, vz = np.array(self.link.linear_velocity()) + self.velocity_error(dt)
        velocity = Vector3Stamped()
        velocity.header = message.header
        velocity.vector = Vector3(*self._north_west(vx, vy), vz)
        self.velocity.publish(velocity)


class HectorMagnetic(_BodyPlugin):
    """The earth's field in the body frame, magnitude 1 unless given."""

    def load(self, server, model, sdf) -> None:
        self._start(server, model, sdf, 0.0)
        heading = math.radians(sdf.get("referenceHeading", 0.0))
        if sdf.get("useWorldSphericalCoordinates", False):
            heading = math.pi / 2 - math.radians(server.description.spherical_coordinates[3])
        declination, dip = math.radians(sdf.get("declination", 0.0)), math.radians(sdf.get("inclination", 60.0))
        magnitude = sdf.get("magnitude", 1.0)
        self.field_W = (
            magnitude * math.cos(dip) * math.cos(heading - declination),
            magnitude * math.cos(dip) * math.sin(heading - declination),
            -magnitude * math.sin(dip),
        )
        self.error = DriftingError(sdf, "", 3, server.world.rng(f"{model.name}/hector_magnetic/{self.link.name}"))
        self.frame = sdf.get("frameId", self.link.name) or self.link.name
        self.kind = MagneticField if sdf.get("useMagneticFieldMsgs", False) else Vector3Stamped
        self.publisher = self.topics.publisher(sdf.text_or("topicName", "magnetic"), self.kind)

    def step(self) -> None:
        now = self.server.now()
        if not self.gate.due(now.to_nsec()) or not self.publisher.get_num_connections():
            return
        dt = self.gate.elapsed
        field = np.array(math3.quat_rotate(math3.quat_inverse(self.link.pose.q), self.field_W)) + self.error(dt)
        message = self.kind()
        message.header.stamp, message.header.frame_id = now, self.frame
        setattr(message, "magnetic_field" if self.kind is MagneticField else "vector", Vector3(*field))
        self.publisher.publish(message)


class HectorSonar(SensorPlugin):
    """The nearest ray as sensor_msgs/Range; the field of view is the smaller side of the ray fan."""

    def load(self, server, sensor, sdf) -> None:
        self.fan = RayFan(server, sensor)
        self.topics = Topics(sdf, sensor.model.name, "C")
        self.error = DriftingError(sdf, "", 1, server.world.rng(sensor.scoped_name + "/sonar"))
        message = self.message = RangeMsg()
        message.header.frame_id = sdf.text_or("frameId", "/sonar_link")
        message.radiation_type = RangeMsg.ULTRASOUND
        message.field_of_view = min(abs(scan.max_angle - scan.min_angle) for scan in (self.fan.horizontal, self.fan.vertical))
        message.min_range, message.max_range = self.fan.min, self.fan.max
        self.last_ns = 0
        self.publisher = self.topics.publisher(sdf.text_or("topicName", "sonar"), RangeMsg)
        sensor.connect(self.measure, subscribed(self.publisher))

    def measure(self, sensor) -> None:
        dt, self.last_ns = max(0.0, (sensor.measurement_ns - self.last_ns) * 1e-9), sensor.measurement_ns
        nearest = min(max(float(np.min(self.fan.cast()[0])), self.fan.min), self.fan.max)
        if nearest < self.fan.max:
            nearest = min(max(nearest + float(self.error(dt)[0]), self.fan.min), self.fan.max)
        self.message.header.stamp, self.message.range = sensor.measurement_time, nearest
        self.publisher.publish(self.message)

    def shutdown(self) -> None:
        self.topics.close()
        self.fan.close()

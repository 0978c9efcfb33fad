"""The hector_gazebo_plugins that robot descriptions carry: IMU, GPS, sonar and magnetometer with drifting errors."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import rospy
from dynamic_parameters import Parameter
from dynamic_parameters import Server as ParameterServer
from gazebo_ros.plugin import ModelPlugin, SensorPlugin
from geometry_msgs.msg import Quaternion, Vector3, Vector3Stamped
from hector_gazebo_plugins.srv import SetBias, SetBiasResponse, SetReferenceGeoPose, SetReferenceGeoPoseResponse
from node_signals.rates import LatenessKept, PeriodAdded
from ode_sim import math3
from ode_sim.description.urdf_extensions import merged_at
from sensor_msgs.msg import Imu, MagneticField, NavSatFix, NavSatStatus
from sensor_msgs.msg import Range as RangeMsg
from std_srvs.srv import Empty, EmptyResponse

from gazebo_plugins.ros_side import Topics, diagonal, find_link, subscribed
from gazebo_plugins.sensors.drifting import DriftingError, error_parameters
from gazebo_plugins.sensors.imu import Differentiator
from gazebo_plugins.sensors.laser import RayFan

_EQUATOR, _ECCENTRICITY_SQUARED = 6378137.0, 6.69437999014e-3  # WGS 84, m


class _BodyPlugin(ModelPlugin):
    """Common start: namespace, link, rate; errors with their parameters, which a reset draws anew."""

    def _start(self, server, model, sdf, rate: float) -> None:
        self.server = server
        self.topics = Topics(sdf, model.name, "C")
        self.link = find_link(model, server.world, sdf) if sdf.get("bodyName", "") else next(iter(model.links.values()))
        self.merged = merged_at(sdf.element, "bodyName")  # where the sensor's link was on the one that is left of it
        self.gate = PeriodAdded(sdf.get("updateRate", rate))
        self.errors: dict[str, DriftingError] = {}
        self.parameters: list[ParameterServer] = []
        server.after_step(self.step)

    def _offer(self, errors: dict[str, DriftingError]) -> None:
        """dynamic_reconfigure of ``errors``, by name in the plugin's namespace."""
        self.errors = errors
        self.parameters += [error_parameters(self.server, self.topics.resolve(name), error) for name, error in errors.items()]

    def step(self) -> None:
        raise NotImplementedError

    def reset(self) -> None:
        for error in self.errors.values():
            error.reset()

    def shutdown(self) -> None:
        for parameters in self.parameters:
            parameters.shutdown()
        self.topics.close()


def _world_heading(server, sdf) -> float:
    """Of the x axis against north, rad clockwise, as ``<referenceHeading>`` says; else as the world does, where the plugin's element
    ``sdf`` asks for that."""
    heading = 0.0
    if sdf.get("useWorldSphericalCoordinates", False):  # there it is from east, counter-clockwise
        heading = 90.0 - server.description.spherical_coordinates[3]
    return math.radians(sdf.get("referenceHeading", heading))


class HectorImu(_BodyPlugin):
    """Rates and acceleration (with the reaction to gravity) in the body frame, orientation in the world's.

    The orientation is that of a level and a compass: the bias of the accelerometer tilts it, as much as gravity seems to be tilted, and
    that of ``yaw`` turns it."""

    def load(self, server, model, sdf) -> None:
        self._start(server, model, sdf, 0.0)
        rng = server.world.rng(f"{model.name}/hector_imu/{self.link.name}")
        self.accel, self.rate, self.yaw = (DriftingError(sdf, prefix, n, rng) for prefix, n in (("accel", 3), ("rate", 3), ("yaw", 1)))
        for error in (self.accel, self.rate):  # gazebo_ros_imu's tag
            if sdf.get("gaussianNoise", 0.0):
                error.sigma = np.full(3, sdf.get("gaussianNoise", 0.0))
        self.mount = math3.quat_from_rpy(*sdf.get("rpyOffset", sdf.get("rpyOffsets", (0.0, 0.0, 0.0))))
        topic = sdf.text_or("topicName", "imu")
        self.publisher = self.topics.publisher(topic, Imu, 10)
        bias_topic = sdf.get("biasTopicName", topic + "/bias")
        self.bias_publisher = self.topics.publisher(bias_topic, Imu, 10) if bias_topic else None
        service = sdf.get("serviceName", topic + "/calibrate")
        if service:
            self.topics.service(service, Empty, self._calibrate)
        self.topics.service(topic + "/set_accel_bias", SetBias, lambda request: self._set_bias(self.accel, request.bias))
        self.topics.service(topic + "/set_rate_bias", SetBias, lambda request: self._set_bias(self.rate, request.bias))
        self._offer({f"{topic}/accel": self.accel, f"{topic}/rate": self.rate, f"{topic}/yaw": self.yaw})
        self.message, self.bias_message = Imu(), Imu()
        self.message.header.frame_id = sdf.get("frameId", self.link.name) or self.link.name
        self.acceleration = Differentiator(self.link, self.merged.p)

    def _calibrate(self, _) -> EmptyResponse:
        self.server.call(lambda: self.rate.start(np.zeros(3)))
        return EmptyResponse()

    def _set_bias(self, error: DriftingError, bias: Vector3) -> SetBiasResponse:
        """The drift of ``error`` goes on from ``bias``; the offset of the description stays on top."""
        drift = np.array((bias.x, bias.y, bias.z))
        if not np.isfinite(drift).all():
            raise rospy.ServiceException("the bias has to be three finite numbers; it stays as it was")
        self.server.call(lambda: error.start(drift))
        return SetBiasResponse()

    def _wanted(self) -> bool:
        return bool(self.publisher.get_num_connections() or (self.bias_publisher and self.bias_publisher.get_num_connections()))

    def step(self) -> None:
        now = self.server.now()
        now_ns = now.to_nsec()
        if not self._wanted() or not self.gate.due(now_ns):
            return
        q_WB = math3.quat_multiply(self.link.pose.q, self.mount)
        q_BW = math3.quat_inverse(q_WB)
        acceleration_W = self.acceleration(now_ns) - np.asarray(self.server.world.gravity)
        acceleration = self.accel.measured(math3.quat_rotate(q_BW, tuple(acceleration_W)), now_ns)
        rates = self.rate.measured(math3.quat_rotate(q_BW, self.link.angular_velocity()), now_ns)
        self.yaw.wander(now_ns)
        wrong = self._orientation_error(q_WB)
        message = self.message
        message.header.stamp = now
        message.orientation = Quaternion(*math3.quat_multiply(wrong, q_WB))
        message.angular_velocity, message.linear_acceleration = Vector3(*rates), Vector3(*acceleration)
        self._tell_variances(message)
        self.publisher.publish(message)
        if self.bias_publisher:
            bias = self.bias_message
            bias.header, bias.orientation = message.header, Quaternion(*wrong)
            bias.angular_velocity, bias.linear_acceleration = Vector3(*self.rate.bias), Vector3(*self.accel.bias)
            self.bias_publisher.publish(bias)

    def _orientation_error(self, q_WB):
        """What stands before ``q_WB``, the true orientation, in the one that is told."""
        gravity = math.hypot(*self.server.world.gravity)
        x, y, _ = math3.quat_rotate(q_WB, tuple(self.accel.bias))
        tilt = (0.5 * y / gravity, -0.5 * x / gravity, 0.0, 1.0) if gravity > 0.0 else (0.0, 0.0, 0.0, 1.0)
        heading = math3.quat_from_rpy(0.0, 0.0, float(self.yaw.bias[0]))
        return math3.quat_normalize(math3.quat_multiply(heading, tilt))

    def _tell_variances(self, message: Imu) -> None:
        gravity = math.hypot(*self.server.world.gravity)
        level = self.accel.variance[:2] / gravity**2 if gravity > 0.0 else (-1.0, -1.0)
        message.orientation_covariance = diagonal((*level, self.yaw.variance[0]))
        message.angular_velocity_covariance = diagonal(self.rate.variance)
        message.linear_acceleration_covariance = diagonal(self.accel.variance)

    def reset(self) -> None:
        super().reset()
        self.acceleration = Differentiator(self.link, self.merged.p)


def _with_status(status: int, service: int) -> NavSatStatus:
    """Numbers of a file, as the message's fields hold them."""
    return NavSatStatus(status=(status + 128) % 256 - 128, service=service % 65536)


_FIXES = {"STATUS_SBAS_FIX": NavSatStatus.STATUS_SBAS_FIX, "STATUS_GBAS_FIX": NavSatStatus.STATUS_GBAS_FIX}
_SYSTEMS = {f"SERVICE_{name}": getattr(NavSatStatus, f"SERVICE_{name}") for name in ("GPS", "GLONASS", "COMPASS", "GALILEO")}
_STATUS_TABLE = tuple(
    Parameter(name, bool, False, description=f"as in sensor_msgs/NavSatStatus: {name}", level=1)
    for name in ("STATUS_FIX", *_FIXES, *_SYSTEMS)
)


def _shown(status: NavSatStatus) -> dict[str, bool]:
    """``status`` as dynamic_reconfigure shows it."""
    fixes = {name: bool(status.status & bit) for name, bit in _FIXES.items()}
    systems = {name: bool(status.service & bit) for name, bit in _SYSTEMS.items()}
    return {"STATUS_FIX": status.status != NavSatStatus.STATUS_NO_FIX, **fixes, **systems}


def _asked(config: dict[str, Any]) -> NavSatStatus:
    """The status that ``config`` of dynamic_reconfigure asks for."""
    fix = sum(bit for name, bit in _FIXES.items() if config[name]) if config["STATUS_FIX"] else NavSatStatus.STATUS_NO_FIX
    return NavSatStatus(status=fix, service=sum(bit for name, bit in _SYSTEMS.items() if config[name]))


class HectorGps(_BodyPlugin):
    """sensor_msgs/NavSatFix around a reference point, and the velocity (north, west, up)."""

    def load(self, server, model, sdf) -> None:
        self._start(server, model, sdf, 4.0)
        usual = (49.9, 8.9, 0.0)
        if sdf.get("useWorldSphericalCoordinates", False):
            usual = server.description.spherical_coordinates[:3]
        place = [sdf.get(f"reference{name}", value) for name, value in zip(("Latitude", "Longitude", "Altitude"), usual)]
        self._refer(place, _world_heading(server, sdf))
        rng = server.world.rng(f"{model.name}/hector_gps/{self.link.name}")
        self.position_error = DriftingError(sdf, "", 3, rng)
        self.velocity_error = DriftingError(sdf, "velocity", 3, rng)
        self.frame = sdf.text_or("frameId", "/world")
        topic = sdf.text_or("topicName", "fix")
        self.fix = self.topics.publisher(topic, NavSatFix, 10)
        self.velocity = self.topics.publisher(sdf.text_or("velocityTopicName", "fix_velocity"), Vector3Stamped, 10)
        self.status = _with_status(sdf.get("status", NavSatStatus.STATUS_FIX), sdf.get("service", 0))
        self.topics.service(topic + "/set_reference_geopose", SetReferenceGeoPose, self._set_reference)
        self._offer({f"{topic}/position": self.position_error, f"{topic}/velocity": self.velocity_error})
        shown = lambda: _shown(self.status)  # noqa: E731
        self.parameters.append(
            ParameterServer(self.topics.resolve(topic + "/status"), _STATUS_TABLE, self._set_status, initial=shown(), current=shown)
        )

    def _refer(self, place: Sequence[float], heading: float) -> None:
        """The world's origin is at ``place`` (latitude and longitude, degrees, altitude, m), its x axis ``heading`` rad from north."""
        self.latitude, self.longitude, self.altitude = place
        self.heading = heading
        sine = 1.0 - _ECCENTRICITY_SQUARED * math.sin(math.radians(self.latitude)) ** 2
        prime_vertical = _EQUATOR / math.sqrt(sine)
        self.radius_north = prime_vertical * (1.0 - _ECCENTRICITY_SQUARED) / sine
        self.radius_east = prime_vertical * math.cos(math.radians(self.latitude))

    def _set_reference(self, request) -> SetReferenceGeoPoseResponse:
        place, q = request.geo_pose.position, request.geo_pose.orientation
        numbers = (place.latitude, place.longitude, place.altitude, q.x, q.y, q.z, q.w)
        if not all(map(math.isfinite, numbers)) or abs(place.latitude) > 90.0:
            raise rospy.ServiceException("a latitude from -90 to 90 and finite numbers are needed; the reference stays where it was")
        yaw = math3.quat_to_rpy(math3.quat_normalize(numbers[3:]))[2]

        def apply() -> None:
            self._refer(numbers[:3], math.pi / 2 - yaw)
            self.reset()

        self.server.call(apply)
        return SetReferenceGeoPoseResponse()

    def _set_status(self, config: dict[str, Any], _level: int) -> None:
        def apply() -> None:
            if config != _shown(self.status):
                self.status = _asked(config)

        self.server.call(apply)

    def _north_west(self, x: float, y: float) -> tuple[float, float]:
        cos, sin = math.cos(self.heading), math.sin(self.heading)
        return cos * x + sin * y, cos * y - sin * x

    def step(self) -> None:
        now = self.server.now()
        now_ns = now.to_nsec()
        if not self.gate.due(now_ns) or not (self.fix.get_num_connections() or self.velocity.get_num_connections()):
            return
        place = math3.transform(self.link.pose, self.merged.p)
        vx, vy, vz = self.velocity_error.measured(self.link.velocity_at(place), now_ns)
        error = self.position_error
        dt = error.wander(now_ns)
        x, y, z = error.measured(place, now_ns)
        error.current = error.current + dt * self.velocity_error.current  # a receiver adds up what it takes for its velocity
        north, west = self._north_west(x, y)
        message = NavSatFix()
        message.header.stamp, message.header.frame_id = now, self.frame
        message.status = self.status
        message.latitude = self.latitude + math.degrees(north / self.radius_north)
        message.longitude = self.longitude - math.degrees(west / self.radius_east)
        message.altitude = self.altitude + z
        message.position_covariance = diagonal(error.drift**2 + error.variance)
        message.position_covariance_type = NavSatFix.COVARIANCE_TYPE_DIAGONAL_KNOWN
        self.fix.publish(message)
        velocity = Vector3Stamped()
        velocity.header = message.header
        velocity.vector = Vector3(*self._north_west(vx, vy), vz)
        self.velocity.publish(velocity)


class HectorMagnetic(_BodyPlugin):
    """The earth's field in the body frame, magnitude 1 unless given."""

    def load(self, server, model, sdf) -> None:
        self._start(server, model, sdf, 0.0)
        declination, dip = math.radians(sdf.get("declination", 0.0)), math.radians(sdf.get("inclination", 60.0))
        magnitude, way = sdf.get("magnitude", 1.0), _world_heading(server, sdf) - declination
        self.field_W = (magnitude * math.cos(dip) * math.cos(way), magnitude * math.cos(dip) * math.sin(way), -magnitude * math.sin(dip))
        self.error = DriftingError(sdf, "", 3, server.world.rng(f"{model.name}/hector_magnetic/{self.link.name}"))
        self.frame = sdf.get("frameId", self.link.name) or self.link.name
        self.kind = MagneticField if sdf.get("useMagneticFieldMsgs", False) else Vector3Stamped
        topic = sdf.text_or("topicName", "magnetic")
        self.publisher = self.topics.publisher(topic, self.kind)
        self._offer({topic: self.error})

    def step(self) -> None:
        now = self.server.now()
        if not self.gate.due(now.to_nsec()) or not self.publisher.get_num_connections():
            return
        q_SW = math3.quat_inverse(math3.quat_multiply(self.link.pose.q, self.merged.q))
        field = self.error.measured(math3.quat_rotate(q_SW, self.field_W), now.to_nsec())
        message = self.kind()
        message.header.stamp, message.header.frame_id = now, self.frame
        setattr(message, "magnetic_field" if self.kind is MagneticField else "vector", Vector3(*field))
        self.publisher.publish(message)


class HectorSonar(SensorPlugin):
    """The nearest ray as sensor_msgs/Range, ``<updateRate>`` times a second (10) and no oftener than the sensor measures; the field of
    view is the smaller side of the ray fan."""

    def load(self, server, sensor, sdf) -> None:
        self.fan = RayFan(server, sensor)
        self.topics = Topics(sdf, sensor.model.name, "C")
        self.error = DriftingError(sdf, "", 1, server.world.rng(sensor.scoped_name + "/sonar"))
        message = self.message = RangeMsg()
        message.header.frame_id = sdf.text_or("frameId", "/sonar_link")
        message.radiation_type = RangeMsg.ULTRASOUND
        message.field_of_view = min(abs(scan.max_angle - scan.min_angle) for scan in (self.fan.horizontal, self.fan.vertical))
        message.min_range, message.max_range = self.fan.min, self.fan.max
        topic = sdf.text_or("topicName", "sonar")
        self.publisher = self.topics.publisher(topic, RangeMsg)
        self.parameters = error_parameters(server, self.topics.resolve(topic), self.error)
        self.gate = LatenessKept(sdf.get("updateRate", 10.0))
        sensor.connect(self.measure, subscribed(self.publisher))

    def measure(self, sensor) -> None:
        if not self.gate.due(sensor.measurement_ns):
            return
        nearest = min(max(float(np.min(self.fan.cast()[0])), self.fan.min), self.fan.max)
        if nearest < self.fan.max:
            nearest = min(max(float(self.error.measured(nearest, sensor.measurement_ns)[0]), self.fan.min), self.fan.max)
        self.message.header.stamp, self.message.range = sensor.measurement_time, nearest
        self.publisher.publish(self.message)

    def reset(self) -> None:
        self.error.reset()
        self.gate.reset()

    def shutdown(self) -> None:
        self.parameters.shutdown()
        self.topics.close()
        self.fan.close()

"""What nodes of filters do, and Madgwick's: read, ask the filter, publish. Topics as upstream: imu/data_raw, imu/mag in, imu/data out."""

from __future__ import annotations

import math

import message_filters
import node_signals
import rospy
import tf2_ros
from dynamic_parameters import Parameter, Server
from geometry_msgs.msg import Quaternion, TransformStamped, Vector3, Vector3Stamped
from node_signals.parameters import ParameterError, number
from sensor_msgs.msg import Imu, MagneticField

from .madgwick import Madgwick, shifted
from .rotation import conjugate, level_or_north, roll_pitch_yaw, turned

QUEUE = 5
_TOGETHER = 0.1  # s that a reading of the field may be from one of the accelerations


def numbers(vector) -> tuple[float, float, float]:
    """x, y, z of ``vector``, a message."""
    return vector.x, vector.y, vector.z


def _non_negative(name: str) -> float:
    value = number(f"~{name}", 0.0)
    if value < 0.0:
        rospy.logwarn("parameter ~%s is %g, which must not be negative; 0 is taken", name, value)
    return max(value, 0.0)


class Node:
    """``answer`` is what a kind of filter adds: the orientation that a reading leads to, or None while there is none."""

    use_mag = False
    publish_tf = False

    def __init__(self):
        use_mag = rospy.get_param("~use_mag", self.use_mag)
        self.fixed_frame = rospy.get_param("~fixed_frame", "odom")
        self.stddev = number("~orientation_stddev", 0.0)
        self._dt = _non_negative("constant_dt")
        self._jump = rospy.Duration(_non_negative("time_jump_threshold"))
        self._reverse = rospy.get_param("~reverse_tf", False)
        self._tf = tf2_ros.TransformBroadcaster() if rospy.get_param("~publish_tf", self.publish_tf) else None
        self._last: rospy.Time | None = None
        self._now = rospy.Time.now()
        name = rospy.resolve_name("imu")
        self._data = rospy.Publisher(f"{name}/data", Imu, queue_size=QUEUE)
        debug = rospy.get_param("~publish_debug_topics", False)
        self._rpy = rospy.Publisher(f"{name}/rpy/filtered", Vector3Stamped, queue_size=QUEUE) if debug else None
        self.prepare(name, debug)
        if use_mag:
            pair = [
                message_filters.Subscriber(f"{name}/{topic}", kind, queue_size=QUEUE)
                for topic, kind in (("data_raw", Imu), ("mag", MagneticField))
            ]
            self._pairs = message_filters.ApproximateTimeSynchronizer(pair, QUEUE, _TOGETHER)
            self._pairs.registerCallback(self._take)
        else:
            self._subscriber = rospy.Subscriber(f"{name}/data_raw", Imu, self._take, queue_size=QUEUE)

    def prepare(self, name: str, debug: bool) -> None:
        """Read the parameters of the filter. ``name``: namespace of the topics, "imu"; ``debug``: publish more, as upstream does."""
        raise NotImplementedError

    def answer(self, reading: Imu, field: tuple | None, dt: float):
        """The orientation (w, x, y, z) after ``reading``; None while there is none.

        :param field: (3,) magnetic field, None where it is not used. :param dt: s since the reading before
        """
        raise NotImplementedError

    def reset(self) -> None:
        raise NotImplementedError

    def finish(self, message: Imu, orientation) -> None:
        """What else a filter changes in ``message`` or publishes beside it; ``orientation``: (w, x, y, z), as answered."""

    def _take(self, reading: Imu, mag: MagneticField | None = None) -> None:
        now = rospy.Time.now()
        if now + self._jump < self._now:
            rospy.logwarn("time jumped back by %.1f s: the filter starts anew", (self._now - now).to_sec())
            self._last = None
            self.reset()
        self._now = now
        field = numbers(mag.magnetic_field) if mag else None
        if field and not all(map(math.isfinite, field)):
            field = None
        stamp = reading.header.stamp
        dt = self._dt or ((stamp - self._last).to_sec() if self._last is not None else 0.0)
        if stamp.is_zero() and not self._dt:
            rospy.logwarn_throttle(5, "the readings carry no time and ~constant_dt is not set: the orientation stands still")
        self._last = stamp
        orientation = self.answer(reading, field, dt)
        if orientation is not None:
            self._publish(reading, orientation)

    def _publish(self, reading: Imu, orientation) -> None:
        w, x, y, z = orientation
        variance = self.stddev**2
        message = Imu(
            reading.header,
            Quaternion(x, y, z, w),
            [variance, 0, 0, 0, variance, 0, 0, 0, variance],
            Vector3(*numbers(reading.angular_velocity)),
            reading.angular_velocity_covariance,
            Vector3(*numbers(reading.linear_acceleration)),
            reading.linear_acceleration_covariance,
        )
        self.finish(message, orientation)
        self._data.publish(message)
        if self._rpy:
            self._rpy.publish(Vector3Stamped(reading.header, Vector3(*roll_pitch_yaw(orientation))))
        if self._tf:
            transform = TransformStamped(header=reading.header)
            parent, child = self.fixed_frame, reading.header.frame_id
            if self._reverse:
                w, x, y, z = conjugate(orientation)
                parent, child = child, parent
            transform.header.frame_id, transform.child_frame_id = parent, child
            transform.transform.rotation = Quaternion(x, y, z, w)
            self._tf.sendTransform(transform)


class MadgwickNode(Node):
    """``imu_filter_node``."""

    use_mag = True
    publish_tf = True

    def prepare(self, name: str, debug: bool) -> None:
        world = rospy.get_param("~world_frame", "enu")
        if world not in ("enu", "nwu", "ned"):
            rospy.logerr("parameter ~world_frame is '%s', and has to be enu, nwu or ned; enu is taken", world)
            world = "enu"
        self._stateless = rospy.get_param("~stateless", False)
        self._bare = rospy.get_param("~remove_gravity_vector", False)
        self._yaw = number("~yaw_offset", 0.0) - number("~declination", 0.0)
        self._raw = rospy.Publisher(f"{name}/rpy/raw", Vector3Stamped, queue_size=QUEUE) if debug else None
        self.filter = Madgwick(world)
        self._iron = 0.0, 0.0, 0.0
        self._started = False
        table = [
            Parameter("gain", float, 0.1, 0.0, 1.0, "rad/s that the turn rates may be wrong"),
            Parameter("zeta", float, 0.0, -1.0, 1.0, "drift of their bias"),
            *(Parameter(f"mag_bias_{axis}", float, 0.0, -10.0, 10.0, "hard iron, taken off the field") for axis in "xyz"),
            Parameter("orientation_stddev", float, 0.0, 0.0, 100.0, "rad, goes into the covariance"),
        ]
        self._server = Server(rospy.get_name(), table, self._reconfigure)

    def _reconfigure(self, config, _level) -> None:
        self.filter.gain, self.filter.zeta = config["gain"], config["zeta"]
        self._iron = tuple(config[f"mag_bias_{axis}"] for axis in "xyz")
        self.stddev = config["orientation_stddev"]

    def reset(self) -> None:
        self._started = False

    def answer(self, reading, field, dt):
        acceleration = numbers(reading.linear_acceleration)
        if field:
            field = tuple(f - b for f, b in zip(field, self._iron))
        now = level_or_north(self.filter.world, acceleration, field) if not self._started or self._stateless or self._raw else None
        if not self._started or self._stateless:
            if now is None:
                rospy.logwarn_throttle(5, "no direction of gravity%s: is it in free fall?", " and the field" if field else "")
                return None
            self.filter.orientation = now
        self._started = True
        if not self._stateless:
            self.filter.update(acceleration, numbers(reading.angular_velocity), field, dt)
        if self._raw and now is not None and field:
            self._raw.publish(Vector3Stamped(reading.header, Vector3(*roll_pitch_yaw(now))))
        return shifted(self.filter.orientation, self._yaw)

    def finish(self, message, orientation):
        if self._bare:
            up = (0.0, 0.0, -9.80665 if self.filter.world == "ned" else 9.80665)
            seen = turned(conjugate(orientation), up)
            acceleration = message.linear_acceleration
            acceleration.x, acceleration.y, acceleration.z = (a - g for a, g in zip(numbers(acceleration), seen))


def main(name: str, kind) -> int:
    """Run the node ``name``, an object of class ``kind``, until it is shut down. :return: the exit code"""
    node_signals.init_node(name)
    try:
        node = kind()
    except ParameterError as error:
        rospy.logfatal("%s", error)
        return 1
    node_signals.spin()
    del node
    return 0

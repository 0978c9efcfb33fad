"""The sensors of the parameters odom0, pose0, twist0, imu0, ...: subscribers that turn messages into measurements."""

from __future__ import annotations

import threading
from typing import Protocol

import numpy as np
import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped, TwistWithCovarianceStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu

from .filters import Measurement
from .messages import transform, vector
from .sensors import GRAVITY, AccelerationInput, FrameMissing, Pose, PoseInput, Transform, TwistInput, flags, quaternion_matrix

KINDS = ("odom", "pose", "twist", "imu")
_WARN_PERIOD = 5.0  # s between two warnings of one sensor


class Owner(Protocol):
    """Whose sensor it is: called in a thread of rospy."""

    def take(self, measurement: Measurement) -> None:
        """A measurement for the filter."""

    def state_rpy(self) -> np.ndarray:
        """(3,): roll, pitch, yaw of the estimate, rad."""

    def remark(self, about: str, sentence: str) -> None:
        """Something for the diagnostics: a ``sentence`` under the key ``about``."""

    def jumped_back(self) -> bool:
        """A message is older than the one before it; whether that starts the filter again."""


class Sensor:
    """One topic. Of messages that are not in the order of their stamps only those count that are not older than the ones before them."""

    def __init__(self, name: str, parameters: dict, frames, lookup, owner: Owner, silent: bool = False):
        """:param silent: of transforms that are not known
        :raises ValueError: a parameter is wrong"""
        self.name, kind = name, name.rstrip("0123456789")
        self._owner, self._silent = owner, silent
        self._lock = threading.Lock()  # each publisher's messages come in a thread of its own
        self._newest: rospy.Time | None = None
        self._put = rospy.Time()  # stamp of the last set_pose
        own = rospy.resolve_name("~" + name)
        used = flags(parameters.get(name + "_config", [False] * 15), own + "_config")

        def get(suffix: str, default):
            return parameters.get(f"{name}_{suffix}", default)

        def threshold(part: str) -> float:
            return float(get(part + "_rejection_threshold", get("rejection_threshold", np.inf)))

        differential, relative = bool(get("differential", False)), bool(get("relative", False))
        if differential and relative:
            rospy.logwarn("Both %s_differential and %s_relative are true; differential it is.", own, own)
        self._by_child = kind == "odom" and bool(get("pose_use_child_frame", False))
        self.pose = self.twist = self.acceleration = None
        if kind in ("odom", "pose", "imu") and used[:6].any():
            self.pose = PoseInput(
                name + "_pose",
                used[:6],
                frames.world,
                frames.base,
                lookup,
                differential,
                relative,
                threshold("pose"),
                inertial=kind == "imu",
            )
        if kind in ("odom", "twist", "imu") and used[6:12].any():
            self.twist = TwistInput(name + "_twist", used[6:12], frames.base, lookup, threshold("twist"))
        if kind == "imu" and used[12:].any():
            self.acceleration = AccelerationInput(
                name + "_acceleration",
                used[12:],
                frames.base,
                lookup,
                threshold("linear_acceleration"),
                bool(get("remove_gravitational_acceleration", False)),
                float(parameters.get("gravitational_acceleration", GRAVITY)),
            )
        if not (self.pose or self.twist or self.acceleration):
            rospy.logwarn("%s_config asks for nothing that a message of %s tells; the topic is not listened to.", own, own)
            return
        message, read = self._reader(kind)
        rospy.Subscriber(
            parameters[name],
            message,
            self._guarded,
            callback_args=read,
            queue_size=int(get("queue_size", 10)),
            tcp_nodelay=bool(get("nodelay", False)),
        )

    def _reader(self, kind: str):
        """(type of the topic's messages, what takes one)"""
        types = {
            "odom": (Odometry, self._odometry),
            "pose": (PoseWithCovarianceStamped, self._posed),
            "twist": (TwistWithCovarianceStamped, self._twisted),
            "imu": (Imu, self._inertial),
        }
        return types[kind]

    def forget(self, put: rospy.Time) -> None:
        """What was measured before does not count any more. :param put: neither do messages up to this stamp"""
        self._newest, self._put = None, put
        if self.pose:
            self.pose.forget()

    def _in_order(self, stamp: rospy.Time) -> bool:
        if stamp <= self._put:
            of = "that of the last set_pose, or older" if self._put else "0: its publisher leaves it out"
            self._late(f"a message is ignored, as its stamp ({stamp.to_sec():.3f} s) is {of}")
            return False
        if self._newest is not None and stamp < self._newest:
            if not self._owner.jumped_back():
                self._late(
                    f"a message is ignored, as its stamp ({stamp.to_sec():.3f} s) is older than that of the message before it "
                    f"({self._newest.to_sec():.3f} s): do two nodes publish the topic, or is a clock wrong?"
                )
            return False
        self._newest = stamp
        return True

    def _late(self, sentence: str) -> None:
        self._owner.remark(f"{self.name}_timestamp", sentence)
        rospy.logwarn_throttle(_WARN_PERIOD, f"{self.name}: {sentence}")

    def _guarded(self, message, read) -> None:
        with self._lock:
            if self._in_order(message.header.stamp):
                self._measure(message, read)

    def _measure(self, message, read) -> None:
        measured: list[Measurement] = []
        try:
            read(message, measured)
        except (FrameMissing, ValueError) as error:
            if not (self._silent and isinstance(error, FrameMissing)):
                rospy.logwarn_throttle(_WARN_PERIOD, f"{self.name}: {error}")
        for measurement in measured:
            used = measurement.used
            if np.isfinite(measurement.values[used]).all() and np.isfinite(measurement.covariance[np.ix_(used, used)]).all():
                self._owner.take(measurement)
            else:
                rospy.logwarn_throttle(_WARN_PERIOD, f"{measurement.name}: a message holds NaN or infinity; it is left out")

    def _odometry(self, message: Odometry, measured: list) -> None:
        child = message.child_frame_id if self._by_child else ""
        self._pose(message.header, message.pose.pose, message.pose.covariance, measured, child)
        self._velocity(message.child_frame_id, message.header.stamp, message.twist.twist, message.twist.covariance, measured)

    def _posed(self, message: PoseWithCovarianceStamped, measured: list) -> None:
        self._pose(message.header, message.pose.pose, message.pose.covariance, measured)

    def _twisted(self, message: TwistWithCovarianceStamped, measured: list) -> None:
        self._velocity(message.header.frame_id, message.header.stamp, message.twist.twist, message.twist.covariance, measured)

    def _pose(self, header, pose, covariance, measured: list, child: str = "") -> None:
        if self.pose:
            made = self.pose.measure(
                Pose(header.frame_id, header.stamp, header.stamp.to_sec(), transform(pose), np.reshape(covariance, (6, 6)), child)
            )
            if made:
                measured.append(made)

    def _velocity(self, frame, stamp, twist, covariance, measured: list) -> None:
        if self.twist:
            measured.append(
                self.twist.measure(
                    frame, stamp, stamp.to_sec(), vector(twist.linear), vector(twist.angular), np.reshape(covariance, (6, 6))
                )
            )

    def _inertial(self, message: Imu, measured: list) -> None:
        header, time, oriented = message.header, message.header.stamp.to_sec(), message.orientation_covariance[0] != -1
        turn = message.orientation
        if self.pose and oriented:
            covariance = np.zeros((6, 6))
            covariance[3:, 3:] = np.reshape(message.orientation_covariance, (3, 3))
            unit = Transform(quaternion_matrix(turn.x, turn.y, turn.z, turn.w), np.zeros(3))
            made = self.pose.measure(Pose(header.frame_id, header.stamp, time, unit, covariance))
            if made:
                measured.append(made)
        if self.twist and message.angular_velocity_covariance[0] != -1:
            covariance = np.zeros((6, 6))
            covariance[3:, 3:] = np.reshape(message.angular_velocity_covariance, (3, 3))
            measured.append(
                self.twist.measure(header.frame_id, header.stamp, time, np.zeros(3), vector(message.angular_velocity), covariance)
            )
        if self.acceleration and message.linear_acceleration_covariance[0] != -1:
            orientation = quaternion_matrix(turn.x, turn.y, turn.z, turn.w) if oriented else None
            measured.append(
                self.acceleration.measure(
                    header.frame_id,
                    header.stamp,
                    time,
                    vector(message.linear_acceleration),
                    np.reshape(message.linear_acceleration_covariance, (3, 3)),
                    orientation,
                    self._owner.state_rpy(),
                )
            )

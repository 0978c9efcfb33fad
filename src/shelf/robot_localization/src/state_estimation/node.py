"""The nodes ekf_localization_node and ukf_localization_node."""

from __future__ import annotations

import re
import sys
import threading
from dataclasses import dataclass
from typing import Any

import node_signals
import numpy as np
import rospy
import tf2_ros
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import AccelWithCovarianceStamped, PoseWithCovarianceStamped, TransformStamped
from nav_msgs.msg import Odometry
from node_signals.parameters import number
from robot_localization.srv import (
    GetState,
    GetStateResponse,
    SetPose,
    SetPoseResponse,
    ToggleFilterProcessing,
    ToggleFilterProcessingResponse,
)
from std_srvs.srv import Empty, EmptyResponse

from .filters import INITIAL_COVARIANCE, PROCESS_NOISE, Ekf, Ukf
from .inputs import KINDS, Sensor
from .messages import Lookup, every, fill, quaternion, transform
from .motion import ORIENTATION, POSITION, RATE, SIZE, VELOCITY, rotation
from .sensors import FrameMissing, Transform, angles, matrix

_LONGEST_GAP = 100.0  # s; a clock that jumps further starts the filter again
_UNSUPPORTED = ("use_control", "smooth_lagged_data")


@dataclass
class Frames:
    """Names, without a slash in front."""

    map: str
    odom: str
    base: str
    world: str


class Localization:
    def __init__(self, kind: str):
        """:param kind: "ekf" or "ukf"
        :raises ValueError: a parameter is wrong; says which
        """
        self._mutex = threading.RLock()
        self._parameters = parameters = rospy.get_param("~", {})
        own = rospy.get_name()
        for name in _UNSUPPORTED:
            if parameters.get(name):
                rospy.logwarn("%s/%s has no effect in this robot_localization.", own, name)
        self.frames = self._frames()
        self.rate = number("~frequency", 30.0)
        if self.rate <= 0:
            raise ValueError(f"parameter {own}/frequency must be above zero")
        self._timeout = number("~sensor_timeout", 1.0 / self.rate)
        self._offset = rospy.Duration(number("~transform_time_offset", 0.0))
        self._to_now = bool(parameters.get("predict_to_current_time", False))
        self._make_filter = self._filter_maker(kind)
        self.filter = self._make_filter()
        self._queue: list = []
        self._running = not parameters.get("disabled_at_startup", False)
        self._rejected = 0
        self._published = None  # s, stamp of the last estimate that went out
        self._look_up = Lookup(rospy.Duration(number("~transform_timeout", 0.0)))
        self._broadcaster = tf2_ros.TransformBroadcaster() if parameters.get("publish_tf", True) else None
        self._odometry = rospy.Publisher("odometry/filtered", Odometry, queue_size=20)
        self._acceleration = (
            rospy.Publisher("accel/filtered", AccelWithCovarianceStamped, queue_size=20)
            if parameters.get("publish_acceleration", False)
            else None
        )
        self._diagnostics = (
            rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=1) if parameters.get("print_diagnostics", True) else None
        )
        names = sorted(name for name in parameters if re.fullmatch(f"({'|'.join(KINDS)})[0-9]+", name))
        self.sensors = [Sensor(name, parameters, self.frames, self._look_up, self._state_rpy, self._take) for name in names]
        if not names:
            rospy.logwarn(
                "%s has no sensors: set its parameters odom0, pose0, twist0 or imu0 to topics, and odom0_config and so on "
                "to what is to be used of them.",
                own,
            )
        rospy.Subscriber("set_pose", PoseWithCovarianceStamped, self.set_pose, queue_size=1)
        rospy.Service("set_pose", SetPose, self._on_set_pose)
        rospy.Service("~enable", Empty, self._enable)
        rospy.Service("~toggle", ToggleFilterProcessing, lambda request: ToggleFilterProcessingResponse(self._toggle(request.on)))
        rospy.Service("~get_state", GetState, self._get_state)

    def _frames(self) -> Frames:
        parameters = self._parameters

        def name(key: str, default: str) -> str:
            prefix = str(parameters.get("tf_prefix", "")).strip("/")
            frame = str(parameters.get(key, default)).lstrip("/")
            return f"{prefix}/{frame}" if prefix else frame

        odom = name("odom_frame", "odom")
        frames = Frames(name("map_frame", "map"), odom, name("base_link_frame", "base_link"), name("world_frame", odom))
        if len({frames.map, frames.odom, frames.base}) < 3:
            raise ValueError(
                "map_frame, odom_frame and base_link_frame must be three different frames, but are "
                f"{frames.map}, {frames.odom} and {frames.base}"
            )
        if frames.world not in (frames.map, frames.odom):
            raise ValueError(f"world_frame must be map_frame ({frames.map}) or odom_frame ({frames.odom}), but is {frames.world}")
        return frames

    def _filter_maker(self, kind: str):
        parameters, own = self._parameters, rospy.get_name()

        def given(name: str, default: np.ndarray) -> np.ndarray:
            return matrix(parameters[name], f"{own}/{name}") if name in parameters else default

        options: dict[str, Any] = dict(
            process_noise=given("process_noise_covariance", PROCESS_NOISE),
            covariance=given("initial_estimate_covariance", INITIAL_COVARIANCE),
            planar=bool(parameters.get("two_d_mode", False)),
            dynamic_noise=bool(parameters.get("dynamic_process_noise_covariance", False)),
        )
        if kind == "ukf":
            options.update({name: number("~" + name, default) for name, default in (("alpha", 0.001), ("kappa", 0.0), ("beta", 2.0))})
        initial = np.diag(given("initial_state", np.zeros((SIZE, SIZE)))).copy()

        def make() -> Ekf:
            made = (Ukf if kind == "ukf" else Ekf)(**options)
            made.state[:] = initial
            return made

        return make

    def _state_rpy(self) -> np.ndarray:
        with self._mutex:
            return self.filter.state[ORIENTATION].copy()

    def _take(self, measurement) -> None:
        with self._mutex:
            if self._running:
                self._queue.append(measurement)

    def _enable(self, _request) -> EmptyResponse:
        self._toggle(True)
        return EmptyResponse()

    def _toggle(self, on: bool) -> bool:
        with self._mutex:
            changed, self._running = self._running != on, bool(on)
            self._queue.clear()
            return changed

    def _on_set_pose(self, request) -> SetPoseResponse:
        self.set_pose(request.pose)
        return SetPoseResponse()

    def set_pose(self, message: PoseWithCovarianceStamped) -> None:
        """The robot is said to stand where ``message`` says, at rest; what was measured before does not count any more."""
        try:
            pose = self._look_up(self.frames.world, message.header.frame_id or self.frames.world, message.header.stamp) @ transform(
                message.pose.pose
            )
        except (FrameMissing, ValueError) as error:
            rospy.logerr("set_pose: %s", error)
            return
        with self._mutex:
            self.filter = self._make_filter()
            self.filter.state[:] = 0.0
            self.filter.state[POSITION], self.filter.state[ORIENTATION] = pose.translation, angles(pose.rotation)
            covariance = np.reshape(message.pose.covariance, (6, 6))
            self.filter.covariance[:6, :6] = np.where(np.isfinite(covariance), covariance, 0.0) + np.eye(6) * 1e-9
            stamp = message.header.stamp if message.header.stamp else rospy.Time.now()
            self.filter.time = stamp.to_sec()
            self._queue.clear()
            for sensor in self.sensors:
                sensor.forget()

    def _get_state(self, request) -> GetStateResponse:
        with self._mutex:
            state, covariance = self.filter.state.copy(), self.filter.covariance.copy()
        return GetStateResponse(state.tolist(), covariance.ravel().tolist())

    def step(self, now: float) -> None:
        """All that was measured until now goes in, and the estimate goes out."""
        with self._mutex:
            if not self._running:
                return
            self._start_again_after_a_jump(now)
            for measurement in sorted(self._queue, key=lambda entry: entry.time):
                if self.filter.time is not None and abs(measurement.time - self.filter.time) > _LONGEST_GAP:
                    continue
                self._rejected += not self.filter.process(measurement)
            self._queue.clear()
            if self.filter.time is None:
                return
            if self._to_now or now - self.filter.time >= self._timeout:
                self.filter.predict(now - self.filter.time)
            self._publish()

    def _start_again_after_a_jump(self, now: float) -> None:
        if self.filter.time is not None and (now < self.filter.time - 1.0 or now > self.filter.time + _LONGEST_GAP):
            rospy.logwarn("The clock jumped from %.3f s to %.3f s; the filter starts again.", self.filter.time, now)
            self.filter, self._published = self._make_filter(), None
            self._queue.clear()
            self._look_up.clear()
            for sensor in self.sensors:
                sensor.forget()

    def _publish(self) -> None:
        state, covariance, time = self.filter.state, self.filter.covariance, self.filter.time
        if self._published is not None and time <= self._published:
            return  # nothing new; a transform of the same stamp twice is warned of by tf
        self._published = time
        message = Odometry(child_frame_id=self.frames.base)
        message.header.stamp, message.header.frame_id = rospy.Time(nsecs=round(time * 1e9)), self.frames.world
        fill(message.pose.pose.position, state[POSITION])
        fill(message.pose.pose.orientation, quaternion(rotation(state[ORIENTATION])), "xyzw")
        fill(message.twist.twist.linear, state[VELOCITY])
        fill(message.twist.twist.angular, state[RATE])
        message.pose.covariance, message.twist.covariance = covariance[:6, :6].ravel().tolist(), covariance[6:12, 6:12].ravel().tolist()
        self._odometry.publish(message)
        if self._acceleration:
            accelerated = AccelWithCovarianceStamped()
            accelerated.header.stamp, accelerated.header.frame_id = message.header.stamp, self.frames.base
            fill(accelerated.accel.accel.linear, state[12:])
            wide = np.zeros((6, 6))
            wide[:3, :3] = covariance[12:, 12:]
            accelerated.accel.covariance = wide.ravel().tolist()
            self._acceleration.publish(accelerated)
        if self._broadcaster:
            self._broadcast(self._broadcaster, message, Transform(rotation(state[ORIENTATION]), state[POSITION].copy()))

    def _broadcast(self, broadcaster: tf2_ros.TransformBroadcaster, message: Odometry, pose: Transform) -> None:
        """world -> base_link; where the world is the map and somebody else tells odom -> base_link, map -> odom."""
        child = self.frames.base
        if self.frames.world == self.frames.map:
            try:
                pose, child = pose @ self._look_up(self.frames.base, self.frames.odom, message.header.stamp), self.frames.odom
            except FrameMissing as error:
                rospy.logwarn_throttle(5.0, str(error))
                return
        sent = TransformStamped(child_frame_id=child)
        sent.header.stamp, sent.header.frame_id = message.header.stamp + self._offset, message.header.frame_id
        fill(sent.transform.translation, pose.translation)
        fill(sent.transform.rotation, quaternion(pose.rotation), "xyzw")
        broadcaster.sendTransform(sent)

    def report(self) -> None:
        """Once a second to /diagnostics."""
        if not self._diagnostics:
            return
        with self._mutex:
            begun = self.filter.time is not None
            status = DiagnosticStatus(
                name=f"{rospy.get_name().strip('/')}: Filter diagnostic updater",
                level=DiagnosticStatus.OK if begun else DiagnosticStatus.WARN,
                message="The robot_localization state estimation node appears to be functioning properly."
                if begun
                else "No sensor has been heard yet",
                hardware_id="none",
                values=[KeyValue("rejected measurements", str(self._rejected))],
            )
        message = DiagnosticArray(status=[status])
        message.header.stamp = rospy.Time.now()
        self._diagnostics.publish(message)


def main(kind: str) -> int:
    node_signals.init_node(f"{kind}_localization_node")
    try:
        localization = Localization(kind)
    except (TypeError, ValueError) as error:
        print(f"{rospy.get_name()}: {error}", file=sys.stderr)
        return 1
    timers = [every(1 / localization.rate, lambda: localization.step(rospy.get_time())), every(1.0, localization.report)]
    node_signals.spin()
    for timer in timers:
        timer.shutdown()
    return 0

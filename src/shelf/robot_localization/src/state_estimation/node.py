"""The nodes ekf_localization_node and ukf_localization_node."""

from __future__ import annotations

import sys
import threading
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
from .inputs import Sensor
from .messages import Lookup, every, fill, quaternion, transform
from .motion import ORIENTATION, POSITION, RATE, SIZE, VELOCITY, rotation
from .sensors import FrameMissing, Transform, angles, matrix
from .settings import SENSOR, frames_of, tell_of_parameters

_LONGEST_GAP = 100.0  # s; a clock that jumps further starts the filter again
_WARN_PERIOD = 5.0  # s


class Localization:
    def __init__(self, kind: str):
        """:param kind: "ekf" or "ukf"
        :raises ValueError: a parameter is wrong; says which
        """
        self._mutex = threading.RLock()
        self._parameters = parameters = rospy.get_param("~", {})
        own = rospy.get_name()
        tell_of_parameters(parameters)
        self.frames = frames_of(parameters)
        self.rate = number("~frequency", 30.0)
        if self.rate <= 0:
            raise ValueError(f"parameter {own}/frequency must be above zero")
        self._timeout = number("~sensor_timeout", 1.0 / self.rate)
        self._offset = rospy.Duration(number("~transform_time_offset", 0.0))
        self._to_now = bool(parameters.get("predict_to_current_time", False))
        self._make_filter = self._filter_maker(kind)
        self.filter = self._make_filter()
        self._queue: list = []
        self._enabled = not parameters.get("disabled_at_startup", False)
        self._toggled = True
        self._put = 0.0  # s, stamp of the last set_pose: what was measured until then does not count
        self._resets = parameters.get("reset_on_time_jump")  # None where it is not set
        self._corrects = bool(parameters.get("permit_corrected_publication", False))
        self._inverted = bool(parameters.get("invert_tf", False))
        self._silent = bool(rospy.get_param("/silent_tf_failure", parameters.get("silent_tf_failure", False)))
        self._rejected = 0
        self._remarks: dict[str, str] = {}  # for the next diagnostics
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
            rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=10) if parameters.get("print_diagnostics", True) else None
        )
        names = sorted(filter(SENSOR.fullmatch, parameters))
        self.sensors: list[Sensor] = []  # they call this node as soon as they are made
        for name in names:
            self.sensors.append(Sensor(name, parameters, self.frames, self._look_up, self, self._silent))
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

    def state_rpy(self) -> np.ndarray:
        with self._mutex:
            return self.filter.state[ORIENTATION].copy()

    def take(self, measurement) -> None:
        with self._mutex:
            if self._enabled and measurement.time > self._put:
                self._queue.append(measurement)

    def remark(self, about: str, sentence: str) -> None:
        """Tells a ``sentence`` under the key ``about`` in the next diagnostics."""
        with self._mutex:
            self._remarks[about] = sentence

    def jumped_back(self) -> bool:
        if not self._resets or rospy.rostime.is_wallclock():
            return False
        with self._mutex:
            self._start_again("A message is older than the one before it, and reset_on_time_jump is set; the filter starts again.")
        return True

    def _enable(self, _request) -> EmptyResponse:
        with self._mutex:
            if self._enabled:
                rospy.logwarn("%s is enabled already; disabled_at_startup lets it wait for this call.", rospy.get_name())
            self._enabled = True
        return EmptyResponse()

    def _toggle(self, on: bool) -> bool:
        """Whether measurements count. Without them the estimate stands still, and goes on being published."""
        with self._mutex:
            changed, self._toggled = self._toggled != on, bool(on)
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
            self._put = message.header.stamp.to_sec()
            self.filter.time = rospy.get_time() or self._put
            self._queue.clear()
            for sensor in self.sensors:
                sensor.forget(message.header.stamp)

    def _get_state(self, request) -> GetStateResponse:
        with self._mutex:
            state, covariance = self.filter.state.copy(), self.filter.covariance.copy()
        return GetStateResponse(state.tolist(), covariance.ravel().tolist())

    def step(self, now: float) -> None:
        """All that was measured until now goes in, and the estimate goes out."""
        with self._mutex:
            if not self._enabled:
                return
            self._start_again_after_a_jump(now)
            if self._toggled:
                self._take_in(now)
            else:
                self._queue.clear()
                if self.filter.time is not None:
                    self.filter.time = now  # when measurements count again, no time has passed for the filter
            if self.filter.time is not None:
                self._publish()

    def _take_in(self, now: float) -> None:
        """What was measured until ``now``; the rest waits for its time."""
        due = [measurement for measurement in self._queue if measurement.time <= now]
        self._queue = [measurement for measurement in self._queue if now < measurement.time <= now + _LONGEST_GAP]
        for measurement in sorted(due, key=lambda entry: entry.time):
            if self.filter.time is not None and self.filter.time - measurement.time > _LONGEST_GAP:
                self.remark(f"{measurement.name}_timestamp", f"a message is ignored, as it is {now - measurement.time:.0f} s old")
                continue
            self._rejected += not self.filter.process(measurement)
        if self.filter.time is not None and (self._to_now or now - self.filter.time >= self._timeout):
            self.filter.predict(now - self.filter.time)

    def _start_again_after_a_jump(self, now: float) -> None:
        if self.filter.time is None:
            return
        back = now < self.filter.time - 1.0 and self._resets is not False
        if back or now > self.filter.time + _LONGEST_GAP:
            self._start_again(f"The clock jumped from {self.filter.time:.3f} s to {now:.3f} s; the filter starts again.")

    def _start_again(self, why: str) -> None:
        rospy.logwarn(why)
        self.filter, self._published, self._put = self._make_filter(), None, 0.0
        self._queue.clear()
        self._look_up.clear()
        for sensor in self.sensors:
            sensor.forget(rospy.Time())

    def _publish(self) -> None:
        state, covariance, time = self.filter.state, self.filter.covariance, self.filter.time
        if self._published is not None and time <= self._published and not self._corrects:
            return  # nothing new; a transform of the same stamp twice is warned of by tf
        self._published = time
        message = Odometry(child_frame_id=self.frames.output)
        message.header.stamp, message.header.frame_id = rospy.Time(nsecs=round(time * 1e9)), self.frames.world
        fill(message.pose.pose.position, state[POSITION])
        fill(message.pose.pose.orientation, quaternion(rotation(state[ORIENTATION])), "xyzw")
        fill(message.twist.twist.linear, state[VELOCITY])
        fill(message.twist.twist.angular, state[RATE])
        message.pose.covariance, message.twist.covariance = covariance[:6, :6].ravel().tolist(), covariance[6:12, 6:12].ravel().tolist()
        self._odometry.publish(message)
        if self._acceleration:
            accelerated = AccelWithCovarianceStamped()
            accelerated.header.stamp, accelerated.header.frame_id = message.header.stamp, self.frames.output
            fill(accelerated.accel.accel.linear, state[12:])
            wide = np.zeros((6, 6))
            wide[:3, :3] = covariance[12:, 12:]
            accelerated.accel.covariance = wide.ravel().tolist()
            self._acceleration.publish(accelerated)
        if self._broadcaster:
            self._broadcast(self._broadcaster, message, Transform(rotation(state[ORIENTATION]), state[POSITION].copy()))

    def _broadcast(self, broadcaster: tf2_ros.TransformBroadcaster, message: Odometry, pose: Transform) -> None:
        """world -> base_link, or the other way round; where the world is the map and somebody else tells odom -> base_link,
        map -> odom."""
        parent, child = message.header.frame_id, self.frames.output
        if self._inverted:
            parent, child, pose = child, parent, pose.inverse()
        elif self.frames.world == self.frames.map:
            try:
                pose, child = pose @ self._look_up(self.frames.base, self.frames.odom, message.header.stamp), self.frames.odom
            except FrameMissing as error:
                if not self._silent:
                    rospy.logwarn_throttle(_WARN_PERIOD, str(error))
                return
        sent = TransformStamped(child_frame_id=child)
        sent.header.stamp, sent.header.frame_id = message.header.stamp + self._offset, parent
        fill(sent.transform.translation, pose.translation)
        fill(sent.transform.rotation, quaternion(pose.rotation), "xyzw")
        broadcaster.sendTransform(sent)

    def report(self) -> None:
        """Once a second to /diagnostics."""
        if not self._diagnostics:
            return
        with self._mutex:
            remarks, self._remarks = self._remarks, {}
            said = "The robot_localization state estimation node appears to be functioning properly."
            if remarks:
                said = "Potentially erroneous data or settings detected for a robot_localization state estimation node."
            elif self.filter.time is None:
                said = "No sensor has been heard yet"
            status = DiagnosticStatus(
                name=f"{rospy.get_name().strip('/')}: Filter diagnostic updater",
                level=DiagnosticStatus.WARN if remarks or self.filter.time is None else DiagnosticStatus.OK,
                message=said,
                hardware_id="none",
                values=[
                    KeyValue("rejected measurements", str(self._rejected)),
                    *(KeyValue(about, sentence) for about, sentence in sorted(remarks.items())),
                ],
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

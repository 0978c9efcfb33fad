"""The four wheel steering controller."""

from __future__ import annotations

import math
from typing import Any

from controller_interface import MultiInterfaceController, NodeHandle, ParameterError, RealtimePublisher, to_stamp
from diff_drive_controller.command_topic import CommandTopic
from diff_drive_controller.laws import MIN_INTERVAL, RollingMean
from diff_drive_controller.wheeled_base import WheeledBase, length
from four_wheel_steering_msgs.msg import FourWheelSteering, FourWheelSteeringStamped
from hardware_interface import PositionJointInterface, VelocityJointInterface
from urdf_geometry_parser import RobotGeometry, robot_geometry

from .kinematics import Axle, Base, axle_angle

_RIGHT_ANGLE = 0.5 * math.pi


class FourWheelSteeringController(WheeledBase, MultiInterfaceController):
    """Obeys ``cmd_vel`` or ``cmd_four_wheel_steering``, whichever came last."""

    interfaces = (VelocityJointInterface, PositionJointInterface)

    def init(self, hw, root_nh: NodeHandle, controller_nh: NodeHandle) -> None:
        wheels, steering = hw.get(VelocityJointInterface), hw.get(PositionJointInterface)
        self._wheels = [wheels.get_handle(name) for axle in ("front", "rear") for name in _pair(controller_nh, f"{axle}_wheel")]
        self._steering = [steering.get_handle(name) for axle in ("front", "rear") for name in _pair(controller_nh, f"{axle}_steering")]
        self.init_base(root_nh, controller_nh, jerk=False, odom_frame="odom")
        self._base = self._geometry(robot_geometry(root_nh, search=False), controller_nh)
        self._rates = _Rates(controller_nh.param("velocity_rolling_window_size", 10))
        self._steering_command = CommandTopic(
            controller_nh, "cmd_four_wheel_steering", FourWheelSteering, _steering_values, "four wheel steering"
        )
        self._steer_publisher = RealtimePublisher(controller_nh, "odom_steer", FourWheelSteeringStamped, queue_size=100)

    def _geometry(self, robot: RobotGeometry, nh: NodeHandle) -> Base:
        """Lengths from parameters, else from the URDF; those found there are written back."""
        link = self._publisher.base_frame
        names = [handle.name for handle in self._wheels]

        def between(first: str, second: str) -> float:
            return math.dist(robot.position(first, link)[:2], robot.position(second, link)[:2])

        track = length(nh, "track", lambda: between(names[0], names[1]))
        base = length(nh, "wheel_base", lambda: between(names[0], names[2]))
        radius = length(nh, "wheel_radius", lambda: robot.wheel_radius(names[0], shapes=("cylinder",)))
        offset = between(self._steering[0].name, names[0])
        for name, value in (("track", track), ("wheel_base", base), ("wheel_radius", radius), ("wheel_steering_y_offset", offset)):
            nh.set_param(name, value)
        return Base(track - 2.0 * offset, base, radius, offset)

    def starting(self, time: float) -> None:
        super().starting(time)
        self._rates.restart()
        self._steering_command.start(time)

    def stopping(self, time: float) -> None:
        self._steering_command.stop()
        super().stopping(time)

    def brake(self) -> None:
        for handle in (*self._wheels, *self._steering):
            handle.command = 0.0

    def update(self, time: float, period: float) -> None:
        self._measure(time)
        linear, angular = self._command.at(time)
        speed, front, rear = self._steering_command.at(time)
        if self._command.stamp > self._steering_command.stamp:
            axles = self._base.from_twist(self._limit_linear.limit(linear, period), self._limit_angular.limit(angular, period))
        else:
            axles = self._base.from_steering(self._limit_linear.limit(speed, period), _clamp(front), _clamp(rear))
        for axle, wheels, steering in zip(axles, (self._wheels[:2], self._wheels[2:]), (self._steering[:2], self._steering[2:])):
            wheels[0].command, wheels[1].command = axle.left_speed, axle.right_speed
            steering[0].command, steering[1].command = axle.left_angle, axle.right_angle

    def _measure(self, time: float) -> None:
        """Odometry and odom_steer from the joints; skipped while one of them is not known."""
        angles = [handle.position for handle in self._steering]
        speeds = [handle.velocity for handle in self._wheels]
        if not all(map(math.isfinite, (*angles, *speeds))):
            return
        front, rear = Axle(*angles[:2], *speeds[:2]), Axle(*angles[2:], *speeds[2:])
        dt = self._odometry.interval(time)
        self.notice_reset(time)
        self._odometry.moved(*self._base.motion(front, rear), time)
        state = FourWheelSteering()
        state.front_steering_angle, state.rear_steering_angle = axle_angle(front), axle_angle(rear)
        state.speed = math.copysign(math.hypot(self._odometry.linear, self._odometry.linear_y), self._odometry.linear)
        if dt >= MIN_INTERVAL:
            self._rates.update(state, dt)
        self._rates.fill(state)
        if self._publisher.publish(self._odometry, time):
            message = FourWheelSteeringStamped(data=state)
            message.header.stamp = to_stamp(time)
            self._steer_publisher.publish(message)


class _Rates:
    """Smoothed derivatives of what odom_steer reports."""

    _FIELDS = {
        "acceleration": "speed",
        "jerk": "acceleration",
        "front_steering_angle_velocity": "front_steering_angle",
        "rear_steering_angle_velocity": "rear_steering_angle",
    }

    def __init__(self, window: int):
        self._means = {name: RollingMean(window) for name in self._FIELDS}
        self.restart()

    def restart(self) -> None:
        for mean in self._means.values():
            mean.clear()
        self._last: Any = None
        self._values = dict.fromkeys(self._FIELDS, 0.0)

    def update(self, state: FourWheelSteering, dt: float) -> None:
        """Take the next values, ``dt`` seconds after the last ones."""
        for rate, quantity in self._FIELDS.items():
            if self._last is not None:
                self._values[rate] = self._means[rate]((getattr(state, quantity) - getattr(self._last, quantity)) / dt)
            setattr(state, rate, self._values[rate])
        self._last = state

    def fill(self, state: FourWheelSteering) -> None:
        for name, value in self._values.items():
            setattr(state, name, value)


def _steering_values(message: FourWheelSteering) -> tuple[float, float, float]:
    """Speed (m/s) and the angles of the front and the rear axle (rad)."""
    return message.speed, message.front_steering_angle, message.rear_steering_angle


def _clamp(angle: float) -> float:
    return max(-_RIGHT_ANGLE, min(_RIGHT_ANGLE, angle))


def _pair(nh: NodeHandle, name: str) -> list[str]:
    """[left, right] joint names from a parameter."""
    names = nh.strings(name)
    if len(names) != 2:
        raise ParameterError(f"parameter {nh.resolve(name)} must name two joints, left and right, it is {names}")
    return names

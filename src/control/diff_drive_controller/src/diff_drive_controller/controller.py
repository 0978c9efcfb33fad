"""The differential drive controller."""

from __future__ import annotations

import math

import rospy
from control_msgs.msg import JointTrajectoryControllerState
from controller_interface import Controller, NodeHandle, ParameterError, RealtimePublisher, to_stamp
from dynamic_parameters import Parameter, Server
from geometry_msgs.msg import TwistStamped
from hardware_interface import VelocityJointInterface
from urdf_geometry_parser import robot_geometry

from .laws import WheelTravel, differential
from .wheeled_base import WheeledBase, length, multiplier

_TABLE = [
    Parameter("left_wheel_radius_multiplier", float, 1.0, 0.5, 1.5, "Left wheel radius multiplier."),
    Parameter("right_wheel_radius_multiplier", float, 1.0, 0.5, 1.5, "Right wheel radius multiplier."),
    Parameter("wheel_separation_multiplier", float, 1.0, 0.5, 1.5, "Wheel separation multiplier."),
    Parameter("publish_rate", float, 50.0, 0.0, 2000.0, "Rate of odom and tf, Hz."),
    Parameter("enable_odom_tf", bool, True, description="Publish the transform from odom to the base."),
]


class DiffDriveController(WheeledBase, Controller):
    """A base with one or more wheels on each side, all wheels of a side turning alike."""

    interface = VelocityJointInterface

    def init(self, hw, root_nh: NodeHandle, controller_nh: NodeHandle) -> None:
        left, right = (wheel_names(controller_nh, side) for side in ("left_wheel", "right_wheel"))
        if len(left) != len(right):
            raise ParameterError(
                f"{controller_nh.namespace}: left_wheel names {len(left)} joints and right_wheel {len(right)}; both sides need as many"
            )
        self._separation = length(
            controller_nh, "wheel_separation", lambda: robot_geometry(root_nh, search=False).distance(left[0], right[0])
        )
        self._radius = length(controller_nh, "wheel_radius", lambda: robot_geometry(root_nh, search=False).wheel_radius(left[0]))
        multipliers = [multiplier(controller_nh, row.name) for row in _TABLE[:3]]
        if controller_nh.has_param("wheel_radius_multiplier"):
            multipliers[:2] = [multiplier(controller_nh, "wheel_radius_multiplier")] * 2
        self._multipliers = tuple(multipliers)
        self._left, self._right = ([hw.get_handle(name) for name in side] for side in (left, right))
        # before odom and cmd_vel, as who sees these takes the controller to be complete
        self._command_publisher = self._wheel_publisher = None
        if controller_nh.param("publish_cmd", False):
            self._command_publisher = RealtimePublisher(controller_nh, "cmd_vel_out", TwistStamped, queue_size=100)
        if controller_nh.param("publish_wheel_joint_controller_state", False):
            self._wheel_publisher = RealtimePublisher(
                controller_nh, "wheel_joint_controller_state", JointTrajectoryControllerState, queue_size=100
            )
        self.init_base(root_nh, controller_nh, (WheelTravel(), WheelTravel()))
        self._desired = [0.0] * (2 * len(self._left))  # wheel positions as commanded, rad
        self._last_velocities = ([0.0] * len(self._desired), [0.0] * len(self._desired))
        controller_nh.own(
            Server(
                controller_nh.namespace,
                _TABLE,
                self._reconfigure,
                initial=dict(zip((row.name for row in _TABLE), (*multipliers, self._publisher.rate, self._publisher.tf_enabled))),
            )
        )

    def _reconfigure(self, config, level: int) -> None:
        if level == -1:
            return  # the server repeats what was loaded
        self._multipliers = tuple(config[row.name] for row in _TABLE[:3])
        self._publisher.tf_enabled = config["enable_odom_tf"]
        self._publisher.set_rate(config["publish_rate"])

    def brake(self) -> None:
        self._drive(0.0, 0.0)

    def _drive(self, left: float, right: float) -> None:
        """Command wheel velocities, rad/s."""
        for handle in self._left:
            handle.command = left
        for handle in self._right:
            handle.command = right

    def _geometry(self) -> tuple[float, float, float]:
        """Radius of the left and of the right wheels and the distance of the sides, m."""
        left, right, separation = self._multipliers
        return self._radius * left, self._radius * right, self._separation * separation

    def measured_way(self) -> tuple[float, float] | None:
        left_radius, right_radius, separation = self._geometry()
        left = sum(handle.state.position for handle in self._left) / len(self._left)
        right = sum(handle.state.position for handle in self._right) / len(self._right)
        if not (math.isfinite(left) and math.isfinite(right)):
            return None
        return differential(self._travel[0](left) * left_radius, self._travel[1](right) * right_radius, separation)

    def update(self, time: float, period: float) -> None:
        if not self.update_odometry(time):
            return
        linear, angular = self.limited_command(time, period)
        left_radius, right_radius, separation = self._geometry()
        left_velocity = (linear - 0.5 * angular * separation) / left_radius
        right_velocity = (linear + 0.5 * angular * separation) / right_radius
        self._drive(left_velocity, right_velocity)

        if self._command_publisher is not None:
            message = TwistStamped()
            message.header.stamp = to_stamp(time)
            message.twist.linear.x = linear
            message.twist.angular.z = angular
            self._command_publisher.publish(message)
        if self._wheel_publisher is not None:
            self._wheel_publisher.publish(self._wheel_state(time, period, left_velocity, right_velocity))

    def _wheel_state(self, time: float, period: float, left_velocity: float, right_velocity: float) -> JointTrajectoryControllerState:
        """State of every wheel, left ones first."""
        states = [handle.state for handle in (*self._left, *self._right)]
        desired = [left_velocity] * len(self._left) + [right_velocity] * len(self._right)
        actual = [state.velocity for state in states]
        for index, velocity in enumerate(desired):
            self._desired[index] += velocity * period
        message = JointTrajectoryControllerState(joint_names=[state.name for state in states])
        message.header.stamp = to_stamp(time)
        for point, velocities, last in zip((message.desired, message.actual), (desired, actual), self._last_velocities):
            point.velocities = velocities
            point.accelerations = [(v - v0) / period if period > 0.0 else 0.0 for v, v0 in zip(velocities, last)]
            point.time_from_start = rospy.Duration.from_sec(period)
        message.desired.positions = list(self._desired)
        message.desired.effort = [math.nan] * len(states)
        message.actual.positions = [state.position for state in states]
        message.actual.effort = [state.effort for state in states]
        for field in ("positions", "velocities", "accelerations", "effort"):
            setattr(message.error, field, [d - a for d, a in zip(getattr(message.desired, field), getattr(message.actual, field))])
        message.error.time_from_start = message.desired.time_from_start
        self._last_velocities = (desired, actual)
        return message


def wheel_names(nh: NodeHandle, name: str) -> list[str]:
    """Joint names from parameter ``name`` below ``nh``, which is one name or a list of them."""
    value = nh.get_param(name)
    return [value] if isinstance(value, str) and value else nh.strings(name)

"""The differential drive controller."""
from __future__ import annotations

import math
from typing import List

import rospy
from control_msgs.msg import JointTrajectoryControllerState
from controller_interface import Controller, NodeHandle, ParameterError, RealtimePublisher
from dynamic_parameters import Parameter, Server
from geometry_msgs.msg import TwistStamped
from hardware_interface import VelocityJointInterface
from urdf_geometry_parser import robot_geometry

from .odometry import PlanarOdometry, WheelTravel, differential
from .odometry_publisher import OdometryPublisher
from .speed_limiter import load_limiter
from .velocity_command import VelocityCommand

_TABLE = [
    Parameter("left_wheel_radius_multiplier", float, 1.0, 0.5, 1.5, "Left wheel radius multiplier."),
    Parameter("right_wheel_radius_multiplier", float, 1.0, 0.5, 1.5, "Right wheel radius multiplier."),
    Parameter("wheel_separation_multiplier", float, 1.0, 0.5, 1.5, "Wheel separation multiplier."),
    Parameter("publish_rate", float, 50.0, 0.0, 2000.0, "Rate of odom and tf, Hz."),
    Parameter("enable_odom_tf", bool, True, description="Publish the transform from odom to the base."),
]


class DiffDriveController(Controller):
    """A base with one or more wheels on each side, all wheels of a side turning alike."""

    interface = VelocityJointInterface

    def init(self, hw, root_nh: NodeHandle, controller_nh: NodeHandle) -> None:
        names = [wheel_names(controller_nh, side) for side in ("left_wheel", "right_wheel")]
        if len(names[0]) != len(names[1]):
            raise ParameterError(f"{controller_nh.namespace}: left_wheel names {len(names[0])} joints and right_wheel "
                                 f"{len(names[1])}; both sides need as many")
        self._separation = controller_nh.param("wheel_separation", 0.0)
        self._radius = controller_nh.param("wheel_radius", 0.0)
        if not (controller_nh.has_param("wheel_separation") and controller_nh.has_param("wheel_radius")):
            robot = robot_geometry(root_nh, search=False)
            if not controller_nh.has_param("wheel_separation"):
                self._separation = robot.distance(names[0][0], names[1][0])
            if not controller_nh.has_param("wheel_radius"):
                self._radius = robot.wheel_radius(names[0][0])
        for name, value in (("wheel_separation", self._separation), ("wheel_radius", self._radius)):
            if not value > 0.0:
                raise ParameterError(f"{controller_nh.namespace}: {name} must be greater than 0 m, it is {value:g}; "
                                     "set it by parameter")
        multiplier = controller_nh.param("wheel_radius_multiplier", 1.0)
        self._multipliers = (
            controller_nh.param("wheel_separation_multiplier", 1.0),
            multiplier if controller_nh.has_param("wheel_radius_multiplier")
            else controller_nh.param("left_wheel_radius_multiplier", 1.0),
            multiplier if controller_nh.has_param("wheel_radius_multiplier")
            else controller_nh.param("right_wheel_radius_multiplier", 1.0))
        self._open_loop = controller_nh.param("open_loop", False)
        self._limit_linear = load_limiter(controller_nh, "linear/x")
        self._limit_angular = load_limiter(controller_nh, "angular/z")

        self._left, self._right = ([hw.get_handle(name) for name in side] for side in names)
        self._odometry = PlanarOdometry(controller_nh.param("velocity_rolling_window_size", 10))
        self._travel = WheelTravel(), WheelTravel()
        self._publisher = OdometryPublisher(root_nh, controller_nh)
        self._command_publisher = self._wheel_publisher = None
        if controller_nh.param("publish_cmd", False):
            self._command_publisher = RealtimePublisher(controller_nh, "cmd_vel_out", TwistStamped, queue_size=100)
        if controller_nh.param("publish_wheel_joint_controller_state", False):
            self._wheel_publisher = RealtimePublisher(controller_nh, "wheel_joint_controller_state",
                                                      JointTrajectoryControllerState, queue_size=100)
        self._desired = [0.0] * (2 * len(self._left))  # wheel positions as commanded, rad
        self._last_velocities = ([0.0] * len(self._desired), [0.0] * len(self._desired))
        self._command = VelocityCommand(controller_nh, self._brake)
        controller_nh.own(Server(controller_nh.namespace, _TABLE, self._reconfigure, initial=dict(
            zip((row.name for row in _TABLE), (*self._multipliers[1:], self._multipliers[0], self._publisher.rate,
                                               self._publisher.tf_enabled)))))

    def _reconfigure(self, config, level: int) -> None:
        if level == -1:
            return  # the server repeats what was loaded, clamped to what a slider shows: the loaded values hold
        self._multipliers = (config["wheel_separation_multiplier"], config["left_wheel_radius_multiplier"],
                             config["right_wheel_radius_multiplier"])
        self._publisher.tf_enabled = config["enable_odom_tf"]
        self._publisher.set_rate(config["publish_rate"])

    def starting(self, time: float) -> None:
        self._brake()
        self._limit_linear.reset()
        self._limit_angular.reset()
        self._odometry.restart(time)
        self._publisher.restart(time)
        self._command.start(time)

    def stopping(self, time: float) -> None:
        self._command.stop()
        self._brake()

    def aborting(self, time: float) -> None:
        self.stopping(time)

    def _brake(self) -> None:
        for handle in (*self._left, *self._right):
            handle.command = 0.0

    def update(self, time: float, period: float) -> None:
        separation_multiplier, left_multiplier, right_multiplier = self._multipliers
        separation = self._separation * separation_multiplier
        left_radius, right_radius = self._radius * left_multiplier, self._radius * right_multiplier

        if self._odometry.interval(time) < 0.0:  # the simulation was reset, and the wheels with it: not a way travelled
            self._odometry.restart(time)
            for travel in self._travel:
                travel.restart()
        if self._open_loop:
            self._odometry.commanded(self._limit_linear.last, self._limit_angular.last, time)
        else:
            left = sum(handle.state.position for handle in self._left) / len(self._left)
            right = sum(handle.state.position for handle in self._right) / len(self._right)
            if not (math.isfinite(left) and math.isfinite(right)):
                return
            self._odometry.travelled(*differential(self._travel[0](left) * left_radius,
                                                   self._travel[1](right) * right_radius, separation), time)
        self._publisher.publish(self._odometry, time)

        linear, angular = self._command.at(time)
        linear = self._limit_linear.limit(linear, period)
        angular = self._limit_angular.limit(angular, period)
        left_velocity = (linear - 0.5 * angular * separation) / left_radius
        right_velocity = (linear + 0.5 * angular * separation) / right_radius
        for handle in self._left:
            handle.command = left_velocity
        for handle in self._right:
            handle.command = right_velocity

        if self._command_publisher is not None:
            message = TwistStamped()
            message.header.stamp = rospy.Time.from_sec(time)
            message.twist.linear.x = linear
            message.twist.angular.z = angular
            self._command_publisher.publish(message)
        if self._wheel_publisher is not None:
            self._publish_wheels(time, period, left_velocity, right_velocity)

    def _publish_wheels(self, time: float, period: float, left_velocity: float, right_velocity: float) -> None:
        """State of every wheel, left ones first."""
        states = [handle.state for handle in (*self._left, *self._right)]
        desired = [left_velocity] * len(self._left) + [right_velocity] * len(self._right)
        actual = [state.velocity for state in states]
        for index, velocity in enumerate(desired):
            self._desired[index] += velocity * period
        message = JointTrajectoryControllerState(joint_names=[state.name for state in states])
        message.header.stamp = rospy.Time.from_sec(time)
        for point, velocities, last in zip((message.desired, message.actual), (desired, actual), self._last_velocities):
            point.velocities = velocities
            point.accelerations = [(v - v0) / period if period > 0.0 else 0.0 for v, v0 in zip(velocities, last)]
            point.time_from_start = rospy.Duration.from_sec(period)
        message.desired.positions = list(self._desired)
        message.desired.effort = [math.nan] * len(states)
        message.actual.positions = [state.position for state in states]
        message.actual.effort = [state.effort for state in states]
        for field in ("positions", "velocities", "accelerations", "effort"):
            setattr(message.error, field, [d - a for d, a in zip(getattr(message.desired, field),
                                                                 getattr(message.actual, field))])
        message.error.time_from_start = message.desired.time_from_start
        self._last_velocities = (desired, actual)
        self._wheel_publisher.publish(message)


def wheel_names(nh: NodeHandle, name: str) -> List[str]:
    """Joint names from a parameter that is one name or a list of them."""
    value = nh.get_param(name)
    return [value] if isinstance(value, str) and value else nh.strings(name)

"""The four wheel steering controller."""
from __future__ import annotations

import math
from typing import Any, List

import rospy
from controller_interface import MultiInterfaceController, NodeHandle, ParameterError, RealtimePublisher
from diff_drive_controller.odometry import MIN_INTERVAL, PlanarOdometry, RollingMean
from diff_drive_controller.odometry_publisher import OdometryPublisher
from diff_drive_controller.speed_limiter import load_limiter
from diff_drive_controller.velocity_command import VelocityCommand
from four_wheel_steering_msgs.msg import FourWheelSteering, FourWheelSteeringStamped
from hardware_interface import PositionJointInterface, VelocityJointInterface
from urdf_geometry_parser import RobotGeometry, robot_geometry

from .kinematics import Axle, Base, axle_angle

_NONE = (0.0, 0.0, 0.0, -math.inf)  # speed m/s, front and rear angle rad, when it came


class FourWheelSteeringController(MultiInterfaceController):
    """Obeys ``cmd_vel`` or ``cmd_four_wheel_steering``, whichever came last."""

    interfaces = (VelocityJointInterface, PositionJointInterface)

    def init(self, hw, root_nh: NodeHandle, controller_nh: NodeHandle) -> None:
        self._name = controller_nh.namespace
        wheels, steering = hw.get(VelocityJointInterface), hw.get(PositionJointInterface)
        self._wheels = [wheels.get_handle(name) for axle in ("front", "rear")
                        for name in _pair(controller_nh, f"{axle}_wheel")]
        self._steering = [steering.get_handle(name) for axle in ("front", "rear")
                          for name in _pair(controller_nh, f"{axle}_steering")]
        self._publisher = OdometryPublisher(root_nh, controller_nh, odom_frame="odom")
        self._base = self._geometry(robot_geometry(root_nh, search=False), controller_nh)
        self._limit_linear = load_limiter(controller_nh, "linear/x", jerk=False)
        self._limit_angular = load_limiter(controller_nh, "angular/z", jerk=False)
        window = controller_nh.param("velocity_rolling_window_size", 10)
        self._odometry = PlanarOdometry(window)
        self._rates = _Rates(window)
        self._timeout = controller_nh.param("cmd_vel_timeout", 0.5)
        self._running = False
        self._now = 0.0
        self._wanted = _NONE
        self._twist = VelocityCommand(controller_nh, self._brake)
        controller_nh.subscriber("cmd_four_wheel_steering", FourWheelSteering, self._on_steering, queue_size=1)
        self._steer_publisher = RealtimePublisher(controller_nh, "odom_steer", FourWheelSteeringStamped, queue_size=100)

    def _geometry(self, robot: RobotGeometry, nh: NodeHandle) -> Base:
        """Lengths from parameters, else from the URDF; those found there are written back."""
        link = self._publisher.base_frame
        names = [handle.name for handle in self._wheels]

        def between(first: str, second: str) -> float:
            return math.dist(robot.position(first, link)[:2], robot.position(second, link)[:2])

        def length(name: str, find) -> float:
            value = nh.param(name, 0.0) if nh.has_param(name) else find()
            if not value > 0.0:
                raise ParameterError(f"{self._name}: {name} must be greater than 0 m, it is {value:g}; set it by "
                                     "parameter")
            nh.set_param(name, value)
            return value

        track = length("track", lambda: between(names[0], names[1]))
        base = length("wheel_base", lambda: between(names[0], names[2]))
        radius = length("wheel_radius", lambda: robot.wheel_radius(names[0], shapes=("cylinder",)))
        offset = between(self._steering[0].name, names[0])
        nh.set_param("wheel_steering_y_offset", offset)
        return Base(track - 2.0 * offset, base, radius, offset)

    def starting(self, time: float) -> None:
        self._brake()
        self._limit_linear.reset()
        self._limit_angular.reset()
        self._odometry.restart(time)
        self._rates.restart()
        self._publisher.restart(time)
        self._now = time
        self._wanted = _NONE
        self._running = True
        self._twist.start(time)

    def stopping(self, time: float) -> None:
        self._running = False
        self._twist.stop()
        self._brake()

    def aborting(self, time: float) -> None:
        self.stopping(time)

    def _brake(self) -> None:
        for handle in (*self._wheels, *self._steering):
            handle.command = 0.0

    def update(self, time: float, period: float) -> None:
        self._now = time
        self._update_odometry(time)
        linear, angular = self._twist.at(time)
        speed, front, rear, stamp = self._wanted
        if stamp > time:  # from before a simulation was reset
            self._wanted = _NONE
        if not 0.0 <= time - stamp <= self._timeout:
            speed = front = rear = 0.0
        if self._twist.stamp > stamp:
            axles = self._base.from_twist(self._limit_linear.limit(linear, period),
                                          self._limit_angular.limit(angular, period))
        else:
            axles = self._base.from_steering(self._limit_linear.limit(speed, period), front, rear)
        for axle, wheels, steering in zip(axles, (self._wheels[:2], self._wheels[2:]),
                                          (self._steering[:2], self._steering[2:])):
            wheels[0].command, wheels[1].command = axle.left_speed, axle.right_speed
            steering[0].command, steering[1].command = axle.left_angle, axle.right_angle

    def _update_odometry(self, time: float) -> None:
        angles = [handle.position for handle in self._steering]
        speeds = [handle.velocity for handle in self._wheels]
        if not all(map(math.isfinite, (*angles, *speeds))):
            return
        front, rear = Axle(*angles[:2], *speeds[:2]), Axle(*angles[2:], *speeds[2:])
        dt = self._odometry.interval(time)
        if dt < 0.0:  # the simulation was reset
            self._odometry.restart(time)
        self._odometry.moved(*self._base.motion(front, rear), time)
        state = FourWheelSteering()
        state.front_steering_angle, state.rear_steering_angle = axle_angle(front), axle_angle(rear)
        state.speed = math.copysign(math.hypot(self._odometry.linear, self._odometry.linear_y), self._odometry.linear)
        if dt >= MIN_INTERVAL:
            self._rates.update(state, dt)
        self._rates.fill(state)
        if self._publisher.due(time):
            message = FourWheelSteeringStamped(data=state)
            message.header.stamp = rospy.Time.from_sec(time)
            self._steer_publisher.publish(message)
        self._publisher.publish(self._odometry, time)

    def _on_steering(self, message: FourWheelSteering) -> None:
        values = (message.speed, message.front_steering_angle, message.rear_steering_angle)
        if not self._running:
            rospy.logerr_throttle(1.0, f"{self._name}: Can't accept new commands. Controller is not running.")
        elif not all(map(math.isfinite, values)):
            rospy.logwarn_throttle(1.0, f"{self._name}: Received NaN in four wheel steering command. Ignoring.")
        else:
            right_angle = 0.5 * math.pi
            self._wanted = (values[0], *(max(-right_angle, min(right_angle, angle)) for angle in values[1:]), self._now)


class _Rates:
    """Smoothed derivatives of what odom_steer reports."""

    _FIELDS = {"acceleration": "speed", "jerk": "acceleration", "front_steering_angle_velocity": "front_steering_angle",
               "rear_steering_angle_velocity": "rear_steering_angle"}

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


def _pair(nh: NodeHandle, name: str) -> List[str]:
    """[left, right] joint names from a parameter."""
    names = nh.strings(name)
    if len(names) != 2:
        raise ParameterError(f"parameter {nh.resolve(name)} must name two joints, left and right, it is {names}")
    return names

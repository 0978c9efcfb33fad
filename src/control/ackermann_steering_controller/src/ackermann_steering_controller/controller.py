"""The Ackermann steering controller."""
from __future__ import annotations

import math

from controller_interface import MultiInterfaceController, NodeHandle, ParameterError
from diff_drive_controller.odometry import PlanarOdometry, WheelTravel
from diff_drive_controller.odometry_publisher import OdometryPublisher
from diff_drive_controller.speed_limiter import load_limiter
from diff_drive_controller.velocity_command import VelocityCommand
from hardware_interface import PositionJointInterface, VelocityJointInterface
from urdf_geometry_parser import robot_geometry


class AckermannSteeringController(MultiInterfaceController):
    """A bicycle: joint ``rear_wheel`` drives, joint ``front_steer`` steers.

    The steering angle is ``angular.z`` of the command itself, rad, and not the one that would give that yaw rate.
    """

    interfaces = (PositionJointInterface, VelocityJointInterface)

    def init(self, hw, root_nh: NodeHandle, controller_nh: NodeHandle) -> None:
        rear_wheel = controller_nh.param("rear_wheel", "rear_wheel_joint")
        front_steer = controller_nh.param("front_steer", "front_steer_joint")
        base = controller_nh.param("wheel_separation_h", 0.0)
        radius = controller_nh.param("wheel_radius", 0.0)
        if not (controller_nh.has_param("wheel_separation_h") and controller_nh.has_param("wheel_radius")):
            robot = robot_geometry(root_nh, search=False)
            if not controller_nh.has_param("wheel_separation_h"):
                base = abs(robot.joint(rear_wheel).origin[0] - robot.joint(front_steer).origin[0])
            if not controller_nh.has_param("wheel_radius"):
                radius = robot.wheel_radius(rear_wheel, shapes=("cylinder",))
        for name, value in (("wheel_separation_h", base), ("wheel_radius", radius)):
            if not value > 0.0:
                raise ParameterError(f"{controller_nh.namespace}: {name} must be greater than 0 m, it is {value:g}; "
                                     "set it by parameter")
        self._radius = radius
        # for odometry only: the command is not corrected by multipliers
        self._odometry_radius = radius * controller_nh.param("wheel_radius_multiplier", 1.0)
        self._odometry_base = base * controller_nh.param("wheel_separation_h_multiplier", 1.0)
        self._steer_multiplier = controller_nh.param("steer_pos_multiplier", 1.0)
        self._open_loop = controller_nh.param("open_loop", False)
        self._limit_linear = load_limiter(controller_nh, "linear/x")
        self._limit_angular = load_limiter(controller_nh, "angular/z")
        self._steer = hw.get(PositionJointInterface).get_handle(front_steer)
        self._wheel = hw.get(VelocityJointInterface).get_handle(rear_wheel)
        self._odometry = PlanarOdometry(controller_nh.param("velocity_rolling_window_size", 10))
        self._travel = WheelTravel()
        self._publisher = OdometryPublisher(root_nh, controller_nh)
        self._command = VelocityCommand(controller_nh, self._brake)

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
        self._wheel.command = 0.0
        self._steer.command = 0.0

    def update(self, time: float, period: float) -> None:
        if self._odometry.interval(time) < 0.0:  # the simulation was reset, and the wheel with it: not a way travelled
            self._odometry.restart(time)
            self._travel.restart()
        if self._open_loop:
            self._odometry.commanded(self._limit_linear.last, self._limit_angular.last, time)
        else:
            wheel, steer = self._wheel.position, self._steer.position
            if not (math.isfinite(wheel) and math.isfinite(steer)):
                return
            distance = self._travel(wheel) * self._odometry_radius
            curvature = math.tan(steer * self._steer_multiplier) / self._odometry_base
            self._odometry.travelled(distance, curvature * distance, time)
        self._publisher.publish(self._odometry, time)

        linear, angular = self._command.at(time)
        self._wheel.command = self._limit_linear.limit(linear, period) / self._radius
        self._steer.command = self._limit_angular.limit(angular, period)

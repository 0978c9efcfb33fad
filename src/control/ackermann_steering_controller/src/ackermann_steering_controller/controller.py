"""The Ackermann steering controller."""

from __future__ import annotations

import math

from controller_interface import MultiInterfaceController, NodeHandle
from diff_drive_controller.laws import WheelTravel, bicycle
from diff_drive_controller.wheeled_base import WheeledBase, length, multiplier
from hardware_interface import PositionJointInterface, VelocityJointInterface
from urdf_geometry_parser import robot_geometry


class AckermannSteeringController(WheeledBase, MultiInterfaceController):
    """A bicycle: joint ``rear_wheel`` drives, joint ``front_steer`` steers.

    The steering angle is ``angular.z`` of the command itself, rad, and not the one that would give that yaw rate.
    """

    interfaces = (PositionJointInterface, VelocityJointInterface)

    def init(self, hw, root_nh: NodeHandle, controller_nh: NodeHandle) -> None:
        rear_wheel = controller_nh.param("rear_wheel", "rear_wheel_joint")
        front_steer = controller_nh.param("front_steer", "front_steer_joint")

        def distance() -> float:
            robot = robot_geometry(root_nh, search=False)
            return abs(robot.joint(rear_wheel).origin[0] - robot.joint(front_steer).origin[0])

        base = length(controller_nh, "wheel_separation_h", distance)
        self._radius = length(
            controller_nh, "wheel_radius", lambda: robot_geometry(root_nh, search=False).wheel_radius(rear_wheel, shapes=("cylinder",))
        )
        # for odometry only: the command is not corrected by multipliers
        self._odometry_radius = self._radius * multiplier(controller_nh, "wheel_radius_multiplier")
        self._odometry_base = base * multiplier(controller_nh, "wheel_separation_h_multiplier")
        self._steer_multiplier = multiplier(controller_nh, "steer_pos_multiplier")
        self._steer = hw.get(PositionJointInterface).get_handle(front_steer)
        self._wheel = hw.get(VelocityJointInterface).get_handle(rear_wheel)
        self.init_base(root_nh, controller_nh, (WheelTravel(),))

    def brake(self) -> None:
        self._wheel.command = 0.0
        self._steer.command = 0.0

    def measured_way(self) -> tuple[float, float] | None:
        wheel, steer = self._wheel.position, self._steer.position
        if not (math.isfinite(wheel) and math.isfinite(steer)):
            return None
        distance = self._travel[0](wheel) * self._odometry_radius
        return bicycle(distance, steer * self._steer_multiplier, self._odometry_base)

    def update(self, time: float, period: float) -> None:
        if self.update_odometry(time):
            linear, angle = self.limited_command(time, period)
            self._wheel.command = linear / self._radius
            self._steer.command = angle

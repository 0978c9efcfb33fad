"""What the trajectory controllers write to each kind of joint."""

from __future__ import annotations

import math
from typing import ClassVar

from control_toolbox import load_pid
from controller_interface import ParameterError
from hardware_interface import (
    EffortJointInterface,
    HardwareInterface,
    PositionJointInterface,
    PosVelAccJointInterface,
    PosVelJointInterface,
    VelocityJointInterface,
)

from .controller import JointTrajectoryController


class PositionTrajectoryController(JointTrajectoryController):
    """Desired positions."""

    interface = PositionJointInterface

    def init_output(self, handles, controller_nh):
        self._handles = handles
        if type(self).write_output is PositionTrajectoryController.write_output:
            self.write_positions_to(handles)

    def start_output(self):
        for handle in self._handles:
            if math.isfinite(handle.position):
                handle.command = handle.position

    def write_output(self, desired, errors, period):
        for handle, point in zip(self._handles, desired):
            handle.command = point[0]


class PosVelTrajectoryController(JointTrajectoryController):
    """Desired positions and velocities."""

    interface: ClassVar[type[HardwareInterface]] = PosVelJointInterface

    def init_output(self, handles, controller_nh):
        self._handles = handles

    def write_output(self, desired, errors, period):
        for handle, point in zip(self._handles, desired):
            handle.command_position, handle.command_velocity, _ = point


class PosVelAccTrajectoryController(PosVelTrajectoryController):
    """Desired positions, velocities and accelerations."""

    interface = PosVelAccJointInterface

    def write_output(self, desired, errors, period):
        for handle, point in zip(self._handles, desired):
            handle.command_position, handle.command_velocity, handle.command_acceleration = point


class _FeedbackTrajectoryController(JointTrajectoryController):
    """PID on the position error (parameters ``gains/JOINT``) plus ``velocity_ff/JOINT`` times the desired velocity."""

    feeds_back = True

    def init_output(self, handles, controller_nh):
        self._outputs = [
            (handle, load_pid(controller_nh.sub(f"gains/{handle.name}")), _feed_forward(controller_nh, handle.name)) for handle in handles
        ]

    def start_output(self):
        for handle, pid, _ in self._outputs:
            pid.reset()
            handle.command = 0.0

    def write_output(self, desired, errors, period):
        for (handle, pid, velocity_ff), point, error in zip(self._outputs, desired, errors):
            handle.command = velocity_ff * point[1] + pid.compute_command(error[0], period, error[1])
            handle.slope = pid.slope_of_position(period)


class VelocityTrajectoryController(_FeedbackTrajectoryController):
    """Velocities."""

    interface = VelocityJointInterface


class EffortTrajectoryController(_FeedbackTrajectoryController):
    """Torques or forces."""

    interface = EffortJointInterface


def _feed_forward(nh, joint):
    """Factor of the desired velocity, from parameter ``velocity_ff/JOINT``; 0 without it."""
    factor = nh.param(f"velocity_ff/{joint}", 0.0)
    if math.isinf(factor):
        raise ParameterError(f"parameter {nh.resolve(f'velocity_ff/{joint}')} must be a finite number, it is {factor}")
    return factor

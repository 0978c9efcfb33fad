"""Interfaces of the package rm_common, for compiled controllers that ask for them (rm_controllers)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from hardware_interface._robots import Robot

from . import _rm_control
from .actuator import Actuator
from .imu import Imu


class RmControlPart:
    """Keeps what compiled controllers see up to date. Imports compiled code; made when the first of them is loaded.

    :ivar robot: the interfaces, in C++
    """

    def __init__(self, actuators: Sequence[Actuator], imus: dict[str, Imu]) -> None:
        self._core = _rm_control.Interfaces()
        self._motors: list[tuple[Actuator, _rm_control.Motor]] = []
        for actuator in actuators:
            motor = self._core.add_motor(actuator.name)
            motor.need_calibration = actuator.need_calibration
            motor.calibrated, motor.offset = actuator.calibrated, actuator.offset
            self._motors.append((actuator, motor))
        self._imus: list[tuple[Imu, Any]] = [
            (imu, self._core.add_imu(name, imu.config.frame_id, imu.handle._addresses)) for name, imu in imus.items()
        ]
        self.robot = Robot(self._core.address, self._core)

    def take(self) -> None:
        """Before frames are read: what calibration controllers have written."""
        for actuator, motor in self._motors:
            actuator.offset, actuator.calibrated = motor.offset, motor.calibrated

    def show(self) -> None:
        """After they have been read."""
        for actuator, motor in self._motors:
            motor.halted, motor.calibrated = actuator.halted, actuator.calibrated
            motor.calibration_reading, motor.position = actuator.calibration_reading, actuator.position
        for imu, stamp in self._imus:
            stamp.set(imu.stamp)

"""Data of one joint, actuator or sensor. All attributes are plain floats in SI units; see the package docstring.

The numbers lie in memory that C++ handles point at (``core/handles.cpp``), so compiled controllers and robots see the same ones.
"""

from __future__ import annotations

from enum import IntEnum

from ._handles import (
    ForceTorqueSensorHandle,
    ImuSensorHandle,
    JointHandle,
    JointStateHandle,
    PositionVelocityTorqueGainsJointHandle,
    PosVelAccJointHandle,
    PosVelJointHandle,
)
from ._handles import JointModeHandle as _JointModeHandle

__all__ = [
    "ActuatorHandle",
    "ActuatorStateHandle",
    "ForceTorqueSensorHandle",
    "ImuSensorHandle",
    "JointHandle",
    "JointMode",
    "JointModeHandle",
    "JointStateHandle",
    "PosVelAccJointHandle",
    "PosVelJointHandle",
    "PositionVelocityTorqueGainsJointHandle",
    "addresses",
]


def addresses(handle) -> tuple[int, ...]:
    """Where its numbers are, in the order in which the class declares them; 0 for what is not there. C++ may read and write them as
    long as the handle lives."""
    return handle._addresses


class ActuatorStateHandle(JointStateHandle):
    """Measured state of an actuator, in its own coordinates (before the transmission)."""

    __slots__ = ()


class ActuatorHandle(JointHandle):
    """An actuator and one command, in the actuator's coordinates."""

    __slots__ = ()


class JointMode(IntEnum):
    """How a drive controls its joint."""

    NOT_OPERATIONAL = -1
    POSITION = 0
    VELOCITY = 1
    EFFORT = 2
    OTHER = 3
    EMERGENCY_STOP = 4
    SWITCHING = 5
    ERROR = 6


class JointModeHandle(_JointModeHandle):
    """The mode of one drive."""

    __slots__ = ()

    @property
    def mode(self) -> JointMode:
        return JointMode(self._mode)

    @mode.setter
    def mode(self, mode: JointMode) -> None:
        self._mode = mode

"""Data of one joint, actuator or sensor. All attributes are plain floats in SI units; see the package docstring."""
from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from operator import attrgetter
from typing import Optional, Sequence


@dataclass(eq=False, slots=True)
class JointStateHandle:
    """Measured state of a joint, written by the hardware.

    :param absolute_position: of an absolute encoder (rad or m), None where there is none.
    :param torque_sensor: reading of a torque sensor (Nm or N), None where there is none.
    """

    name: str
    position: float = 0.0
    velocity: float = 0.0
    effort: float = 0.0
    absolute_position: Optional[float] = None
    torque_sensor: Optional[float] = None


class ActuatorStateHandle(JointStateHandle):
    """Measured state of an actuator, in its own coordinates (before the transmission)."""

    __slots__ = ()


@dataclass(eq=False, slots=True)
class _CommandHandle:
    """A commanding handle shows the state of its joint too. In a tight loop read ``handle.state`` directly."""

    state: JointStateHandle

    def __post_init__(self) -> None:
        if not isinstance(self.state, JointStateHandle):
            raise TypeError(f"a joint or actuator state handle is needed here, not {self.state!r}")

    name = property(attrgetter("state.name"))
    position = property(attrgetter("state.position"))
    velocity = property(attrgetter("state.velocity"))
    effort = property(attrgetter("state.effort"))
    absolute_position = property(attrgetter("state.absolute_position"))
    torque_sensor = property(attrgetter("state.torque_sensor"))


@dataclass(eq=False, slots=True)
class JointHandle(_CommandHandle):
    """A joint and one command: position, velocity or effort, depending on the interface it is registered in.

    :param slope: of the law behind an effort command: how much less effort a controller that closes a loop commands per rad/s or
        m/s that its joint gets faster, N m s/rad or N s/m; 0 where nothing is known. A simulation may hold a stiff law with it;
        hardware need not look at it.
    """

    command: float = 0.0
    slope: float = 0.0


class ActuatorHandle(JointHandle):
    """An actuator and one command, in the actuator's coordinates."""

    __slots__ = ()


@dataclass(eq=False, slots=True)
class PosVelJointHandle(_CommandHandle):
    """A joint commanded in position and velocity."""

    command_position: float = 0.0
    command_velocity: float = 0.0


@dataclass(eq=False, slots=True)
class PosVelAccJointHandle(PosVelJointHandle):
    """A joint commanded in position, velocity and acceleration."""

    command_acceleration: float = 0.0


@dataclass(eq=False, slots=True)
class PositionVelocityTorqueGainsJointHandle(PosVelJointHandle):
    """A joint whose drive closes the loop itself: set points, feed-forward effort and the gains kp, kd."""

    command_effort: float = 0.0
    kp: float = 0.0
    kd: float = 0.0


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


@dataclass(eq=False, slots=True)
class JointModeHandle:
    """The mode of one drive."""

    name: str
    mode: JointMode = JointMode.NOT_OPERATIONAL


@dataclass(eq=False, slots=True)
class ImuSensorHandle:
    """An inertial measurement unit. What the sensor does not measure stays None.

    :param name: of the sensor; also the topic it is published on.
    :param frame_id: tf frame of the measurements.
    :param orientation: (4,) x y z w of the sensor frame in the world.
    :param angular_velocity: (3,) rad/s in the sensor frame.
    :param linear_acceleration: (3,) m/s^2 in the sensor frame.
    :param orientation_covariance: (9,) row-major, likewise the other two.
    """

    name: str
    frame_id: str = ""
    orientation: Optional[Sequence[float]] = None
    orientation_covariance: Optional[Sequence[float]] = None
    angular_velocity: Optional[Sequence[float]] = None
    angular_velocity_covariance: Optional[Sequence[float]] = None
    linear_acceleration: Optional[Sequence[float]] = None
    linear_acceleration_covariance: Optional[Sequence[float]] = None


@dataclass(eq=False, slots=True)
class ForceTorqueSensorHandle:
    """A wrist or foot sensor.

    :param name: of the sensor; also the topic it is published on.
    :param frame_id: tf frame of the measurements.
    :param force: (3,) N in that frame; None where there is no force sensor.
    :param torque: (3,) Nm in that frame; None where there is no torque sensor.
    """

    name: str
    frame_id: str = ""
    force: Optional[Sequence[float]] = None
    torque: Optional[Sequence[float]] = None

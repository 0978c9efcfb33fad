"""Data of one joint, actuator or sensor. All attributes are plain floats in SI units; see the package docstring."""
from __future__ import annotations

from enum import IntEnum
from typing import Optional, Sequence


class JointStateHandle:
    """Measured state of a joint, written by the hardware.

    :param absolute_position: of an absolute encoder (rad or m), None where there is none.
    :param torque_sensor: reading of a torque sensor (Nm or N), None where there is none.
    """

    __slots__ = ("name", "position", "velocity", "effort", "absolute_position", "torque_sensor")

    def __init__(self, name: str, position: float = 0.0, velocity: float = 0.0, effort: float = 0.0,
                 absolute_position: Optional[float] = None, torque_sensor: Optional[float] = None):
        self.name = name
        self.position = position
        self.velocity = velocity
        self.effort = effort
        self.absolute_position = absolute_position
        self.torque_sensor = torque_sensor


class ActuatorStateHandle(JointStateHandle):
    """Measured state of an actuator, in its own coordinates (before the transmission)."""

    __slots__ = ()


class _StatePassThrough:
    """A commanding handle shows the state of its joint too. In a tight loop read ``handle.state`` directly."""

    __slots__ = ("state",)

    def __init__(self, state: JointStateHandle):
        if not isinstance(state, JointStateHandle):
            raise TypeError(f"a joint or actuator state handle is needed here, not {state!r}")
        self.state = state

    @property
    def name(self) -> str:
        return self.state.name

    @property
    def position(self) -> float:
        return self.state.position

    @property
    def velocity(self) -> float:
        return self.state.velocity

    @property
    def effort(self) -> float:
        return self.state.effort

    @property
    def absolute_position(self) -> Optional[float]:
        return self.state.absolute_position

    @property
    def torque_sensor(self) -> Optional[float]:
        return self.state.torque_sensor


class JointHandle(_StatePassThrough):
    """A joint and one command: position, velocity or effort, depending on the interface it is registered in."""

    __slots__ = ("command",)

    def __init__(self, state: JointStateHandle, command: float = 0.0):
        super().__init__(state)
        self.command = command


class ActuatorHandle(JointHandle):
    """An actuator and one command, in the actuator's coordinates."""

    __slots__ = ()


class PosVelJointHandle(_StatePassThrough):
    """A joint commanded in position and velocity."""

    __slots__ = ("command_position", "command_velocity")

    def __init__(self, state: JointStateHandle, command_position: float = 0.0, command_velocity: float = 0.0):
        super().__init__(state)
        self.command_position = command_position
        self.command_velocity = command_velocity


class PosVelAccJointHandle(PosVelJointHandle):
    """A joint commanded in position, velocity and acceleration."""

    __slots__ = ("command_acceleration",)

    def __init__(self, state: JointStateHandle, command_position: float = 0.0, command_velocity: float = 0.0,
                 command_acceleration: float = 0.0):
        super().__init__(state, command_position, command_velocity)
        self.command_acceleration = command_acceleration


class PositionVelocityTorqueGainsJointHandle(PosVelJointHandle):
    """A joint whose drive closes the loop itself: set points, feed-forward effort and the gains kp, kd."""

    __slots__ = ("command_effort", "kp", "kd")

    def __init__(self, state: JointStateHandle, command_position: float = 0.0, command_velocity: float = 0.0,
                 command_effort: float = 0.0, kp: float = 0.0, kd: float = 0.0):
        super().__init__(state, command_position, command_velocity)
        self.command_effort = command_effort
        self.kp = kp
        self.kd = kd


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


class JointModeHandle:
    """The mode of one drive."""

    __slots__ = ("name", "mode")

    def __init__(self, name: str, mode: JointMode = JointMode.NOT_OPERATIONAL):
        self.name = name
        self.mode = mode


class ImuSensorHandle:
    """An inertial measurement unit. What the sensor does not measure stays None.

    :param name: of the sensor; also the topic it is published on.
    :param frame_id: tf frame of the measurements.
    :param orientation: (4,) x y z w of the sensor frame in the world.
    :param angular_velocity: (3,) rad/s in the sensor frame.
    :param linear_acceleration: (3,) m/s^2 in the sensor frame.
    :param orientation_covariance: (9,) row-major, likewise the other two.
    """

    __slots__ = ("name", "frame_id", "orientation", "orientation_covariance", "angular_velocity",
                 "angular_velocity_covariance", "linear_acceleration", "linear_acceleration_covariance")

    def __init__(self, name: str, frame_id: str = "", orientation: Optional[Sequence[float]] = None,
                 orientation_covariance: Optional[Sequence[float]] = None,
                 angular_velocity: Optional[Sequence[float]] = None,
                 angular_velocity_covariance: Optional[Sequence[float]] = None,
                 linear_acceleration: Optional[Sequence[float]] = None,
                 linear_acceleration_covariance: Optional[Sequence[float]] = None):
        self.name = name
        self.frame_id = frame_id
        self.orientation = orientation
        self.orientation_covariance = orientation_covariance
        self.angular_velocity = angular_velocity
        self.angular_velocity_covariance = angular_velocity_covariance
        self.linear_acceleration = linear_acceleration
        self.linear_acceleration_covariance = linear_acceleration_covariance


class ForceTorqueSensorHandle:
    """A wrist or foot sensor.

    :param name: of the sensor; also the topic it is published on.
    :param frame_id: tf frame of the measurements.
    :param force: (3,) N in that frame; None where there is no force sensor.
    :param torque: (3,) Nm in that frame; None where there is no torque sensor.
    """

    __slots__ = ("name", "frame_id", "force", "torque")

    def __init__(self, name: str, frame_id: str = "", force: Optional[Sequence[float]] = None,
                 torque: Optional[Sequence[float]] = None):
        self.name = name
        self.frame_id = frame_id
        self.force = force
        self.torque = torque

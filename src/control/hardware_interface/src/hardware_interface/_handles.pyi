"""Handles whose numbers C++ can point at: core/handles.cpp.

``_addresses`` are those of the numbers, in the order in which they are declared here, 0 for what is not there; ``_look_at`` makes a
handle a view of numbers that ``keeper`` keeps.
"""

from collections.abc import Sequence
from typing import Any

_Addresses = tuple[int, int, int, int, int, int]

class JointStateHandle:
    """Measured state of a joint, written by the hardware.

    :param absolute_position: of an absolute encoder (rad or m), None where there is none.
    :param torque_sensor: reading of a torque sensor (Nm or N), None where there is none.
    """

    position: float
    velocity: float
    effort: float
    absolute_position: float | None
    torque_sensor: float | None
    def __init__(
        self,
        name: str,
        position: float = ...,
        velocity: float = ...,
        effort: float = ...,
        absolute_position: float | None = ...,
        torque_sensor: float | None = ...,
    ) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def _addresses(self) -> _Addresses: ...
    def _look_at(self, addresses: tuple[int, ...], keeper: Any, /) -> None: ...

class _CommandHandle:
    """A commanding handle shows the state of its joint too. In a tight loop read ``handle.state`` directly."""

    @property
    def name(self) -> str: ...
    @property
    def state(self) -> JointStateHandle: ...
    @property
    def position(self) -> float: ...
    @property
    def velocity(self) -> float: ...
    @property
    def effort(self) -> float: ...
    @property
    def absolute_position(self) -> float | None: ...
    @property
    def torque_sensor(self) -> float | None: ...
    @property
    def _addresses(self) -> _Addresses: ...
    def _look_at(self, addresses: tuple[int, ...], keeper: Any, /) -> None: ...

class JointHandle(_CommandHandle):
    """A joint and one command: position, velocity or effort, depending on the interface it is registered in.

    :param slope: of the law behind an effort command: how much less effort a controller that closes a loop commands per rad/s or
        m/s that its joint gets faster, N m s/rad or N s/m; 0 where nothing is known. A simulation may hold a stiff law with it;
        hardware need not look at it.
    """

    command: float
    slope: float
    def __init__(self, state: JointStateHandle, command: float = ..., slope: float = ...) -> None: ...

class PosVelJointHandle(_CommandHandle):
    """A joint commanded in position and velocity."""

    command_position: float
    command_velocity: float
    def __init__(self, state: JointStateHandle, command_position: float = ..., command_velocity: float = ...) -> None: ...

class PosVelAccJointHandle(PosVelJointHandle):
    """A joint commanded in position, velocity and acceleration."""

    command_acceleration: float
    def __init__(
        self, state: JointStateHandle, command_position: float = ..., command_velocity: float = ..., command_acceleration: float = ...
    ) -> None: ...

class PositionVelocityTorqueGainsJointHandle(PosVelJointHandle):
    """A joint whose drive closes the loop itself: set points, feed-forward effort and the gains kp, kd."""

    command_effort: float
    kp: float
    kd: float
    def __init__(
        self,
        state: JointStateHandle,
        command_position: float = ...,
        command_velocity: float = ...,
        command_effort: float = ...,
        kp: float = ...,
        kd: float = ...,
    ) -> None: ...

class ImuSensorHandle:
    """An inertial measurement unit. What the sensor does not measure stays None.

    :param name: of the sensor; also the topic it is published on.
    :param frame_id: tf frame of the measurements.
    :param orientation: (4,) x y z w of the sensor frame in the world.
    :param angular_velocity: (3,) rad/s in the sensor frame.
    :param linear_acceleration: (3,) m/s^2 in the sensor frame.
    :param orientation_covariance: (9,) row-major, likewise the other two.
    """

    orientation: Sequence[float] | None
    orientation_covariance: Sequence[float] | None
    angular_velocity: Sequence[float] | None
    angular_velocity_covariance: Sequence[float] | None
    linear_acceleration: Sequence[float] | None
    linear_acceleration_covariance: Sequence[float] | None
    def __init__(
        self,
        name: str,
        frame_id: str = ...,
        orientation: Sequence[float] | None = ...,
        orientation_covariance: Sequence[float] | None = ...,
        angular_velocity: Sequence[float] | None = ...,
        angular_velocity_covariance: Sequence[float] | None = ...,
        linear_acceleration: Sequence[float] | None = ...,
        linear_acceleration_covariance: Sequence[float] | None = ...,
    ) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def frame_id(self) -> str: ...
    @property
    def _addresses(self) -> _Addresses: ...
    def _look_at(self, addresses: tuple[int, ...], keeper: Any, /) -> None: ...

class ForceTorqueSensorHandle:
    """A wrist or foot sensor.

    :param name: of the sensor; also the topic it is published on.
    :param frame_id: tf frame of the measurements.
    :param force: (3,) N in that frame; None where there is no force sensor.
    :param torque: (3,) Nm in that frame; None where there is no torque sensor.
    """

    force: Sequence[float] | None
    torque: Sequence[float] | None
    def __init__(
        self, name: str, frame_id: str = ..., force: Sequence[float] | None = ..., torque: Sequence[float] | None = ...
    ) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def frame_id(self) -> str: ...
    @property
    def _addresses(self) -> _Addresses: ...
    def _look_at(self, addresses: tuple[int, ...], keeper: Any, /) -> None: ...

class JointModeHandle:
    """The mode of one drive, as a number."""

    _mode: int
    def __init__(self, name: str, mode: int = ...) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def _address(self) -> int: ...
    def _look_at(self, address: int, keeper: Any, /) -> None: ...

"""From messages to measurements: frames, covariances, what each sensor is asked for."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .filters import Measurement
from .motion import ACCELERATION, ORIENTATION, POSITION, SIZE, rotation, wrap

GRAVITY = 9.80665  # m/s²


class FrameMissing(Exception):
    """A transform is not known (yet); the text says which."""


@dataclass
class Transform:
    """x_target = rotation @ x_source + translation"""

    rotation: np.ndarray
    translation: np.ndarray

    def inverse(self) -> "Transform":
        return Transform(self.rotation.T, -self.rotation.T @ self.translation)

    def __matmul__(self, other: "Transform") -> "Transform":
        return Transform(self.rotation @ other.rotation, self.rotation @ other.translation + self.translation)


IDENTITY = Transform(np.eye(3), np.zeros(3))


def quaternion_matrix(x: float, y: float, z: float, w: float) -> np.ndarray:
    """(3, 3) of the quaternion ``x``, ``y``, ``z``, ``w``; all zeros count as no rotation.

    :raises ValueError: it is not finite or far from length 1
    """
    length = np.sqrt(x * x + y * y + z * z + w * w)
    if length == 0.0:
        return np.eye(3)
    if not abs(length - 1) < 0.1:
        raise ValueError(f"orientation ({x:g}, {y:g}, {z:g}, {w:g}) is not a unit quaternion")
    x, y, z, w = x / length, y / length, z / length, w / length
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def angles(matrix: np.ndarray) -> np.ndarray:
    """(3,): fixed-axis roll, pitch, yaw of ``matrix``, a rotation, rad."""
    return np.array(
        [np.arctan2(matrix[2, 1], matrix[2, 2]), np.arcsin(np.clip(-matrix[2, 0], -1, 1)), np.arctan2(matrix[1, 0], matrix[0, 0])]
    )


def _turned(used: np.ndarray, turn: np.ndarray) -> np.ndarray:
    """Which axes are known after a rotation: those into which a known one turns for the most part."""
    return np.abs(turn @ np.diag(used.astype(float))).max(axis=1) >= 1e-6 if used.any() else used


def _blocks(turn: np.ndarray) -> np.ndarray:
    """(6, 6) with the rotation twice."""
    return np.kron(np.eye(2), turn)


Lookup = Callable[[str, str, object], Transform]  # target frame, source frame, stamp; raises FrameMissing


@dataclass
class Pose:
    """What a PoseWithCovarianceStamped, the pose of an Odometry or the orientation of an Imu says."""

    frame: str
    stamp: object
    time: float
    transform: Transform
    covariance: np.ndarray  # (6, 6)
    child: str = ""  # the frame that has this pose, "" is the robot's base


class PoseInput:
    """Poses as measurements of position and orientation, or differentially of velocities.

    :param used: (6,) bool: x, y, z, roll, pitch, yaw
    :param inertial: the frame is that in which an inertial unit is mounted, not the one its orientation is given in
    """

    def __init__(
        self,
        name: str,
        used,
        world: str,
        base: str,
        lookup: Lookup,
        differential: bool = False,
        relative: bool = False,
        threshold: float = np.inf,
        inertial: bool = False,
    ):
        self.name, self.used = name, np.array(used, bool)
        self._world, self._base, self._lookup = world, base, lookup
        self._differential, self._relative, self._threshold, self._inertial = differential, relative, threshold, inertial
        self._first: Transform | None = None
        self._last: tuple | None = None

    def measure(self, pose: Pose) -> Measurement | None:
        """What ``pose`` says of the state; None where that is nothing yet. :raises FrameMissing: a transform is not known"""
        used, transform, covariance = self._in_world(pose)
        if self._differential:
            return self._velocity(used, transform, covariance, pose.time)
        if self._relative:
            if self._first is None:
                self._first = transform.inverse()
            turn = _blocks(self._first.rotation)
            transform, covariance = self._first @ transform, turn @ covariance @ turn.T
        values, wide = np.zeros(SIZE), np.zeros((SIZE, SIZE))
        values[POSITION], values[ORIENTATION] = transform.translation, angles(transform.rotation)
        wide[:6, :6] = covariance
        return Measurement(self.name, pose.time, np.concatenate([used, np.zeros(9, bool)]), values, wide, self._threshold)

    def _in_world(self, pose: Pose):
        """(used, transform, covariance) with regard to the world's frame; an inertial unit's as if it sat straight."""
        if self._inertial:
            mount = self._lookup(self._base, pose.frame or self._base, pose.stamp)
            offset = angles(mount.rotation)
            turn = rotation(np.array([0.0, 0.0, offset[2]]))
            straight = turn @ wrap(angles(pose.transform.rotation) - offset)
            used = np.concatenate([self.used[:3], _turned(self.used[3:], turn)])
            # The covariance is that of the unit's own axes, which are turned as it sits.
            both = _blocks(turn)
            return used, Transform(rotation(straight), np.zeros(3)), both @ pose.covariance @ both.T
        to_world = self._lookup(self._world, pose.frame or self._world, pose.stamp)
        used = np.concatenate([_turned(self.used[:3], to_world.rotation), _turned(self.used[3:], to_world.rotation)])
        both = _blocks(to_world.rotation)
        of_base = pose.transform @ self._lookup(pose.child, self._base, pose.stamp) if pose.child else pose.transform
        return used, to_world @ of_base, both @ pose.covariance @ both.T

    def _velocity(self, used, transform: Transform, covariance, time: float) -> Measurement | None:
        last, self._last = self._last, (transform, covariance, time)
        if last is None or time - last[2] <= 1e-6:
            return None
        dt = time - last[2]
        way = last[0].inverse() @ transform
        values, wide = np.zeros(SIZE), np.zeros((SIZE, SIZE))
        values[6:9], values[9:12] = way.translation / dt, angles(way.rotation) / dt
        both = _blocks(transform.rotation.T)
        wide[6:12, 6:12] = both @ (covariance + last[1]) @ both.T / dt**2
        return Measurement(self.name, time, np.concatenate([np.zeros(6, bool), used, np.zeros(3, bool)]), values, wide, self._threshold)

    def forget(self) -> None:
        """The robot was put somewhere else."""
        self._first = self._last = None


class TwistInput:
    """Velocities of a frame on the robot. ``used`` (6,): vx, vy, vz, vroll, vpitch, vyaw."""

    def __init__(self, name: str, used, base: str, lookup: Lookup, threshold: float = np.inf):
        self.name, self.used = name, np.array(used, bool)
        self._base, self._lookup, self._threshold = base, lookup, threshold

    def measure(self, frame: str, stamp, time: float, linear, angular, covariance) -> Measurement:
        """A measurement in the robot's base frame.

        :param frame: of the sensor at ``stamp``, "" is the base. :param time: of the measurement, s
        :param linear, angular: (3,) m/s and rad/s in ``frame``
        :param covariance: (6, 6)
        :raises FrameMissing: a transform is not known
        """
        mount = self._lookup(self._base, frame or self._base, stamp)
        values, wide = np.zeros(SIZE), np.zeros((SIZE, SIZE))
        values[9:12] = mount.rotation @ angular
        # A sensor beside the turning axis moves along when the robot turns.
        values[6:9] = mount.rotation @ linear + np.cross(mount.translation, values[9:12])
        both = _blocks(mount.rotation)
        wide[6:12, 6:12] = both @ covariance @ both.T
        used = np.concatenate(
            [np.zeros(6, bool), _turned(self.used[:3], mount.rotation), _turned(self.used[3:], mount.rotation), np.zeros(3, bool)]
        )
        return Measurement(self.name, time, used, values, wide, self._threshold)


class AccelerationInput:
    """Linear accelerations of an inertial unit. ``used`` (3,)."""

    def __init__(
        self, name: str, used, base: str, lookup: Lookup, threshold: float = np.inf, remove_gravity: bool = False, gravity: float = GRAVITY
    ):
        self.name, self.used = name, np.array(used, bool)
        self._base, self._lookup, self._threshold = base, lookup, threshold
        self._remove, self._gravity = remove_gravity, gravity

    def measure(
        self, frame: str, stamp, time: float, acceleration, covariance, orientation: np.ndarray | None, state_rpy: np.ndarray
    ) -> Measurement:
        """A measurement in the robot's base frame.

        :param frame: of the unit at ``stamp``, "" is the base. :param time: of the measurement, s
        :param acceleration: (3,) m/s^2 in ``frame``. :param covariance: (3, 3) of it
        :param orientation: (3, 3) of the unit in the world, None if it has none: that of ``state_rpy`` (3,), rad, is taken then
        :raises FrameMissing: a transform is not known
        """
        mount = self._lookup(self._base, frame or self._base, stamp)
        value = np.array(acceleration, float)
        if self._remove:
            unit = rotation(state_rpy) @ mount.rotation if orientation is None else orientation
            value -= unit.T @ np.array([0.0, 0.0, self._gravity])
        values, wide = np.zeros(SIZE), np.zeros((SIZE, SIZE))
        values[ACCELERATION] = mount.rotation @ value
        wide[12:, 12:] = mount.rotation @ covariance @ mount.rotation.T
        used = np.concatenate([np.zeros(12, bool), _turned(self.used, mount.rotation)])
        return Measurement(self.name, time, used, values, wide, self._threshold)


def flags(value, parameter: str) -> np.ndarray:
    """(15,) bool of ``value``, from ``parameter``, a <sensor>_config. :raises ValueError: it is no list of 15 truth values"""
    if not isinstance(value, list) or len(value) != SIZE or not all(type(entry) in (bool, int) for entry in value):
        raise ValueError(
            f"parameter {parameter} must be a list of 15 truth values (x, y, z, roll, pitch, yaw, vx, vy, vz, vroll, "
            f"vpitch, vyaw, ax, ay, az), but is {value!r:.60}"
        )
    return np.array(value, bool)


def matrix(value, parameter: str) -> np.ndarray:
    """(15, 15) of ``value``, a list of 225 numbers, row by row, or of the 15 on the diagonal, from ``parameter``.

    :raises ValueError: it is neither
    """
    numbers: np.ndarray
    try:
        numbers = np.array(value, float).ravel()
    except (TypeError, ValueError):
        numbers = np.array([np.nan])
    if len(numbers) not in (SIZE, SIZE**2) or not np.isfinite(numbers).all():
        raise ValueError(f"parameter {parameter} must be a list of 225 numbers, row by row, or of the 15 on the diagonal")
    return np.diag(numbers) if len(numbers) == SIZE else numbers.reshape(SIZE, SIZE)

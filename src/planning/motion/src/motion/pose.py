"""Poses: a position and a quaternion, in Python's plainest form."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np


class Pose(NamedTuple):
    """Where a frame is in another one.

    :param position: (3,) in metres.
    :param quaternion: (4,) x, y, z, w of unit length.
    """

    position: np.ndarray
    quaternion: np.ndarray

    @staticmethod
    def identity() -> Pose:
        return Pose(np.zeros(3), np.array([0.0, 0.0, 0.0, 1.0]))

    @staticmethod
    def from_rpy(xyz: Sequence[float], rpy: Sequence[float]) -> Pose:
        """:param xyz: the position, m.
        :param rpy: turns about the fixed axes x, y, z in this order, rad (the rule of URDF).
        """
        (cr, cp, cy), (sr, sp, sy) = np.cos(np.asarray(rpy) / 2), np.sin(np.asarray(rpy) / 2)
        return Pose(
            np.asarray(xyz, float),
            np.array([sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy]),
        )

    @staticmethod
    def from_matrix(matrix: np.ndarray) -> Pose:
        """:param matrix: (4, 4) homogeneous."""
        m = np.asarray(matrix, float)
        # The largest of the four squares is safe to divide by.
        squares = np.array(
            [
                1 + m[0, 0] - m[1, 1] - m[2, 2],
                1 - m[0, 0] + m[1, 1] - m[2, 2],
                1 - m[0, 0] - m[1, 1] + m[2, 2],
                1 + m[0, 0] + m[1, 1] + m[2, 2],
            ]
        )
        largest = int(np.argmax(squares))
        q = np.empty(4)
        if largest == 3:
            q[:] = m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], squares[3]
        else:
            j, k = (largest + 1) % 3, (largest + 2) % 3
            q[largest] = squares[largest]
            q[j] = m[j, largest] + m[largest, j]
            q[k] = m[k, largest] + m[largest, k]
            q[3] = m[k, j] - m[j, k]
        return Pose(m[:3, 3].copy(), q / np.linalg.norm(q))

    @property
    def rotation(self) -> np.ndarray:
        """(3, 3) rotation matrix."""
        x, y, z, w = self.quaternion
        return np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
            ]
        )

    def matrix(self) -> np.ndarray:
        """(4, 4) homogeneous."""
        m = np.eye(4)
        m[:3, :3] = self.rotation
        m[:3, 3] = self.position
        return m

    def rpy(self) -> np.ndarray:
        """(3,) turns about the fixed axes x, y, z, rad."""
        r = self.rotation
        return np.array([np.arctan2(r[2, 1], r[2, 2]), np.arctan2(-r[2, 0], np.hypot(r[2, 1], r[2, 2])), np.arctan2(r[1, 0], r[0, 0])])

    def inverse(self) -> Pose:
        x, y, z, w = self.quaternion
        return Pose(-self.rotation.T @ np.asarray(self.position), np.array([-x, -y, -z, w]))

    def __mul__(self, other: Pose) -> Pose:  # type: ignore[override]
        """The pose of what is at `other` in this frame. A pair or a (3,) point will do as well."""
        if len(other) == 3:
            return self.rotation @ np.asarray(other, float) + self.position
        position, (bx, by, bz, bw) = other
        ax, ay, az, aw = self.quaternion
        quaternion = np.array(
            [
                aw * bx + ax * bw + ay * bz - az * by,
                aw * by - ax * bz + ay * bw + az * bx,
                aw * bz + ax * by - ay * bx + az * bw,
                aw * bw - ax * bx - ay * by - az * bz,
            ]
        )
        return Pose(self.rotation @ np.asarray(position, float) + self.position, quaternion)

"""Points to ranges. No ROS."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Fan:
    """Which points count, and in which ray: heights and ranges in m, angles in rad, as in the node's parameters."""

    min_height: float
    max_height: float
    angle_min: float
    angle_max: float
    angle_increment: float
    range_min: float
    range_max: float

    def __post_init__(self):
        if not self.angle_increment > 0 or not self.angle_max > self.angle_min:
            raise ValueError(
                f"angle_min {self.angle_min:g} must be below angle_max {self.angle_max:g} and "
                f"angle_increment {self.angle_increment:g} above 0"
            )
        if self.size > 1_000_000:
            raise ValueError(f"angle_increment {self.angle_increment:g} makes more than a million rays")

    @property
    def size(self) -> int:
        return math.ceil((self.angle_max - self.angle_min) / self.angle_increment)

    def ranges(self, points: np.ndarray, empty: float) -> np.ndarray:
        """The nearest point in each ray.

        :param points: (N, 3) m, in the scan's frame; not-a-numbers are passed over.
        :param empty: what rays without a point say.
        :returns: (size,) m, float32.
        """
        out = np.full(self.size, np.inf)
        points = points[np.isfinite(points).all(axis=1)]
        away = np.hypot(points[:, 0], points[:, 1])
        angle = np.arctan2(points[:, 1], points[:, 0])
        counts = (
            (points[:, 2] >= self.min_height)
            & (points[:, 2] <= self.max_height)
            & (away >= self.range_min)
            & (away <= self.range_max)
            & (angle >= self.angle_min)
            & (angle <= self.angle_max)
        )
        ray = ((angle[counts] - self.angle_min) / self.angle_increment).astype(int)
        np.minimum.at(out, np.minimum(ray, self.size - 1), away[counts])
        return np.where(np.isfinite(out), out, empty).astype(np.float32)


def xyz(data: bytes, width: int, height: int, point_step: int, row_step: int, offsets, big_endian: bool) -> np.ndarray:
    """(N, 3) of a cloud of float32 coordinates, in m, as sensor_msgs/PointCloud2 lays it out.

    :param data: bytes of ``height`` rows of ``width`` points; ``point_step``, ``row_step``: from one to the next, bytes.
    :param offsets: of x, y and z within a point, bytes. :param big_endian: of the numbers.
    :raises ValueError: fewer bytes than the sizes say.
    """
    if len(data) < height * row_step or row_step < width * point_step:
        raise ValueError(f"{len(data)} bytes do not hold {width} x {height} points of {point_step} bytes")
    kind = np.dtype({"names": "xyz", "formats": [">f4" if big_endian else "<f4"] * 3, "offsets": list(offsets), "itemsize": point_step})
    rows = [np.frombuffer(data, kind, width, row * row_step) for row in range(height)]
    joined = np.concatenate(rows) if rows else np.empty(0, kind)
    return np.stack([joined["x"], joined["y"], joined["z"]], axis=1).astype(float)


def turned(points: np.ndarray, translation, quaternion) -> np.ndarray:
    """(N, 3) ``points`` of a frame as another has them, in which the first is at ``translation`` (3,), m.

    :param quaternion: of the first frame in the other: x, y, z, w, of length 1.
    """
    x, y, z, w = quaternion
    rotation = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    return points @ rotation.T + np.asarray(translation)


def hits(ranges: np.ndarray, angle_min: float, angle_increment: float, range_min: float, range_max: float) -> tuple[np.ndarray, np.ndarray]:
    """The points (N, 3), m, that the rays of a scan met, and the numbers (N,) of the rays; z is 0.

    :param ranges: (M,) m. :param angle_min: of the first ray, rad. :param angle_increment: from one to the next, rad.
    :param range_min: the least range, m, that counts. :param range_max: the range, m, from which on nothing was met.
    """
    with np.errstate(invalid="ignore"):
        rays = np.flatnonzero((ranges >= range_min) & (ranges < range_max))
    angle, away = angle_min + rays * angle_increment, ranges[rays].astype(float)
    return np.column_stack((away * np.cos(angle), away * np.sin(angle), np.zeros(len(rays)))), rays

"""A lidar's ranges from depth pictures: what is seen of visuals, as a graphics card's laser measures it.

The fan is cut into pinhole pictures side by side. The inverse of a picture's depth is linear over a plane, so a range between four pixels
of one plane is exact; where they belong to several surfaces, the nearest pixel's counts, and an edge is where its pixel is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from ode_sim import math3
from ode_sim.description.model import Pose

from ode_sim_rendering.camera import MAX_SIZE, Camera, Fan
from ode_sim_rendering.target import NOTHING

_WIDEST = math.pi / 2  # of one picture
_COARSEST = math.radians(0.25)  # of a pixel
_LARGEST = MAX_SIZE // 2  # pixels along a side
_FLAT = 0.02  # of the inverse depth: by how much four pixels of one plane may differ from one


@dataclass(frozen=True)
class _Side:
    """One picture, and for the rays (V,h) of ``columns`` where they are in it."""

    camera: Camera
    columns: np.ndarray
    at: tuple[np.ndarray, np.ndarray]  # row and column, pixels
    reach: np.ndarray  # m of a ray for each metre along the picture's axis


class LidarView:
    """What a lidar of ``fan`` needs drawn, and how it becomes its ranges.

    :param camera: its name, pose, link and clip distances count.
    """

    def __init__(self, camera: Camera, fan: Fan):
        yaws, pitches = np.asarray(fan.yaws, float), np.asarray(fan.pitches, float)
        extent = float(yaws[-1] - yaws[0])
        count = max(1, math.ceil(extent / _WIDEST - 1e-9))
        of_side = np.minimum(((yaws - yaws[0]) / max(extent, 1e-12) * count).astype(int), count - 1)
        fine = min(_finest(yaws), _finest(pitches))
        self.shape = len(pitches), len(yaws)
        self._sides = [_side(camera, np.flatnonzero(of_side == k), yaws, pitches, fine) for k in range(count) if (of_side == k).any()]

    @property
    def cameras(self) -> list[Camera]:
        """Of the pictures, in the order in which :meth:`ranges` takes them."""
        return [side.camera for side in self._sides]

    def ranges(self, pictures: list[dict[str, np.ndarray]]) -> tuple[np.ndarray, np.ndarray]:
        """Of each ray (V,H): m, +inf where nothing is seen; and the index of the visual that is, :data:`NOTHING` for none.

        :param pictures: ``depth`` and ``ident`` of each camera
        """
        ranges, seen = np.full(self.shape, np.inf, np.float32), np.full(self.shape, NOTHING, np.int32)
        for side, picture in zip(self._sides, pictures):
            inverse, who = _between(1.0 / picture["depth"].astype(float), picture["ident"], *side.at)  # 1 / inf is 0
            with np.errstate(divide="ignore"):
                ranges[:, side.columns] = side.reach / inverse
            seen[:, side.columns] = who
        return ranges, seen


def _finest(angles: np.ndarray) -> float:
    """The pixels that rays at ``angles`` need, rad: finer than they stand, since an edge is as sharp as a pixel."""
    between = float(np.diff(angles).min()) if len(angles) > 1 and angles[-1] > angles[0] else _COARSEST
    return min(between / 1.5, _COARSEST)


def _side(camera: Camera, columns: np.ndarray, yaws: np.ndarray, pitches: np.ndarray, fine: float) -> _Side:
    middle = float(yaws[columns[0]] + yaws[columns[-1]]) / 2
    aside, up = np.tan(yaws[columns] - middle)[None, :], np.tan(pitches)[:, None] / np.cos(yaws[columns] - middle)[None, :]
    across, along = float(np.abs(aside).max()), float(np.abs(up).max())
    focal = min(1.0 / max(fine, 1e-6), (_LARGEST - 4) / (2 * max(across, along, 1e-6)))
    width, height = (2 * math.ceil(focal * half) + 4 for half in (across, along))  # with a pixel beyond each end
    turned: Pose = math3.compose(camera.pose, math3.from_rpy(0, 0, 0, 0, 0, middle))
    one = replace(camera, width=width, height=height, hfov=2 * math.atan(width / (2 * focal)), pose=turned)
    at = np.broadcast_arrays((height - 1) / 2 - focal * up, (width - 1) / 2 - focal * aside)
    return _Side(one, columns, (at[0], at[1]), np.sqrt(1 + aside**2 + up**2))


def _between(inverse: np.ndarray, ident: np.ndarray, row: np.ndarray, column: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Inverse depth and visual where a ray goes through the picture, between the middles of its pixels."""
    top, left = np.floor(row).astype(int), np.floor(column).astype(int)
    down, right = row - top, column - left
    corners = [(top, left), (top, left + 1), (top + 1, left), (top + 1, left + 1)]
    a, b, c, d = (inverse[corner] for corner in corners)
    whose = [ident[corner] for corner in corners]
    nearest = np.rint(row).astype(int), np.rint(column).astype(int)
    of_one = (whose[0] == whose[1]) & (whose[0] == whose[2]) & (whose[0] == whose[3])
    flat = of_one & (np.abs(a + d - b - c) <= _FLAT * np.maximum(np.maximum(a, b), np.maximum(c, d)))
    mixed = (a * (1 - right) + b * right) * (1 - down) + (c * (1 - right) + d * right) * down
    return np.where(flat, mixed, inverse[nearest]), ident[nearest]

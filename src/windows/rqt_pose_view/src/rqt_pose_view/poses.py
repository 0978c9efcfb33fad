"""Where a message holds a pose, and the projection of a box that is turned by it. No Qt and no node in here."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import roslib.message
import roslib.msgs

_DEEPEST = 6


def quaternion_path(message_class, wanted: str = "geometry_msgs/Quaternion") -> list[str] | None:
    """Names that lead to the first quaternion in messages of ``message_class``, the nearest to its top first; arrays are left out.

    :param wanted: type to look for in the place of the quaternion
    :returns: None if there is none; an empty list for a quaternion itself.
    """
    waiting: list[tuple[list[str], Any]] = [([], message_class)]
    while waiting:
        path, found = waiting.pop(0)
        if found is None:
            continue
        if found._type == wanted:
            return path
        if len(path) < _DEEPEST:
            for name, kind in zip(found.__slots__, found._slot_types):
                base, is_array, _ = roslib.msgs.parse_type(kind)
                if "/" in base and not is_array:
                    waiting.append((path + [name], roslib.message.get_message_class(base)))
    return None


def reader(path: list[str]) -> Callable:
    """Reads (x, y, z, w) out of a message."""

    def read(message) -> tuple[float, float, float, float]:
        for name in path:
            message = getattr(message, name)
        return message.x, message.y, message.z, message.w

    return read


def rotation(quaternion) -> np.ndarray | None:
    """(3, 3) matrix of (x, y, z, w) of any length; None for one that is none, as of a message that nobody filled in."""
    x, y, z, w = quaternion
    length = math.sqrt(x * x + y * y + z * z + w * w)
    if not (math.isfinite(length) and length > 1e-9):
        return None
    x, y, z, w = x / length, y / length, z / length, w / length
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


#: faces of a box: normal in its own frame, colour; +x red, +y green, +z blue, the others paler
FACES = (
    ((1, 0, 0), (230, 40, 40)),
    ((-1, 0, 0), (255, 150, 150)),
    ((0, 1, 0), (40, 180, 40)),
    ((0, -1, 0), (150, 230, 150)),
    ((0, 0, 1), (50, 80, 240)),
    ((0, 0, -1), (150, 165, 255)),
)
BOX = np.array([1.4, 1.0, 0.6])  #: half lengths along x, y and z: each is told from the others


def face_corners(normal) -> np.ndarray:
    """(4, 3) corners of the face with that normal, in order around it."""
    axis = int(np.argmax(np.abs(normal)))
    u, v = np.eye(3)[(axis + 1) % 3], np.eye(3)[(axis + 2) % 3]
    middle = np.array(normal, float)
    return np.array([middle + a * u + b * v for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]) * BOX


class Camera:
    """Looks at the origin from ``distance`` m, in directions ``azimuth`` and ``elevation`` (rad)."""

    def __init__(self):
        self.reset()

    def reset(self) -> None:
        self.azimuth, self.elevation, self.distance = math.radians(35), math.radians(28), 9.0

    def turn(self, right: float, up: float) -> None:
        """Turn by the angles ``right`` and ``up``, rad; never over the top."""
        self.azimuth -= right
        self.elevation = min(max(self.elevation + up, -1.55), 1.55)

    def zoom(self, factor: float) -> None:
        self.distance = min(max(self.distance * factor, 3.0), 60.0)

    @property
    def position(self) -> np.ndarray:
        flat = math.cos(self.elevation)
        return self.distance * np.array([flat * math.cos(self.azimuth), flat * math.sin(self.azimuth), math.sin(self.elevation)])

    def project(self, points: np.ndarray) -> np.ndarray:
        """(n, 3) in the world to (n, 3): right and up in units of half the picture, and depth in m."""
        back = self.position / self.distance
        right = np.array([-math.sin(self.azimuth), math.cos(self.azimuth), 0.0])
        up = np.cross(back, right)
        depth = self.distance - points @ back
        scale = 2.2 / np.maximum(depth, 0.1)
        return np.column_stack((points @ right * scale, points @ up * scale, depth))

"""Messages of navigation to arrays and pictures. No Qt and no node in here."""

from __future__ import annotations

import math

import numpy as np
from qt_gui.errors import WindowError


class MapError(WindowError, ValueError):
    """A map that cannot be shown; one line that says why."""


def map_pixels(message) -> np.ndarray:
    """(h, w) uint8 grey of a nav_msgs/OccupancyGrid, the row with the lowest y first: free white, occupied black, unknown grey.

    :raises MapError: sizes that do not fit the data.
    """
    width, height, resolution = message.info.width, message.info.height, message.info.resolution
    if width < 1 or height < 1 or len(message.data) != width * height:
        raise MapError(f"a map of {width} x {height} cells with {len(message.data)} values")
    if not (math.isfinite(resolution) and resolution > 0):
        raise MapError(f"a map with cells of {resolution} m")
    cells = np.array(message.data, np.int16).reshape(height, width)
    grey = np.full(cells.shape, 200, np.uint8)
    known = (cells >= 0) & (cells <= 100)
    grey[known] = 255 - (cells[known] * 255 // 100).astype(np.uint8)
    return grey


def yaw(orientation) -> float:
    """Angle about z of a quaternion message, rad; one that nobody filled in is 0."""
    x, y, z, w = orientation.x, orientation.y, orientation.z, orientation.w
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)) if any((x, y, z, w)) else 0.0


def transformed(points: np.ndarray, transform) -> np.ndarray:
    """(n, 2) points of a frame in the frame above it. :param points: (n, 3), m. :param transform: geometry_msgs/Transform"""
    q, t = transform.rotation, transform.translation
    x, y, z, w = q.x, q.y, q.z, q.w
    rotation = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        ]
    )
    return points @ rotation.T + np.array([t.x, t.y])


def points_of(message) -> np.ndarray:
    """(n, 3) points of a nav_msgs/Path or geometry_msgs/PolygonStamped, m; a polygon is closed."""
    if hasattr(message, "poses"):
        points = [(pose.pose.position.x, pose.pose.position.y, pose.pose.position.z) for pose in message.poses]
    else:
        points = [(point.x, point.y, point.z) for point in message.polygon.points]
        points += points[:1]
    found = np.array(points, float).reshape(-1, 3)
    return found[np.isfinite(found).all(axis=1)]


def quaternion_of(angle: float) -> tuple[float, float]:
    """z and w of the rotation by ``angle`` (rad) about z."""
    return math.sin(angle / 2), math.cos(angle / 2)

"""From where a page looks at the world at first: everything in it fills the view."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from ode_sim.math3 import Pose, quat_rotate

FIELD = 0.9  # rad, from the lower to the upper edge of a page
_AZIMUTH = -0.9  # rad, of the eye as seen from what it looks at
_ELEVATIONS = (0.45, 0.9)  # rad: of what is as high as wide, of a room that has to be looked into
_FLAT = 2.5  # times as wide as high: a room
_FILLED = 0.85  # of the view
_WIDEST = 40.0  # m: in a larger world the eye looks at what can move
_USUAL = np.array([[-2.0, -2.0, 0.0], [2.0, 2.0, 1.0]])  # an empty world: the ground around the origin
_ASPECT = 1.4  # of the usual page's scene, its width by its height; what fits into it is also seen in a wider one
_SAME = 0.02  # of the distance: the eye is where it was put

View = tuple[np.ndarray, np.ndarray]  # place of the eye and of what it looks at, (3,) m


def view_of(still: np.ndarray, moving: np.ndarray, aspect: float = _ASPECT) -> View:
    """
    :param still, moving: (N, 3) corners in the world, m, of what cannot and what can move
    :param aspect: of the scene, its width by its height
    """
    corners = np.concatenate([still, moving])
    corners = corners[(np.abs(corners) < 1e5).all(axis=1)]
    if not len(corners):
        corners = _USUAL
    elif len(moving) and np.ptp(corners, axis=0).max() > _WIDEST:
        corners = moving
    width, depth, height = np.maximum(np.ptp(corners, axis=0), 0.1)
    flat = max(width, depth) > _FLAT * height and max(width, depth) > 3.0
    elevation = _ELEVATIONS[1 if flat else 0]
    away = np.array([math.cos(elevation) * math.cos(_AZIMUTH), math.cos(elevation) * math.sin(_AZIMUTH), math.sin(elevation)])
    right = np.array([-math.sin(_AZIMUTH), math.cos(_AZIMUTH), 0.0])
    middle = (corners.min(axis=0) + corners.max(axis=0)) / 2
    seen = (corners - middle) @ np.stack([right, np.cross(away, right), away]).T
    slope = math.tan(FIELD / 2) * _FILLED
    across = slope * min(aspect, _ASPECT)
    distance = max(float((np.abs(seen[:, 1]) / slope + seen[:, 2]).max()), float((np.abs(seen[:, 0]) / across + seen[:, 2]).max()), 0.3)
    return middle + distance * away, middle


def view_from(eye: Pose, still: np.ndarray, moving: np.ndarray) -> View:
    """The view of an eye that a world file places; what is there says how far ahead the point lies about which a hand turns it.

    :param eye: X_WE; it looks along its x axis. :param still, moving: as for :func:`view_of`
    """
    corners = np.concatenate([still, moving])
    corners = corners[(np.abs(corners) < 1e5).all(axis=1)]
    place, ahead = np.asarray(eye.p), np.asarray(quat_rotate(eye.q, (1.0, 0.0, 0.0)))
    middle = (corners.min(axis=0) + corners.max(axis=0)) / 2 if len(corners) else np.zeros(3)
    return place, place + max(float((middle - place) @ ahead), 1.0) * ahead


def put_eye(client: Any, place: Iterable[float], target: Iterable[float]) -> None:
    """Have the page of ``client`` look from ``place`` to ``target``, m: in this order, as the target goes along with the eye."""
    client.camera.position = tuple(float(v) for v in place)
    client.camera.look_at = tuple(float(v) for v in target)


class Eyes:
    """Puts the eyes of all pages where they see the world, until the world has settled or a hand has moved them."""

    def __init__(self, server: Any):
        self._server = server
        self._view_at: Callable[[float], View] | None = None
        self._fitted: set[int] = set()  # pages
        server.initial_camera.fov = FIELD

    def look(self, view_at: Callable[[float], View]) -> None:
        """From now on new pages look so; those that still look as they were told before, too.

        :param view_at: the view of a scene that is so many times as wide as high
        """
        before, self._view_at = self._view_at, view_at
        self._server.initial_camera.position, self._server.initial_camera.look_at = view_at(_ASPECT)
        for client in self._server.get_clients().values():
            self._tell(client, before)

    def fit(self) -> None:
        """Narrow pages that have just begun, as all do, look from farther away. Once for each: viser has its own say as they come."""
        for number, client in self._server.get_clients().items():
            if self._view_at is None or number in self._fitted or client.camera.aspect >= _ASPECT:
                continue
            if self._as_told(client.camera, self._view_at(_ASPECT)):
                self._fitted.add(number)
                put_eye(client, *self._view_at(client.camera.aspect))

    def _tell(self, client: Any, before: Callable[[float], View] | None) -> None:
        camera, now = client.camera, self._view_at
        if now is not None and (before is None or any(self._as_told(camera, before(aspect)) for aspect in (camera.aspect, _ASPECT))):
            put_eye(client, *now(camera.aspect))

    @staticmethod
    def _as_told(camera: Any, view: View) -> bool:
        distance = float(np.linalg.norm(view[0] - view[1]))
        return all(np.linalg.norm(np.subtract(now, then)) < _SAME * distance for now, then in zip((camera.position, camera.look_at), view))

"""Wide-angle lenses: square pictures to up to six sides, joined to the one that such a lens sees."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import cv2
import numpy as np
from ode_sim import math3
from ode_sim.description.model import Pose

from ode_sim_rendering.camera import LENS_FUNCTIONS, Camera, Distortion, WideLens

_EDGE = 0.02  # of the picture's half width, over which it grows black
_FORWARD = np.array([[1, 0, 0], [0, 1, 0], [0, -1, 0], [-1, 0, 0], [0, 0, 1], [0, 0, -1]], float)
_LEFT = np.array([[0, 1, 0], [-1, 0, 0], [1, 0, 0], [0, -1, 0], [0, 1, 0], [0, 1, 0]], float)
_INVERSE: dict[str, Callable] = {"sin": np.arcsin, "tan": np.arctan, "id": np.asarray}
_BEYOND = {"color": 0, "depth": np.inf, "ident": -1}


@dataclass(frozen=True)
class _Side:
    """One of the pictures, and which pixels (H,W) of the wide one are taken from where in it."""

    turn: Pose
    shown: np.ndarray
    columns: np.ndarray
    rows: np.ndarray


class WideView:
    """What cameras with this wide-angle lens and size need drawn, and how it becomes their picture."""

    def __init__(self, camera: Camera):
        assert camera.lens is not None
        self._lens = lens = camera.lens
        column, row = np.meshgrid(np.arange(camera.width, dtype=float), np.arange(camera.height, dtype=float))
        right = (2 * column + 1 - camera.width) / camera.width
        down = (2 * row + 1 - camera.height) / camera.width
        radius = np.hypot(right, down)
        angle = _angle(lens, radius)
        aside = np.sin(angle) / np.maximum(radius, 1e-12)
        directions = np.stack([np.cos(angle), -aside * right, -aside * down], axis=-1)  # forward, left, up
        self._light = np.where(np.isfinite(angle) & (angle >= 0), _brightness(lens, radius), 0.0)
        self._seen = self._light > 0
        directions[~self._seen] = (1.0, 0.0, 0.0)
        self._reach = 1 / np.abs(directions).max(axis=-1)  # of a ray, for each metre along the axis of its side
        nearest = (directions @ _FORWARD.T).argmax(axis=-1)
        self._sides = [
            _side(lens.texture, index, nearest == index, directions)
            for index in range(len(_FORWARD))
            if (nearest[self._seen] == index).any()
        ]

    def cameras(self, camera: Camera) -> list[Camera]:
        """Of the pictures to draw for ``camera``, in the order in which :meth:`joined` takes them."""
        size = self._lens.texture
        return [
            replace(
                camera,
                width=size,
                height=size,
                hfov=2 * math.atan(_half(size)),
                lens=None,
                distortion=Distortion(),
                pose=math3.compose(camera.pose, side.turn),
            )
            for side in self._sides
        ]

    def joined(self, pictures: list[dict[str, np.ndarray]]) -> dict[str, np.ndarray]:
        """The images (H,W) of the lens, of ``pictures`` by kind; its depths are distances from the eye, m."""
        return {kind: self._join([picture[kind] for picture in pictures], kind) for kind in pictures[0]}

    def _join(self, pictures: list[np.ndarray], kind: str) -> np.ndarray:
        first = pictures[0]
        image = np.full(self._seen.shape + first.shape[2:], _BEYOND[kind], first.dtype)
        way = cv2.INTER_LINEAR if kind == "color" else cv2.INTER_NEAREST
        for side, picture in zip(self._sides, pictures):
            moved = cv2.remap(picture, side.columns, side.rows, way, borderMode=cv2.BORDER_REPLICATE)
            image[side.shown] = moved[side.shown]
        if kind == "color":
            return (image * self._light[..., None] + 0.5).astype(np.uint8)
        if kind == "depth":
            return np.where(self._seen, image * self._reach, np.inf).astype(first.dtype)
        return np.where(self._seen, image, _BEYOND[kind]).astype(first.dtype)


def _angle(lens: WideLens, radius: np.ndarray) -> np.ndarray:
    """Angle from the optical axis, rad, of what is at ``radius``; NaN where nothing is."""
    value = radius / (lens.c1 * lens.f)
    with np.errstate(invalid="ignore"):
        turned = _INVERSE[lens.fun](value)
    return (turned - lens.c3) * lens.c2


def _brightness(lens: WideLens, radius: np.ndarray) -> np.ndarray:
    """1 within the lens' cut-off angle, 0 beyond, and smooth in between."""
    turned = lens.cutoff / lens.c2 + lens.c3
    if lens.fun != "id":
        turned = min(turned, np.pi / 2)
    value = LENS_FUNCTIONS[lens.fun](turned)
    within = np.clip((lens.c1 * lens.f * value - radius) / _EDGE, 0.0, 1.0)
    return within * within * (3 - 2 * within)


def _half(size: int) -> float:
    """Half the width of a side's square at 1 m: a little more than a quarter turn, so that pixels at its border have neighbours."""
    return 1 + 2 / size


def _side(size: int, index: int, shown: np.ndarray, directions: np.ndarray) -> _Side:
    forward, left = _FORWARD[index], _LEFT[index]
    axes: np.ndarray = np.stack([forward, left, np.cross(forward, left)])
    ahead, aside, upwards = (directions @ axis for axis in axes)
    ahead = np.where(shown, ahead, 1.0)
    columns, rows = (((size - 1) / 2 - size / (2 * _half(size)) * part / ahead).astype(np.float32) for part in (aside, upwards))
    return _Side(Pose((0.0, 0.0, 0.0), math3.quat_from_matrix([row.tolist() for row in axes.T])), shown, columns, rows)

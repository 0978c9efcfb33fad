"""Lens distortion: a pinhole picture, drawn wide enough, resampled to what the distorting lens would have seen."""

from __future__ import annotations

import cv2
import numpy as np

from ode_sim_rendering.camera import MAX_SIZE, Camera, Distortion

_SOLVER_STEPS = 20
_WIDEST = 3.0  # times the image size; beyond it the picture has black corners rather than a frame without end


class Lens:
    """Resampling map of one camera. ``width``, ``height``: pixels of the pinhole picture it needs, drawn with the
    camera's focal length and the optical axis in its middle.

    The coefficients have OpenCV's and CameraInfo's meaning, so that a picture and its camera_info agree.
    With ``crop`` the pinhole picture is larger than the image and every pixel shows something; without it the pinhole
    picture has the image's own field of view and what lies beyond is black.
    """

    def __init__(self, camera: Camera):
        lens, f = camera.distortion, camera.focal_length
        centre = lens.center[0] * camera.width - 0.5, lens.center[1] * camera.height - 0.5
        column, row = np.meshgrid(np.arange(camera.width, dtype=float), np.arange(camera.height, dtype=float))
        target = np.stack([(column - centre[0]) / f, (row - centre[1]) / f], -1)
        ideal = self._undistort(target, lens)
        # pixels of the pinhole picture relative to its middle; a lens whose centre is off the middle shifts both alike
        shift = centre[0] - (camera.width - 1) / 2, centre[1] - (camera.height - 1) / 2
        x, y = ideal[..., 0] * f + shift[0], ideal[..., 1] * f + shift[1]
        self.width, self.height = camera.width, camera.height
        if lens.crop:
            self.width = self._cover(x, camera.width)
            self.height = self._cover(y, camera.height)
        # a pixel whose ray the polynomial cannot explain (folded over) is left black
        valid = np.isfinite(x) & np.isfinite(y)
        x = np.where(valid, x + (self.width - 1) / 2, -1e4)
        y = np.where(valid, y + (self.height - 1) / 2, -1e4)
        self._exact = x.astype(np.float32), y.astype(np.float32)
        self._fast = cv2.convertMaps(*self._exact, cv2.CV_16SC2)

    @staticmethod
    def _cover(offset: np.ndarray, size: int) -> int:
        reach = np.abs(offset[np.isfinite(offset)]).max(initial=0.0)
        needed = 2 * int(np.ceil(reach)) + 3
        return int(min(max(size, needed), _WIDEST * size, MAX_SIZE))

    @staticmethod
    def _undistort(target: np.ndarray, lens: Distortion) -> np.ndarray:
        """Ideal image coordinates (H,W,2), focal length 1, that the lens moves to ``target``; NaN where there are
        none."""
        ideal = target.copy()
        for _ in range(_SOLVER_STEPS):
            x, y = ideal[..., 0], ideal[..., 1]
            r2 = x * x + y * y
            radial = 1 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3))
            dx = 2 * lens.p1 * x * y + lens.p2 * (r2 + 2 * x * x)
            dy = lens.p1 * (r2 + 2 * y * y) + 2 * lens.p2 * x * y
            error = np.stack([x * radial + dx, y * radial + dy], -1) - target
            # Newton with the radial part of the derivative; it dominates for any lens one can buy
            slope = radial + 2 * r2 * (lens.k1 + r2 * (2 * lens.k2 + 3 * r2 * lens.k3))
            slope = np.clip(np.minimum(radial, slope), 0.2, None)
            ideal = np.clip(ideal - error / slope[..., None], -50, 50)
        return np.where((np.abs(error).max(axis=-1) < 1e-3)[..., None], ideal, np.nan)

    def distort(self, picture: np.ndarray, kind: str) -> np.ndarray:
        """The image (camera's size) of a pinhole ``picture``. Colours are interpolated, depths and indices are not.

        :param kind: ``color``, ``depth`` or ``ident``.
        """
        if kind == "color":
            return cv2.remap(picture, *self._fast, cv2.INTER_LINEAR)
        border = np.inf if kind == "depth" else -1
        return cv2.remap(picture, *self._exact, cv2.INTER_NEAREST, borderMode=cv2.BORDER_CONSTANT, borderValue=border)

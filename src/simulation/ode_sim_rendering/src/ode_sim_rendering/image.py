"""From the ideal picture to what a sensor delivers: noise, pixel formats, compression, point clouds."""

from __future__ import annotations

import functools

import cv2
import numpy as np

from ode_sim_rendering.camera import Camera

_BANK = 1 << 20  # pixels of ready-made noise
_PIECE = 1 << 18  # pixels that follow each other in the bank before the next random start

# rows and columns (of a 2x2 cell) where red, green (twice) and blue sit
_BAYER = {"bayer_rggb8": "RGGB", "bayer_bggr8": "BGGR", "bayer_gbrg8": "GBRG", "bayer_grbg8": "GRBG"}


@functools.lru_cache(maxsize=8)
def _noise_bank(mean: float, stddev: float) -> tuple[np.ndarray, np.ndarray]:
    """What to add and what to subtract, uint8, three equal channels per pixel as in Gazebo, flattened."""
    draws = np.random.Generator(np.random.PCG64(0)).standard_normal(_BANK, np.float32)
    steps = np.clip(np.rint((draws * stddev + mean) * 255), -255, 255).astype(np.int16)
    steps = np.repeat(steps, 3)
    return np.maximum(steps, 0).astype(np.uint8), np.maximum(-steps, 0).astype(np.uint8)


def add_noise(rgb: np.ndarray, camera: Camera, seed: int, time_ns: int) -> np.ndarray:
    """``rgb`` (H,W,3) uint8 with the camera's Gaussian noise, saturating. The same ``seed`` and ``time_ns`` (sim time)
    give the same bytes: pieces of a noise bank made once are laid over the picture at random places."""
    if camera.noise_stddev == 0 and camera.noise_mean == 0:
        return rgb
    plus, minus = _noise_bank(camera.noise_mean, camera.noise_stddev)
    flat = np.ascontiguousarray(rgb).reshape(-1)
    noisy = np.empty_like(flat)
    pieces = -(-flat.size // (3 * _PIECE))
    starts = np.random.Generator(np.random.PCG64([seed, time_ns])).integers(_BANK - _PIECE, size=pieces)
    for piece, start in enumerate(starts):
        part = slice(3 * _PIECE * piece, min(3 * _PIECE * (piece + 1), flat.size))
        bank = slice(3 * int(start), 3 * int(start) + part.stop - part.start)
        # as rows of one channel: OpenCV's saturating operations work on whole cache lines
        sum_ = cv2.add(flat[None, part], plus[None, bank])
        cv2.subtract(sum_, minus[None, bank], noisy[None, part])
    return noisy.reshape(rgb.shape)


def encode(rgb: np.ndarray, encoding: str) -> np.ndarray:
    """``rgb``, (H,W,3) bytes, as an image of a sensor_msgs ``encoding``: (H,W) or (H,W,3), uint8 or uint16.

    A camera without colours shows what is red: Gazebo's does, and thresholds are tuned to it.

    :raises ValueError: an encoding that is not known.
    """
    if encoding == "rgb8":
        return rgb
    if encoding == "bgr8":
        return cv2.cvtColor(rgb, cv2.COLOR_RGB2BGR)
    if encoding == "mono8":
        return np.ascontiguousarray(rgb[..., 0])
    if encoding == "mono16":
        return rgb[..., 0].astype(np.uint16) * 257
    if encoding == "rgb16":
        return rgb.astype(np.uint16) * 257
    if encoding in _BAYER:
        mosaic = np.empty(rgb.shape[:2], np.uint8)
        for cell, channel in enumerate(_BAYER[encoding]):
            place = slice(cell // 2, None, 2), slice(cell % 2, None, 2)
            mosaic[place] = rgb[(*place, "RGB".index(channel))]
        return mosaic
    raise ValueError(f"unknown encoding '{encoding}'")


def compress(image: np.ndarray, encoding: str, kind: str, level: int) -> np.ndarray:
    """``image``, of a sensor_msgs ``encoding``, as a file in memory, (N,) uint8.

    :param kind: ``jpeg`` with ``level`` 1..100 (quality), or ``png`` with ``level`` 1..9 (effort).
    :raises ValueError: OpenCV cannot write it.
    """
    if encoding.startswith("rgb"):
        image = cv2.cvtColor(image, cv2.COLOR_RGB2BGR)  # the order that OpenCV writes from
    if kind == "jpeg":
        if image.dtype == np.uint16:
            image = (image >> 8).astype(np.uint8)
        done, data = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, level])
    else:
        done, data = cv2.imencode(".png", image, [cv2.IMWRITE_PNG_COMPRESSION, level])
    if not done:
        raise ValueError(f"OpenCV cannot write {encoding} as {kind}")
    return data.ravel()


def cloud(depth: np.ndarray, image: np.ndarray, camera: Camera, valid: np.ndarray) -> np.ndarray:
    """Organised cloud (H,W,8) float32: x y z in the optical frame (x right, y down, z forward), one unused, colour,
    three unused. The colour is the image's bytes in their own order in the low bytes of one float; invalid points are
    NaN.

    :param depth: (H,W) m along the optical axis. :param valid: (H,W) bool, where it is one.
    :param image: (H,W) or (H,W,3) colours. :param camera: whose pixels these are.
    """
    height, width = depth.shape
    points = np.zeros((height, width, 8), np.float32)
    column = ((np.arange(width) - (width - 1) / 2) / camera.focal_length).astype(np.float32)
    row = ((np.arange(height) - (height - 1) / 2) / camera.focal_length).astype(np.float32)
    z = np.where(valid, depth, np.float32(np.nan))
    points[..., 0], points[..., 1], points[..., 2] = z * column, z * row[:, None], z
    colour = points.view(np.uint8).reshape(height, width, 32)[..., 16:19]
    if image.dtype == np.uint16:
        image = (image >> 8).astype(np.uint8)
    colour[:] = image if image.ndim == 3 else image[..., None]
    return points

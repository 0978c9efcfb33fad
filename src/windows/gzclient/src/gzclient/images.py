"""Image messages as pictures for the page."""
from __future__ import annotations

from typing import Any

import numpy as np

# OpenCV is imported where a picture is made: it takes half a second, which a page need not wait for
_DEPTH = {"32FC1": np.float32, "16UC1": np.uint16}
#: encoding -> channels, OpenCV's conversion to RGB
_COLOURS = {"rgb8": (3, ""), "bgr8": (3, "BGR2RGB"), "rgba8": (4, "RGBA2RGB"), "bgra8": (4, "BGRA2RGB"),
            "mono8": (1, "GRAY2RGB"), "8UC1": (1, "GRAY2RGB"), "8UC3": (3, "BGR2RGB"),
            "bayer_rggb8": (1, "BayerBG2RGB"), "bayer_bggr8": (1, "BayerRG2RGB"), "bayer_gbrg8": (1, "BayerGR2RGB"),
            "bayer_grbg8": (1, "BayerGB2RGB")}
_LARGEST = 640  # pixels along a side that a page is sent


def picture_of(message: Any) -> np.ndarray:
    """(H, W, 3) uint8 RGB of a sensor_msgs Image or CompressedImage; depth from near (white) to far (black).

    :raises ValueError: one line that says what is wrong with it
    """
    picture = _compressed(message) if hasattr(message, "format") else _raw(message)
    step = -(-max(picture.shape[:2]) // _LARGEST)
    return np.ascontiguousarray(picture[::step, ::step])


def _compressed(message: Any) -> np.ndarray:
    import cv2
    picture = cv2.imdecode(np.frombuffer(message.data, np.uint8), cv2.IMREAD_COLOR)
    if picture is None:
        raise ValueError(f"the image of format '{message.format}' cannot be read")
    return cv2.cvtColor(picture, cv2.COLOR_BGR2RGB)


def _raw(message: Any) -> np.ndarray:
    height, width, encoding = message.height, message.width, message.encoding
    if not 0 < height <= 16384 or not 0 < width <= 16384:
        raise ValueError(f"an image of {width}x{height} pixels cannot be shown")
    if encoding in _DEPTH:
        depth = _rows(message, _DEPTH[encoding], 1).astype(np.float32)
        good = np.isfinite(depth) & (depth > 0)
        if not good.any():
            return np.zeros((height, width, 3), np.uint8)
        near, far = depth[good].min(), depth[good].max()
        grey = np.where(good, 255 - 235 * (depth - near) / max(far - near, 1e-6), 0)
        return np.repeat(np.nan_to_num(grey).astype(np.uint8)[..., None], 3, axis=2)
    if encoding not in _COLOURS:
        raise ValueError(
            f"images of encoding '{encoding}' cannot be shown; there are {', '.join((*_COLOURS, *_DEPTH))}")
    channels, conversion = _COLOURS[encoding]
    pixels = _rows(message, np.uint8, channels)
    if not conversion:
        return pixels
    import cv2
    return cv2.cvtColor(np.ascontiguousarray(pixels), getattr(cv2, f"COLOR_{conversion}"))


def _rows(message: Any, kind: type, channels: int) -> np.ndarray:
    """(H, W) or (H, W, channels) of the message's data, rows of ``step`` bytes."""
    size = message.width * channels * np.dtype(kind).itemsize
    if message.step < size or len(message.data) < message.step * (message.height - 1) + size:
        raise ValueError(f"the image is cut off: {len(message.data)} bytes, step {message.step}")
    order = np.dtype(kind).newbyteorder(">" if message.is_bigendian else "<")
    data = np.frombuffer(message.data, np.uint8)
    rows = np.stack([data[y * message.step:y * message.step + size] for y in range(message.height)])
    pixels = rows.view(order).reshape(message.height, message.width, channels)
    return pixels[..., 0] if channels == 1 else pixels

"""Image messages as pictures for the page."""

from __future__ import annotations

from typing import Any

import image_pixels
import numpy as np

_LARGEST = 640  # pixels along a side that a page is sent


def picture_of(message: Any) -> np.ndarray:
    """(H, W, 3) uint8 RGB of a sensor_msgs Image or CompressedImage; depth from near (white) to far (black).

    :raises ValueError: one line that says what is wrong with it
    """
    picture = image_pixels.picture_of(message, unnamed="bgr")  # as RViz takes 8UC3, which cv_bridge makes of OpenCV's pictures
    pixels = _near_and_far(picture.pixels) if picture.unit else picture.pixels
    step = -(-max(pixels.shape[:2]) // _LARGEST)
    pixels = pixels[::step, ::step]
    return np.ascontiguousarray(pixels if pixels.ndim == 3 else np.repeat(pixels[..., None], 3, axis=2))


def _near_and_far(numbers: np.ndarray) -> np.ndarray:
    """Depth as grey; what has none is black."""
    depth = numbers.astype(np.float32)
    good = np.isfinite(depth) & (depth > 0)
    if not good.any():
        return np.zeros(depth.shape, np.uint8)
    near, far = depth[good].min(), depth[good].max()
    grey = np.where(good, 255 - 235 * (depth - near) / max(far - near, 1e-6), 0)
    return np.nan_to_num(grey).astype(np.uint8)

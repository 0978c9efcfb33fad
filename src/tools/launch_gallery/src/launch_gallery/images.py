"""Image messages as PNG files."""

from __future__ import annotations

import cv2
import image_pixels
import numpy as np
from sensor_msgs.msg import Image


def save(message: Image, path: str) -> None:
    """Write ``message`` to ``path``: colours as they are; depth in gray from its least (black) to its largest (white).

    :raises ValueError: an encoding that cannot be shown.
    """
    picture = image_pixels.picture_of(message, unnamed="bgr")
    pixels = _gray(picture.pixels) if picture.unit else picture.pixels
    if not cv2.imwrite(path, pixels[..., ::-1] if pixels.ndim == 3 else pixels):
        raise ValueError(f"cannot write {path}")


def _gray(numbers: np.ndarray) -> np.ndarray:
    """(rows, columns) of any numbers to uint8; what is not finite is black."""
    numbers = numbers.astype(float)
    finite = np.isfinite(numbers)
    if not finite.any():
        return np.zeros(numbers.shape, np.uint8)
    low, high = numbers[finite].min(), numbers[finite].max()
    scaled = np.where(finite, (numbers - low) / max(high - low, 1e-9), 0)
    return (55 + 200 * scaled).astype(np.uint8) * finite.astype(np.uint8)

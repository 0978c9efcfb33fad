"""Image messages as PNG files."""
from __future__ import annotations

import cv2
import cv_bridge
import numpy as np
from sensor_msgs.msg import Image


def save(message: Image, path: str) -> None:
    """Colours as they are; depth, 16 bit and other numbers in gray from their least (black) to their largest (white).

    :raises ValueError: an encoding that cannot be shown.
    """
    try:
        pixels = cv_bridge.CvBridge().imgmsg_to_cv2(message, "passthrough")
        if pixels.dtype == np.uint8 and message.encoding != "mono8":
            pixels = cv_bridge.CvBridge().imgmsg_to_cv2(message, "bgr8")
    except cv_bridge.CvBridgeError as error:
        raise ValueError(f"encoding {message.encoding}: {error}") from error
    if pixels.dtype != np.uint8:
        pixels = _gray(pixels)
    if not cv2.imwrite(path, pixels):
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

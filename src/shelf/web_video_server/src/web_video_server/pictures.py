"""Image messages as files of JPEG or PNG."""

from __future__ import annotations

from typing import Any

import cv2
import image_pixels
import numpy as np

from web_video_server.request import Request, VideoError


class NoPicture(VideoError):
    """A message that cannot be shown."""


def encoded(message: Any, request: Request) -> bytes:
    """``message``, a sensor_msgs Image or CompressedImage, as the ``request`` wants it.

    :raises NoPicture: an encoding that is not known, or fewer bytes than it has pixels
    """
    pixels = _colours(message)
    if request.invert:
        pixels = cv2.rotate(pixels, cv2.ROTATE_180)
    height, width = pixels.shape[:2]
    wanted = (min(request.width or width, width), min(request.height or height, height))  # a page makes it larger, for nothing
    if wanted != (width, height):
        pixels = cv2.resize(pixels, wanted)
    if request.type == "png":
        return cv2.imencode(".png", pixels, [cv2.IMWRITE_PNG_COMPRESSION, request.quality])[1].tobytes()
    return cv2.imencode(".jpeg", pixels, [cv2.IMWRITE_JPEG_QUALITY, request.quality])[1].tobytes()


def _colours(message: Any) -> np.ndarray:
    """(H, W, 3) BGR or (H, W) grey, uint8."""
    try:
        picture = image_pixels.picture_of(message, unnamed="bgr")
    except image_pixels.ImageError as error:
        name = message.format if hasattr(message, "format") else message.encoding
        raise NoPicture(f"a picture of {name[:60]!r} cannot be shown: {error}") from None
    if picture.unit:
        return _brightness(picture.pixels)
    return np.ascontiguousarray(picture.pixels[..., ::-1]) if picture.pixels.ndim == 3 else picture.pixels


def _brightness(numbers: np.ndarray) -> np.ndarray:
    """The largest is white, 0 and what is no number black."""
    numbers = np.nan_to_num(numbers.astype(np.float32), nan=0.0, posinf=0.0, neginf=0.0)
    largest = float(numbers.max(initial=0.0))
    scaled = numbers * (255.0 / largest) if largest > 0 else numbers
    return np.clip(np.rint(scaled), 0, 255).astype(np.uint8)

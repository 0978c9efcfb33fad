"""Image messages as files of JPEG or PNG."""
from __future__ import annotations

from typing import Any

import cv2
import cv_bridge
import numpy as np

from web_video_server.request import Request, VideoError


class NoPicture(VideoError):
    """A message that cannot be shown."""


def encoded(message: Any, request: Request) -> bytes:
    """A sensor_msgs Image or CompressedImage as the request wants it.

    :raises NoPicture: an encoding that is not known, or fewer bytes than it has pixels
    """
    pixels = _colours(message)
    if request.invert:
        pixels = cv2.rotate(pixels, cv2.ROTATE_180)
    height, width = pixels.shape[:2]
    wanted = (request.width or width, request.height or height)
    if wanted != (width, height):
        pixels = cv2.resize(pixels, wanted)
    if request.type == "png":
        return cv2.imencode(".png", pixels, [cv2.IMWRITE_PNG_COMPRESSION, request.quality])[1].tobytes()
    return cv2.imencode(".jpeg", pixels, [cv2.IMWRITE_JPEG_QUALITY, request.quality])[1].tobytes()


def _colours(message: Any) -> np.ndarray:
    """(H, W, 3) BGR or (H, W) grey, uint8."""
    try:
        if hasattr(message, "format"):
            pixels = cv_bridge.CvBridge().compressed_imgmsg_to_cv2(message, "bgr8")
        elif _is_depth(message.encoding):
            return _brightness(cv_bridge.CvBridge().imgmsg_to_cv2(message, "passthrough"))
        else:
            pixels = cv_bridge.CvBridge().imgmsg_to_cv2(message, "bgr8")
    except (cv_bridge.CvBridgeError, cv2.error, TypeError, ValueError) as error:
        raise NoPicture(f"a picture of {_format(message)!r} cannot be shown: "
                        f"{' '.join(str(error).split())[:200]}") from None
    if pixels is None or not pixels.size:
        raise NoPicture("an empty picture cannot be shown")
    return pixels


def _format(message: Any) -> str:
    return message.format if hasattr(message, "format") else message.encoding


def _is_depth(encoding: str) -> bool:
    return "F" in encoding or encoding in ("16UC1", "16SC1", "32SC1")


def _brightness(numbers: np.ndarray) -> np.ndarray:
    """The largest is white, 0 and what is no number black."""
    numbers = np.nan_to_num(numbers.astype(np.float32), nan=0.0, posinf=0.0, neginf=0.0)
    largest = float(numbers.max(initial=0.0))
    scaled = numbers * (255.0 / largest) if largest > 0 else numbers
    return np.clip(np.rint(scaled), 0, 255).astype(np.uint8)

"""Pixels of messages to pictures for the screen: uint8, (h, w) grey or (h, w, 3) RGB. No ROS and no Qt in here."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import cv2
import image_pixels
import numpy as np
from qt_gui.errors import WindowError


class PictureError(WindowError, ValueError):
    """Data that is no picture; one line that says why."""


_SCHEMES = ("Autumn", "Bone", "Cool", "Gray", "Hot", "Hsv", "Jet", "Ocean", "Pink", "Rainbow", "Spring", "Summer", "Winter")
#: names of the colour schemes of depth pictures -> OpenCV's map, or None for grey; in Noetic's order, whose settings hold the place in it
COLOR_SCHEMES = {name: None if name == "Gray" else getattr(cv2, f"COLORMAP_{name.upper()}") for name in _SCHEMES}


@dataclass(frozen=True)
class DepthView:
    """How depth is shown. :param max_depth: m, white; 0 means dynamic. :param dynamic: smallest to largest depth instead.
    :param scheme: of :data:`COLOR_SCHEMES`."""

    max_depth: float = 10.0
    dynamic: bool = False
    scheme: str = "Gray"


def from_raw(
    encoding: str, height: int, width: int, step: int, data, big_endian: bool = False, depth: DepthView = DepthView()
) -> np.ndarray:
    """A picture from the fields of a sensor_msgs/Image.

    :param encoding, height, width: fields of it; pixels
    :param step: bytes per row.
    :param data: bytes.
    :param big_endian: of numbers in ``data`` that have several bytes
    :param depth: how pictures of depths are shown
    :returns: uint8, (h, w) or (h, w, 3) RGB; perhaps a view of ``data``.
    :raises PictureError: an encoding that is not known, or data that does not fit height, width and step.
    """
    return _shown(lambda: image_pixels.raw(encoding, height, width, step, data, big_endian), depth)


def from_compressed(layout: str, data, depth: DepthView = DepthView()) -> np.ndarray:
    """A picture from the fields of a sensor_msgs/CompressedImage, compressedDepth included.

    :param layout: field ``format``, as ``rgb8; jpeg compressed bgr8`` or ``16UC1; compressedDepth png``.
    :param data: bytes
    :param depth: how pictures of depths are shown
    :returns: uint8, (h, w) or (h, w, 3) RGB
    :raises PictureError: data that cannot be decoded.
    """
    return _shown(lambda: image_pixels.compressed(layout, data), depth)


def _shown(read: Callable[[], image_pixels.Picture], depth: DepthView) -> np.ndarray:
    try:
        picture = read()
    except image_pixels.ImageError as error:
        raise PictureError(str(error)) from None
    return show_depth(picture.pixels, picture.unit, depth) if picture.unit else picture.pixels


def show_depth(values: np.ndarray, unit: float, view: DepthView) -> np.ndarray:
    """Depth as grey or colours, as ``view`` says; what is no depth (NaN, or 0 of whole numbers) is black.

    :param values: (h, w).
    :param unit: m per unit of ``values``.
    """
    invalid = values == 0 if values.dtype.kind in "ui" else np.isnan(values)
    values = values.astype(np.float32)
    low, high = 0.0, view.max_depth / unit
    if view.dynamic or view.max_depth <= 0:
        known = values[np.isfinite(values) & ~invalid]
        low, high = (float(known.min()), float(known.max())) if len(known) else (0.0, 1.0)
    scale = 255 / ((high - low) or 1.0)
    grey = np.clip(np.nan_to_num((values - np.float32(low)) * np.float32(scale), nan=0.0), 0, 255).astype(np.uint8)
    scheme = COLOR_SCHEMES.get(view.scheme)
    if scheme is None:
        grey[invalid] = 0
        return grey
    picture = cv2.cvtColor(cv2.applyColorMap(grey, scheme), cv2.COLOR_BGR2RGB)
    picture[invalid] = 0
    return picture


class TheoraDecoder:
    """Pictures of one Theora stream, as theora_image_transport sends it: three head packets, then pictures."""

    def __init__(self):
        self._heads = {}
        self._context: Any = None

    def decode(self, data: bytes) -> np.ndarray | None:
        """
        :param data: of a packet. :returns: (h, w, 3) RGB, or None if the packet brings no picture.
        :raises PictureError: no PyAV, or a packet that is broken.
        """
        if data and data[0] & 0x80:
            if data[0] == 0x80:
                self._heads, self._context = {}, None
            self._heads[data[0]] = data
            return None
        if self._context is None and not self._open():
            return None
        try:
            frames = self._context.decode(self._av.Packet(data)) if data else []
        except self._av.error.FFmpegError as error:
            raise PictureError(f"a theora packet of {len(data)} bytes cannot be decoded: {error}") from None
        return _full_range(frames[-1]) if frames else None

    def _open(self) -> bool:
        if len(self._heads) < 3:
            return False  # joined in the middle: the heads come again when the publisher sees a new subscriber
        try:
            import av
        except ImportError:
            raise PictureError("theora needs PyAV: install python3-av") from None
        av.logging.set_level(av.logging.PANIC)
        self._av = av
        self._context = av.CodecContext.create("theora", "r")
        self._context.thread_count = 1  # with more, each picture would come some pictures late
        self._context.extradata = b"".join(len(head).to_bytes(2, "big") + head for _, head in sorted(self._heads.items()))
        return True


def _full_range(frame) -> np.ndarray:
    """RGB of a 4:2:0 frame whose Y is 0..255, as theora_image_transport's are."""
    y, u, v = (np.frombuffer(plane, np.uint8).reshape(-1, plane.line_size)[: plane.height, : plane.width] for plane in frame.planes)
    size = (frame.width, frame.height)
    u, v = (cv2.resize(np.repeat(np.repeat(part, 2, 0), 2, 1)[: frame.height, : frame.width], size) for part in (u, v))
    return cv2.cvtColor(cv2.merge((y[: frame.height, : frame.width], v, u)), cv2.COLOR_YCrCb2RGB)


def rotated(picture: np.ndarray, quarters: int) -> np.ndarray:
    """``picture`` turned clockwise by ``quarters`` of a turn."""
    return np.ascontiguousarray(np.rot90(picture, -quarters % 4)) if quarters % 4 else picture


def unrotated_point(x: int, y: int, height: int, width: int, quarters: int):
    """Pixel of the picture of height x width before :func:`rotated` by ``quarters``, from its place (x, y) afterwards."""
    return {0: (x, y), 1: (y, height - 1 - x), 2: (width - 1 - x, height - 1 - y), 3: (width - 1 - y, x)}[quarters % 4]


def invert_grid(picture: np.ndarray, lines: int) -> np.ndarray:
    """A copy of ``picture`` with ``lines`` lines each way, evenly spaced, where the colours are inverted."""
    picture = picture.copy()
    height, width = picture.shape[:2]
    rows = [round((i + 1) * height / (lines + 1)) for i in range(lines)]
    columns = [round((i + 1) * width / (lines + 1)) for i in range(lines)]
    turned = np.zeros((height, width), bool)
    turned[[row for row in rows if row < height]] = True
    turned[:, [column for column in columns if column < width]] = True
    picture[turned] = 255 - picture[turned]
    return picture

"""Pixels of messages to pictures for the screen: uint8, (h, w) grey or (h, w, 3) RGB. No ROS and no Qt in here."""
from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import Optional

import cv2
import numpy as np
from qt_gui.errors import WindowError


class PictureError(WindowError, ValueError):
    """Data that is no picture; one line that says why."""


#: names of the colour schemes of depth pictures -> OpenCV's map, or None for grey
COLOR_SCHEMES = {"Gray": None, **{name: getattr(cv2, f"COLORMAP_{name.upper()}") for name in (
    "Autumn", "Bone", "Cool", "Hot", "Hsv", "Jet", "Ocean", "Pink", "Rainbow", "Spring", "Summer", "Winter")}}


@dataclass(frozen=True)
class DepthView:
    """How depth is shown. :param max_depth: m, white; 0 means dynamic. :param dynamic: smallest to largest depth instead.
    :param scheme: of :data:`COLOR_SCHEMES`."""

    max_depth: float = 10.0
    dynamic: bool = False
    scheme: str = "Gray"


# OpenCV names a Bayer pattern by its second row and column, ROS by its first.
_BAYER = {"rggb": cv2.COLOR_BayerBG2RGB, "bggr": cv2.COLOR_BayerRG2RGB, "gbrg": cv2.COLOR_BayerGR2RGB,
          "grbg": cv2.COLOR_BayerGB2RGB}
#: encoding -> (type of an element, channels)
_LAYOUT = {
    "rgb8": ("u1", 3), "bgr8": ("u1", 3), "rgba8": ("u1", 4), "bgra8": ("u1", 4), "mono8": ("u1", 1), "mono16": ("u2", 1),
    "rgb16": ("u2", 3), "bgr16": ("u2", 3), "rgba16": ("u2", 4), "bgra16": ("u2", 4),
    "yuv422": ("u1", 2), "yuv422_yuy2": ("u1", 2), "uyvy": ("u1", 2), "yuyv": ("u1", 2),
    **{f"bayer_{pattern}{bits}": (f"u{bits // 8}", 1) for pattern in _BAYER for bits in (8, 16)}}
_TYPES = {"8U": "u1", "8S": "i1", "16U": "u2", "16S": "i2", "32S": "i4", "32F": "f4", "64F": "f8"}
_CHANGES = {"bgr": cv2.COLOR_BGR2RGB, "rgba": cv2.COLOR_RGBA2RGB, "bgra": cv2.COLOR_BGRA2RGB}
_MOST_PIXELS = 1 << 28


def _layout(encoding: str):
    if encoding in _LAYOUT:
        return _LAYOUT[encoding]
    kind, mark, channels = encoding.partition("C")  # OpenCV's own names: 32FC1; 8UC is 8UC1
    if kind in _TYPES and mark and (channels == "" or channels in "1234" and len(channels) == 1):
        return _TYPES[kind], int(channels or 1)
    raise PictureError(f"encoding '{encoding[:40]}' cannot be shown")


def from_raw(encoding: str, height: int, width: int, step: int, data, big_endian: bool = False,
             depth: DepthView = DepthView()) -> np.ndarray:
    """A picture from the fields of a sensor_msgs/Image.

    :param step: bytes per row. :param data: bytes. :returns: uint8, (h, w) or (h, w, 3) RGB; perhaps a view of ``data``.
    :raises PictureError: an encoding that is not known, or data that does not fit height, width and step.
    """
    kind, channels = _layout(encoding)
    dtype = np.dtype(kind).newbyteorder(">" if big_endian else "<")
    row = width * channels * dtype.itemsize
    if height < 1 or width < 1 or height * width > _MOST_PIXELS:
        raise PictureError(f"an image of {width}x{height} pixels cannot be shown")
    if step < row or step % dtype.itemsize:
        raise PictureError(f"step is {step}, but {width} pixels of {encoding} are {row} bytes")
    # The last row need not be padded.
    if len(data) < step * (height - 1) + row:
        raise PictureError(f"{len(data)} bytes of data, but step {step} and height {height} make {step * height}")
    pixels = np.ndarray((height, width, channels), dtype, data, strides=(step, channels * dtype.itemsize, dtype.itemsize))
    if channels == 1:
        pixels = pixels[..., 0]
    return _to_screen(pixels, encoding, depth)


def _to_screen(pixels: np.ndarray, encoding: str, depth: DepthView) -> np.ndarray:
    if encoding in ("16UC1", "16UC", "16SC1", "32FC1", "32FC", "64FC1", "32SC1"):
        # REP 118: whole numbers are millimetres, floats metres.
        return show_depth(pixels, 1e-3 if pixels.dtype.kind in "ui" else 1.0, depth)
    if pixels.dtype.itemsize == 2 and pixels.dtype.kind == "u":
        pixels = (pixels >> 8).astype(np.uint8)
    elif pixels.dtype != np.uint8:
        raise PictureError(f"encoding '{encoding[:40]}' cannot be shown")
    if encoding.startswith("bayer_"):
        if min(pixels.shape) < 2:
            raise PictureError(f"a {encoding} image needs two rows and columns")
        return cv2.cvtColor(np.ascontiguousarray(pixels), _BAYER[encoding[6:10]])
    if encoding in ("yuv422", "uyvy", "yuv422_yuy2", "yuyv"):
        if pixels.shape[1] % 2:
            raise PictureError(f"a {encoding} image has an even number of columns, not {pixels.shape[1]}")
        change = cv2.COLOR_YUV2RGB_UYVY if encoding in ("yuv422", "uyvy") else cv2.COLOR_YUV2RGB_YUY2
        return cv2.cvtColor(np.ascontiguousarray(pixels), change)
    order = encoding.rstrip("0123456789")
    if order in _CHANGES:
        return cv2.cvtColor(np.ascontiguousarray(pixels), _CHANGES[order])
    if pixels.ndim == 3 and pixels.shape[2] == 2:
        raise PictureError(f"encoding '{encoding[:40]}' cannot be shown")
    return pixels if pixels.ndim == 2 else pixels[..., :3]  # 8UC3 is taken for RGB


def show_depth(values: np.ndarray, unit: float, view: DepthView) -> np.ndarray:
    """Depth as grey or colours; what is no depth (NaN, or 0 of whole numbers) is black.

    :param values: (h, w). :param unit: m per unit of ``values``.
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


def from_compressed(layout: str, data, depth: DepthView = DepthView()) -> np.ndarray:
    """A picture from the fields of a sensor_msgs/CompressedImage, compressedDepth included.

    :param layout: field ``format``, as ``rgb8; jpeg compressed bgr8`` or ``16UC1; compressedDepth png``.
    :raises PictureError: data that cannot be decoded.
    """
    encoding, _, way = (part.strip() for part in layout.partition(";"))
    if "compressedDepth" in layout:
        return _from_compressed_depth(encoding, way, data, depth)
    pixels = _decode(data, layout)
    if pixels.ndim == 2:
        if pixels.dtype == np.uint16:  # a depth image sent by `compressed`, or mono16
            return _to_screen(pixels, "mono16" if encoding == "mono16" else "16UC1", depth)
        return _to_screen(pixels, encoding, depth) if encoding.startswith("bayer_") and encoding in _LAYOUT else pixels
    return _to_screen(pixels, {3: "bgr", 4: "bgra"}[pixels.shape[2]] + str(8 * pixels.dtype.itemsize), depth)


def _from_compressed_depth(encoding: str, way: str, data, depth: DepthView) -> np.ndarray:
    if len(data) < 12:
        raise PictureError(f"compressedDepth of {len(data)} bytes lacks its 12 bytes of head")
    _, a, b = struct.unpack("<iff", bytes(data[:12]))
    pixels = decode_rvl(bytes(data[12:])) if "rvl" in way.lower() else _decode(data[12:], "compressedDepth")
    if pixels.ndim != 2:
        raise PictureError("compressedDepth with colours in it")
    if not encoding.startswith("32FC1"):
        return show_depth(pixels, 1e-3, depth)
    inverse = pixels.astype(np.float32)
    inverse[inverse == 0] = np.nan  # no depth
    with np.errstate(divide="ignore"):
        return show_depth(np.float32(a) / (inverse - np.float32(b)), 1.0, depth)


def decode_rvl(data: bytes) -> np.ndarray:
    """(h, w) uint16 from columns, rows (uint32 each) and runs of zeros and differences.

    A. D. Wilson's "Fast Lossless Depth Image Compression" (SIGCHI 2017) packs them as numbers of groups of three bits,
    the lowest first, in the nibbles of words of 32 bits.

    :raises PictureError: data that is cut short or no such image.
    """
    columns, rows = struct.unpack("<II", data[:8]) if len(data) >= 8 else (0, 0)
    count = columns * rows
    if not 0 < count <= _MOST_PIXELS:
        raise PictureError(f"a depth image of {columns}x{rows} pixels compressed with RVL cannot be shown")
    words = np.frombuffer(data, "<u4", (len(data) - 8) // 4, 8)
    nibbles = ((words[:, None] >> np.arange(28, -4, -4, np.uint32)) & 15).ravel()
    ends = np.flatnonzero(nibbles < 8)  # the fourth bit says that the number goes on
    starts = np.concatenate(([0], ends[:-1] + 1))
    numbers = np.zeros(0, np.int64)
    if len(ends):
        place = np.arange(ends[-1] + 1) - np.repeat(starts, ends - starts + 1)
        numbers = np.add.reduceat((nibbles[:ends[-1] + 1] & 7).astype(np.int64) << np.minimum(3 * place, 60), starts)
    pixels, runs, differences, at, done = np.zeros(count, np.uint16), [], [], 0, 0
    while done < count:
        zeros, others = (int(number) for number in numbers[at:at + 2]) if at + 2 <= len(numbers) else (count, count)
        if done + zeros + others > count or at + 2 + others > len(numbers) or zeros + others == 0:
            raise PictureError(f"{len(data)} bytes of RVL are no depth image of {columns}x{rows} pixels, or cut short")
        runs.append(np.arange(done + zeros, done + zeros + others))
        differences.append(numbers[at + 2:at + 2 + others])
        at, done = at + 2 + others, done + zeros + others
    differences = np.concatenate(differences)
    values = np.cumsum((differences >> 1) ^ -(differences & 1))  # each from the pixel before it that is not 0
    pixels[np.concatenate(runs)] = values.astype(np.uint16)
    return pixels.reshape(rows, columns)


def _decode(data, layout: str) -> np.ndarray:
    try:
        pixels = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED) if len(data) else None
    except cv2.error:  # sizes that it refuses
        pixels = None
    if pixels is None:
        raise PictureError(f"{len(data)} bytes of '{layout[:60]}' cannot be decoded")
    return pixels


class TheoraDecoder:
    """Pictures of one Theora stream, as theora_image_transport sends it: three head packets, then pictures."""

    def __init__(self):
        self._heads = {}
        self._context = None

    def decode(self, data: bytes) -> Optional[np.ndarray]:
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
    y, u, v = (np.frombuffer(plane, np.uint8).reshape(-1, plane.line_size)[:plane.height, :plane.width] for plane in frame.planes)
    size = (frame.width, frame.height)
    u, v = (cv2.resize(np.repeat(np.repeat(part, 2, 0), 2, 1)[:frame.height, :frame.width], size) for part in (u, v))
    return cv2.cvtColor(cv2.merge((y[:frame.height, :frame.width], v, u)), cv2.COLOR_YCrCb2RGB)


def rotated(picture: np.ndarray, quarters: int) -> np.ndarray:
    """Turned clockwise by ``quarters`` of a turn."""
    return np.ascontiguousarray(np.rot90(picture, -quarters % 4)) if quarters % 4 else picture


def unrotated_point(x: int, y: int, height: int, width: int, quarters: int):
    """Pixel (x, y) of the picture of height x width before :func:`rotated`, from its place afterwards."""
    return {0: (x, y), 1: (y, height - 1 - x), 2: (width - 1 - x, height - 1 - y), 3: (width - 1 - y, x)}[quarters % 4]


def invert_grid(picture: np.ndarray, lines: int) -> np.ndarray:
    """A copy with ``lines`` lines each way, evenly spaced, where the colours are inverted."""
    picture = picture.copy()
    height, width = picture.shape[:2]
    rows = [round((i + 1) * height / (lines + 1)) for i in range(lines)]
    columns = [round((i + 1) * width / (lines + 1)) for i in range(lines)]
    turned = np.zeros((height, width), bool)
    turned[[row for row in rows if row < height]] = True
    turned[:, [column for column in columns if column < width]] = True
    picture[turned] = 255 - picture[turned]
    return picture

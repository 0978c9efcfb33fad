"""The pixels of image messages as arrays, for whoever shows, sends or judges them. No ROS in here.

OpenCV is imported by what needs it alone: mosaics, YUV and what is compressed. It takes half a second.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import Any

import numpy as np

__all__ = ["ImageError", "Picture", "compressed", "decode_rvl", "picture_of", "raw"]


class ImageError(ValueError):
    """Data that is no picture; one line that says why."""


@dataclass(frozen=True, eq=False)
class Picture:
    """``pixels``: uint8, (h, w) grey or (h, w, 3) RGB; of depth (h, w) numbers. ``unit``: m for each of those; 0, it is no depth."""

    pixels: np.ndarray
    unit: float = 0.0


# OpenCV names a Bayer pattern by its second row and column, ROS by its first.
_BAYER = {"rggb": "BayerBG2RGB", "bggr": "BayerRG2RGB", "gbrg": "BayerGR2RGB", "grbg": "BayerGB2RGB"}
#: encoding -> (type of an element, channels)
_LAYOUT = {
    "rgb8": ("u1", 3),
    "bgr8": ("u1", 3),
    "rgba8": ("u1", 4),
    "bgra8": ("u1", 4),
    "mono8": ("u1", 1),
    "mono16": ("u2", 1),
    "rgb16": ("u2", 3),
    "bgr16": ("u2", 3),
    "rgba16": ("u2", 4),
    "bgra16": ("u2", 4),
    "yuv422": ("u1", 2),
    "yuv422_yuy2": ("u1", 2),
    "uyvy": ("u1", 2),
    "yuyv": ("u1", 2),
    **{f"bayer_{pattern}{bits}": (f"u{bits // 8}", 1) for pattern in _BAYER for bits in (8, 16)},
}
_TYPES = {"8U": "u1", "8S": "i1", "16U": "u2", "16S": "i2", "32S": "i4", "32F": "f4", "64F": "f8"}
_DEPTHS = ("16UC1", "16UC", "16SC1", "32FC1", "32FC", "64FC1", "32SC1")
_YUV = {"yuv422": "YUV2RGB_UYVY", "uyvy": "YUV2RGB_UYVY", "yuv422_yuy2": "YUV2RGB_YUY2", "yuyv": "YUV2RGB_YUY2"}
_MOST_PIXELS = 1 << 28


def picture_of(message: Any, unnamed: str = "rgb") -> Picture:
    """Of ``message``, a sensor_msgs/Image or CompressedImage.

    :param unnamed: order of the colours where the encoding names none, as 8UC3: ``rgb`` or ``bgr``
    :raises ImageError: an encoding that is not known, or data that does not fit it
    """
    if hasattr(message, "format"):
        return compressed(message.format, message.data)
    return raw(message.encoding, message.height, message.width, message.step, message.data, bool(message.is_bigendian), unnamed)


def raw(encoding: str, height: int, width: int, step: int, data: Any, big_endian: bool = False, unnamed: str = "rgb") -> Picture:
    """From the fields of a sensor_msgs/Image; its pixels are perhaps a view of ``data``.

    :param step: bytes per row. :param data: bytes. :param unnamed: see :func:`picture_of`
    :param big_endian: of values of more than one byte
    :raises ImageError: an encoding that is not known, or data that does not fit height, width and step
    """
    kind, channels = _layout(encoding)
    dtype = np.dtype(kind).newbyteorder(">" if big_endian else "<")
    row = width * channels * dtype.itemsize
    if height < 1 or width < 1 or height * width > _MOST_PIXELS:
        raise ImageError(f"an image of {width}x{height} pixels cannot be shown")
    if step < row or step % dtype.itemsize:
        raise ImageError(f"step is {step}, but {width} pixels of {encoding} are {row} bytes")
    # The last row need not be padded.
    if len(data) < step * (height - 1) + row:
        raise ImageError(f"{len(data)} bytes of data, but step {step} and height {height} make {step * height}")
    pixels: np.ndarray = np.ndarray((height, width, channels), dtype, data, strides=(step, channels * dtype.itemsize, dtype.itemsize))
    return _seen(pixels[..., 0] if channels == 1 else pixels, encoding, unnamed)


def _layout(encoding: str) -> tuple[str, int]:
    if encoding in _LAYOUT:
        return _LAYOUT[encoding]
    kind, mark, channels = encoding.partition("C")  # OpenCV's own names: 32FC1; 8UC is 8UC1
    if kind in _TYPES and mark and (channels == "" or channels in "1234" and len(channels) == 1):
        return _TYPES[kind], int(channels or 1)
    raise _unknown(encoding)


def _unknown(encoding: str) -> ImageError:
    return ImageError(f"encoding '{encoding[:40]}' cannot be shown")


def _seen(pixels: np.ndarray, encoding: str, unnamed: str = "rgb") -> Picture:
    if encoding in _DEPTHS:
        return Picture(pixels, 1e-3 if pixels.dtype.kind in "ui" else 1.0)  # REP 118: whole numbers are millimetres, floats metres
    if pixels.dtype.itemsize == 2 and pixels.dtype.kind == "u":
        pixels = (pixels >> 8).astype(np.uint8)
    elif pixels.dtype != np.uint8:
        raise _unknown(encoding)
    if encoding.startswith("bayer_"):
        if min(pixels.shape) < 2:
            raise ImageError(f"a {encoding} image needs two rows and columns")
        return Picture(_converted(pixels, _BAYER[encoding[6:10]]))
    if encoding in _YUV:
        if pixels.shape[1] % 2:
            raise ImageError(f"a {encoding} image has an even number of columns, not {pixels.shape[1]}")
        return Picture(_converted(pixels, _YUV[encoding]))
    if pixels.ndim == 2:
        return Picture(pixels)
    if pixels.shape[2] == 2:
        raise _unknown(encoding)
    order = encoding.rstrip("0123456789") if encoding in _LAYOUT else unnamed
    return Picture(np.ascontiguousarray(pixels[..., 2::-1]) if order.startswith("bgr") else pixels[..., :3])


def _converted(pixels: np.ndarray, change: str) -> np.ndarray:
    import cv2

    return cv2.cvtColor(np.ascontiguousarray(pixels), getattr(cv2, f"COLOR_{change}"))


def compressed(layout: str, data: Any) -> Picture:
    """From the fields of a sensor_msgs/CompressedImage, compressedDepth included.

    :param layout: field ``format``, as ``rgb8; jpeg compressed bgr8`` or ``16UC1; compressedDepth png``
    :raises ImageError: data that cannot be decoded
    """
    encoding, _, way = (part.strip() for part in layout.partition(";"))
    if "compressedDepth" in layout:
        return _compressed_depth(encoding, way, data)
    pixels = _decoded(data, layout)
    if pixels.ndim == 2:
        if pixels.dtype == np.uint16:  # a depth image sent by `compressed`, or mono16
            return _seen(pixels, "mono16" if encoding == "mono16" else "16UC1")
        return _seen(pixels, encoding) if encoding.startswith("bayer_") and encoding in _LAYOUT else Picture(pixels)
    return _seen(pixels, {3: "bgr", 4: "bgra"}[pixels.shape[2]] + str(8 * pixels.dtype.itemsize))


def _compressed_depth(encoding: str, way: str, data: Any) -> Picture:
    if len(data) < 12:
        raise ImageError(f"compressedDepth of {len(data)} bytes lacks its 12 bytes of head")
    _, a, b = struct.unpack("<iff", bytes(data[:12]))
    pixels = decode_rvl(bytes(data[12:])) if "rvl" in way.lower() else _decoded(data[12:], "compressedDepth")
    if pixels.ndim != 2:
        raise ImageError("compressedDepth with colours in it")
    if not encoding.startswith("32FC1"):
        return Picture(pixels, 1e-3)
    inverse = pixels.astype(np.float32)
    inverse[inverse == 0] = np.nan  # no depth
    with np.errstate(divide="ignore"):
        return Picture(np.float32(a) / (inverse - np.float32(b)), 1.0)


def _decoded(data: Any, layout: str) -> np.ndarray:
    import cv2

    try:
        pixels = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED) if len(data) else None
    except cv2.error:  # sizes that it refuses
        pixels = None
    if pixels is None:
        raise ImageError(f"{len(data)} bytes of '{layout[:60]}' cannot be decoded")
    return pixels


def decode_rvl(data: bytes) -> np.ndarray:
    """(h, w) uint16 from columns, rows (uint32 each) and runs of zeros and differences.

    A. D. Wilson's "Fast Lossless Depth Image Compression" (SIGCHI 2017) packs them as numbers of groups of three bits,
    the lowest first, in the nibbles of words of 32 bits.

    :raises ImageError: data that is cut short or no such image
    """
    columns, rows = struct.unpack("<II", data[:8]) if len(data) >= 8 else (0, 0)
    count = columns * rows
    if not 0 < count <= _MOST_PIXELS:
        raise ImageError(f"a depth image of {columns}x{rows} pixels compressed with RVL cannot be shown")
    words = np.frombuffer(data, "<u4", (len(data) - 8) // 4, 8)
    nibbles = ((words[:, None] >> np.arange(28, -4, -4, np.uint32)) & 15).ravel()
    ends = np.flatnonzero(nibbles < 8)  # the fourth bit says that the number goes on
    starts = np.concatenate(([0], ends[:-1] + 1))
    numbers: np.ndarray = np.zeros(0, np.int64)
    if len(ends):
        place = np.arange(ends[-1] + 1) - np.repeat(starts, ends - starts + 1)
        numbers = np.add.reduceat((nibbles[: ends[-1] + 1] & 7).astype(np.int64) << np.minimum(3 * place, 60), starts)
    pixels, runs, differences, at, done = np.zeros(count, np.uint16), [], [], 0, 0
    while done < count:
        zeros, others = (int(number) for number in numbers[at : at + 2]) if at + 2 <= len(numbers) else (count, count)
        if done + zeros + others > count or at + 2 + others > len(numbers) or zeros + others == 0:
            raise ImageError(f"{len(data)} bytes of RVL are no depth image of {columns}x{rows} pixels, or cut short")
        runs.append(np.arange(done + zeros, done + zeros + others))
        differences.append(numbers[at + 2 : at + 2 + others])
        at, done = at + 2 + others, done + zeros + others
    joined = np.concatenate(differences)
    values = np.cumsum((joined >> 1) ^ -(joined & 1))  # each from the pixel before it that is not 0
    pixels[np.concatenate(runs)] = values.astype(np.uint16)
    return pixels.reshape(rows, columns)

"""Pictures to Theora packets, with the libtheora inside ffmpeg (PyAV). Free of ROS."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from importlib.util import find_spec
from typing import Any, NamedTuple, cast

import numpy as np

#: encodings of sensor_msgs/Image that can be encoded -> (ffmpeg's name, channels)
ENCODINGS = {"rgb8": ("rgb24", 3), "bgr8": ("bgr24", 3), "mono8": ("gray", 1)}

_BLOCK = 16  # a coded frame is made of whole macroblocks
_LAMBDA = 118  # of ffmpeg: units of global_quality per step of its quality scale
_RATE = 30  # pictures per second that a bit rate is meant for; stamps are in the messages


class Packet(NamedTuple):
    """The fields of an ogg_packet."""

    data: bytes
    b_o_s: int
    granulepos: int
    packetno: int


@dataclass(frozen=True)
class Settings:
    """:param bitrate: bit/s to aim at, or None to keep ``quality``. :param quality: 0 (worst) to 63.
    :param keyframe_frequency: pictures from one key frame to the next, at most."""

    bitrate: int | None = None
    quality: int = 31
    keyframe_frequency: int = 64


def available() -> bool:
    """Whether PyAV is installed. It is loaded with the first encoder: that takes a moment."""
    return find_spec("av") is not None


class Encoder:
    """One stream of pictures of one size.

    :param shape: (height, width), pixels. :param encoding: of :data:`ENCODINGS`.
    :ivar headers: the three header packets.
    :raises ValueError: a stream that libtheora does not make, in one line. :raises ImportError: PyAV does not load.
    """

    def __init__(self, shape: tuple[int, int], encoding: str, settings: Settings = Settings()):
        import av  # not before somebody wants a stream

        self._av = av
        av.logging.set_level(av.logging.ERROR)  # ffmpeg warns of the name yuvj420p, PyAV knows no other for full range
        self._shape, (self._format, self._channels) = shape, ENCODINGS[encoding]
        self._padding = tuple((0, -size % _BLOCK) for size in shape)
        height, width = (size + after for size, (_, after) in zip(shape, self._padding))
        try:
            self._context = context = cast(Any, av.CodecContext.create("libtheora", "w"))
            context.height, context.width, context.pix_fmt = height, width, "yuv420p"
            context.time_base = Fraction(1, _RATE)
            context.gop_size = settings.keyframe_frequency
            if settings.bitrate is None:
                # ffmpeg's scale ends at 10 and is cut to libtheora's whole numbers: round up, or 31 becomes 30.
                scale = math.ceil(settings.quality / 6.3 * _LAMBDA)
                context.options = {"flags": "+qscale", "global_quality": str(scale)}
            else:
                context.bit_rate = settings.bitrate
            context.open()
        except (av.error.FFmpegError, ValueError) as error:
            raise ValueError(f"no theora stream of {shape[1]}x{shape[0]} with {settings}: {error}") from None
        info, *others = _split(bytes(context.extradata))
        self.headers = [Packet(data, int(not i), 0, i) for i, data in enumerate((_with_picture(info, shape), *others))]
        self._shift = (int.from_bytes(info[40:42], "big") >> 5) & 31
        self._frames = self._key = 0

    def encode(self, data) -> list[Packet]:
        """
        :param data: buffer of a picture, rows without gaps. :returns: its packets, usually one.
        :raises ValueError: libtheora refuses it, in one line.
        """
        picture: np.ndarray = np.frombuffer(data, np.uint8).reshape(*self._shape, self._channels)
        picture = np.pad(picture, self._padding + ((0, 0),), mode="edge")
        if self._channels == 1:
            picture = picture[..., 0]
        # Full range 0..255, as theora_image_transport's subscribers undo it; ffmpeg's own yuv420p would be 16..235.
        full = self._av.VideoFrame.from_ndarray(picture, format=self._format).reformat(format="yuvj420p")
        frame = self._av.VideoFrame.from_ndarray(full.to_ndarray(), format="yuv420p")
        frame.pts = self._frames
        try:
            return [self._packet(bytes(packet)) for packet in self._context.encode(frame)]
        except self._av.error.FFmpegError as error:
            raise ValueError(f"a picture could not be encoded: {error}") from None

    def _packet(self, data: bytes) -> Packet:
        self._frames += 1
        if data and not data[0] & 0x40:  # an empty packet repeats the last picture
            self._key = self._frames
        granulepos = (self._key << self._shift) | (self._frames - self._key)
        return Packet(data, 0, granulepos, len(self.headers) + self._frames - 1)


def _split(extradata: bytes) -> list[bytes]:
    """ffmpeg's three header packets, each behind its length in 16 bits."""
    headers, at = [], 0
    while at < len(extradata):
        end = at + 2 + int.from_bytes(extradata[at : at + 2], "big")
        headers.append(extradata[at + 2 : end])
        at = end
    return headers


def _with_picture(info: bytes, shape: tuple[int, int]) -> bytes:
    """The info header with the size of the picture in the upper left corner of the coded frame.

    ffmpeg is given padded pictures, for it reads whole blocks whatever the size; so it knows the padded size alone.
    """
    height, width = shape
    below = int.from_bytes(info[12:14], "big") * _BLOCK - height  # Theora counts rows from below
    return info[:14] + width.to_bytes(3, "big") + height.to_bytes(3, "big") + bytes((0, below)) + info[22:]

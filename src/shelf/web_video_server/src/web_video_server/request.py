"""What is asked for in an address: ``/stream?topic=/camera/image_raw&type=mjpeg&width=320``."""

from __future__ import annotations

import re
from dataclasses import dataclass
from urllib.parse import parse_qs

#: type of a stream -> (content type of a picture, quality where the address gives none: JPEG's per cent, PNG's compression)
ENCODED = {"mjpeg": ("image/jpeg", 95), "png": ("image/png", 3)}
AS_SENT = "ros_compressed"
#: films that upstream encodes with FFmpeg
FILMS = ("vp8", "vp9", "h264")
LARGEST = 8192  # pixels along a side that an address may ask for
_NAME = re.compile(r"/[A-Za-z][A-Za-z0-9_]*(/[A-Za-z0-9_]+)*")  # of a topic, http://wiki.ros.org/Names


def shown(text: str) -> str:
    """``text``, what a stranger sent, for a log, a terminal or an answer: in one line of at most 200 printable characters."""
    plain = "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
    return plain if len(plain) <= 200 else plain[:200] + "..."


class VideoError(ValueError):
    """One sentence."""


class BadRequest(VideoError):
    """For who asked."""


@dataclass(frozen=True)
class Request:
    """:param width, height: pixels, None for those of the topic. :param invert: turned by 180 degrees.
    :param transport: ``raw`` or ``compressed``, what is subscribed to"""

    topic: str
    type: str = "mjpeg"
    width: int | None = None
    height: int | None = None
    quality: int = 95
    invert: bool = False
    transport: str = "raw"

    @property
    def content_type(self) -> str:
        return ENCODED[self.type][0]


def read(query: str, default_type: str = "mjpeg") -> Request:
    """What the address's ``query`` asks for; ``default_type`` where it names no type.

    :raises BadRequest: no such type, or a number that is none or out of its range
    """
    values = {name: given[-1] for name, given in parse_qs(query, keep_blank_values=True).items()}
    kind = values.get("type", default_type)
    if kind in FILMS:
        raise BadRequest(f"type={kind} is not supplied here; ask for type=mjpeg")
    if kind not in (*ENCODED, AS_SENT):
        raise BadRequest(f"there is no type {shown(kind)}; there are {', '.join((*ENCODED, AS_SENT))}")
    topic = values.get("topic", "").strip()
    if not topic:
        raise BadRequest("name a topic: ?topic=/camera/image_raw")
    topic = "/" + topic.lstrip("/")
    if not _NAME.fullmatch(topic):
        raise BadRequest(f"{shown(topic)} is no name of a topic: letters, digits, _ and /")
    most, usual = (9, 3) if kind == "png" else (100, 95)
    quality = _number(values, "quality", most)
    return Request(
        topic,
        kind,
        _size(values, "width"),
        _size(values, "height"),
        usual if quality is None else quality,
        "invert" in values,
        "compressed" if values.get("default_transport") == "compressed" else "raw",
    )


def _size(values: dict[str, str], name: str) -> int | None:
    size = _number(values, name, LARGEST)
    return size or None


def _number(values: dict[str, str], name: str, most: int) -> int | None:
    """None where it is not given, or -1."""
    text = values.get(name, "-1")
    try:
        number = int(text)
    except ValueError:
        number = -2
    if not -1 <= number <= most:
        raise BadRequest(f"{name}={shown(text[:20])} must be a whole number up to {most}")
    return None if number == -1 else number

"""Pictures of an image topic, whatever its type turns out to be."""

from __future__ import annotations

import threading
from collections.abc import Callable

import numpy as np
import rosgraph
import roslib.message
import rospy

from rqt_image_view.pictures import DepthView, PictureError, TheoraDecoder, from_compressed, from_raw

RAW, COMPRESSED, THEORA = "sensor_msgs/Image", "sensor_msgs/CompressedImage", "theora_image_transport/Packet"
TRANSPORTS = ("compressed", "compressedDepth", "theora")
_BUFFER = 1 << 24  # bytes: with less, rospy copies a large message many times while it arrives


def image_topics() -> list[str]:
    """Names of image topics, those of transports behind their base topic. Asks the master.

    :raises rosgraph.MasterException or OSError: no master.
    """
    types = dict(rosgraph.Master("/rqt_image_view").getTopicTypes())
    names: list[str] = []
    for base in sorted(name for name, kind in types.items() if kind == RAW):
        names += [base] + [f"{base}/{transport}" for transport in TRANSPORTS if f"{base}/{transport}" in types]
    return names + sorted(name for name, kind in types.items() if kind == COMPRESSED and name not in names)


def picture_of(message, depth: DepthView = DepthView()) -> np.ndarray:
    """The picture in ``message``, a sensor_msgs/Image or CompressedImage: uint8, (h, w) or (h, w, 3) RGB.

    :param depth: how pictures of depths are shown
    :raises PictureError: it cannot be shown; one line that says why.
    """
    if message._type == RAW:
        return from_raw(message.encoding, message.height, message.width, message.step, message.data, bool(message.is_bigendian), depth)
    if message._type == COMPRESSED:
        return from_compressed(message.format, message.data, depth)
    raise PictureError(f"{message._type} is no image")


class ImageSource:
    """Subscribes a topic that need not exist yet, and hands over pictures.

    Both functions are called in a thread of rospy's. A picture is not even made while the one before has not been taken:
    call :meth:`taken` when it has been drawn.

    :param on_picture: takes (h, w) or (h, w, 3) uint8. :param on_problem: takes a line.
    """

    def __init__(self, topic: str, on_picture: Callable[[np.ndarray], None], on_problem: Callable[[str], None]):
        self.topic = topic
        self.depth = DepthView()
        self._on_picture, self._on_problem = on_picture, on_problem
        self._theora = TheoraDecoder()
        self._free = threading.Event()
        self._free.set()
        self._last = None  # message shown last, to be shown again with other settings
        # Of images the newest is enough. A Theora stream needs all its packets, the heads first, which come in one burst.
        queue_size = None if topic.endswith("/theora") else 1
        self._subscriber = rospy.Subscriber(topic, rospy.AnyMsg, self._receive, queue_size=queue_size, buff_size=_BUFFER)

    def close(self) -> None:
        self._subscriber.unregister()

    def taken(self) -> None:
        """The last picture is on the screen; the next may come."""
        self._free.set()

    def again(self) -> None:
        """Make the last picture again, after a change of :attr:`depth`."""
        if self._last is not None:
            self._hand_over(self._last)

    def _receive(self, raw) -> None:
        kind = raw._connection_header["type"]
        if not self._free.is_set() and kind != THEORA:  # theora: each picture builds on the one before
            return
        message_class = roslib.message.get_message_class(kind) if kind in (RAW, COMPRESSED, THEORA) else None
        if message_class is None:
            self._on_problem(f"{self.topic} is of type {kind}, which is no image")
            return
        try:
            message = message_class().deserialize(raw._buff)
        except Exception as error:  # genpy raises many kinds for bytes that are cut short
            self._on_problem(f"{self.topic}: broken message: {str(error)[:80]}")
            return
        self._hand_over(message)

    def _hand_over(self, message) -> None:
        try:
            picture = self._picture(message)
        except PictureError as error:
            self._on_problem(f"{self.topic}: {error}")
            return
        if picture is not None:
            self._last = message if message._type != THEORA else None
            self._free.clear()
            self._on_picture(picture)

    def _picture(self, message) -> np.ndarray | None:
        if message._type == THEORA:
            return self._theora.decode(message.data)
        return picture_of(message, self.depth)

"""Messages that wait for their transform, as behind tf2_ros' MessageFilter in C++. Who uses it depends on tf2_ros."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import rospy
import tf2_ros

from .held import Held

_COMPLAINTS = 1.0  # s between them


class _Buffer(tf2_ros.Buffer):
    """Tells when a clock that went back has emptied it."""

    emptied: Callable[[], None] | None = None

    def clear(self) -> None:
        super().clear()
        if self.emptied is not None:
            self.emptied()


class _Listener(tf2_ros.TransformListener):
    """Tells when transforms have come."""

    def __init__(self, buffer: tf2_ros.Buffer, told: Callable[[], None]):
        self._told = told
        super().__init__(buffer)

    def callback(self, data: Any) -> None:
        super().callback(data)
        self._told()

    def static_callback(self, data: Any) -> None:
        super().static_callback(data)
        self._told()


class TransformFilter:
    """Messages with a header, taken as soon as ``frame`` is known at their time; at most ``size`` of them wait, the oldest goes first.

    ``buffer`` is the tf2 buffer that it looks into.

    :param frame: into which a message is going to be transformed.
    :param size: how many messages may wait.
    :param take: is called with each message, in a thread of its own, in turn.
    :param tolerance: s, by which the transform must be known after a message as well.
    """

    def __init__(self, frame: str, size: int, take: Callable[[Any], None], tolerance: float = 0.0):
        self.buffer = _Buffer()
        self._frame, self._tolerance = frame.lstrip("/"), rospy.Duration.from_sec(max(tolerance, 0.0))
        self._held = Held(size, self._known, take, self._dropped)
        self.buffer.emptied = self._held.clear
        self._listener = _Listener(self.buffer, self._held.look)

    def add(self, message: Any) -> None:
        """A message has come."""
        if message.header.frame_id:
            self._held.add(message)
        else:
            rospy.logwarn_throttle(
                _COMPLAINTS, "a message without a frame_id cannot be brought into the frame %s: it is dropped", self._frame
            )

    def _known(self, message: Any) -> bool:
        source, stamp = message.header.frame_id.lstrip("/"), message.header.stamp
        if source == self._frame:
            return True
        times = {stamp, stamp + self._tolerance} if stamp else {stamp}
        return all(self.buffer.can_transform(self._frame, source, when) for when in times)

    def _dropped(self, message: Any) -> None:
        if self._known(message):
            return  # more messages than can be worked on
        source, stamp = message.header.frame_id.lstrip("/"), message.header.stamp
        try:
            self.buffer.lookup_transform(self._frame, source, stamp)
            reason = f"it is not known {self._tolerance.to_sec():g} s later"
        except tf2_ros.TransformException as error:
            reason = " ".join(str(error).split())
        rospy.logwarn_throttle(
            _COMPLAINTS,
            "no transform from %s to %s for a message of %.3f, which is dropped: %s",
            source,
            self._frame,
            stamp.to_sec(),
            reason,
        )

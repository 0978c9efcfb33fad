"""Points of a curve from messages. No node in here: messages come from topics or bags alike."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable

from rqt_plot.fields import FieldError, getter, parse_path, slot_of

from rqt_multiplot.config import Curve, CurveAxis, FieldType

#: points that wait to be drawn, and values of one axis that wait for the other: more are lost, the oldest first
_MOST_WAITING = 200_000
_MOST_UNPAIRED = 10_000

AXES = ("x_axis", "y_axis")


def is_time(axis: CurveAxis, message_class) -> bool:
    """Whether the values of ``axis`` are times, in messages of ``message_class``; without a class only times of receipt are."""
    if axis.field_type == FieldType.RECEIPT_TIME:
        return True
    try:
        return message_class is not None and slot_of(message_class, axis.field).kind == "time"
    except FieldError:
        return False


def _stamp_getter(axis: CurveAxis, message_class) -> Callable | None:
    """Reads the stamp of the innermost message with a header around a field; None if there is none."""
    steps = parse_path(axis.field) if axis.field_type == FieldType.DATA else []
    for count in range(len(steps) - 1, -1, -1):
        path = "".join(f"/{step}" for step in steps[:count]) + "/header/stamp"
        try:
            if slot_of(message_class, path).kind == "time":
                return getter(path)
        except FieldError:
            continue
    return None


class Sampler:
    """Makes points of one curve. An axis takes its values from a field or from the time of receipt.

    When both axes have one topic, each message is a point. Otherwise the values of one axis are interpolated at the times of
    the other's: the stamp of the header around the field, or the time of receipt.

    :ivar problem: why messages give no points, or "".
    """

    def __init__(self, curve: Curve):
        self.curve = curve
        self.problem = ""
        self._times = {name: getattr(curve.axes, name).field_type == FieldType.RECEIPT_TIME for name in AXES}
        self.topics: set[str] = {curve.axes.x_axis.topic, curve.axes.y_axis.topic} if curve.complete else set()
        self._readers: dict[tuple[str, type], tuple] = {}
        self._unpaired: tuple[deque, deque] = (deque(maxlen=_MOST_UNPAIRED), deque(maxlen=_MOST_UNPAIRED))
        self._points: deque[tuple[float, float]] = deque(maxlen=_MOST_WAITING)
        self._lock = threading.Lock()

    def is_time(self, axis: str) -> bool:
        """Whether ``x_axis`` or ``y_axis`` shows times, as far as known from the messages so far."""
        return self._times[axis]

    def take(self) -> list[tuple[float, float]]:
        """Points since the last call."""
        with self._lock:
            points = list(self._points)
            self._points.clear()
        return points

    def reset(self) -> None:
        """Forget what waits, as after a jump in time."""
        with self._lock:
            self._points.clear()
            for values in self._unpaired:
                values.clear()

    def add(self, topic: str, message, receipt_time: float) -> None:
        """Take ``message``, of ``topic``, one of :attr:`topics`.

        :param receipt_time: s
        """
        axes = self.curve.axes
        try:
            if len(self.topics) == 1:
                point = [self._reader(name, message)[0](message, receipt_time) for name in AXES]
                with self._lock:
                    self._points.append((point[0], point[1]))
                return
            for which, name in enumerate(AXES):
                if getattr(axes, name).topic == topic:
                    read, read_stamp = self._reader(name, message)
                    self._add_single(which, (read_stamp(message) if read_stamp else 0.0) or receipt_time, read(message, receipt_time))
        except FieldError as error:
            self.problem = f"{self.curve.title}: {error}"
        except (IndexError, AttributeError, TypeError, ValueError) as error:
            self.problem = f"{self.curve.title}: a message of {topic} holds no such number: {error}"

    def _reader(self, name: str, message):
        """(function of message and time of receipt, function that reads the stamp or None) of an axis."""
        key = name, type(message)
        if key not in self._readers:
            axis = getattr(self.curve.axes, name)
            if axis.field_type == FieldType.RECEIPT_TIME:
                self._readers[key] = (lambda _message, receipt_time: receipt_time), None
            else:
                slot = slot_of(type(message), axis.field)
                if slot.is_array or slot.kind not in ("numeric", "boolean", "time"):
                    raise FieldError(f"{axis.name} is no number but {slot.type}{'[]: give an index' if slot.is_array else ''}")
                number = getter(axis.field)
                self._readers[key] = (lambda message, _time: number(message)), _stamp_getter(axis, type(message))
            self._times[name] = is_time(axis, type(message))
        return self._readers[key]

    def _add_single(self, which: int, time: float, value: float) -> None:
        with self._lock:
            values = self._unpaired[which]
            if values and time <= values[-1][0]:
                if time > values[-1][0] - 1.0:
                    return  # not newer: nothing to interpolate
                for unpaired in self._unpaired:  # the clock was set back
                    unpaired.clear()
            values.append((time, value))
            self._interpolate()

    def _interpolate(self) -> None:
        xs, ys = self._unpaired
        while len(xs) > 1 and len(ys) > 1:
            for values, others in ((xs, ys), (ys, xs)):
                while len(values) > 1 and values[1][0] < others[0][0]:
                    values.popleft()
            if len(xs) < 2 or len(ys) < 2:
                return
            if ys[0][0] >= xs[0][0]:
                self._points.append((_between(xs[0], xs[1], ys[0][0]), ys[0][1]))
                ys.popleft()
            else:
                self._points.append((xs[0][1], _between(ys[0], ys[1], xs[0][0])))
                xs.popleft()


def _between(first: tuple[float, float], second: tuple[float, float], time: float) -> float:
    return first[1] + (second[1] - first[1]) * (time - first[0]) / (second[0] - first[0])

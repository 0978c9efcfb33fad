"""Numbers of topics as they arrive. `ROSData` is a curve's source; `TopicTypes` knows which topics there are."""

from __future__ import annotations

import threading
import weakref
from collections import deque

import rosgraph
import roslib.message
import rospy
from qt_gui.errors import WindowError

from rqt_plot.fields import FieldError, expand, getter, split_topic
from rqt_plot.series import CAPACITY


class RosPlotException(WindowError):
    """A topic that cannot be plotted, or a master that does not answer."""


def topic_types() -> dict[str, str]:
    """Topics that the master knows a type of. Asks it, so call it from the GUI's thread only where waiting is allowed.

    :raises RosPlotException: the master does not answer.
    """
    try:
        return {name: kind for name, kind in rosgraph.Master("/rosplot").getTopicTypes() if kind != "*"}
    except (OSError, rosgraph.MasterException) as error:
        raise RosPlotException(f"unable to get list of topics from master: {error}") from None


def get_topic_type(topic: str) -> tuple[str | None, str | None, str | None]:
    """Type, name and field path of what ``topic`` names; three times None when no such topic exists.

    :raises RosPlotException: the master does not answer.
    """
    types = topic_types()
    name, path = split_topic(topic, types)
    return (None, None, None) if name is None else (types[name], name, path)


class TopicTypes:
    """What topics there are, asked for every second in a thread of its own while somebody holds this object."""

    PERIOD = 1.0  # s

    def __init__(self):
        self.types: dict[str, str] = {}  #: topic -> type, replaced as a whole
        self.known = threading.Event()  #: set after the first answer of the master
        self._stop = threading.Event()
        self._again = threading.Event()
        threading.Thread(target=_watch, args=(weakref.ref(self), self._stop, self._again), daemon=True).start()

    def refresh(self) -> None:
        """Ask soon, without waiting for the second to pass."""
        self._again.set()

    def close(self) -> None:
        self._stop.set()
        self._again.set()

    def _ask(self) -> None:
        try:
            self.types = topic_types()
            self.known.set()
        except RosPlotException:
            pass  # the master may come back; the container tells the user that it is away


def _watch(owner, stop: threading.Event, again: threading.Event) -> None:
    while not stop.is_set():
        watcher = owner()
        if watcher is None:
            return
        watcher._ask()
        del watcher
        again.wait(TopicTypes.PERIOD)
        again.clear()


class ROSData:
    """The numbers of one field of a topic: x is the stamp, or the time of receipt, since ``start_time``.

    A topic that does not exist yet is waited for: give :meth:`connect` the types of the topics that there are.

    :param topic: name of topic and field, as ``/odom/pose/pose/position/x``. :param start_time: s, of the x axis' zero.
    :param types: topic -> type when known; otherwise the master is asked.
    :ivar error: what is wrong with the name (RosPlotException), or None.
    :ivar connected: whether the topic has been found.
    """

    def __init__(self, topic: str, start_time: float, types: dict[str, str] | None = None):
        self.name = topic
        self.start_time = start_time
        self.error: RosPlotException | None = None
        self.connected = False
        self.lock = threading.Lock()
        # Bounded: a window that is paused for hours must not eat the memory.
        self.buff_x: deque[float] = deque(maxlen=CAPACITY)
        self.buff_y: deque[float] = deque(maxlen=CAPACITY)
        self.sub = None
        self.problem = ""  #: what was wrong with the last message, if it gave no number
        self.connect(topic_types() if types is None else types)

    def connect(self, types: dict[str, str]) -> bool:
        """Subscribe if the topic is there now. :returns: whether it is subscribed."""
        if self.connected or self.error:
            return self.connected
        topic, path = split_topic(self.name, types)
        if topic is None:
            return False
        message_class = roslib.message.get_message_class(types[topic])
        try:
            names, reason = expand(self.name, types)
            if self.name not in (names or ()):
                raise FieldError(reason)
            self._value = getter(path)
        except FieldError as error:
            self.error = RosPlotException(f"Invalid topic spec [{self.name}]: {error}")
            return False
        self.connected = True
        self.sub = rospy.Subscriber(topic, message_class, self._ros_cb)
        return True

    def close(self) -> None:
        if self.sub is not None:
            self.sub.unregister()
            self.sub = None

    def _ros_cb(self, msg) -> None:
        try:
            value = self._value(msg)
        except (IndexError, AttributeError, TypeError, ValueError) as error:
            self.problem = f"[{self.name}] a message holds no such number: {error}"
            return
        # A stamp that nobody filled in would lie decades off the screen.
        stamp = msg.header.stamp.to_sec() if msg._has_header else 0.0
        with self.lock:
            self.buff_x.append((stamp or rospy.get_time()) - self.start_time)
            self.buff_y.append(value)

    def next(self) -> tuple[list[float], list[float]]:
        """Samples since the last call: x in s, y.

        :raises RosPlotException: there will never be any.
        """
        if self.error:
            raise self.error
        with self.lock:
            x, y = list(self.buff_x), list(self.buff_y)
            self.buff_x.clear()
            self.buff_y.clear()
        return x, y

"""A namespace, with what a controller makes in it: parameters, publishers, subscribers, services."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import rosgraph
import rospy
from node_signals import offers
from node_signals.parameters import REQUIRED, ParameterError, of_kind, or_default, texts

_KINDS = (float, int, bool, str, list, dict)


def one_line(text: object, longest: int = 400) -> str:
    """``text`` for a message: on one line, without its middle if it is longer than ``longest``."""
    line = " ".join(str(text).split())
    return line if len(line) <= longest else f"{line[: longest - 85]} ... {line[-80:]}"


def to_stamp(time: float) -> rospy.Time:
    """``time`` (s) of the control loop as a message stamp, rounded to the nanosecond."""
    secs, nsecs = divmod(round(time * 1e9), 1000000000)
    return rospy.Time(secs, nsecs)


class NodeHandle:
    """Names relative to ``namespace``; remembers what is made through it, until ``shutdown``.

    :param namespace: absolute, or relative to the namespace of the process; "" is the latter.
    """

    def __init__(self, namespace: str = "", _owned: list[Any] | None = None):
        self.namespace = rospy.resolve_name(namespace or rospy.get_namespace()).rstrip("/") or "/"
        self._owned = [] if _owned is None else _owned

    def sub(self, name: str) -> NodeHandle:
        """A handle of ``name``, one level down; what it makes goes when this handle is shut down."""
        return NodeHandle(self._join(name), self._owned)

    def resolve(self, name: str) -> str:
        """Absolute name, remappings applied."""
        return rospy.resolve_name(self._join(name))

    def _join(self, name: str) -> str:
        if not name:
            return self.namespace
        return name if name[0] in "/~" else f"{self.namespace.rstrip('/')}/{name}"

    # -- parameters -------------------------------------------------------------------------------------------------

    def has_param(self, name: str) -> bool:
        """Whether the parameter ``name`` is set."""
        return rospy.has_param(self._join(name))

    def param(self, name: str, default: Any) -> Any:
        """Value of parameter ``name``, or ``default``: also where it is of another kind, as roscpp's param() has it, with an ERROR line.

        :raises ParameterError: it is NaN where a number is expected.
        """
        value = rospy.get_param(self._join(name), default)
        return value if value is default or type(default) not in _KINDS else or_default(self._join(name), value, default)

    def get_param(self, name: str, kind: type | None = None) -> Any:
        """Value of the required parameter ``name``.

        :param kind: float (whole numbers accepted), int, bool, str, list or dict; None takes anything.
        :raises ParameterError: missing, or of another kind.
        """
        value = rospy.get_param(self._join(name), REQUIRED)
        if value is REQUIRED:
            raise ParameterError(f"parameter {self._join(name)} is not set; {self.describe()}")
        return value if kind is None else of_kind(f"parameter {self._join(name)}", value, kind)

    def strings(self, name: str, empty: bool = False) -> list[str]:
        """The required parameter ``name``, a list of texts (joint names).

        :param empty: whether it may have none.
        :raises ParameterError: missing, empty, or something else than texts in it.
        """
        return texts(f"parameter {self._join(name)}", self.get_param(name, list), empty)

    def describe(self) -> str:
        """What the parameter server has in this namespace, for messages: '/a/b has: joint, type'."""
        value = rospy.get_param(self.namespace, None)
        if value is None:
            return f"there are no parameters in {self.namespace}"
        if not isinstance(value, dict):
            return f"{self.namespace} is not a namespace but the value {one_line(repr(value))}"
        return f"{self.namespace} has: {one_line(', '.join(sorted(value))) or 'nothing'}"

    def set_param(self, name: str, value: Any) -> None:
        """Set parameter ``name`` to ``value``: numbers, text, lists and maps of them."""
        rospy.set_param(self._join(name), value)

    def search_param(self, name: str) -> str | None:
        """Absolute name of the closest parameter ``name`` here or in a namespace above, or None."""
        # the master refuses "/" as the place to begin; from a name below, it looks there on its way up
        place = "/search_param" if self.namespace == "/" else self.namespace
        try:
            return rosgraph.Master(place).searchParam(name) or None
        except rosgraph.MasterError:  # the master's way of saying that there is none
            return None

    # -- communication ------------------------------------------------------------------------------------------------

    def publisher(self, name: str, message_type: type, queue_size: int = 1, latch: bool = False) -> rospy.Publisher:
        """A publisher on topic ``name``. Small messages leave at once (no Nagle delay: it makes a 50 Hz topic stutter by 40 ms).

        :param message_type: class of the messages.
        :param queue_size: of messages that wait for a slow subscriber; older ones are dropped.
        :param latch: whoever subscribes later is sent the last message.
        """
        return self.own(rospy.Publisher(self.resolve(name), message_type, queue_size=queue_size, latch=latch, tcp_nodelay=True))

    def subscriber(self, name: str, message_type: type, callback: Callable, queue_size: int = 1) -> rospy.Subscriber:
        """Call ``callback`` with each message on topic ``name``. It runs in a thread of rospy: it should only store a value.

        Without the wish for no delay, TCP holds a command until the one before it is acknowledged: up to 0.2 s.

        :param message_type: class of the messages.
        :param queue_size: of messages that wait for ``callback``; older ones are dropped.
        """
        return self.own(rospy.Subscriber(self.resolve(name), message_type, callback, queue_size=queue_size, tcp_nodelay=True))

    def service(self, name: str, service_type: type, callback: Callable) -> rospy.Service:
        """Offer service ``name`` of type ``service_type``: ``callback`` makes a response of the request, in a thread of rospy."""
        return self.own(offers.service(self.resolve(name), service_type, callback))

    def own(self, thing: Any) -> Any:
        """Release ``thing`` (by its unregister() or shutdown()) together with the rest. :return: ``thing``."""
        self._owned.append(thing)
        return thing

    def shutdown(self) -> None:
        """Unregister everything made through this handle, last first."""
        while self._owned:
            thing = self._owned.pop()
            release = getattr(thing, "unregister", None) or thing.shutdown
            try:
                release()
            except (OSError, rospy.ROSException) as error:  # the master has gone: nothing is left to unregister from
                rospy.logdebug("releasing %s: %s", thing, error)

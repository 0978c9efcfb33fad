"""What tests of controllers do again and again: wait for something in simulated time, send, load, switch."""

from __future__ import annotations

import time as wall
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import rosgraph
import rospy
from controller_manager_msgs.srv import ListControllers, LoadController, SwitchController, SwitchControllerRequest, UnloadController
from std_srvs.srv import Empty, Trigger

_ROUNDING = 1e-6  # s
_advance = None


def advance() -> float:
    """Let a little simulated time pass, see node.TestRobotNode. The clock of this process then shows it, too.

    :return: the robot's time, s
    """
    global _advance
    if _advance is None:
        rospy.wait_for_service("/test_robot/advance", 60.0)
        _advance = rospy.ServiceProxy("/test_robot/advance", Trigger, persistent=True)
    now, wall_deadline = float(_advance().message), wall.monotonic() + 60.0
    while rospy.get_time() < now - _ROUNDING:
        if wall.monotonic() > wall_deadline:
            raise AssertionError("/clock does not arrive")
        wall.sleep(0.0002)
    return now


def wait_until(condition: Callable[[], Any], what: str, timeout: float = 30.0) -> Any:
    """Let time pass until ``condition`` is true. :return: its value.

    :param timeout: s of simulated time
    :raises AssertionError: it never came true; ``what`` says what was waited for
    """
    deadline, wall_deadline = None, wall.monotonic() + 60.0
    while not rospy.is_shutdown():
        value = condition()
        if value:
            return value
        advance()
        now = rospy.get_time()
        if deadline is None and now > 0.0:
            deadline = now + timeout
        if (deadline is not None and now > deadline) or wall.monotonic() > wall_deadline:
            raise AssertionError(f"waited in vain for {what}")
    raise AssertionError(f"shut down while waiting for {what}")


def sim_sleep(seconds: float) -> None:
    """Let ``seconds`` of simulated time pass."""
    end = advance() + seconds - _ROUNDING
    wait_until(lambda: rospy.get_time() >= end, f"{seconds} s to pass", seconds + 10.0)


class Topic:
    """Messages of a topic since the last ``clear``."""

    def __init__(self, name: str, message_type: type):
        self.messages: list[Any] = []
        self.name = name
        self._since = 0.0
        self._subscriber = rospy.Subscriber(name, message_type, self._receive, tcp_nodelay=True)

    def _receive(self, message: Any) -> None:
        header, since = getattr(message, "header", None), self._since
        # sent before the last clear; unless time has begun anew
        late = header is not None and header.stamp.to_sec() < since - _ROUNDING and rospy.get_time() > since - _ROUNDING
        if not late:
            self.messages.append(message)

    @property
    def last(self) -> Any:
        return self.messages[-1]

    def clear(self) -> None:
        """Forget all messages, those with a stamp also when they are still under way."""
        self._since = advance()
        self.messages = []

    def next(self, timeout: float = 30.0) -> Any:
        """Wait, up to ``timeout`` s, for a message that was sent after this call; one that was still under way then does not count."""
        messages = self.messages
        count, now = len(messages), advance()

        def newer() -> bool:
            if len(messages) <= count:
                return False
            header = getattr(messages[-1], "header", None)
            return header is None or header.stamp.to_sec() > now - _ROUNDING

        wait_until(newer, f"a message on {self.name}", timeout)
        return messages[-1]

    def close(self) -> None:
        self._subscriber.unregister()


def publisher(name: str, message_type: type) -> rospy.Publisher:
    """A publisher on topic ``name``, of class ``message_type``, that is connected to its subscriber."""
    result = rospy.Publisher(name, message_type, queue_size=10)
    wait_until(lambda: result.get_num_connections() > 0, f"a subscriber of {name}", 60.0)
    return result


def load(*names: str) -> None:
    for name in names:
        assert _call("load_controller", LoadController, name=name).ok, f"controller {name} did not load"


def unload(*names: str) -> None:
    for name in names:
        assert _call("unload_controller", UnloadController, name=name).ok, f"controller {name} did not unload"


def loads(name: str) -> bool:
    """Whether the controller ``name`` can be loaded."""
    return _call("load_controller", LoadController, name=name).ok


def switch(start: Sequence[str] = (), stop: Sequence[str] = ()) -> None:
    """One strict switch: the controllers ``start`` start and ``stop`` stop."""
    assert _call(
        "switch_controller",
        SwitchController,
        start_controllers=list(start),
        stop_controllers=list(stop),
        strictness=SwitchControllerRequest.STRICT,
    ).ok, f"controllers did not switch to {start} from {stop}"


def controller_state(name: str) -> str:
    """What list_controllers says of the controller ``name``; "" where it is not loaded."""
    return next((c.state for c in _call("list_controllers", ListControllers).controller if c.name == name), "")


def set_faults(**faults: dict) -> None:
    """Give joints of the test robot faults (see robot.Faults); all others have none."""
    rospy.set_param("/test_robot/faults", faults)
    rospy.wait_for_service("/test_robot/apply_faults", 60.0)
    rospy.ServiceProxy("/test_robot/apply_faults", Empty)()


def reset() -> None:
    """Begin time anew, with the joints where they began; back when everybody here knows."""
    before = rospy.get_time()
    rospy.wait_for_service("/test_robot/reset", 60.0)
    rospy.ServiceProxy("/test_robot/reset", Empty)()
    wait_until(lambda: 0.0 < rospy.get_time() < before, "time to begin anew", 1e9)


def _call(manager_service: str, kind: type, **request: Any) -> Any:
    rospy.wait_for_service("/controller_manager/" + manager_service, 60.0)
    return rospy.ServiceProxy("/controller_manager/" + manager_service, kind)(**request)


@contextmanager
def running(*names: str) -> Iterator[None]:
    """Controllers loaded and started for the time of a ``with`` block."""
    load(*names)
    try:
        switch(names)
        yield
    finally:
        if any(controller_state(name) == "running" for name in names):
            switch(stop=names)
        unload(*names)


def published(topic: str) -> bool:
    """Whether somebody publishes ``topic``."""
    return topic in (name for name, _ in rospy.get_published_topics())


def publisher_count(topic: str) -> int:
    """Nodes that publish ``topic``."""
    publishers, _, _ = rosgraph.Master(rospy.get_name()).getSystemState()
    return len(dict(publishers).get(topic, []))

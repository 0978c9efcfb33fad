"""Nodes, topics, services, parameters, transforms, controllers."""

from __future__ import annotations

import difflib
import fnmatch
import math
import socket
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

import rosgraph
import rospy

from ..examination.commands import CommandError, find_topic
from ..examination.simulated_world import Sample
from .base import Check, Context, names

if TYPE_CHECKING:
    from tf2_msgs.msg import TFMessage

_PATIENCE, _TF_PATIENCE = 5.0, 10.0  # s after the commands
_TF_WATCH = 0.3  # s after the commands for which transforms are watched at least
_RATE_WATCH, _RATE_MOST = 2.0, 60.0  # s for which a rate is counted at least and at most, where the spec does not say
_RATE_COUNT = 4  # messages of the slowest rate that is asked for
_FEWEST, _LONG_PERIOD = 3, 4.0  # messages whose pauses tell a rate, if these are so many quanta long
_ANSWER = 0.5  # s of wall time
_MOST_ASKED = 8  # nodes


def master() -> rosgraph.Master:
    return rosgraph.Master("/lab_check")


def _missing(what: str, name: str, there: list[str]) -> str:
    near = difflib.get_close_matches(name, there, 1, 0.6)
    return f"there is no {what} {name}" + (f"; did you mean {near[0]}?" if near else f" (there are: {names(there)})")


def runs(node: str) -> bool:
    """Somebody is at the address that ``node`` registered: the master keeps the names of those that were killed. Who is slow runs."""
    try:
        address = urlsplit(master().lookupNode(node))
        socket.create_connection((address.hostname, address.port), _ANSWER).close()
    except TimeoutError:
        return True
    except (OSError, ValueError, TypeError, rosgraph.MasterException):
        return False
    return True


class _Awaited(Check):
    """Has a while to come up, in simulated and in wall time."""

    in_wall_time = True

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.patience = wanted.get("within", _PATIENCE) if isinstance(wanted, dict) else _PATIENCE

    def there(self) -> bool:
        return self.verdict()[0]


class NodeCheck(_Awaited):
    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        wanted = self.wanted["name"] if isinstance(self.wanted, dict) else self.wanted
        there = sorted({node for part in master().getSystemState() for _, nodes in part for node in nodes} - {rospy.get_name()})
        found = [node for node in there if fnmatch.fnmatchcase(node, wanted)]
        if not found:
            return False, _missing("node", wanted, there), {}
        if not any(runs(node) for node in found[:_MOST_ASKED]):
            return False, f"the node {names(found)} has ended: it is registered at the master, but does not answer any more", {}
        return True, f"the node {wanted} runs", {}


class TopicCheck(_Awaited):
    """A topic's publisher or subscriber, its type, its rate in simulated time, whether it is latched."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self._arrivals: list[float] = []
        self._begin: float | None = None  # simulated s, when counting began
        self._subscriber: rospy.Subscriber | None = None
        self._window = 0.0
        if "rate" in wanted:
            slowest = _RATE_COUNT / wanted["rate"][0] if wanted["rate"][0] > 0 else 0.0
            self._window = wanted.get("within", min(max(_RATE_WATCH, slowest), _RATE_MOST))
            self.horizon = self._window
            self.patience = _PATIENCE + self._window
        elif "latched" in wanted:
            self.horizon = min(self.patience, 0.2)

    def commanded(self) -> None:
        self._listen()

    def sample(self, sample: Sample) -> None:
        del sample
        self._listen()

    def _listen(self) -> None:
        """From when somebody publishes it."""
        if self._subscriber is not None or not {"rate", "latched"} & set(self.wanted):
            return
        try:
            name = find_topic(self.wanted["name"])
        except CommandError:
            return
        if not set(dict(master().getSystemState()[0]).get(name, ())) - {rospy.get_name()}:
            return
        self._subscriber = rospy.Subscriber(name, rospy.AnyMsg, self._receive, queue_size=None, tcp_nodelay=True)
        self.context.bench.connect()
        self._begin = self.context.bench.now.time
        del self._arrivals[:]

    def _receive(self, message: Any) -> None:
        del message
        self._arrivals.append(self.context.bench.now.time)

    def there(self) -> bool:
        if "rate" in self.wanted:
            return self._begin is not None and self.context.bench.now.time >= self._begin + self._window - 1e-9
        return super().there()

    def end(self) -> None:
        if self._subscriber is not None:
            self._subscriber.unregister()

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        try:
            name = find_topic(self.wanted["name"])
        except CommandError as error:
            return False, str(error), {}
        published, subscribed, _ = master().getSystemState()
        side = subscribed if self.wanted.get("subscribed") else published
        there = {topic: sorted(set(nodes) - {rospy.get_name()}) for topic, nodes in side if set(nodes) - {rospy.get_name()}}
        does = "listens to" if self.wanted.get("subscribed") else "publishes"
        if name not in there:
            return False, _missing(f"topic that anybody {does}:", name, sorted(there)), {}
        if not any(runs(node) for node in there[name][:_MOST_ASKED]):
            return False, f"the node {names(there[name])}, which {does} {name}, has ended: it does not answer any more", {}
        kind = dict(master().getTopicTypes()).get(name, "?")
        if self.wanted.get("type", kind) != kind:
            return False, f"{name} carries {kind}, not {self.wanted['type']}", {}
        if "latched" in self.wanted:
            latched = self._latched()
            if latched is None:
                return False, f"nobody who publishes {name} could be reached: whether it is latched is not known", {}
            if latched != self.wanted["latched"]:
                return False, f"{name} is {'' if latched else 'not '}latched", {}
        if "rate" in self.wanted:
            return self._rate(name)
        return True, f"{name} is there, {kind}", {}

    def _latched(self) -> bool | None:
        """What publishers say when they are connected to; None while none is."""
        headers = [c.header for c in self._subscriber.impl.connections] if self._subscriber is not None else []
        return any(header.get("latching") == "1" for header in headers) if headers else None

    def _rate(self, name: str) -> tuple[bool, str, dict[str, Any]]:
        if self._begin is None:
            return False, f"nobody published {name} when it was counted", {}
        rate = rate_of(self._arrivals, self._begin, self.context.bench.now.time, self.context.bench.quantum)
        low, high = self.wanted["rate"]
        return (low <= rate <= high, f"{name} comes at {rate:.4g} Hz of simulated time; {low:g} to {high:g} are asked for", {"rate": rate})


def rate_of(arrivals: list[float], begin: float, end: float, quantum: float) -> float:
    """Hz, from the times of ``arrivals`` between ``begin`` and ``end``, which are known to a ``quantum``.

    Of few that come regularly, by the pauses between them: how many fall into a time is uncertain by one.
    """
    if len(arrivals) >= _FEWEST:
        period = (arrivals[-1] - arrivals[0]) / (len(arrivals) - 1)
        rest = max(arrivals[0] - begin, end - arrivals[-1])
        if period > _LONG_PERIOD * quantum and rest <= period + 2 * quantum:
            return 1 / period
    return len(arrivals) / (end - begin) if end > begin else 0.0


class ServiceCheck(_Awaited):
    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        from rosservice import ROSServiceException, get_service_type

        name = self.wanted["name"]
        there = sorted(service for service, _ in master().getSystemState()[2])
        if name not in there:
            return False, _missing("service", name, there), {}
        try:
            kind = get_service_type(name)
        except (ROSServiceException, OSError) as error:
            return False, f"service {name} does not answer: {error}", {}
        if kind is None:
            return False, f"service {name} does not answer", {}
        if self.wanted.get("type", kind) != kind:
            return False, f"{name} is of type {kind}, not {self.wanted['type']}", {}
        return True, f"the service {name} is offered", {}


class ParamCheck(_Awaited):
    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        name = self.wanted["name"]
        try:
            value = master().getParam(name)
        except rosgraph.MasterException:
            return False, _missing("parameter", name, sorted(master().getParamNames())), {}
        if "value" in self.wanted:
            expected, tolerance = self.wanted["value"], self.wanted.get("tolerance", 0.0)
            number = isinstance(value, (int, float)) and isinstance(expected, (int, float))
            if not (abs(value - expected) <= tolerance if number else value == expected):
                return False, f"parameter {name} is {str(value)[:80]}, not {expected}", {}
        return True, f"parameter {name} is set", {}


class TfCheck(_Awaited):
    """A transform between two frames; joints of the tree are composed from what /tf and /tf_static brought."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.patience = wanted.get("within", _TF_PATIENCE)
        self.horizon = min(_TF_WATCH, self.patience)

    def start(self) -> None:
        import tf2_ros

        self._buffer = tf2_ros.BufferCore(rospy.Duration(1e6))
        from tf2_msgs.msg import TFMessage

        self._subscribers = [
            rospy.Subscriber(name, TFMessage, lambda message, static=static: self._take(message, static), queue_size=None)
            for name, static in (("/tf", False), ("/tf_static", True))
        ]
        self.context.bench.connect()

    def _take(self, message: TFMessage, static: bool) -> None:
        set_it = self._buffer.set_transform_static if static else self._buffer.set_transform
        for transform in message.transforms:
            set_it(transform, "lab_check")

    def end(self) -> None:
        for subscriber in self._subscribers:
            subscriber.unregister()

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        import tf2_ros

        source, target = self.wanted["from"], self.wanted["to"]
        try:
            found = self._buffer.lookup_transform_core(source, target, rospy.Time(0)).transform.translation
        except tf2_ros.TransformException as error:
            return False, f"there is no transform from {source} to {target}: {str(error).splitlines()[0]}", {}
        place = [found.x, found.y, found.z]
        if not all(map(math.isfinite, place)):
            return False, f"the transform from {source} to {target} holds what is no number", {}
        if "xyz" in self.wanted:
            off = math.dist(place[: len(self.wanted["xyz"])], self.wanted["xyz"])
            if not off <= self.wanted.get("tolerance", 0.01):
                return False, f"{target} is {off:.4g} m from where it should be in {source}", {"xyz": place}
        return True, f"{target} is known in {source}", {"xyz": place}


class ControllersCheck(_Awaited):
    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        from controller_manager_msgs.srv import ListControllers

        services = sorted(s for s, _ in master().getSystemState()[2] if s.endswith("/controller_manager/list_controllers"))
        manager = self.wanted.get("manager")
        mine = [s for s in services if manager in (None, s[: -len("/list_controllers")])]
        if not mine:
            which = f" {manager}" if manager else ""
            return (
                False,
                (
                    f"there is no controller manager{which}: is the gazebo_ros_control plugin in the URDF? "
                    f"(there are: {names(s[: -len('/list_controllers')] for s in services)})"
                ),
                {},
            )
        try:
            self._doubt(mine)
            found = {c.name: c for service in mine for c in rospy.ServiceProxy(service, ListControllers)().controller}
        except (rospy.ServiceException, rospy.ROSException) as error:
            return False, f"the controller manager does not answer: {error}", {}
        running = sorted(name for name, c in found.items() if c.state == "running")
        figures = {"running": running}
        for pattern in self.wanted.get("running", []):
            if not any(fnmatch.fnmatchcase(name, pattern) for name in running):
                state = next((c.state for name, c in found.items() if fnmatch.fnmatchcase(name, pattern)), "")
                return (
                    False,
                    (f"controller {pattern} is loaded, but {state}" if state else f"controller {pattern} is not loaded")
                    + f" (running: {names(running)})",
                    figures,
                )
        if len(running) < self.wanted.get("count", 0):
            return False, f"{len(running)} controllers run, {self.wanted['count']} are asked for (running: {names(running)})", figures
        for pattern, kind in self.wanted.get("types", {}).items():
            fitting = [c for name, c in found.items() if fnmatch.fnmatchcase(name, pattern)]
            if not fitting:
                return False, f"controller {pattern} is not loaded (there are: {names(sorted(found))})", figures
            wrong = [f"{c.name} is {c.type}" for c in fitting if c.type != kind]
            if wrong:
                return False, f"{names(wrong)}, not {kind}", figures
        return True, f"running: {names(running)}", figures

    def _doubt(self, services: list[str]) -> None:
        """A node of the submission that is a controller manager, of a robot of its own say, tells what it likes."""
        owners = {node for service, nodes in master().getSystemState()[2] if service in services for node in nodes}
        for node in sorted(owners):
            if master().lookupNode(node) != self.context.bench.simulator:
                self.doubts.add(f"a controller manager that was asked is the node {node}'s, not the simulator's: it tells what it likes")

"""Nodes, topics, services, parameters, transforms, controllers, what was printed, how programs ended."""

from __future__ import annotations

import difflib
import fnmatch
import math
from typing import TYPE_CHECKING, Any

import rosgraph
import rospy

from ..examination.commands import CommandError, find_topic
from ..examination.simulated_world import Sample
from ..explain import crashed, error_lines, refusal, timeless
from .base import Check, Context, names, search

if TYPE_CHECKING:
    from tf2_msgs.msg import TFMessage

    from ..isolation.supervise import Program


def master() -> rosgraph.Master:
    return rosgraph.Master("/lab_check")


def _missing(what: str, name: str, there: list[str]) -> str:
    near = difflib.get_close_matches(name, there, 1, 0.6)
    return f"there is no {what} {name}" + (f"; did you mean {near[0]}?" if near else f" (there are: {names(there)})")


class NodeCheck(Check):
    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        there = sorted({node for part in master().getSystemState() for _, nodes in part for node in nodes} - {rospy.get_name()})
        if any(fnmatch.fnmatchcase(node, self.wanted) for node in there):
            return True, f"the node {self.wanted} runs", {}
        return False, _missing("node", self.wanted, there), {}


class TopicCheck(Check):
    """A topic's publisher or subscriber, its type, its rate in simulated time, whether it is latched."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self._arrivals: list[float] = []
        self._latched = None
        self._subscriber = None
        if "rate" in wanted or "latched" in wanted:
            self.horizon = wanted.get("within", 2.0 if "rate" in wanted else 0.2)

    def commanded(self) -> None:
        if not self.horizon:
            return
        try:
            name = find_topic(self.wanted["name"])
        except CommandError:
            return
        self._subscriber = rospy.Subscriber(name, rospy.AnyMsg, self._receive, queue_size=None, tcp_nodelay=True)
        self.context.bench.connect()
        self._begin = self.context.bench.now.time
        del self._arrivals[:]

    def _receive(self, message: Any) -> None:
        self._arrivals.append(self.context.bench.now.time)
        self._latched = message._connection_header.get("latching") == "1"

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        if self._subscriber is not None:
            self._subscriber.unregister()
        try:
            name = find_topic(self.wanted["name"])
        except CommandError as error:
            return False, str(error), {}
        published, subscribed, _ = master().getSystemState()
        side = subscribed if self.wanted.get("subscribed") else published
        there = sorted(topic for topic, nodes in side if set(nodes) - {rospy.get_name()})
        if name not in there:
            does = "listens to:" if self.wanted.get("subscribed") else "publishes:"
            return False, _missing(f"topic that anybody {does}", name, there), {}
        kind = dict(master().getTopicTypes()).get(name, "?")
        if self.wanted.get("type", kind) != kind:
            return False, f"{name} carries {kind}, not {self.wanted['type']}", {}
        if "latched" in self.wanted and bool(self._latched) != self.wanted["latched"]:
            return False, f"{name} is {'' if self._latched else 'not '}latched", {}
        if "rate" in self.wanted:
            return self._rate(name)
        return True, f"{name} is there, {kind}", {}

    def _rate(self, name: str) -> tuple[bool, str, dict[str, Any]]:
        passed_time = self.context.bench.now.time - self._begin
        rate = len(self._arrivals) / passed_time if passed_time > 0 else 0.0
        low, high = self.wanted["rate"]
        return (low <= rate <= high, f"{name} comes at {rate:.4g} Hz of simulated time; {low:g} to {high:g} are asked for", {"rate": rate})


class ServiceCheck(Check):
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
        if self.wanted.get("type", kind) != kind:
            return False, f"{name} is of type {kind}, not {self.wanted['type']}", {}
        return True, f"the service {name} is offered", {}


class ParamCheck(Check):
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


class TfCheck(Check):
    """A transform between two frames; joints of the tree are composed from what /tf and /tf_static brought."""

    horizon = 0.3

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

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        import tf2_ros

        for subscriber in self._subscribers:
            subscriber.unregister()
        source, target = self.wanted["from"], self.wanted["to"]
        try:
            found = self._buffer.lookup_transform_core(source, target, rospy.Time(0)).transform.translation
        except tf2_ros.TransformException as error:
            return False, f"there is no transform from {source} to {target}: {str(error).splitlines()[0]}", {}
        place = [found.x, found.y, found.z]
        if "xyz" in self.wanted:
            off = math.dist(place, self.wanted["xyz"])
            if not off <= self.wanted.get("tolerance", 0.01):
                return False, f"{target} is {off:.4g} m from where it should be in {source}", {"xyz": place}
        return True, f"{target} is known in {source}", {"xyz": place}


class ControllersCheck(Check):
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
            wrong = [f"{name} is {c.type}" for name, c in found.items() if fnmatch.fnmatchcase(name, pattern) and c.type != kind]
            if wrong:
                return False, f"{names(wrong)}, not {kind}", figures
        return True, f"running: {names(running)}", figures

    def _doubt(self, services: list[str]) -> None:
        """A node of the submission that is a controller manager, of a robot of its own say, tells what it likes."""
        owners = {node for service, nodes in master().getSystemState()[2] if service in services for node in nodes}
        for node in sorted(owners):
            if master().lookupNode(node) != self.context.bench.simulator:
                self.doubts.add(f"a controller manager that was asked is the node {node}'s, not the simulator's: it tells what it likes")


class NoErrorsCheck(Check):
    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        ignored = self.wanted.get("ignore", [])
        lines = [line for line in error_lines(self.context.log()) if not any(search(pattern, line) for pattern in ignored)]
        if lines:
            return False, f"{len(lines)} error lines, the first: {timeless(lines[0])[:200]}", {}
        return True, "nothing was reported as an error", {}


class ExitCheck(Check):
    """How a program of the task's ``run`` ended, or that it goes on; what it printed."""

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self.horizon = wanted.get("within", 2.0) if "code" in wanted or wanted.get("refused") else 0.0

    @property
    def settled(self) -> bool:
        program = self.context.actor.runs.get(self.wanted["run"])
        return program is None or not program.running

    @settled.setter
    def settled(self, value: bool) -> None:
        del value

    def sample(self, sample: Sample) -> None:
        del sample

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        program = self.context.actor.runs.get(self.wanted["run"])
        if program is None:
            return False, "the program was not started", {}
        if "code" in self.wanted or self.wanted.get("refused"):
            self.context.bench.leave(program)
        said = program.output.text()
        last = timeless(next((line for line in reversed(said.splitlines()) if line.strip()), "nothing"))[:160]
        if program.broke:
            return False, f"the program was ended: {program.broke}", {}
        if "Couldn't find executable" in said or "[rosrun]" in said:
            return False, f"the program could not be started: {last}", {}
        if self.wanted.get("refused"):
            taken = self._taken(program, said, last)
            if taken:
                return False, taken, {}
        if "code" in self.wanted and program.code != self.wanted["code"]:
            how = "still runs" if program.running else f"ended with code {program.code}"
            return False, f"the program {how}; it should end with {self.wanted['code']} (it last printed: {last})", {}
        if "says" in self.wanted and not search(self.wanted["says"], said):
            return False, f"the program printed nothing like '{self.wanted['says']}'; it last printed: {last}", {}
        if not set(self.wanted) & {"code", "refused", "says"} and not program.running and program.code:
            return False, f"the program ended with code {program.code}: {last}", {}
        return True, "the program did as it should" + (f": {last}" if self.wanted.get("refused") else ""), {}

    def _taken(self, program: Program, said: str, last: str) -> str:
        """Why a wrong argument was not refused; '' when it was: by an exit code that is not 0, or by what the program said.

        Many programs print how they are used and end with 0; one that ends with 0 and says nothing has taken the argument for a good one.
        """
        if program.running:
            return "the program took a wrong argument and went on, instead of refusing it"
        if crashed(program.code, said):
            return f"the program crashed on a wrong argument instead of refusing it: {last}"
        if program.code == 0 and not (search(self.wanted["says"], said) if "says" in self.wanted else refusal(said)):
            return (
                "the program took a wrong argument: it ended with code 0 and did not say what is wrong with it, nor how it is used "
                f"(it last printed: {last})"
            )
        return ""


class AnswerCheck(Check):
    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        key = self.wanted["call"]
        answer = self.context.actor.answers.get(key)
        refusal = self.context.actor.refusals.get(key)
        if refusal is None and isinstance(answer, dict):
            refusal = next((str(answer) for field in ("success", "ok") if answer.get(field) is False), None)
        if self.wanted.get("refused"):
            return (
                refusal is not None,
                (
                    f"refused, as it should be: {refusal}"
                    if refusal is not None
                    else f"this had to be refused, but was taken: {str(answer)[:160]}"
                ),
                {},
            )
        if answer is None:
            return False, f"no answer came: {refusal or 'nothing was asked'}", {}
        wrong = [
            f"{field} is {str(answer.get(field))[:80]}, not {value}"
            for field, value in self.wanted.get("equals", {}).items()
            if answer.get(field) != value
        ]
        if wrong:
            return False, names(wrong), {}
        if refusal is not None and not self.wanted.get("equals"):
            return False, f"refused: {refusal[:160]}", {}
        return True, "answered as it should", {}

"""What a task does to the submission: messages, calls, goals, programs and key strokes."""

from __future__ import annotations

import json
import shlex
import struct
import threading
import time
from collections import Counter
from collections.abc import Callable
from typing import Any

import genpy
import roslib.message
import rospy
from rosservice import ROSServiceException, get_service_class_by_name

from ..errors import LabError
from ..isolation.supervise import Program
from ..specs.spec_messages import MisfitError, filled
from . import connections
from .simulated_world import CONNECTED, Bench

_REFUSED = "responded with an error"  # what rospy says where the service itself said no; else its node has ended, or was not there
_START = 15.0  # s of wall time that a program gets to become a node


class CommandError(LabError, ValueError):
    """A command could not be given; a sentence that says why."""


class Actor:
    """Gives the commands of one task.

    :param start: starts a program of the submission from words for a shell, ``keys``: on a terminal
    """

    def __init__(self, bench: Bench, start: Callable[[str, bool], Program]):
        self._bench, self._start = bench, start
        self.runs: dict[str, Program] = {}
        self.answers: dict[str, Any] = {}  # name -> dict of the response, or a refusal's text
        self.refusals: dict[str, str] = {}
        self.lost: dict[str, str] = {}  # name -> why no answer came
        self.by_hand: list[str] = []
        self.called: Counter = Counter()  # last part of a name -> how often
        self._typed: dict[str, str] = {}  # name of a run -> what started it
        self._publishers: list[rospy.Publisher] = []

    def calls(self, service: str) -> int:
        """How often the task's own commands have called a service of this name, or published to such a topic, since it was last asked."""
        return self.called.pop(service, 0)

    def give(self, command: dict[str, Any]) -> None:
        """Do what ``command``, an entry of the task's list, says. :raises CommandError: nobody is there to take it"""
        ((kind, wanted),) = command.items()
        try:
            getattr(self, f"_{kind}")(wanted)
        except MisfitError as error:
            raise CommandError(str(error)) from error

    def end(self) -> None:
        for program in self.runs.values():
            if program.running:
                program.interrupt()
                program.wait(5.0)
        for publisher in self._publishers:
            publisher.unregister()

    def _wait(self, seconds: float) -> None:
        self.by_hand.append(f"sleep {seconds:g}")
        self._bench.pass_time(seconds)

    def _publish(self, wanted: dict[str, Any]) -> None:
        name = find_topic(wanted["topic"])
        kind = roslib.message.get_message_class(wanted["type"])
        if kind is None:
            raise CommandError(f"message type {wanted['type']} is not known here")
        message = filled(kind(), wanted.get("message", {}), f"the spec's message does not fit {wanted['type']}")
        rate, seconds = wanted.get("rate"), wanted.get("for", 1.0)
        how = f"timeout {seconds:g} rostopic pub -r {rate:g}" if rate else "rostopic pub -1"
        self.by_hand.append(f"{how} {name} {wanted['type']} {shlex.quote(json.dumps(wanted.get('message', {})))}")
        publisher = rospy.Publisher(name, kind, queue_size=10, latch=not rate)
        self._publishers.append(publisher)
        self._bench.connect()
        if not publisher.get_num_connections():
            raise CommandError(f"nobody listens to {name}" + _near(name, "subscribe to"))
        self.called[name.rpartition("/")[2]] += 1 if not rate else 1 << 30
        publisher.publish(message)
        if rate:
            end, due = self._bench.now.time + seconds, self._bench.now.time
            while self._bench.now.time < end - 1e-9:
                if self._bench.now.time >= due - 1e-9:
                    publisher.publish(message)
                    due += 1.0 / rate
                self._bench.tick()
        else:
            self._bench.settle(0.02)

    def _call(self, wanted: dict[str, Any]) -> None:
        name = wanted["service"]
        self.by_hand.append(f"rosservice call {name} {shlex.quote(json.dumps(wanted.get('request', {})))}")
        key = wanted.get("name", "it")
        try:
            kind = get_service_class_by_name(name)
        except (ROSServiceException, rospy.ROSException, OSError, ValueError, TypeError, KeyError, struct.error) as error:
            raise CommandError(f"service {name} cannot be asked: {error}") from error
        if kind is None:
            raise CommandError(f"nobody offers the service {name}")
        request = filled(
            kind._request_class(), wanted.get("request", {}), f"the spec's request does not fit {kind._type}, as which {name} is offered"
        )
        done = threading.Event()

        self.called[name.rpartition("/")[2]] += 1

        def ask() -> None:
            try:
                self.answers[key] = plain(rospy.ServiceProxy(name, kind)(request))
            except (rospy.ServiceException, rospy.ROSException) as error:
                (self.refusals if _REFUSED in str(error) else self.lost)[key] = str(error)
            done.set()

        threading.Thread(target=ask, daemon=True).start()
        self._bench.settle(0.02)
        if not self._bench.until(done.is_set, 10.0):
            raise CommandError(f"service {name} gave no answer within 10 s")

    def _action(self, wanted: dict[str, Any]) -> None:
        import actionlib

        kind = roslib.message.get_message_class(wanted["type"])
        goal_kind = roslib.message.get_message_class(wanted["type"][: -len("Action")] + "Goal")
        if kind is None or goal_kind is None:
            raise CommandError(f"action type {wanted['type']} is not known here")
        goal = filled(goal_kind(), wanted["goal"], f"the spec's goal does not fit {wanted['type'][: -len('Action')]}Goal")
        name, key = wanted["topic"], wanted.get("name", "it")
        self.by_hand.append(f"rostopic pub -1 {name}/goal {wanted['type']}Goal {shlex.quote(json.dumps({'goal': wanted['goal']}))}")
        client = actionlib.SimpleActionClient(name, kind)
        self._bench.settle(0.3)
        if not client.wait_for_server(rospy.Duration(5.0)):
            raise CommandError(f"nobody serves the action {name}")
        client.send_goal(goal)
        self._bench.settle(0.02)
        within = wanted.get("within", 30.0)
        if not self._bench.until(lambda: client.get_state() >= 2, within):
            client.cancel_goal()
            raise CommandError(f"the action {name} was not done within {within:g} s")
        names = {2: "preempted", 3: "succeeded", 4: "aborted", 5: "rejected", 8: "recalled", 9: "lost"}
        state = names.get(client.get_state(), str(client.get_state()))
        self.answers[key] = {"state": state, "result": plain(client.get_result()), "text": client.get_goal_status_text()}
        if state in ("aborted", "rejected"):
            self.refusals[key] = client.get_goal_status_text() or state

    def _run(self, wanted: dict[str, Any]) -> None:
        key = wanted.get("name", "it")
        self._typed[key] = f"rosrun {wanted['command']}"
        self.by_hand.append(self._typed[key] + (f"   # then type {json.dumps(wanted['keys'])}" if "keys" in wanted else ""))
        before = connections.nodes()
        program = self.runs[key] = self._start(f"exec rosrun {wanted['command']}", "keys" in wanted)
        self._wait_for_node(program, before)
        for stroke in wanted.get("keys", ""):
            program.write(stroke)
            self._bench.pass_time(wanted.get("every", 0.2))
        if "wait" in wanted:
            self._bench.until(lambda: not program.running, wanted["wait"])

    def _wait_for_node(self, program: Program, before: set[str]) -> None:
        """Simulated time stands still until the program is a node that is connected, or has ended."""
        end = time.monotonic() + _START
        while program.running and time.monotonic() < end and not connections.nodes() - before:
            self._bench.alive()
            time.sleep(0.02)
        self._bench.settle(0.1)
        self._bench.connect()

    def _stop(self, name: str) -> None:
        program = self.runs.get(name)
        if program is None:
            raise CommandError(f"no run is named '{name}'")
        self.by_hand.append(f"# Ctrl-C in the terminal of {self._typed[name]}")
        program.interrupt()
        self._bench.settle(CONNECTED)


def find_topic(pattern: str) -> str:
    """``pattern``, a name, as it is; with ``*`` in it the one topic of the graph that fits; ``command of JOINT`` is the topic by which the
    running controller of that joint takes commands, whatever it was called.

    :raises CommandError: none or several fit
    """
    if pattern.startswith("command of "):
        return _command_of(pattern[len("command of ") :])
    if "*" not in pattern:
        return pattern
    import fnmatch

    import rosgraph

    published, subscribed, _ = rosgraph.Master("/lab_check").getSystemState()
    names = sorted({name for name, _ in published + subscribed if fnmatch.fnmatchcase(name, pattern)})
    if len(names) != 1:
        raise CommandError(
            f"{'several topics fit' if names else 'no topic fits'} {pattern}" + (f": {', '.join(names[:6])}" if names else "")
        )
    return names[0]


def _command_of(joint: str) -> str:
    import rosgraph
    from controller_manager_msgs.srv import ListControllers

    services = [
        name for name, _ in rosgraph.Master("/lab_check").getSystemState()[2] if name.endswith("/controller_manager/list_controllers")
    ]
    holders = []
    for service in sorted(services):
        try:
            found = rospy.ServiceProxy(service, ListControllers)().controller
        except (rospy.ServiceException, rospy.ROSException) as error:
            raise CommandError(f"the controller manager does not answer: {error}") from error
        base = service[: -len("controller_manager/list_controllers")]
        holders += [
            f"{base}{c.name}/command"
            for c in found
            if c.state == "running" and any(joint in claimed.resources for claimed in c.claimed_resources)
        ]
    if len(holders) != 1:
        raise CommandError(f"{'several running controllers claim' if holders else 'no running controller claims'} the joint {joint}")
    return holders[0]


def _near(name: str, what: str) -> str:
    import difflib

    import rosgraph

    _, subscribed, _ = rosgraph.Master("/lab_check").getSystemState()
    close = difflib.get_close_matches(name, [topic for topic, _ in subscribed], 3, 0.5)
    return f"; your nodes {what} {', '.join(close)}" if close else ""


def plain(message: Any) -> Any:
    """A message as dicts, lists and numbers."""
    if isinstance(message, genpy.Message):
        return {slot: plain(getattr(message, slot)) for slot in message.__slots__}
    if isinstance(message, (genpy.Time, genpy.Duration)):
        return message.to_sec()
    if isinstance(message, (list, tuple)):
        return [plain(item) for item in message]
    return message.decode("latin-1") if isinstance(message, bytes) else message

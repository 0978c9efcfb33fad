"""``dynamic_bridge``, ``parameter_bridge`` and ``static_bridge``."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Callable
from functools import partial
from typing import Any

import rosgraph
import rosmsg
import rospkg
import rospy
import rosservice

from ros1_bridge.errors import BridgeError, Ros2Missing
from ros1_bridge.link import HINT, Link, prefix
from ros1_bridge.pairs import Pairs, service_class
from ros1_bridge.services import ActionOfRos1, ActionOfRos2, Calls, ServiceOfRos1, ServiceOfRos2, actions_of_ros1, of_an_action
from ros1_bridge.settings import Options, SettingError, allowed, entries, options, quality
from ros1_bridge.topics import ToRos1, ToRos2
from ros1_bridge.types import candidates

PAUSE = 0.5  # s between looks at ROS 1's graph
NOT_BRIDGED = ("/rosout_agg", "/rosout", "/parameter_events")  # each side's own; bridge_all would carry a line round and round
OWN_SERVICES = ("/get_loggers", "/set_logger_level")  # every node's own
OF_EVERY_NODE = ("rcl_interfaces/", "type_description_interfaces/", "lifecycle_msgs/")


class Bridge:
    """Both graphs, and what is bridged between them."""

    def __init__(self) -> None:
        self._own = rospy.get_name()
        self.to_ros2: dict[str, ToRos2] = {}
        self.to_ros1: dict[str, ToRos1] = {}
        self.of_ros1: dict[str, Any] = {}  # services
        self.of_ros2: dict[str, Any] = {}
        self.actions_of_ros1: dict[str, ActionOfRos1] = {}
        self.actions_of_ros2: dict[str, ActionOfRos2] = {}
        self.graph: dict[str, Any] = {"topics": {}, "services": {}, "actions": {}}
        self.changed, self.failed = threading.Event(), False
        self.link = Link(self._heard, self._lost)
        self.pairs = Pairs(self.link.describe, lambda line: rospy.logwarn("%s", line))
        self.calls = Calls(self.link)

    # ------------------------------------------------------------------------------------------ what ROS 2 tells

    def _heard(self, word: str, *words: Any) -> None:
        try:
            getattr(self, "on_" + word)(*words)
        except Exception as error:  # one thing that goes wrong ends none of the others
            rospy.logwarn("%s from ROS 2: %s", word, " ".join(str(error).split())[:200] or type(error).__name__)

    def _lost(self) -> None:
        if not rospy.is_shutdown():
            self.failed = True
            rospy.logfatal("the process of ROS 2 has ended; its own words are above")
            rospy.signal_shutdown("ROS 2 has ended")

    def on_graph(self, graph: dict[str, Any], _: Any) -> None:
        self.graph = graph
        self.changed.set()

    def on_message(self, topic: str, data: Any) -> None:
        """``data`` came on ``topic`` in ROS 2. The link calls this and the methods below, by the word that the other side tells."""
        found = self.to_ros1.get(topic)
        if found is not None:
            found.message(data)

    def on_matched(self, topic: str, count: int, _: Any) -> None:
        """``topic``, published in ROS 2, has ``count`` subscribers there now."""
        found = self.to_ros2.get(topic)
        if found is not None:
            found.matched(count)

    def on_unequal(self, topic: str, policy: str, words: dict[str, Any] | None, _: Any) -> None:
        """A subscriber or publisher in ROS 2 asks for another ``policy`` than that of ``topic``.

        :param words: the quality of service that we publish with; None: it is a topic that we read
        """
        if words is not None and topic in self.to_ros2:
            self.to_ros2[topic].unequal(policy, words)
        elif words is None and topic in self.to_ros1:
            self.to_ros1[topic].unequal(policy)

    def on_failed(self, words: list[Any], line: str, trace: str, _: Any) -> None:
        """The order ``words`` failed in ROS 2: ``line`` says it to people, ``trace`` to developers."""
        rospy.logdebug("%s", trace)
        self.pairs.once(f"{' '.join(map(str, words))} in ROS 2: {line}")

    def on_call(self, number: int, name: str, data: Any) -> None:
        """A client in ROS 2 calls the service ``name`` with the request ``data``; ``number`` is the call's."""
        found = self.of_ros1.get(name)
        if found is not None:
            found.call(number, data)

    def on_done(self, number: int, error: str | None, data: Any) -> None:
        """The call ``number`` of a service in ROS 2 has ended, with the response ``data`` or with ``error``."""
        self.calls.done(number, error, data)

    def on_goal(self, number: int, name: str, data: Any) -> None:
        """A client in ROS 2 sends the goal ``data`` to the action ``name``; ``number`` is the goal's."""
        found = self.actions_of_ros1.get(name)
        if found is None:
            self.link.tell("result", number, "aborted")
        else:
            found.send(number, data)

    def on_cancel(self, number: int, _: Any) -> None:
        any(one.cancel(number) for one in list(self.actions_of_ros1.values()))

    def on_progress(self, number: int, data: Any) -> None:
        """``data`` is feedback for the goal ``number``, which is in ROS 2."""
        any(one.progress(number, data) for one in list(self.actions_of_ros2.values()))

    def on_end(self, number: int, status: str, data: Any) -> None:
        """The goal ``number``, which was in ROS 2, has ended with ``status`` and the result ``data``."""
        any(one.end(number, status, data) for one in list(self.actions_of_ros2.values()))

    # ------------------------------------------------------------------------------------------ all that both know

    def follow(self, chosen: Options) -> None:
        """Until the node ends: bridges come and go with what they join."""
        master = rosgraph.Master(rospy.get_name())
        while not rospy.is_shutdown():
            try:
                state, types = master.getSystemState(), dict(master.getTopicTypes())
            except (rosgraph.MasterException, OSError):  # it is away; it may come back
                self.changed.wait(PAUSE)
                continue
            published, subscribed, services = ({name: [n for n in nodes if n != self._own] for name, nodes in part} for part in state)
            published, subscribed, services = (
                {name: nodes for name, nodes in part.items() if nodes} for part in (published, subscribed, services)
            )
            if chosen.introspection:
                self._show(published, subscribed, types)
            self._topics(chosen, published, subscribed, types)
            self._services(chosen, services)
            self._actions(chosen, published, types)
            self.changed.wait(PAUSE)
            self.changed.clear()

    def _show(self, published: dict[str, Any], subscribed: dict[str, Any], types: dict[str, str]) -> None:
        for what, part in (("publishers", published), ("subscribers", subscribed)):
            print(f"> Current ROS 1 {what}:", *(f"  - '{types.get(name, '*')}' for '{name}'" for name in sorted(part)), sep="\n")
        for what in ("publishers", "subscribers"):
            lines = (f"  - '{', '.join(seen['types'])}' for '{name}'" for name, seen in sorted(self.graph["topics"].items()) if seen[what])
            print(f"> Current ROS 2 {what}:", *lines, sep="\n", flush=True)

    def _topics(self, chosen: Options, published: dict[str, Any], subscribed: dict[str, Any], types: dict[str, str]) -> None:
        there = self.graph["topics"]
        for name in sorted({*published, *subscribed, *there}):
            if name in NOT_BRIDGED or not allowed(name, chosen.topic_whitelist) or of_an_action(name, types.get(name, "")):
                continue
            seen = there.get(name, {"types": [], "publishers": 0, "subscribers": 0})
            forward = name in published and bool(chosen.all_1to2 or seen["subscribers"])
            back = bool(seen["publishers"]) and bool(chosen.all_2to1 or name in subscribed)
            one = types.get(name, "*") if name in published or name in subscribed else "*"
            two = seen["types"][0] if seen["types"] else None
            if one == "*" and two is not None and back:
                one = self.pairs.of_ros2("msg", two) or "*"
            pair: Any = self.pairs.message(one, two) if one != "*" and (forward or back) else None
            if _stale(self.to_ros2, name, forward and pair):
                self.to_ros2[name] = ToRos2(name, pair, self.link, self.pairs)
            if _stale(self.to_ros1, name, back and pair):
                self.to_ros1[name] = ToRos1(name, pair, self.link, self.pairs, seen)
            if name in self.to_ros1:
                self.to_ros1[name].look(seen)
        for kept in (self.to_ros2, self.to_ros1):
            for name in set(kept) - {*published, *subscribed, *there}:
                kept.pop(name).close()

    def _services(self, chosen: Options, services: dict[str, Any]) -> None:
        there = {name: kind for name, kind in self.graph["services"].items() if not kind.startswith(OF_EVERY_NODE)}
        for name in set(self.of_ros1) - set(services):
            self.of_ros1.pop(name).close()
        for name in set(self.of_ros2) - set(there):
            self.of_ros2.pop(name).close()
        for name in sorted(set(services) - set(there) - set(self.of_ros1)):
            if name.endswith(OWN_SERVICES) or not allowed(name, chosen.service_whitelist):
                continue
            kind = _type_of_service(name)
            found = self.pairs.service(kind) if kind else None
            if found:
                self.of_ros1[name] = ServiceOfRos1(name, str(kind), found, self.link)
        for name in sorted(set(there) - set(services) - set(self.of_ros2)):
            if allowed(name, chosen.service_whitelist):
                one = self.pairs.of_ros2("srv", there[name])
                found = self.pairs.service(one, there[name]) if one else None
                if found:
                    self.of_ros2[name] = ServiceOfRos2(name, str(one), found, self.calls)

    def _actions(self, chosen: Options, published: dict[str, Any], types: dict[str, str]) -> None:
        ours = actions_of_ros1(published, types, self._own)
        theirs = self.graph["actions"]
        for name in set(self.actions_of_ros1) - set(ours):
            self.actions_of_ros1.pop(name).close()
        for name in set(self.actions_of_ros2) - set(theirs):
            self.actions_of_ros2.pop(name).close()
        for name in sorted(set(ours) - set(theirs) - set(self.actions_of_ros1)):
            found = self.pairs.action(ours[name]) if allowed(name, chosen.action_whitelist) else None
            if found:
                self.actions_of_ros1[name] = ActionOfRos1(name, ours[name], found, self.link)
        for name in sorted(set(theirs) - set(ours) - set(self.actions_of_ros2)):
            one = self.pairs.of_ros2("action", theirs[name]) if allowed(name, chosen.action_whitelist) else None
            found = self.pairs.action(one, theirs[name]) if one else None
            if found:
                self.actions_of_ros2[name] = ActionOfRos2(name, str(one), found, self.link)

    # ------------------------------------------------------------------------------------------ what parameters name

    def named(self, topics: Any, services_1_to_2: Any, services_2_to_1: Any, names: tuple[str, str, str]) -> None:
        """``parameter_bridge``: each of ``topics`` in both directions, and the services, each by an entry of its parameter.

        :param services_1_to_2, services_2_to_1: entries, by where calls come from and go to
        :param names: of the three parameters, for messages
        """

        def warn(line: str, about: str = "") -> None:
            rospy.logwarn("%s%s", about, line)

        for entry in entries(names[0], topics, "topic", warn):
            name, one = rospy.resolve_name(entry["topic"]), self.pairs.of_ros2("msg", entry["type"])
            pair = self.pairs.message(one, entry["type"]) if one else None
            if pair is None:
                continue
            words = quality(entry["qos"], partial(warn, about=f"{name}: ")) if "qos" in entry else None
            self.to_ros2[name] = ToRos2(name, pair, self.link, self.pairs, words, entry["queue_size"])
            self.to_ros1[name] = ToRos1(name, pair, self.link, self.pairs, {}, words or self.to_ros2[name].words, entry["queue_size"])
        # By where calls come from and go to: what is named in services_1_to_2 is a server of ROS 2, with its type of ROS 2.
        patience = rospy.get_param("ros1_bridge/parameter_bridge/service_execution_timeout", 5)
        for entry in entries(names[1], services_1_to_2, "service", warn):
            name, one = rospy.resolve_name(entry["service"]), self.pairs.of_ros2("srv", entry["type"])
            found = self.pairs.service(one, entry["type"]) if one else None
            if found:
                self.of_ros2[name] = ServiceOfRos2(name, str(one), found, self.calls, float(patience))
        for entry in entries(names[2], services_2_to_1, "service", warn):
            name, one = rospy.resolve_name(entry["service"]), entry["type"]
            if service_class(one) is None:  # of ROS 2, though it should be of ROS 1
                one = self.pairs.of_ros2("srv", one) or one
            found = self.pairs.service(one)
            if found:
                self.of_ros1[name] = ServiceOfRos1(name, one, found, self.link)

    def print_pairs(self) -> None:
        known = {f"{one.split('/')[0]}/{one.rpartition('/')[2]}": one.split("/")[1] for one in self.link.ask("known")}
        rospack = rospkg.RosPack()
        for mode, form, what in ((rosmsg.MODE_MSG, "msg", "message"), (rosmsg.MODE_SRV, "srv", "service")):
            print(f"Supported ROS 2 <=> ROS 1 {what} type conversion pairs:")
            for package, path in sorted(rosmsg.iterate_packages(rospack, mode)):
                for short in rosmsg._list_types(path, form, mode):
                    one = f"{package}/{short}"
                    if not any(two in known for two in candidates(one)):
                        continue
                    found: Any = self.pairs.message(one) if form == "msg" else self.pairs.service(one)
                    if found:
                        two = found.ros2 if form == "msg" else found[0]
                        print(f"  - '{two.replace('/', f'/{form}/')}' (ROS 2) <=> '{one}' (ROS 1)", flush=True)


def _stale(kept: dict[str, Any], name: str, pair: Any) -> bool:
    """Whether a bridge for ``pair`` has to be made; one for another is closed."""
    old = kept.get(name)
    if old is not None and (not pair or old.pair is not pair):
        kept.pop(name).close()
    return bool(pair) and name not in kept


def _type_of_service(name: str) -> str | None:
    try:
        return rosservice.get_service_type(name)
    except Exception:  # a server that is going, of another language, behind a wall
        return None


def run(work: Callable[[Bridge], None]) -> int:
    if prefix() is None:
        print(f"ros1_bridge: {HINT}", file=sys.stderr)
        return 1
    rospy.init_node("ros_bridge")
    try:
        bridge = Bridge()
    except Ros2Missing as error:
        rospy.logfatal("%s", error)
        return 1
    signal.signal(signal.SIGTERM, lambda *_: rospy.signal_shutdown("SIGTERM"))
    rospy.on_shutdown(bridge.link.close)
    try:
        work(bridge)
    except BridgeError as error:
        if not rospy.is_shutdown():
            rospy.logfatal("%s", error)
            return 1
    return int(bridge.failed)


def dynamic_bridge() -> int:
    words = rospy.myargv()[1:]
    try:
        options(words, lambda name, default: default)  # -h and what is misspelt, before anything starts
        return run(lambda bridge: _dynamic(bridge, options(words, lambda name, default: rospy.get_param("~" + name, default))))
    except SettingError as error:
        print(f"ros1_bridge: {error}", file=sys.stderr)
        return 1


def _dynamic(bridge: Bridge, chosen: Options) -> None:
    if chosen.print_pairs:
        bridge.print_pairs()
    else:
        bridge.follow(chosen)


def parameter_bridge() -> int:
    import argparse

    parser = argparse.ArgumentParser(prog="parameter_bridge", description="Bridge the topics and services that parameters name.")
    for option, name in (("--topics", "topics"), ("--services-1-to-2", "services_1_to_2"), ("--services-2-to-1", "services_2_to_1")):
        parser.add_argument(option, default=name, help=f"the parameter that holds them (default: {name})")
    parser.add_argument("--multi-threads", action="store_true", help="taken for upstream's sake")
    parser.add_argument("names", nargs="*", help="the three parameters, as upstream took them before")
    read = parser.parse_args(rospy.myargv()[1:])
    names = tuple([*read.names, *(read.topics, read.services_1_to_2, read.services_2_to_1)[len(read.names) :]][:3])

    def work(bridge: Bridge) -> None:
        values = [rospy.get_param(name, [] if index else None) for index, name in enumerate(names)]
        bridge.named(values[0], values[1], values[2], names)
        rospy.spin()

    return run(work)


def static_bridge() -> int:
    def work(bridge: Bridge) -> None:
        bridge.named([{"topic": "chatter", "type": "std_msgs/msg/String", "queue_size": 10}], [], [], ("topics", "", ""))
        rospy.spin()

    return run(work)

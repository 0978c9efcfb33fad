"""``dynamic_bridge``, ``parameter_bridge`` and ``static_bridge``."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

import node_signals
import rosgraph
import rosmsg
import rospkg
import rospy
from rosbridge_library.internal.service_types import types_of

from ros1_bridge.errors import BridgeError, Ros2Missing
from ros1_bridge.line import one_line
from ros1_bridge.link import HINT, Link, prefix
from ros1_bridge.pairs import Match, Pairs, service_class
from ros1_bridge.services import ActionOfRos1, ActionOfRos2, ServiceOfRos1, ServiceOfRos2, actions_of_ros1, of_an_action
from ros1_bridge.settings import Options, SettingError, allowed, entries, options, quality
from ros1_bridge.topics import ToRos1, ToRos2
from ros1_bridge.types import candidates

PAUSE = 0.5  # s between looks at ROS 1's graph
NOT_BRIDGED = ("/rosout_agg", "/rosout", "/parameter_events")  # each side's own; bridge_all would carry a line round and round
OWN_SERVICES = ("/get_loggers", "/set_logger_level")  # every node's own
OF_EVERY_NODE = ("rcl_interfaces/", "type_description_interfaces/", "lifecycle_msgs/")
Names = Iterable[str]
#: What is bridged, by what the other side calls it.
KINDS: dict[str, type[Any]] = {
    "to_ros1": ToRos1,
    "to_ros2": ToRos2,
    "services_of_ros1": ServiceOfRos1,
    "services_of_ros2": ServiceOfRos2,
    "actions_of_ros1": ActionOfRos1,
    "actions_of_ros2": ActionOfRos2,
}


class Bridge:
    """Both graphs, and what is bridged between them."""

    def __init__(self) -> None:
        self._own = rospy.get_name()
        self.kept: dict[str, dict[str, Any]] = {kind: {} for kind in KINDS}
        self.graph: dict[str, Any] = {"topics": {}, "services": {}, "actions": {}}
        self.changed, self.failed = threading.Event(), False
        self.link = Link(self._heard, self._lost)
        self.pairs = Pairs(partial(self.link.question, "describe"), lambda line: rospy.logwarn("%s", line))

    # ------------------------------------------------------------------------------------------ what ROS 2 tells

    def _heard(self, kind: str, name: str, word: str, *words: Any) -> None:
        """Call the method ``word`` of what is kept as ``kind`` by ``name``; without a kind it is one of this class."""
        found = self.kept[kind].get(name) if kind else self
        try:
            if found is not None:
                getattr(found, word)(*words)
            elif word == "call":
                raise BridgeError(f"{name} of ROS 1 has gone")
        except Exception as error:  # one thing that goes wrong ends none of the others
            rospy.logwarn("%s from ROS 2: %s", word, one_line(error))
            if word == "call":
                self.link.answer(words[0], one_line(error))

    def _lost(self) -> None:
        if not rospy.is_shutdown():
            self.failed = True
            rospy.logfatal("the process of ROS 2 has ended; its own words are above")
            rospy.signal_shutdown("ROS 2 has ended")

    def seen(self, graph: dict[str, Any], _: Any) -> None:
        self.graph = graph
        self.changed.set()

    def refused(self, words: list[Any], line: str, trace: str, _: Any) -> None:
        """The order ``words`` failed in ROS 2: ``line`` says it to people, ``trace`` to developers."""
        rospy.logdebug("%s", trace)
        self.pairs.once(f"{' '.join(map(str, words))} in ROS 2: {line}")

    def keep(self, kind: str, name: str, match: Match, *more: Any) -> None:
        """Bridge ``name`` as ``kind``, with the types ``match`` and what its class takes ``more``.

        It is opened when it can be found: the other side may answer at once.
        """
        bridged = self.kept[kind][name] = KINDS[kind](name, match, self.link, self.pairs, *more)
        bridged.open()

    # ------------------------------------------------------------------------------------------ all that both know

    def dynamic(self, chosen: Options) -> None:
        """Until the node ends: bridges come and go with what they join. Or the pairs of types are printed, if that is ``chosen``."""
        if chosen.print_pairs:
            self.print_pairs()
            return
        master = rosgraph.Master(rospy.get_name())
        while not rospy.is_shutdown():
            try:
                state, types = master.getSystemState(), dict(master.getTopicTypes())
            except (rosgraph.MasterException, OSError):  # it is away; it may come back
                self.changed.wait(PAUSE)
                continue
            published, subscribed, services = (
                {name: others for name, nodes in part if (others := [node for node in nodes if node != self._own])} for part in state
            )
            if chosen.introspection:
                self._show(published, subscribed, types)
            self._topics(chosen, published, subscribed, types)
            of_ros2 = {name: kind for name, kind in self.graph["services"].items() if not kind.startswith(OF_EVERY_NODE)}
            allow = chosen.service_whitelist
            self._offer("services_of_ros1", services, of_ros2, allow, self._of_services(services, of_ros2, allow))
            self._offer("services_of_ros2", of_ros2, services, allow, lambda name: self.pairs.counterpart("srv", of_ros2[name]))
            ours, theirs, allow = actions_of_ros1(published, types, self._own), self.graph["actions"], chosen.action_whitelist
            self._offer("actions_of_ros1", ours, theirs, allow, lambda name: self.pairs.find("action", ours[name]))
            self._offer("actions_of_ros2", theirs, ours, allow, lambda name: self.pairs.counterpart("action", theirs[name]))
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
            match = self.pairs.find("msg", one, two) if one != "*" and (forward or back) else None
            self._renew("to_ros2", name, match if forward else None)
            self._renew("to_ros1", name, match if back else None, seen)
            if name in self.kept["to_ros1"]:
                self.kept["to_ros1"][name].look(seen)
        for kind in ("to_ros2", "to_ros1"):
            for name in set(self.kept[kind]) - {*published, *subscribed, *there}:
                self.kept[kind].pop(name).close()

    def _renew(self, kind: str, name: str, match: Match | None, *more: Any) -> None:
        """Close a bridge for another match, and keep one for ``match``."""
        old = self.kept[kind].get(name)
        if old is not None and old.match is not match:
            self.kept[kind].pop(name).close()
        if match is not None and name not in self.kept[kind]:
            self.keep(kind, name, match, *more)

    def _offer(self, kind: str, here: Names, there: Names, allow: tuple[str, ...], find: Callable[[str], Match | None]) -> None:
        """Have of ``kind`` what is ``here``, was not ``there`` when it came and fits ``allow``; ``find`` gives types by name."""
        kept = self.kept[kind]
        for name in set(kept) - set(here):
            kept.pop(name).close()
        for name in sorted(set(here) - set(there) - set(kept)):
            match = find(name) if allowed(name, allow) else None
            if match is not None:
                self.keep(kind, name, match)

    def _of_services(self, names: Names, there: Names, allow: tuple[str, ...]) -> Callable[[str], Match | None]:
        """Gives the types of those services ``names`` of ROS 1 that are new; their servers are asked at the same time, as some may hang."""
        new = set(names) - set(there) - set(self.kept["services_of_ros1"])
        kinds = types_of(name for name in new if allowed(name, allow) and not name.endswith(OWN_SERVICES))
        return lambda name: self.pairs.find("srv", kinds[name]) if name in kinds else None

    # ------------------------------------------------------------------------------------------ what parameters name

    def named(self, topics: Any, services_1_to_2: Any, services_2_to_1: Any, names: tuple[str, str, str]) -> None:
        """``parameter_bridge``, until the node ends: each of ``topics`` both ways, and the services, each by an entry of its parameter.

        :param services_1_to_2, services_2_to_1: entries, by where calls come from and go to
        :param names: of the three parameters, for messages
        """

        def warn(line: str, about: str = "") -> None:
            rospy.logwarn("%s%s", about, line)

        for entry in entries(names[0], topics, "topic", warn):
            name, match = rospy.resolve_name(entry["topic"]), self.pairs.counterpart("msg", entry["type"])
            if match is None:
                continue
            words = quality(entry["qos"], partial(warn, about=f"{name}: ")) if "qos" in entry else None
            self.keep("to_ros2", name, match, words, entry["queue_size"])
            self.keep("to_ros1", name, match, {}, words or self.kept["to_ros2"][name].words, entry["queue_size"])
        # By where calls come from and go to: what is named in services_1_to_2 is a server of ROS 2, with its type of ROS 2.
        self.link.patience = float(rospy.get_param("ros1_bridge/parameter_bridge/service_execution_timeout", 5))
        for entry in entries(names[1], services_1_to_2, "service", warn):
            self._name("services_of_ros2", entry, self.pairs.counterpart("srv", entry["type"]))
        for entry in entries(names[2], services_2_to_1, "service", warn):
            one = entry["type"]
            if service_class(one) is None:  # of ROS 2, though it should be of ROS 1
                one = self.pairs.of_ros2("srv", one) or one
            self._name("services_of_ros1", entry, self.pairs.find("srv", one))
        rospy.spin()

    def _name(self, kind: str, entry: dict[str, Any], match: Match | None) -> None:
        if match is not None:
            self.keep(kind, rospy.resolve_name(entry["service"]), match)

    def print_pairs(self) -> None:
        known = self.link.question("known")
        rospack = rospkg.RosPack()
        for mode, form, what in ((rosmsg.MODE_MSG, "msg", "message"), (rosmsg.MODE_SRV, "srv", "service")):
            print(f"Supported ROS 2 <=> ROS 1 {what} type conversion pairs:")
            for package, path in sorted(rosmsg.iterate_packages(rospack, mode)):
                for short in rosmsg._list_types(path, form, mode):
                    one = f"{package}/{short}"
                    match = self.pairs.find(form, one) if known.intersection(candidates(one)) else None
                    if match is not None:
                        print(f"  - '{match.ros2.replace('/', f'/{form}/')}' (ROS 2) <=> '{one}' (ROS 1)", flush=True)


def run(work: Callable[[Bridge], None]) -> int:
    if prefix() is None:
        print(f"ros1_bridge: {HINT}", file=sys.stderr)
        return 1
    node_signals.init_node("ros_bridge")
    try:
        bridge = Bridge()
    except Ros2Missing as error:
        rospy.logfatal("%s", error)
        return 1
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
        return run(lambda bridge: bridge.dynamic(options(words, lambda name, default: rospy.get_param("~" + name, default))))
    except SettingError as error:
        print(f"ros1_bridge: {error}", file=sys.stderr)
        return 1


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

    return run(work)


def static_bridge() -> int:
    chatter = {"topic": "chatter", "type": "std_msgs/msg/String", "queue_size": 10}
    return run(lambda bridge: bridge.named([chatter], [], [], ("topics", "", "")))

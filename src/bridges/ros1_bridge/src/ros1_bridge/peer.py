"""The side of ROS 2: a process that knows nothing of ROS 1, run by the Python that ``scripts/setup --ros2`` installed.

``python peer.py DESCRIPTOR NAME`` takes orders from a socket and tells what comes (:mod:`ros1_bridge.line`). Messages are the bytes of CDR,
as they are on the wire. What it tells begins with where the other side keeps what it is about ("to_ros1", "services_of_ros2" ...), its name
there and the method to call.

All that rclpy makes is made, used and destroyed by the executor's one thread: a second thread would let it see things half made. What waits
for ROS 1 is a coroutine.
"""

from __future__ import annotations

import importlib
import sys
import threading
import time
import traceback
from collections import deque
from collections.abc import Callable
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import rclpy
from line import PARTS, Line, one_line
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.action.graph import get_action_server_names_and_types_by_node as actions_of
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.exceptions import InvalidHandle
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, HistoryPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message, serialize_message
from rclpy.task import Future

LOOK = 0.25  # s between looks at the graph
FOUND = 10.0  # s until a server that the graph has shown must be connected
#: Orders that the thread of the line carries out: they make nothing of rclpy's, and a publisher may publish in any thread.
AT_ONCE = ("publish", "describe", "known")


def kind_of(name: str, form: str) -> Any:
    """The class of ``name``, ``package/Name``, which is by ``form`` a "msg", "srv" or "action"; None where it is not here."""
    package, _, short = name.partition("/")
    try:
        kind = getattr(importlib.import_module(f"{package}.{form}"), short)
        kind.__class__.__import_type_support__()
        return kind
    except Exception:  # no such package, no such name, a package that was built for another version
        return None


def short_name(name: str) -> str:
    """package/msg/Name as package/Name"""
    package, _, rest = name.partition("/")
    return f"{package}/{rest.rpartition('/')[2]}"


def fields(kind: Any, found: dict[str, dict[str, str]], name: str) -> None:
    """All types that ``kind``, called ``name``, consists of, into ``found``."""
    found[name] = kind.get_fields_and_field_types()
    for inner in found[name].values():
        inner = inner.removeprefix("sequence<").partition(",")[0].rstrip(">").partition("[")[0]
        if "/" in inner and inner not in found:
            nested = kind_of(inner, "msg")
            if nested is not None:
                fields(nested, found, inner)


def profile(words: dict[str, Any]) -> QoSProfile:
    spans = ("deadline", "lifespan", "liveliness_lease_duration")
    return QoSProfile(
        depth=words.get("depth", 10),
        history=HistoryPolicy[words.get("history", "keep_last").upper()],
        reliability=ReliabilityPolicy[words.get("reliability", "reliable").upper()],
        durability=DurabilityPolicy[words.get("durability", "volatile").upper()],
        liveliness=LivelinessPolicy(words.get("liveliness", 0)),
        **{name: Duration(nanoseconds=words[name]) for name in spans if name in words},
    )


def policy(info: Any) -> str:
    """What does not fit: DURABILITY, RELIABILITY ..."""
    return info.last_policy_kind.name.upper().rpartition("POLICY_")[2]


class Peer:
    def __init__(self, connection: Connection, name: str) -> None:
        self._line = Line(connection)
        self.tell = self._line.tell
        rclpy.init(args=["ros1_bridge", "--ros-args", "--log-level", "ERROR"])
        self.node = rclpy.create_node(name, start_parameter_services=False, enable_rosout=False)
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)
        self._orders: deque[tuple[Any, ...]] = deque()  # that the executor has not carried out yet
        self._made: dict[tuple[str, str], Any] = {}  # publishers, subscribers, servers and clients by what they are and their names
        self._gids: set[bytes] = set()  # of our own publishers
        self._group = ReentrantCallbackGroup()  # an answer that is waited for does not hold up another
        # Goals by the numbers of their questions, of which each side counts its own.
        self._for_ros1: dict[int, tuple[Any, Any]] = {}  # handles and types
        self._for_ros2: dict[int, Any] = {}  # handles; None: no server has answered yet
        self._canceled: set[int] = set()  # of these

    # -------------------------------------------------------------------------------------------- the line

    def listen(self) -> None:
        """Take orders until the line ends. What has been ordered before a message is done before it is published."""
        self._line.listen(self._take)
        rclpy.try_shutdown()

    def _take(self, *order: Any) -> None:
        if order[0] in AT_ONCE and (order[0] != "publish" or not self._orders):
            self._do(order)
        else:
            self._orders.append(order)
            self.executor.create_task(self._work)

    def _work(self) -> None:
        self._do(self._orders[0])
        self._orders.popleft()

    def _do(self, order: tuple[Any, ...]) -> None:
        try:
            getattr(self, "do_" + order[0])(*order[1:])
        except Exception as error:
            self.tell("", "", "refused", order[:2], one_line(error), traceback.format_exc())
            if order[0] in ("call", "send_goal"):
                self._line.answer(order[-2], one_line(error))

    def spin(self) -> None:
        """Until the line or the process ends; what one callback raises ends no other."""
        while rclpy.ok():
            try:
                self.executor.spin()
            except (KeyboardInterrupt, ExternalShutdownException):
                return
            except InvalidHandle:  # an answer for a server that has ended
                pass
            except Exception as error:
                self.tell("", "", "refused", ("a callback",), one_line(error), traceback.format_exc())
                time.sleep(0.05)  # what fails each time does not take a processor

    def _ask(self, kind: str, name: str, data: bytes) -> tuple[int, Future]:
        """Have ``name``, kept as ``kind`` in ROS 1, called with ``data``. Returns the question's number, and what will be its answer."""
        answer = self.executor.create_future()
        number = self._line.ask(lambda _, *said: answer.set_result(said), kind, name, "call", data=data)
        return number, answer

    def do_answer(self, number: int, said: Any, data: Any) -> None:
        """ROS 1's answer to the question ``number``: ``said`` and ``data``. These methods are called by the word that is ordered."""
        self._line.answered(number, said, data)
        self.executor.wake()  # a coroutine is not woken by what it awaits

    # -------------------------------------------------------------------------------------------- what is here

    def do_describe(self, name: str, form: str, number: int, _: Any) -> None:
        """Answer the question ``number`` with the fields of ``name``, by ``form`` a "msg", "srv" or "action"."""
        kind = kind_of(name, form)
        found: dict[str, dict[str, str]] = {}
        for part in PARTS[form] if kind is not None else ():
            fields(getattr(kind, part) if part else kind, found, name + part)
        self._line.answer(number, found)

    def do_known(self, number: int, _: Any) -> None:
        """Answer the question ``number`` with all interfaces that are installed, as package/Name."""
        from ament_index_python.resources import get_resource, get_resources

        listed = ((package, get_resource("rosidl_interfaces", package)[0].split()) for package in get_resources("rosidl_interfaces"))
        self._line.answer(number, {f"{package}/{Path(line).stem}" for package, lines in listed for line in lines})

    def watch(self) -> None:
        before = None
        while rclpy.ok():
            try:
                graph = self._graph()
            except Exception:  # the context ends while it is looked at
                return
            if graph != before:
                self.tell("", "", "seen", graph)
            before = graph
            time.sleep(LOOK)

    def _graph(self) -> dict[str, Any]:
        node = self.node
        topics: dict[str, Any] = {}
        for name, types in node.get_topic_names_and_types():
            if "/_action/" in name or len(types) == 0:
                continue
            publishers = [one for one in node.get_publishers_info_by_topic(name) if one.node_name != node.get_name()]
            subscribers = [one for one in node.get_subscriptions_info_by_topic(name) if one.node_name != node.get_name()]
            if publishers or subscribers:
                topics[name] = {
                    "types": sorted({short_name(one.topic_type) for one in [*publishers, *subscribers]}),
                    "publishers": len(publishers),
                    "subscribers": len(subscribers),
                    "best_effort": any(one.qos_profile.reliability == ReliabilityPolicy.BEST_EFFORT for one in publishers),
                    "latched": bool(publishers)
                    and all(one.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL for one in publishers),
                }
        services: dict[str, str] = {}
        actions: dict[str, str] = {}
        for other, space in node.get_node_names_and_namespaces():
            if other != node.get_name():
                found = node.get_service_names_and_types_by_node(other, space)
                services.update({name: short_name(types[0]) for name, types in found if "/_action/" not in name})
                actions.update({name: short_name(types[0]) for name, types in actions_of(node, other, space)})
        return {"topics": topics, "services": services, "actions": actions}

    # -------------------------------------------------------------------------------------------- topics

    def do_advertise(self, topic: str, type_name: str, words: dict[str, Any], _: Any) -> None:
        """Publish ``topic``, of ``type_name``, with the quality of service ``words``."""
        self.do_forget("publisher", topic, None)
        events = PublisherEventCallbacks(
            matched=lambda info: self.tell("to_ros2", topic, "matched", info.current_count),
            incompatible_qos=lambda info: self.tell("to_ros2", topic, "unequal", policy(info), words),
            use_default_callbacks=False,
        )
        publisher = self.node.create_publisher(kind_of(type_name, "msg"), topic, profile(words), event_callbacks=events)
        self._made["publisher", topic] = publisher
        for info in self.node.get_publishers_info_by_topic(topic):
            if info.node_name == self.node.get_name():
                self._gids.add(bytes(info.endpoint_gid))

    def do_publish(self, topic: str, data: Any) -> None:
        """Publish ``data``, a message as bytes of CDR, on ``topic``."""
        publisher = self._made.get(("publisher", topic))
        if publisher is not None:
            publisher.publish(data)

    def do_subscribe(self, topic: str, type_name: str, words: dict[str, Any], _: Any) -> None:
        """Tell what comes on ``topic``, of ``type_name``, read with the quality of service ``words``."""
        self.do_forget("subscriber", topic, None)

        def take(data: bytes, info: dict[str, Any]) -> None:
            if info["publisher_gid"]["data"] not in self._gids:
                self.tell("to_ros1", topic, "message", data=data)

        events = SubscriptionEventCallbacks(
            incompatible_qos=lambda info: self.tell("to_ros1", topic, "unequal", policy(info)), use_default_callbacks=False
        )
        self._made["subscriber", topic] = self.node.create_subscription(
            kind_of(type_name, "msg"), topic, take, profile(words), raw=True, event_callbacks=events
        )

    def do_forget(self, what: str, name: str, _: Any) -> None:
        """End the publisher, subscriber, server or action_server (``what``) called ``name``."""
        node, made = self.node, self._made.pop((what, name), None)
        ends = {"publisher": node.destroy_publisher, "subscriber": node.destroy_subscription, "server": node.destroy_service}
        if made is not None:
            ends.get(what, ActionServer.destroy)(made)

    # -------------------------------------------------------------------------------------------- services

    def do_serve(self, name: str, type_name: str, _: Any) -> None:
        """The service ``name`` of ROS 1, of ``type_name``, offered here."""
        kind = kind_of(type_name, "srv")

        async def answer(request: Any, response: Any) -> Any:
            error, data = await self._ask("services_of_ros1", name, serialize_message(request))[1]
            return deserialize_message(data, kind.Response) if error is None else response

        self._made["server", name] = self.node.create_service(kind, name, answer, callback_group=self._group)

    def _reached(self, wait: Callable[..., bool], work: Callable[[], Any], missing: Callable[[], Any]) -> None:
        """``work()`` as soon as a client has its server, ``missing()`` when it gets none; the executor goes on meanwhile."""
        if wait(timeout_sec=0.0):
            work()
            return
        find = lambda: self.executor.create_task(work if wait(timeout_sec=FOUND) else missing)
        threading.Thread(target=find, daemon=True).start()

    def do_call(self, name: str, type_name: str, number: int, data: Any) -> None:
        """Answer the question ``number`` with what the service ``name``, of ``type_name``, which is here, says to the request ``data``."""
        kind = kind_of(type_name, "srv")
        if ("client", name) not in self._made:
            self._made["client", name] = self.node.create_client(kind, name)
        client = self._made["client", name]

        def call() -> None:
            client.call_async(deserialize_message(data, kind.Request)).add_done_callback(
                lambda done: self._line.answer(number, None, data=serialize_message(done.result()))
            )

        self._reached(client.wait_for_service, call, lambda: self._line.answer(number, f"no node of ROS 2 offers {name}"))

    # -------------------------------------------------------------------------------------------- actions

    def do_serve_action(self, name: str, type_name: str, _: Any) -> None:
        """The action server ``name`` of ROS 1, of ``type_name``, offered here."""
        kind = kind_of(type_name, "action")

        async def execute(handle: Any) -> Any:
            number, answer = self._ask("actions_of_ros1", name, serialize_message(handle.request))
            self._for_ros1[number] = handle, kind
            if handle.is_cancel_requested:  # before it was handed on
                self.tell("actions_of_ros1", name, "cancel", number)
            status, data = await answer
            del self._for_ros1[number]
            if status == "canceled" and not handle.is_cancel_requested:
                status = "aborted"  # a client of ROS 1 took it over; ROS 2 knows no such end
            {"succeeded": handle.succeed, "canceled": handle.canceled}.get(status, handle.abort)()
            return deserialize_message(data, kind.Result) if data else kind.Result()

        def cancel(handle: Any) -> Any:
            for number, (other, _) in self._for_ros1.items():
                if other is handle:
                    self.tell("actions_of_ros1", name, "cancel", number)
            return CancelResponse.ACCEPT

        self._made["action_server", name] = ActionServer(self.node, kind, name, execute, cancel_callback=cancel)

    def do_feedback(self, number: int, data: Any) -> None:
        """``data`` is ROS 1's feedback for the goal ``number``."""
        if number in self._for_ros1:
            handle, kind = self._for_ros1[number]
            handle.publish_feedback(deserialize_message(data, kind.Feedback))

    def do_send_goal(self, name: str, type_name: str, number: int, data: Any) -> None:
        """Send the goal ``data`` to the action server ``name``, of ``type_name``, that is here; its end is the answer to ``number``."""
        kind = kind_of(type_name, "action")
        if ("action_client", name) not in self._made:
            self._made["action_client", name] = ActionClient(self.node, kind, name)
        client = self._made["action_client", name]
        self._for_ros2[number] = None

        def feedback(message: Any) -> None:
            self.tell("actions_of_ros2", name, "progress", number, data=serialize_message(message.feedback))

        def accepted(future: Any) -> None:
            handle = self._for_ros2[number] = future.result()
            if not handle.accepted:
                end("rejected")
                return
            if number in self._canceled:
                handle.cancel_goal_async()
            handle.get_result_async().add_done_callback(ended)

        def ended(future: Any) -> None:
            answer = future.result()
            end({4: "succeeded", 5: "canceled"}.get(answer.status, "aborted"), serialize_message(answer.result))

        def end(status: str, result: bytes | None = None) -> None:
            del self._for_ros2[number]
            self._canceled.discard(number)
            self._line.answer(number, status, data=result)

        def send() -> None:
            goal = deserialize_message(data, kind.Goal)
            client.send_goal_async(goal, feedback_callback=feedback).add_done_callback(accepted)

        self._reached(client.wait_for_server, send, lambda: end("rejected"))

    def do_cancel_goal(self, number: int, _: Any) -> None:
        handle = self._for_ros2.get(number)
        if handle is not None:
            handle.cancel_goal_async()
        elif number in self._for_ros2:
            self._canceled.add(number)


def main() -> None:
    peer = Peer(Connection(int(sys.argv[1])), sys.argv[2])
    for run in (peer.listen, peer.watch):
        threading.Thread(target=run, daemon=True).start()
    peer.tell("ready")
    peer.spin()


if __name__ == "__main__":
    main()

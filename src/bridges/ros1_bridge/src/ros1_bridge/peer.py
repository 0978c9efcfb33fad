"""The side of ROS 2: a process that knows nothing of ROS 1, run by the Python that ``scripts/setup --ros2`` installed.

``python peer.py DESCRIPTOR`` takes orders from a socket and tells what comes, both as pickled tuples (:mod:`ros1_bridge.link`). Messages
are the bytes of CDR, as they are on the wire.
"""

from __future__ import annotations

import importlib
import queue
import sys
import threading
import traceback
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any

import rclpy
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.action import get_action_names_and_types as actions_known
from rclpy.action.graph import get_action_server_names_and_types_by_node as actions_of
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.qos import DurabilityPolicy, HistoryPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message, serialize_message

LOOK = 0.25  # s between looks at the graph
THREADS = 16  # services and actions of ROS 1 that are waited for at one time
FOUND = 10.0  # s until a server that the graph has shown must be connected
BULK = 65536  # bytes from which data goes as a piece of its own


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
    made = QoSProfile(
        depth=words.get("depth", 10),
        history=HistoryPolicy.KEEP_ALL if words.get("history") == "keep_all" else HistoryPolicy.KEEP_LAST,
        reliability=ReliabilityPolicy.BEST_EFFORT if words.get("reliability") == "best_effort" else ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if words.get("durability") == "transient_local" else DurabilityPolicy.VOLATILE,
    )
    for name in ("deadline", "lifespan", "liveliness_lease_duration"):
        if name in words:
            setattr(made, name, Duration(nanoseconds=words[name]))
    if "liveliness" in words:
        made.liveliness = LivelinessPolicy(words["liveliness"])
    return made


def policy(info: Any) -> str:
    """What does not fit: DURABILITY, RELIABILITY ..."""
    return info.last_policy_kind.name.upper().rpartition("POLICY_")[2]


class Peer:
    def __init__(self, connection: Connection, name: str) -> None:
        self._connection, self._sending = connection, threading.Lock()
        rclpy.init(args=["ros1_bridge", "--ros-args", "--log-level", "ERROR"])
        self.node = rclpy.create_node(name, start_parameter_services=False, enable_rosout=False)
        self.executor = MultiThreadedExecutor(THREADS)
        self.executor.add_node(self.node)
        self._group = ReentrantCallbackGroup()
        self._publishers: dict[str, tuple[Any, dict[str, Any], str]] = {}  # with what they promise and their type
        self._others: dict[tuple[str, str], Any] = {}
        self._gids: set = set()  # of our own publishers
        self._waiting: dict[int, queue.Queue] = {}  # for answers of ROS 1
        self._goals: dict[int, Any] = {}
        self._sent: dict[int, bool] = {}  # goals that a server here has not answered yet, and whether they are canceled already
        self._early: set[bytes] = set()  # goals for ROS 1 that were canceled before they were handed on
        self._goal_lock = threading.Lock()
        self._number = 0

    # -------------------------------------------------------------------------------------------- the line

    def tell(self, *words: Any, data: Any = None) -> None:
        with self._sending:
            try:
                bulk = data is not None and len(data) > BULK
                self._connection.send((*words, None if bulk else data, bulk))
                if bulk:
                    self._connection.send_bytes(data)
            except OSError:  # ROS 1 is gone; so is this, soon
                pass

    def listen(self) -> None:
        """Orders, until the line ends."""
        try:
            while True:
                *words, data, bulk = self._connection.recv()
                if bulk:
                    data = self._connection.recv_bytes()
                try:
                    getattr(self, "do_" + words[0])(*words[1:], data)
                except Exception as error:
                    line = " ".join(str(error).split())[:200] or type(error).__name__
                    self.tell("failed", words[:2], line, traceback.format_exc())
        except (EOFError, OSError):
            rclpy.try_shutdown()

    def ask(self, word: str, *words: Any, goal: Any = None, data: Any = None) -> tuple[Any, Any]:
        """What ROS 1 answers to ``word`` with ``words`` and ``data``; waits for it.

        :param goal: the handle of a goal of whose end this waits, and its type
        """
        with self._sending:
            self._number += 1
            number = self._number
        self._waiting[number] = queue.Queue()
        canceled = False
        if goal is not None:
            with self._goal_lock:
                self._goals[number] = goal
                canceled = goal[0].goal_id.uuid.tobytes() in self._early
                self._early.discard(goal[0].goal_id.uuid.tobytes())
        self.tell(word, number, *words, data=data)
        if canceled:
            self.tell("cancel", number)
        try:
            return self._waiting[number].get()
        finally:
            del self._waiting[number]
            self._goals.pop(number, None)

    def do_answer(self, number: int, error: str | None, data: Any) -> None:
        """ROS 1's answer to the question ``number``: ``data``, or ``error``. These methods are called by the word that is ordered."""
        waiting = self._waiting.get(number)
        if waiting is not None:
            waiting.put((error, bytes(data) if data else None))

    # -------------------------------------------------------------------------------------------- what is here

    def do_describe(self, number: int, name: str, form: str, _: Any) -> None:
        """Tell the fields of ``name``, by ``form`` a "msg", "srv" or "action", as the reply ``number``."""
        kind = kind_of(name, form)
        found: dict[str, dict[str, str]] = {}
        parts = {"msg": ("",), "srv": ("Request", "Response"), "action": ("Goal", "Result", "Feedback")}[form]
        if kind is not None:
            for part in parts:
                fields(getattr(kind, part) if part else kind, found, f"{name}_{part}" if part else name)
        self.tell("reply", number, found)

    def do_known(self, number: int, _: Any) -> None:
        """All interfaces that are installed: package/msg/Name"""
        from ament_index_python.resources import get_resource, get_resources

        names = []
        for package in get_resources("rosidl_interfaces"):
            for line in get_resource("rosidl_interfaces", package)[0].splitlines():
                if line.startswith(("msg/", "srv/", "action/")) and not line.endswith((".idl", ".json")):
                    names.append(f"{package}/{line.rpartition('.')[0]}")
        self.tell("reply", number, sorted(set(names)))

    def watch(self) -> None:
        before = None
        while rclpy.ok():
            try:
                graph = self._graph()
            except Exception:  # the context ends while it is looked at
                return
            if graph != before:
                self.tell("graph", graph)
            before = graph
            self._stop.wait(LOOK)

    _stop = threading.Event()

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
        wanted = {name: short_name(types[0]) for name, types in actions_known(node)}
        return {"topics": topics, "services": services, "actions": actions, "wanted": wanted}

    # -------------------------------------------------------------------------------------------- topics

    def do_advertise(self, topic: str, type_name: str, words: dict[str, Any], _: Any) -> None:
        """Publish ``topic``, of ``type_name``, with the quality of service ``words``."""
        old = self._publishers.pop(topic, None)
        if old is not None:
            self.node.destroy_publisher(old[0])
        events = PublisherEventCallbacks(
            matched=lambda info: self.tell("matched", topic, info.current_count),
            incompatible_qos=lambda info: self.tell("unequal", topic, policy(info), words),
            incompatible_type=lambda info: None,
            use_default_callbacks=False,
        )
        publisher = self.node.create_publisher(kind_of(type_name, "msg"), topic, profile(words), event_callbacks=events)
        self._publishers[topic] = (publisher, words, type_name)
        for info in self.node.get_publishers_info_by_topic(topic):
            if info.node_name == self.node.get_name():
                self._gids.add(bytes(info.endpoint_gid))

    def do_publish(self, topic: str, data: Any) -> None:
        """Publish ``data``, a message as bytes of CDR, on ``topic``."""
        found = self._publishers.get(topic)
        if found is not None:
            found[0].publish(bytes(data))

    def do_subscribe(self, topic: str, type_name: str, words: dict[str, Any], _: Any) -> None:
        """Tell what comes on ``topic``, of ``type_name``, read with the quality of service ``words``."""
        self.do_forget("subscriber", topic, None)

        def take(data: bytes, info: Any) -> None:
            if self._foreign(info):
                self.tell("message", topic, data=data)

        events = SubscriptionEventCallbacks(
            incompatible_qos=lambda info: self.tell("unequal", topic, policy(info), None), use_default_callbacks=False
        )
        self._others["subscriber", topic] = self.node.create_subscription(
            kind_of(type_name, "msg"), topic, take, profile(words), raw=True, event_callbacks=events
        )

    def _foreign(self, info: Any) -> bool:
        gid = info.get("publisher_gid") if isinstance(info, dict) else info.publisher_gid
        data = gid.get("data") if isinstance(gid, dict) else gid
        return data is None or bytes(data)[:16] not in {own[:16] for own in self._gids}

    def do_forget(self, what: str, name: str, _: Any) -> None:
        """End the publisher, subscriber, server, client ... (``what``) called ``name``."""
        if what == "publisher":
            found = self._publishers.pop(name, None)
            if found is not None:
                self.node.destroy_publisher(found[0])
            return
        other = self._others.pop((what, name), None)
        if other is None:
            return
        if what in ("action_server", "action_client"):
            other.destroy()
        else:
            destroy: Callable[[Any], Any] = getattr(
                self.node, {"subscriber": "destroy_subscription", "server": "destroy_service"}.get(what, "destroy_client")
            )
            destroy(other)

    # -------------------------------------------------------------------------------------------- services

    def do_serve(self, name: str, type_name: str, _: Any) -> None:
        """The service ``name`` of ROS 1, of ``type_name``, offered here."""
        kind = kind_of(type_name, "srv")

        def answer(request: Any, response: Any) -> Any:
            error, data = self.ask("call", name, data=serialize_message(request))
            return deserialize_message(data, kind.Response) if error is None else response

        self._others["server", name] = self.node.create_service(kind, name, answer, callback_group=self._group)

    def _reached(self, wait: Callable[..., bool], work: Callable[[], Any], missing: Callable[[], Any]) -> None:
        """``work()`` as soon as a client has its server, ``missing()`` when it gets none; the line goes on meanwhile."""
        if wait(timeout_sec=0.0):
            work()
            return
        threading.Thread(target=lambda: work() if wait(timeout_sec=FOUND) else missing(), daemon=True).start()

    def do_call(self, number: int, name: str, type_name: str, data: Any) -> None:
        """Call the service ``name``, of ``type_name``, which is here, for a client of ROS 1; ``number`` is the call's, ``data`` the
        request.
        """
        kind = kind_of(type_name, "srv")
        key = ("client", name)
        if key not in self._others:
            self._others[key] = self.node.create_client(kind, name, callback_group=self._group)
        client = self._others[key]

        def call() -> None:
            client.call_async(deserialize_message(bytes(data), kind.Request)).add_done_callback(
                lambda done: self.tell("done", number, None, data=serialize_message(done.result()))
            )

        self._reached(client.wait_for_service, call, lambda: self.tell("done", number, f"no node of ROS 2 offers {name}"))

    # -------------------------------------------------------------------------------------------- actions

    def do_serve_action(self, name: str, type_name: str, _: Any) -> None:
        """The action server ``name`` of ROS 1, of ``type_name``, offered here."""
        kind = kind_of(type_name, "action")

        def execute(handle: Any) -> Any:
            status, data = self.ask("goal", name, goal=(handle, kind), data=serialize_message(handle.request))
            if status == "canceled" and not handle.is_cancel_requested:
                status = "aborted"  # a client of ROS 1 took it over; ROS 2 knows no such end
            {"succeeded": handle.succeed, "canceled": handle.canceled}.get(status, handle.abort)()
            return deserialize_message(data, kind.Result) if data else kind.Result()

        def cancel(handle: Any) -> Any:
            ours = handle.goal_id.uuid.tobytes()
            with self._goal_lock:
                numbers = [number for number, (other, _) in self._goals.items() if other.goal_id.uuid.tobytes() == ours]
                if not numbers:
                    self._early.add(ours)
            for number in numbers:
                self.tell("cancel", number)
            return CancelResponse.ACCEPT

        self._others["action_server", name] = ActionServer(
            self.node,
            kind,
            name,
            execute,
            goal_callback=lambda goal: GoalResponse.ACCEPT,
            cancel_callback=cancel,
            callback_group=self._group,
        )

    def do_feedback(self, number: int, data: Any) -> None:
        """``data`` is ROS 1's feedback for the goal ``number``."""
        found = self._goals.get(number)
        if found is not None:
            found[0].publish_feedback(deserialize_message(bytes(data), found[1].Feedback))

    def do_result(self, number: int, status: str, data: Any) -> None:
        """The goal ``number`` has ended in ROS 1 with ``status`` and the result ``data``."""
        self.do_answer(number, status, data)

    def do_send_goal(self, number: int, name: str, type_name: str, data: Any) -> None:
        """``data`` is a goal of a client of ROS 1 for the action server ``name``, of ``type_name``, that is here; ``number`` is the
        goal's.
        """
        kind = kind_of(type_name, "action")
        key = ("action_client", name)
        if key not in self._others:
            self._others[key] = ActionClient(self.node, kind, name, callback_group=self._group)
        client = self._others[key]
        self._sent[number] = False

        def feedback(message: Any) -> None:
            self.tell("progress", number, data=serialize_message(message.feedback))

        def accepted(future: Any) -> None:
            handle = future.result()
            with self._goal_lock:
                canceled = self._sent.pop(number)
                self._goals[number] = (handle, kind)
            if not handle.accepted:
                missing()
                return
            if canceled:
                handle.cancel_goal_async()
            handle.get_result_async().add_done_callback(ended)

        def ended(future: Any) -> None:
            answer = future.result()
            self._goals.pop(number, None)
            words = {4: "succeeded", 5: "canceled"}
            self.tell("end", number, words.get(answer.status, "aborted"), data=serialize_message(answer.result))

        def send() -> None:
            goal = deserialize_message(bytes(data), kind.Goal)
            client.send_goal_async(goal, feedback_callback=feedback).add_done_callback(accepted)

        def missing() -> None:
            self._sent.pop(number, None)
            self._goals.pop(number, None)
            self.tell("end", number, "rejected")

        self._reached(client.wait_for_server, send, missing)

    def do_cancel_goal(self, number: int, _: Any) -> None:
        with self._goal_lock:
            if number in self._sent:
                self._sent[number] = True
            found = self._goals.get(number)
        if found is not None:
            found[0].cancel_goal_async()


def main() -> None:
    peer = Peer(Connection(int(sys.argv[1])), sys.argv[2])
    threads: list[threading.Thread] = [threading.Thread(target=run, daemon=True) for run in (peer.listen, peer.watch)]
    for thread in threads:
        thread.start()
    peer.tell("ready")
    try:
        peer.executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == "__main__":
    main()

"""Services and actions, each offered on the side that has it not."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import actionlib
import rospy
from actionlib_msgs.msg import GoalStatus

from ros1_bridge.errors import BridgeError, MappingError
from ros1_bridge.link import Link
from ros1_bridge.pairs import bytes_of, message_class, service_class
from ros1_bridge.wire import Pair

PATIENCE = 5.0  # s of wall time that a service of ROS 2 has, as upstream's


def filled(message: Any, data: Any) -> Any:
    """``message``, filled with ``data``, its bytes."""
    message.deserialize(bytes(data))
    return message


class CallFailed(BridgeError):
    """A service of the other side did not answer."""


class Calls:
    """Services of ROS 2 that nodes of ROS 1 call, and answers that come."""

    def __init__(self, link: Link) -> None:
        self._link = link
        self._came = threading.Condition()
        self._answers: dict[int, tuple[str | None, Any]] = {}

    def call(self, name: str, type_of_ros2: str, data: Any, patience: float) -> Any:
        """The response of the service ``name`` of ROS 2 to the request ``data``, as bytes; ``type_of_ros2`` is its type.

        :param patience: s to wait for it
        :raises CallFailed: no answer, or the other side says why
        """
        number = self._link.number()
        self._link.tell("call", number, name, type_of_ros2, data=data)
        with self._came:
            if not self._came.wait_for(lambda: number in self._answers, patience):
                raise CallFailed(f"{name} of ROS 2 has not answered for {patience:g} s")
            error, answer = self._answers.pop(number)
        if error is not None:
            raise CallFailed(error)
        return answer

    def done(self, number: int, error: str | None, data: Any) -> None:
        """The call ``number`` has ended, with the response ``data`` or with ``error``."""
        with self._came:
            self._answers[number] = error, data
            self._came.notify_all()


class ServiceOfRos2:
    """Offered in ROS 1."""

    def __init__(self, name: str, of_ros1: str, found: tuple[str, Pair, Pair], calls: Calls, patience: float = PATIENCE) -> None:
        self.type = of_ros1
        two, request_pair, response_pair = found
        kind = service_class(of_ros1)

        def answer(request: Any) -> Any:
            data = calls.call(name, two, request_pair.to_ros2(bytes_of(request)), patience)
            return filled(kind._response_class(), response_pair.to_ros1(data))

        def failed(error: Exception, *_: Any) -> None:  # rospy would print a traceback; the caller is told the line
            rospy.logwarn("%s: %s", name, error)

        self._service = rospy.Service(name, kind, answer, error_handler=failed)

    def close(self) -> None:
        self._service.shutdown()


class ServiceOfRos1:
    """Offered in ROS 2."""

    def __init__(self, name: str, of_ros1: str, found: tuple[str, Pair, Pair], link: Link) -> None:
        self.name, self.type, self._link = name, of_ros1, link
        self._two, self._request, self._response = found
        self._kind = service_class(of_ros1)
        link.tell("serve", name, self._two)

    def call(self, number: int, data: Any) -> None:
        """The request ``data`` of the call ``number``, answered in a thread of its own."""
        threading.Thread(target=self._call, args=(number, data), daemon=True).start()

    def _call(self, number: int, data: Any) -> None:
        try:
            request = filled(self._kind._request_class(), self._request.to_ros1(data))
            answer = rospy.ServiceProxy(self.name, self._kind).call(request)
            self._link.tell("answer", number, None, data=self._response.to_ros2(bytes_of(answer)))
        except Exception as error:  # the server's own, a mapping's, the network's: ROS 2 has no failure of a call but silence
            rospy.logwarn("%s, called from ROS 2: %s", self.name, " ".join(str(error).split())[:200])
            self._link.tell("answer", number, str(error))

    def close(self) -> None:
        self._link.tell("forget", "server", self.name)


def action_spec(of_ros1: str) -> Any:
    return message_class(of_ros1 + "Action")


class ActionOfRos1:
    """An action server of ROS 1, offered in ROS 2."""

    def __init__(self, name: str, of_ros1: str, found: tuple[str, Pair, Pair, Pair], link: Link) -> None:
        self.name, self.type, self._link = name, of_ros1, link
        self._two, self._goal, self._result, self._feedback = found
        self._client = actionlib.ActionClient(name, action_spec(of_ros1))
        self._goals: dict[int, Any] = {}
        self._lock, self._closed = threading.RLock(), False
        threading.Thread(target=self._offer, daemon=True).start()

    def _offer(self) -> None:
        """Once the server hears us: a goal that is sent before is lost."""
        connected = self._client.wait_for_server()
        with self._lock:
            if connected and not self._closed:
                self._link.tell("serve_action", self.name, self._two)

    def send(self, number: int, data: Any) -> None:
        """Send the goal ``data`` on; ``number`` is its number in ROS 2."""
        try:
            goal = filled(message_class(self.type + "Goal")(), self._goal.to_ros1(data))
        except MappingError as error:
            rospy.logwarn("%s: a goal from ROS 2 is not bridged: %s", self.name, error)
            self._link.tell("result", number, "aborted")
            return
        with self._lock:
            self._goals[number] = self._client.send_goal(
                goal, lambda handle: self._moved(number, handle), lambda _, feedback: self._told(number, feedback)
            )

    def cancel(self, number: int) -> bool:
        with self._lock:
            handle = self._goals.get(number)
        if handle is not None:
            handle.cancel()
        return handle is not None

    def _told(self, number: int, feedback: Any) -> None:
        self._link.tell("feedback", number, data=self._feedback.to_ros2(bytes_of(feedback)))

    def _moved(self, number: int, handle: Any) -> None:
        if handle.get_comm_state() != actionlib.CommState.DONE:
            return
        with self._lock:
            self._goals.pop(number, None)
        status, result = handle.get_goal_status(), handle.get_result()
        words = {GoalStatus.SUCCEEDED: "succeeded", GoalStatus.PREEMPTED: "canceled", GoalStatus.RECALLED: "canceled"}
        data = self._result.to_ros2(bytes_of(result)) if result is not None else None
        self._link.tell("result", number, words.get(status, "aborted"), data=data)

    def close(self) -> None:
        with self._lock:
            self._closed = True
            self._link.tell("forget", "action_server", self.name)
        self._client.stop()


class ActionOfRos2:
    """An action server of ROS 2, offered in ROS 1."""

    def __init__(self, name: str, of_ros1: str, found: tuple[str, Pair, Pair, Pair], link: Link) -> None:
        self.name, self.type, self._link = name, of_ros1, link
        self._two, self._goal, self._result, self._feedback = found
        self._goals: dict[int, Any] = {}
        self._lock = threading.RLock()
        self._server = actionlib.ActionServer(name, action_spec(of_ros1), self._accept, self._cancel, auto_start=False)
        self._server.start()

    def _accept(self, handle: Any) -> None:
        with self._lock:
            handle.set_accepted()
            number = self._link.number()
            self._goals[number] = handle
            self._link.tell("send_goal", number, self.name, self._two, data=self._goal.to_ros2(bytes_of(handle.get_goal())))
            if handle.get_goal_status().status == GoalStatus.PREEMPTING:  # its cancel came before
                self._link.tell("cancel_goal", number)

    def _cancel(self, handle: Any) -> None:
        with self._lock:
            for number, other in list(self._goals.items()):
                if other.get_goal_id().id == handle.get_goal_id().id:
                    self._link.tell("cancel_goal", number)

    def progress(self, number: int, data: Any) -> bool:
        """Feedback ``data`` of the goal ``number``; False where it is none of this action's."""
        handle = self._goals.get(number)
        if handle is not None:
            handle.publish_feedback(filled(message_class(self.type + "Feedback")(), self._feedback.to_ros1(data)))
        return handle is not None

    def end(self, number: int, status: str, data: Any) -> bool:
        """The goal ``number`` has ended with ``status`` and the result ``data``; False where it is none of this action's."""
        handle = self._goals.pop(number, None)
        if handle is None:
            return False
        result = message_class(self.type + "Result")()
        if data:
            filled(result, self._result.to_ros1(data))
        finish: Callable[..., None] = {"succeeded": handle.set_succeeded, "canceled": handle.set_canceled}.get(status, handle.set_aborted)
        finish(result, "rejected in ROS 2" if status == "rejected" else "")
        return True

    def close(self) -> None:
        for name in ("status_pub", "result_pub", "feedback_pub", "goal_sub", "cancel_sub"):
            part = getattr(self._server, name, None)
            if part is not None:
                part.unregister()


def actions_of_ros1(published: dict[str, list[str]], types: dict[str, str], own: str) -> dict[str, str]:
    """Action servers by name: package/Name, by the topics that they publish. Those of the node ``own`` are left out.

    :param published: nodes by topic. :param types: by topic
    """
    found = {}
    for topic, nodes in published.items():
        name, _, last = topic.rpartition("/")
        kind = types.get(topic, "")
        if last == "result" and kind.endswith("ActionResult") and f"{name}/status" in published and set(nodes) != {own}:
            found[name] = kind[: -len("ActionResult")]
    return found


def of_an_action(topic: str, kind: str) -> bool:
    """Whether actionlib made ``topic``, of type ``kind``: it is bridged as an action, or not at all."""
    last = topic.rpartition("/")[2]
    return (
        last in ("goal", "result", "feedback")
        and kind.endswith("Action" + last.capitalize())
        or (last, kind) in (("cancel", "actionlib_msgs/GoalID"), ("status", "actionlib_msgs/GoalStatusArray"))
    )

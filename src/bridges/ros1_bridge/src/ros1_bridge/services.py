"""Services and actions, each offered on the side that has it not. The other side is told nothing before ``open()``."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import actionlib
import rospy
from actionlib_msgs.msg import GoalStatus

from ros1_bridge.errors import BridgeError, MappingError
from ros1_bridge.line import one_line
from ros1_bridge.pairs import Bridged, message_class, service_class


class CallFailed(BridgeError):
    """A service of the other side did not answer."""


class ServiceOfRos2(Bridged):
    """Offered in ROS 1."""

    def open(self) -> None:
        def failed(error: Exception, *_: Any) -> None:  # rospy would print a traceback; the caller is told the line
            rospy.logwarn("%s: %s", self.name, error)

        self._service = rospy.Service(self.name, service_class(self.match.ros1), self._answer, error_handler=failed)

    def _answer(self, request: Any) -> Any:
        """:raises CallFailed: no answer, or the other side says why"""
        patience = self._link.patience
        try:
            error, data = self._link.wait(patience, "call", self.name, self.match.ros2, data=self.match.data("Request", request))
        except TimeoutError:
            raise CallFailed(f"{self.name} of ROS 2 has not answered for {patience:g} s") from None
        if error is not None:
            raise CallFailed(error)
        return self.match.message("Response", data)

    def close(self) -> None:
        self._service.shutdown()


class ServiceOfRos1(Bridged):
    """Offered in ROS 2."""

    def open(self) -> None:
        self._link.tell("serve", self.name, self.match.ros2)

    def call(self, number: int, data: Any) -> None:
        """The request ``data`` of the call ``number``, answered in a thread of its own."""
        threading.Thread(target=self._call, args=(number, data), daemon=True).start()

    def _call(self, number: int, data: Any) -> None:
        try:
            answer = rospy.ServiceProxy(self.name, service_class(self.match.ros1)).call(self.match.message("Request", data))
            self._link.answer(number, None, data=self.match.data("Response", answer))
        except Exception as error:  # the server's own, a mapping's, the network's: ROS 2 has no failure of a call but silence
            rospy.logwarn("%s, called from ROS 2: %s", self.name, one_line(error))
            self._link.answer(number, one_line(error))

    def close(self) -> None:
        self._link.tell("forget", "server", self.name)


class ActionOfRos1(Bridged):
    """An action server of ROS 1, offered in ROS 2."""

    def open(self) -> None:
        self._client = actionlib.ActionClient(self.name, message_class(self.match.ros1 + "Action"))
        self._goals: dict[int, Any] = {}
        self._lock, self._closed = threading.RLock(), False
        threading.Thread(target=self._offer, daemon=True).start()

    def _offer(self) -> None:
        """Once the server hears us: a goal that is sent before is lost."""
        connected = self._client.wait_for_server()
        with self._lock:
            if connected and not self._closed:
                self._link.tell("serve_action", self.name, self.match.ros2)

    def call(self, number: int, data: Any) -> None:
        """Send the goal ``data`` on; ``number`` is its number in ROS 2."""
        try:
            goal = self.match.message("Goal", data)
        except MappingError as error:
            rospy.logwarn("%s: a goal from ROS 2 is not bridged: %s", self.name, error)
            self._link.answer(number, "aborted")
            return
        with self._lock:
            self._goals[number] = self._client.send_goal(
                goal, lambda handle: self._moved(number, handle), lambda _, feedback: self._told(number, feedback)
            )

    def cancel(self, number: int, _: Any) -> None:
        with self._lock:
            handle = self._goals.get(number)
        if handle is not None:
            handle.cancel()

    def _told(self, number: int, feedback: Any) -> None:
        self._link.tell("feedback", number, data=self.match.data("Feedback", feedback))

    def _moved(self, number: int, handle: Any) -> None:
        if handle.get_comm_state() != actionlib.CommState.DONE:
            return
        with self._lock:
            self._goals.pop(number, None)
        status, result = handle.get_goal_status(), handle.get_result()
        words = {GoalStatus.SUCCEEDED: "succeeded", GoalStatus.PREEMPTED: "canceled", GoalStatus.RECALLED: "canceled"}
        self._link.answer(number, words.get(status, "aborted"), data=None if result is None else self.match.data("Result", result))

    def close(self) -> None:
        with self._lock:
            self._closed = True
            for number in self._goals:
                self._link.answer(number, "aborted")
            self._link.tell("forget", "action_server", self.name)
        self._client.stop()


class ActionOfRos2(Bridged):
    """An action server of ROS 2, offered in ROS 1."""

    def open(self) -> None:
        self._goals: dict[int, Any] = {}
        self._lock = threading.RLock()
        kind = message_class(self.match.ros1 + "Action")
        self._server = actionlib.ActionServer(self.name, kind, self._accept, self._cancel, auto_start=False)
        self._server.start()

    def _accept(self, handle: Any) -> None:
        with self._lock:
            handle.set_accepted()
            goal = self.match.data("Goal", handle.get_goal())
            number = self._link.ask(self._end, "send_goal", self.name, self.match.ros2, data=goal)
            self._goals[number] = handle
            if handle.get_goal_status().status == GoalStatus.PREEMPTING:  # its cancel came before
                self._link.tell("cancel_goal", number)

    def _cancel(self, handle: Any) -> None:
        with self._lock:
            for number, other in list(self._goals.items()):
                if other.get_goal_id().id == handle.get_goal_id().id:
                    self._link.tell("cancel_goal", number)

    def progress(self, number: int, data: Any) -> None:
        """Feedback ``data`` of the goal ``number``."""
        with self._lock:
            handle = self._goals.get(number)
        if handle is not None:
            handle.publish_feedback(self.match.message("Feedback", data))

    def _end(self, number: int, status: str, data: Any) -> None:
        """The goal ``number`` has ended with ``status`` and the result ``data``."""
        with self._lock:
            handle = self._goals.pop(number)
        try:
            result = self.match.message("Result", data)
        except MappingError as error:
            rospy.logwarn("%s: a result from ROS 2 is not bridged: %s", self.name, error)
            status, result = "aborted", self.match.message("Result", None)
        finish: Callable[..., None] = {"succeeded": handle.set_succeeded, "canceled": handle.set_canceled}.get(status, handle.set_aborted)
        finish(result, "rejected in ROS 2" if status == "rejected" else "")

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

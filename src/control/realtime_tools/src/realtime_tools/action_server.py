"""Action server whose goals are finished by a control loop without blocking it."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable

import actionlib
import rospy
from actionlib_msgs.msg import GoalStatus

_UNFINISHED = (GoalStatus.PENDING, GoalStatus.ACTIVE, GoalStatus.PREEMPTING, GoalStatus.RECALLING)


class RealtimeGoal:
    """A goal of a RealtimeActionServer. All methods are realtime safe: the server's own thread publishes, in order.

    :ivar goal: the goal message
    :ivar id: its identity, text
    """

    def __init__(self, handle, outbox: queue.SimpleQueue):
        self.goal = handle.get_goal()
        self.id = handle.get_goal_id().id
        self._handle = handle
        self._outbox = outbox

    def accept(self) -> None:
        self._outbox.put(self._handle.set_accepted)

    def reject(self, result=None, text: str = "") -> None:
        """To REJECTED, with the action's ``result`` (None: an empty one) and a ``text`` for people."""
        self._finish(self._handle.set_rejected, result, text)

    def cancel(self, result=None, text: str = "") -> None:
        """To PREEMPTED, with the action's ``result`` (None: an empty one) and a ``text`` for people."""
        self._finish(self._handle.set_canceled, result, text)

    def succeed(self, result, text: str = "") -> None:
        """To SUCCEEDED, with the action's ``result`` and a ``text`` for people."""
        self._finish(self._handle.set_succeeded, result, text)

    def abort(self, result, text: str = "") -> None:
        """To ABORTED, with the action's ``result`` and a ``text`` for people."""
        self._finish(self._handle.set_aborted, result, text)

    def feedback(self, feedback) -> None:
        """Send ``feedback``, the action's message, only while the goal is ACTIVE."""
        self._outbox.put(lambda: self._status() == GoalStatus.ACTIVE and self._handle.publish_feedback(feedback))

    def _finish(self, transition, result, text: str) -> None:
        self._outbox.put(lambda: self._status() in _UNFINISHED and transition(result, text))

    def _status(self) -> int:
        return self._handle.get_goal_status().status


class RealtimeActionServer:
    """Serves an action from its own thread.

    :param name: resolved name of the action
    :param action: action type, such as ``control_msgs.msg.FollowJointTrajectoryAction``
    :param on_goal: called with a RealtimeGoal in a ROS thread; is to accept or reject it
    :param on_cancel: called with the id of a goal that a client wants cancelled
    """

    def __init__(self, name: str, action: type, on_goal: Callable[[RealtimeGoal], None], on_cancel: Callable[[str], None]):
        self._outbox: queue.SimpleQueue = queue.SimpleQueue()
        self._server = _Server(
            name,
            action,
            lambda handle: on_goal(RealtimeGoal(handle, self._outbox)),
            lambda handle: on_cancel(handle.get_goal_id().id),
            auto_start=False,
        )
        self._thread = threading.Thread(target=self._publish, name=f"action {name}", daemon=True)
        self._thread.start()
        self._server.start()

    def shutdown(self) -> None:
        """Publish what is outstanding and take the action off the graph."""
        self._outbox.put(None)
        self._thread.join()
        self._server.stop()

    def _publish(self) -> None:
        while True:
            job = self._outbox.get()
            if job is None:
                return
            try:
                job()
            except rospy.ROSException as error:  # a topic closed at shutdown
                rospy.logdebug("action server: %s", error)


class _Server(actionlib.ActionServer):
    """actionlib's server; its status timer survives a simulation clock that jumps back."""

    _hz = 0.0

    @property
    def status_frequency(self) -> float:
        """0 for actionlib, which would start a timer that a jump of the clock ends with a traceback, stopped or not."""
        return 0.0

    @status_frequency.setter
    def status_frequency(self, hz: float) -> None:
        self._hz = hz

    def initialize(self):
        super().initialize()
        if self._hz > 0.0:
            self.status_timer = rospy.Timer(rospy.Duration(1.0 / self._hz), self.publish_status_async, reset=True)

    def stop(self):
        with self.lock:
            self.started = False
            if self.status_timer is not None:  # None when the parameter actionlib_status_frequency is 0
                self.status_timer.shutdown()
            for topic in (self.goal_sub, self.cancel_sub, self.status_pub, self.feedback_pub, self.result_pub):
                topic.unregister()

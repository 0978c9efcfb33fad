"""Base of the controllers that serve an action."""

from __future__ import annotations

import threading

from realtime_tools.action_server import RealtimeActionServer, RealtimeGoal

from .controller import Controller
from .node_handle import NodeHandle

_STOPPED = "The controller was stopped"


class ActionController(Controller):
    """Has one active goal at most; a new one takes its place.

    ``_lock`` guards what the control loop shares with the threads of rospy: ``_goal``, ``_running`` and what a deriving
    class adds. A deriving class calls ``serve`` at the end of ``init`` and sets ``_running`` in ``starting``.
    """

    def serve(self, controller_nh: NodeHandle, name: str, action: type) -> None:
        """Offer the action ``name`` of type ``action``, say ``control_msgs.msg.FollowJointTrajectoryAction``, in ``controller_nh``."""
        self._lock = threading.Lock()
        self._running = False
        self._goal: RealtimeGoal | None = None
        controller_nh.own(RealtimeActionServer(controller_nh.resolve(name), action, self._on_goal, self._on_cancel))

    def _on_goal(self, goal: RealtimeGoal) -> None:
        """Take ``goal`` or reject it. Called in a thread of rospy."""
        raise NotImplementedError

    def _hold(self, goal: RealtimeGoal | None) -> None:
        """Stop, on behalf of ``goal`` or of nobody. Called with ``_lock`` held."""
        raise NotImplementedError

    def stopping(self, time: float) -> None:
        with self._lock:
            self._running = False
            self._replace(None, _STOPPED)

    def aborting(self, time: float) -> None:
        self.stopping(time)

    def _replace(self, goal: RealtimeGoal | None, text: str) -> None:
        """``goal`` (or none) becomes the active one. Call it with ``_lock`` held, so that the loop cannot finish a goal
        that is not accepted yet.

        :param text: why the goal before it is cancelled
        """
        if self._goal is not None:
            self._goal.cancel(text=text)
        if goal is not None:
            goal.accept()
            if not self._running:  # no longer, since the goal was looked at
                goal.cancel(text=_STOPPED)
                goal = None
        self._goal = goal

    def _release(self, goal: RealtimeGoal) -> bool:
        """Let go of the active goal, to finish it; False if a thread of rospy was quicker."""
        with self._lock:
            if self._goal is not goal:
                return False
            self._goal = None
            return True

    def _on_cancel(self, goal_id: str) -> None:
        with self._lock:
            if self._goal is not None and self._goal.id == goal_id:
                self._hold(None)
                self._replace(None, "Cancelled by a client")

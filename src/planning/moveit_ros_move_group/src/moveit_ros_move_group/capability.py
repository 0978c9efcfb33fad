"""The base of capabilities, and what keeps a bad request from harming the node."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import actionlib
import motion
import rospy
from moveit_core.errors import PlanningError, code_name, one_line
from moveit_msgs.msg import MoveItErrorCodes
from moveit_ros_planning.plan_execution import PlanExecution, Stop

from .context import Context


class Capability:
    """One thing that move_group can do. ``title`` is printed in the list of capabilities at start."""

    title = ""

    def __init__(self, context: Context):
        self.context = context

    @property
    def plan_execution(self) -> PlanExecution:
        """What plans and executes, of a move_group that may execute."""
        assert self.context.plan_execution is not None
        return self.context.plan_execution

    def shutdown(self) -> None:
        """End what the capability is doing."""


def serve(name: str, kind: Any, handler: Callable[[Any, Any], None]) -> rospy.Service:
    """Offer the service ``name`` of class ``kind``: ``handler(request, response)`` fills the response.

    PlanningError puts its code into ``response.error_code`` (or that of ``motion_plan_response``), if there is one,
    and is logged as one line; so is any other exception, with FAILURE. A response that has no place for a failure is none then: the
    call fails, as where upstream's handler returns false.
    """

    @functools.wraps(handler)
    def answer(request):
        response = kind._response_class()
        try:
            handler(request, response)
        except PlanningError as error:
            rospy.logerr("%s: %s (%s)", name, error, code_name(error.code))
            _set_code(response, error.code)
        except (motion.MotionError, ValueError) as error:
            rospy.logerr("%s: %s", name, one_line(error))
            _set_code(response, MoveItErrorCodes.FAILURE)
        except Exception as error:  # whatever a request does to the planner, the node lives on
            rospy.logerr("%s failed: %s: %s", name, type(error).__name__, one_line(error))
            _set_code(response, MoveItErrorCodes.FAILURE)
        else:
            return response
        if not _tells_failure(response):
            raise rospy.ServiceException(f"{name}: it failed; move_group's output says why")
        return response

    return rospy.Service(name, kind, answer)


def _tells_failure(response) -> bool:
    return bool(_holders_of_code(response)) or hasattr(response, "success") or hasattr(response, "valid")


def _holders_of_code(response) -> list[Any]:
    holders = (response, getattr(response, "motion_plan_response", None), getattr(response, "response", None))
    return [holder for holder in holders if hasattr(holder, "error_code")]


def _set_code(response, code: int) -> None:
    for holder in _holders_of_code(response):
        holder.error_code.val = code


class _Server(actionlib.SimpleActionServer):
    """Notes with each goal how often it had been said to stop before it came: it may wait for the end of another."""

    def __init__(self, name: str, kind: type, execute: Callable[[Any], None], stops_before: Callable[[rospy.Time], int]):
        self._stops_before = stops_before
        super().__init__(name, kind, execute_cb=execute, auto_start=False)

    def internal_goal_callback(self, goal) -> None:
        goal.stops = self._stops_before(goal.get_goal_id().stamp)
        super().internal_goal_callback(goal)

    @property
    def stops(self) -> int:
        """Those of the goal that runs."""
        return self.current_goal.stops


class ActionCapability(Capability):
    """A capability behind an action with one goal at a time; a new goal stops the running one."""

    #: name of the action and its type
    action_name = ""
    action: Any = None

    def __init__(self, context: Context):
        super().__init__(context)
        #: of the goal that runs: whether it is to end, and how often it had been said to stop before it came
        self.stop, self.stops = Stop(), 0
        execution = context.execution
        self._server = _Server(
            self.action_name, self.action, self._execute, execution.stops_before if execution is not None else lambda stamp: 0
        )
        self._server.register_preempt_callback(self.preempt)
        self._server.start()

    def preempt(self) -> None:
        """A cancel, or a new goal: stop the running one."""
        self.stop.set()

    def shutdown(self) -> None:
        self.preempt()

    def serve(self, goal, result) -> str:
        """Do what ``goal`` says and fill ``result`` (its error_code above all); the text of the goal's status."""
        raise NotImplementedError

    def feedback(self, state: str) -> None:
        """Publish the state: IDLE, PLANNING, MONITOR or LOOK."""
        self._server.publish_feedback(type(self.action().action_feedback.feedback)(state))

    def _execute(self, goal) -> None:
        result = type(self.action().action_result.result)()
        self.stop, self.stops = Stop(), self._server.stops
        if self._server.is_preempt_requested():
            self.stop.set()
        try:
            text = self.serve(goal, result)
        except PlanningError as error:
            rospy.logerr("%s: %s (%s)", self.action_name, error, code_name(error.code))
            text = self.failed(result, error.code, str(error))
        except Exception as error:  # whatever a goal does to the planner, the node lives on
            rospy.logerr("%s failed: %s: %s", self.action_name, type(error).__name__, one_line(error))
            text = self.failed(result, MoveItErrorCodes.FAILURE, one_line(error))
        code = self.code(result)
        if code == MoveItErrorCodes.SUCCESS:
            self._server.set_succeeded(result, text)
        elif code == MoveItErrorCodes.PREEMPTED:
            if self._server.is_new_goal_available():
                text += f"; another goal came for {self.action_name}, which does one at a time: is a second client running?"
            self._server.set_preempted(result, text)
        else:
            self._server.set_aborted(result, text)
        self.feedback("IDLE")

    def code(self, result) -> int:
        """The error code in ``result``, of MoveItErrorCodes."""
        return result.error_code.val

    def failed(self, result, code: int, message: str) -> str:
        """Write ``code`` into ``result``; the text of the status, which is ``message``."""
        result.error_code.val = code
        return message


_CHANGED = "Solution found but the environment changed during execution and the path was aborted"


def result_text(code: int, message: str, empty: bool, plan_only: bool) -> str:
    """The text of a goal's status, as upstream words it, with the reason of a failure, ``message``.

    :param code: of MoveItErrorCodes. :param empty: the trajectory has no points, or there is none.
    :param plan_only: nothing was to be executed.
    """
    codes = MoveItErrorCodes
    if code == codes.SUCCESS:
        if empty:
            return "Requested path and goal constraints are already met."
        return "Motion plan was computed succesfully." if plan_only else "Solution was found and executed."
    texts = {
        codes.INVALID_GROUP_NAME: "Invalid group in motion plan request",
        codes.UNABLE_TO_AQUIRE_SENSOR_DATA: "Motion plan was found but it seems to be too costly and looking around did not help.",
        codes.MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE: _CHANGED,
    }
    if code in (codes.PLANNING_FAILED, codes.INVALID_MOTION_PLAN):
        text = (
            "No motion plan found. No execution attempted."
            if empty
            else "Motion plan was found but it seems to be invalid (possibly due to postprocessing). Not executing."
        )
    else:
        text = texts.get(code, code_name(code))
    return f"{text}: {message}" if message else text

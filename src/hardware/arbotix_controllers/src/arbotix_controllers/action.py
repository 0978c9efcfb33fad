"""gripper_controller: the action ~gripper_action (control_msgs/GripperCommand)."""

from __future__ import annotations

import math

import actionlib
import rospy
from control_msgs.msg import GripperCommandAction, GripperCommandFeedback, GripperCommandGoal, GripperCommandResult

from .commands import Joints, run
from .grippers import OutOfReach
from .parameters import gripper

_REACHED = 0.03  # rad off what was told
_STILL = 0.005  # rad within which a servo stands
_STALLED = rospy.Duration(0.5)  # for which it stands off its goal: it holds something
_LONGEST = rospy.Duration(5.0)  # for one goal
_UNHEARD = rospy.Duration(0.5)  # after which nobody is taken to tell where the joints are
_PERIOD = 0.05  # s between two looks


class GripperController:
    """A goal ends when the joints are where they were told to be, or stand, as they do round an object (``stalled``). Where nobody tells
    where they are, it ends as reached; upstream ends every goal so, at once."""

    def __init__(self) -> None:
        self._gripper = gripper()
        self._joints = Joints(self._gripper)
        self._server = actionlib.SimpleActionServer("~gripper_action", GripperCommandAction, execute_cb=self._execute, auto_start=False)
        self._server.start()

    def _execute(self, goal: GripperCommandGoal) -> None:
        opening = goal.command.position
        try:
            if not math.isfinite(opening):
                raise OutOfReach(f"an opening of {opening:g} m is no width")
            wanted = self._joints.tell(opening)
        except OutOfReach as error:
            rospy.logerr("gripper_controller: %s", error)
            self._server.set_aborted(text=str(error))
            return
        self._follow(opening, wanted)

    def _follow(self, opening: float, wanted: dict[str, float]) -> None:
        began = moved = rospy.Time.now()
        before: dict[str, float] = {}
        while not rospy.is_shutdown():
            now, at = rospy.Time.now(), self._joints.positions()
            if self._server.is_preempt_requested():
                self._server.set_preempted(self._result(opening, at, False, False))
                return
            if at is None:
                if now - began > _UNHEARD:
                    return self._server.set_succeeded(self._result(opening, at, False, True))
            else:
                self._server.publish_feedback(GripperCommandFeedback(position=self._gripper.opening(at)))
                if all(abs(at[joint] - wanted[joint]) < _REACHED for joint in wanted):
                    return self._server.set_succeeded(self._result(opening, at, False, True))
                if any(abs(at[joint] - before.get(joint, math.inf)) > _STILL for joint in wanted):
                    moved, before = now, at
                if now - moved > _STALLED or now - began > _LONGEST:
                    return self._server.set_succeeded(self._result(opening, at, True, False))
            rospy.sleep(_PERIOD)

    def _result(self, opening: float, at: dict[str, float] | None, stalled: bool, reached: bool) -> GripperCommandResult:
        return GripperCommandResult(position=self._gripper.opening(at) if at else opening, stalled=stalled, reached_goal=reached)


def main() -> None:
    run("gripper_controller", GripperController)

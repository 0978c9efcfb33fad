"""Controllers that are reached through actions. An action server that comes late is found when it comes."""

from __future__ import annotations

import threading
import time
from typing import Any

import actionlib
import rospy
from actionlib_msgs.msg import GoalStatus
from control_msgs.msg import (
    FollowJointTrajectoryAction,
    FollowJointTrajectoryGoal,
    FollowJointTrajectoryResult,
    GripperCommandAction,
    GripperCommandGoal,
)
from moveit_core import action_links
from moveit_core.controller_manager import Completion, ControllerHandle, ExecutionStatus
from moveit_msgs.msg import RobotTrajectory

from . import entries

#: a server whose connection is lost for this long (wall s) during a motion is taken for dead
_GONE = 1.0
_LONGEST = 1e9  # s: what a duration holds
_RESULTS = {value: name for name, value in vars(FollowJointTrajectoryResult).items() if name.isupper() and isinstance(value, int)}
_ENDS = {
    GoalStatus.SUCCEEDED: ExecutionStatus.SUCCEEDED,
    GoalStatus.ABORTED: ExecutionStatus.ABORTED,
    GoalStatus.PREEMPTED: ExecutionStatus.PREEMPTED,
}


class ActionHandle(ControllerHandle):
    """A controller behind an action. ``entry`` is its table in controller_list."""

    action: Any = None
    kind = ""

    def __init__(self, name: str, topic: str, entry: dict[str, Any]):
        super().__init__(name)
        self.topic = topic
        self._entry = entry
        self._completion = Completion()
        self._goal: actionlib.ClientGoalHandle | None = None
        self._client = actionlib.ActionClient(topic, self.action)
        threading.Thread(target=self._announce, name=f"waiting for {topic}", daemon=True).start()

    def _announce(self) -> None:
        end, told = time.monotonic() + 5.0, False
        while not rospy.is_shutdown():
            if self.connected:
                rospy.loginfo("Added %s controller for %s", self.kind, self.name)
                return
            if not told and time.monotonic() > end:
                told = True
                rospy.logwarn(
                    "Waiting for %s to come up: controller '%s' has no action server yet (it is used as soon as it is there)",
                    rospy.resolve_name(self.topic),
                    self.name,
                )
            time.sleep(0.05)

    @property
    def connected(self) -> bool:
        return action_links.is_connected(self._client)

    def wait_for_server(self, timeout: float) -> bool:
        """Wait (up to ``timeout`` wall seconds) for the action server."""
        end = time.monotonic() + timeout
        while not self.connected:
            if time.monotonic() > end or rospy.is_shutdown():
                return False
            time.sleep(0.01)
        return True

    def send(self, trajectory: RobotTrajectory) -> bool:
        if not self.wait_for_server(2.0):
            self.reason = (
                f"Action client not connected to action server: {rospy.resolve_name(self.topic)}. Start the "
                f"controller "
                f"'{self.name}' (rosservice call /controller_manager/list_controllers shows those that run)"
            )
            return False
        goal = self._make_goal(trajectory)
        if goal is None:
            return False
        self.reason = ""
        self._completion = completion = Completion()
        completion.begin()
        self._goal = self._client.send_goal(goal, lambda handle: self._changed(completion, handle))
        return True

    def _make_goal(self, trajectory: RobotTrajectory):
        """The action's goal; None, with ``reason``, when the trajectory cannot be one."""
        raise NotImplementedError

    def _changed(self, completion: Completion, handle: actionlib.ClientGoalHandle) -> None:
        if handle.get_comm_state() != actionlib.CommState.DONE:
            return
        state = handle.get_goal_status()
        if completion is self._completion:
            self.reason = self._explain(handle, state, handle.get_result()) or self.reason
        completion.finish(self._status(state))

    def _status(self, state: int) -> ExecutionStatus:
        return _ENDS.get(state, ExecutionStatus.FAILED)

    def _explain(self, handle: actionlib.ClientGoalHandle, state: int, result) -> str:
        text = handle.get_goal_status_text() if state != GoalStatus.SUCCEEDED else ""
        return " ".join(text.split())

    def cancel(self) -> bool:
        if self._completion.finish(ExecutionStatus.PREEMPTED):
            rospy.loginfo("Cancelling execution for %s", self.name)
            if self._goal is not None:
                self._goal.cancel()
        return True

    def wait(self, timeout: float | None = None) -> bool:
        completion = self._completion
        if completion.wait(timeout):
            return True
        if not self.connected and not self._comes_back(completion):
            self.reason = (
                f"the action server {rospy.resolve_name(self.topic)} has gone away during the motion; the "
                f"controller "
                f"'{self.name}' was stopped, or its node has ended"
            )
            return completion.finish(ExecutionStatus.ABORTED) or True
        return False

    def _comes_back(self, completion: Completion) -> bool:
        end = time.monotonic() + _GONE
        while time.monotonic() < end:
            if completion.wait(0.05) or self.connected:
                return True
        return False

    @property
    def status(self) -> ExecutionStatus:
        return self._completion.status


class FollowJointTrajectoryHandle(ActionHandle):
    """A trajectory controller."""

    action = FollowJointTrajectoryAction
    kind = "FollowJointTrajectory"

    def __init__(self, name: str, topic: str, entry: dict[str, Any]):
        self._path = entries.tolerances(entry, "path_tolerance")
        self._end = entries.tolerances(entry, "goal_tolerance")
        self._late = rospy.Duration.from_sec(max(-_LONGEST, min(_LONGEST, entries.number(entry, "goal_time_tolerance"))))
        super().__init__(name, topic, entry)

    def _make_goal(self, trajectory: RobotTrajectory):
        if trajectory.multi_dof_joint_trajectory.points:
            rospy.logwarn("%s cannot execute multi-dof trajectories.", self.name)
        if not trajectory.joint_trajectory.points:
            self.reason = f"the trajectory for '{self.name}' has no points"
            return None
        goal = FollowJointTrajectoryGoal(trajectory=trajectory.joint_trajectory)
        goal.path_tolerance, goal.goal_tolerance, goal.goal_time_tolerance = self._path, self._end, self._late
        rospy.logdebug("sending trajectory to %s", self.name)
        return goal

    def _explain(self, handle: actionlib.ClientGoalHandle, state: int, result) -> str:
        text = super()._explain(handle, state, result)
        if result is None or result.error_code == FollowJointTrajectoryResult.SUCCESSFUL:
            return text
        said = " ".join(result.error_string.split()) or text
        return f"{_RESULTS.get(result.error_code, result.error_code)}{': ' + said if said else ''}"


class GripperCommandHandle(ActionHandle):
    """A gripper: the last point of a trajectory is where it goes."""

    action = GripperCommandAction
    kind = "GripperCommand"

    def __init__(self, name: str, topic: str, entry: dict[str, Any]):
        self._max_effort = entries.number(entry, "max_effort")
        super().__init__(name, topic, entry)

    def _make_goal(self, trajectory: RobotTrajectory):
        points, names = trajectory.joint_trajectory.points, trajectory.joint_trajectory.joint_names
        if trajectory.multi_dof_joint_trajectory.points:
            self.reason = f"{self.name} cannot execute multi-dof trajectories"
            return None
        if not points:
            self.reason = f"{self.name} requires at least one joint trajectory point, but none is given"
            return None
        commanded = self._commanded(names)
        if not commanded:
            self.reason = f"{self.name} found no joint of its own in the trajectory, which moves {', '.join(names)}"
            return None
        goal, last = GripperCommandGoal(), points[-1]
        for index in commanded:
            if index >= len(last.positions):
                self.reason = f"{self.name}: the last point has no position of joint '{names[index]}'"
                return None
            goal.command.position += last.positions[index]
        goal.command.max_effort = last.effort[commanded[-1]] if len(last.effort) > commanded[-1] else self._max_effort
        return goal

    def _commanded(self, names) -> list:
        joints = self._entry["joints"]
        if entries.flag(self._entry, "parallel"):
            return [index for index, name in enumerate(names) if name in joints]
        command = self._entry.get("command_joint", joints[0] if joints else "")
        return [names.index(command)] if command in names else []

    def _status(self, state: int) -> ExecutionStatus:
        if state == GoalStatus.ABORTED and entries.flag(self._entry, "allow_failure"):
            return ExecutionStatus.SUCCEEDED  # it stalled on what it holds
        return super()._status(state)

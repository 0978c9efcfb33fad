"""The action ``move_group``."""

from __future__ import annotations

import motion
import rospy
from moveit_core import states
from moveit_msgs.msg import MotionPlanRequest, MoveGroupAction, MoveItErrorCodes, PlanningScene, RobotState
from moveit_ros_planning.plan_execution import Plan, Segment

from ..capability import ActionCapability, result_text


def current_state_only(request: MotionPlanRequest) -> MotionPlanRequest:
    """The request with the present state as its start: motions that are executed start where the robot is."""
    if states.is_empty(request.start_state):
        return request
    rospy.logwarn(
        "Execution of motions should always start at the robot's current state. Ignoring the state supplied "
        "as start state "
        "in the motion planning request"
    )
    request.start_state = RobotState(is_diff=True)
    return request


def without_robot_state(diff: PlanningScene) -> PlanningScene:
    """The diff without its robot state, for the same reason."""
    if states.is_empty(diff.robot_state):
        return diff
    rospy.logwarn(
        "Execution of motions should always start at the robot's current state. Ignoring the state supplied "
        "as difference in "
        "the planning scene diff"
    )
    diff.robot_state = RobotState(is_diff=True)
    return diff


class MoveAction(ActionCapability):
    """Plans, and executes unless ``plan_only``."""

    title = "MoveAction"
    action_name = "move_group"
    action = MoveGroupAction

    def serve(self, goal, result) -> str:
        if self.stop.is_set():
            return self.failed(result, MoveItErrorCodes.PREEMPTED, "Preempt requested before the goal is planned.")
        self.feedback("PLANNING")
        self.context.monitor.wait_for_state()
        options = goal.planning_options
        plan_only = options.plan_only or self.context.execution is None
        if plan_only and not options.plan_only:
            rospy.logwarn(
                "This instance of MoveGroup is not allowed to execute trajectories but the goal request has "
                "plan_only set to "
                "false. Only a motion plan will be computed anyway."
            )
        if plan_only:
            plan = self._plan(self.context.monitor.copy(options.planning_scene_diff), goal.request)
            result.planning_time = plan.planning_time
        else:
            plan = self._plan_and_execute(goal)
        result.error_code.val = plan.code
        empty = self._fill(plan, result)
        return result_text(plan.code, plan.message, empty, options.plan_only)

    def _fill(self, plan: Plan, result) -> bool:
        """Write the trajectory into the result; True if there is none."""
        trajectory = plan.segments[0].trajectory if plan.segments else None
        if trajectory is None or not len(trajectory):
            return True
        result.trajectory_start = states.robot_state_message(trajectory.start)
        result.planned_trajectory = states.trajectory_message(trajectory)
        if plan.executed is not None:
            result.executed_trajectory = plan.executed
        return False

    def _plan_and_execute(self, goal) -> Plan:
        rospy.loginfo(
            "Combined planning and execution request received for MoveGroup action. Forwarding to planning and execution pipeline."
        )
        options, request = goal.planning_options, current_state_only(goal.request)
        diff = without_robot_state(options.planning_scene_diff)
        return self.plan_execution.plan_and_execute(
            lambda scene: self._plan(scene, request),
            diff,
            self.stop,
            options.replan,
            options.replan_attempts,
            options.replan_delay,
            before=lambda: self.feedback("MONITOR"),
            stops=self.stops,
        )

    def _plan(self, scene: motion.PlanningScene, request: MotionPlanRequest) -> Plan:
        self.feedback("PLANNING")
        result = self.context.plan(scene, request, self.stop.token)
        plan = Plan(result.code, result.message, planning_time=result.planning_time)
        if result.trajectory is not None:
            plan.segments = [Segment(result.trajectory)]
        return plan

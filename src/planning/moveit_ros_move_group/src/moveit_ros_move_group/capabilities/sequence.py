"""Sequences of industrial motions with blending: the action ``sequence_move_group``, the service
``plan_sequence_path``."""

from __future__ import annotations

import motion
import rospy
from moveit_core import states
from moveit_core.errors import PlanningError
from moveit_msgs.msg import MotionSequenceRequest, MoveGroupSequenceAction, MoveItErrorCodes
from moveit_msgs.srv import GetMotionSequence
from moveit_ros_planning.plan_execution import Plan, Segment
from moveit_ros_planning.planning_pipeline import Pipeline

from ..capability import ActionCapability, Capability, result_text, serve
from .move_action import current_state_only, without_robot_state


def plan_sequence(context, scene, request: MotionSequenceRequest, cancel: motion.CancelToken | None = None):
    """Plan a MotionSequenceRequest that is not empty in ``scene``, with ``context``'s pipelines.

    :param cancel: ends it from another thread.
    :raises PlanningError: a request cannot be understood, or there is no pipeline of industrial motions.
    """
    for item in request.items:
        context.display.request(item.req)
    found = _pipeline(context, request.items[0].req.pipeline_id).sequence(
        scene, [(item.req, item.blend_radius) for item in request.items], cancel
    )
    context.display.trajectories(found.trajectories)
    if found.contacts:
        context.display.contacts(found.contacts)
    return found


def _pipeline(context, name: str) -> Pipeline:
    if name:
        return context.pipelines.find(name)
    found = next((pipeline for pipeline in context.pipelines.pipelines.values() if pipeline.is_pilz), None)
    if found is None:
        raise PlanningError(MoveItErrorCodes.FAILURE, "no pipeline plans with pilz_industrial_motion_planner::CommandPlanner")
    return found


def _start_where_the_robot_is(request: MotionSequenceRequest) -> None:
    """The first motion of each group starts where the robot is when it is executed."""
    seen = set()
    for item in request.items:
        if item.req.group_name not in seen:
            seen.add(item.req.group_name)
            current_state_only(item.req)


def _fill(response, trajectories: list[motion.Trajectory]) -> None:
    if trajectories:
        response.sequence_start = states.robot_state_message(trajectories[0].start)
        response.planned_trajectories = [states.trajectory_message(trajectory) for trajectory in trajectories]


class SequenceService(Capability):
    """Plans a sequence."""

    title = "SequenceService"

    def __init__(self, context):
        super().__init__(context)
        self._service = serve("plan_sequence_path", GetMotionSequence, self._plan)

    def _plan(self, request, response) -> None:
        if not request.request.items:
            rospy.logwarn("Received an empty sequence: nothing is planned")
            response.response.error_code.val = MoveItErrorCodes.SUCCESS
            return
        found = plan_sequence(self.context, self.context.monitor.copy(), request.request)
        response.response.error_code.val, response.response.planning_time = found.code, found.planning_time
        _fill(response.response, found.trajectories)


class SequenceAction(ActionCapability):
    """Plans a sequence, and executes it unless ``plan_only``."""

    title = "SequenceAction"
    action_name = "sequence_move_group"
    action = MoveGroupSequenceAction

    def code(self, result) -> int:
        return result.response.error_code.val

    def failed(self, result, code: int, message: str) -> str:
        result.response.error_code.val = code
        return message

    def serve(self, goal, result) -> str:
        self.feedback("PLANNING")
        if not goal.request.items:
            return self.failed(result, MoveItErrorCodes.SUCCESS, "The sequence is empty.")
        self.context.monitor.wait_for_state()
        options = goal.planning_options
        if not options.plan_only and self.context.execution is None:
            rospy.logwarn("Only plan will be calculated, although plan_only == false.")
        if options.plan_only or self.context.execution is None:
            plan = self._plan(self.context.monitor.copy(options.planning_scene_diff), goal.request)
        else:
            _start_where_the_robot_is(goal.request)
            plan = self.plan_execution.plan_and_execute(
                lambda scene: self._plan(scene, goal.request),
                without_robot_state(options.planning_scene_diff),
                self.stop,
                options.replan,
                options.replan_attempts,
                options.replan_delay,
                before=lambda: self.feedback("MONITOR"),
                stops=self.stops,
            )
        result.response.error_code.val, result.response.planning_time = plan.code, plan.planning_time
        _fill(result.response, [segment.trajectory for segment in plan.segments if segment.trajectory is not None])
        return result_text(plan.code, plan.message, not plan.segments, options.plan_only)

    def _plan(self, scene, request: MotionSequenceRequest) -> Plan:
        found = plan_sequence(self.context, scene, request, self.stop.token)
        return Plan(
            found.code,
            found.message,
            [Segment(trajectory, f"sequence {number}") for number, trajectory in enumerate(found.trajectories)],
            found.planning_time,
        )

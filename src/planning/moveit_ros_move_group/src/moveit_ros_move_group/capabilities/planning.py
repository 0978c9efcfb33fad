"""The services ``plan_kinematic_path``, ``query_planner_interface``, ``get_planner_params`` and
``set_planner_params``."""

from __future__ import annotations

from moveit_core import states
from moveit_msgs.msg import PlannerInterfaceDescription
from moveit_msgs.srv import GetMotionPlan, GetPlannerParams, QueryPlannerInterfaces, SetPlannerParams

from ..capability import Capability, serve


class PlanService(Capability):
    """Plans and answers with the trajectory."""

    title = "MotionPlanService"

    def __init__(self, context):
        super().__init__(context)
        self._service = serve("plan_kinematic_path", GetMotionPlan, self._plan)

    def _plan(self, request, response) -> None:
        wanted = request.motion_plan_request
        if wanted.start_state.is_diff:
            self.context.monitor.wait_for_state()
        answer = response.motion_plan_response
        answer.group_name = wanted.group_name
        result = self.context.plan(self.context.monitor.copy(), wanted)
        answer.error_code.val, answer.planning_time = result.code, result.planning_time
        if result.trajectory is not None and len(result.trajectory):
            answer.trajectory_start = states.robot_state_message(result.trajectory.start)
            answer.trajectory = states.trajectory_message(result.trajectory)


class QueryPlanners(Capability):
    """Tells which planners there are, and their settings."""

    title = "QueryPlannersService"

    def __init__(self, context):
        super().__init__(context)
        self._services = [
            serve("query_planner_interface", QueryPlannerInterfaces, self._query),
            serve("get_planner_params", GetPlannerParams, self._get),
            serve("set_planner_params", SetPlannerParams, self._set),
        ]

    def _query(self, _request, response) -> None:
        response.planner_interfaces = [
            PlannerInterfaceDescription(pipeline.title, name, pipeline.planner_ids())
            for name, pipeline in sorted(self.context.pipelines.pipelines.items())
        ]

    def _get(self, request, response) -> None:
        settings = self.context.pipelines.find(request.pipeline_id).configs.get(request.group, request.planner_config)
        response.params.keys, response.params.values = list(settings), list(settings.values())
        response.params.descriptions = [""] * len(settings)

    def _set(self, request, _response) -> None:
        if len(request.params.keys) != len(request.params.values):
            raise ValueError(f"{len(request.params.keys)} keys and {len(request.params.values)} values were given")
        self.context.pipelines.find(request.pipeline_id).configs.set(
            request.group, request.planner_config, request.params.keys, request.params.values, request.replace
        )

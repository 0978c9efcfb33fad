"""Planning pipelines: a planner and the adapters around it, configured from parameters, for MotionPlanRequest
messages."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import motion
import rospy
from dynamic_parameters import Parameter, Server
from moveit_core import convert, states
from moveit_core.errors import MoveItError, PlanningError, code_name, one_line
from moveit_core.scene_messages import attach_to_state
from moveit_msgs.msg import Constraints, MotionPlanRequest, MoveItErrorCodes

from . import industrial
from .compiled import CompiledPipeline, exported
from .planner_configs import PlannerConfigs
from .robot_model import RobotDescription

_OMPL = "ompl_interface/OMPLPlanner"
_PILZ = ("pilz_industrial_motion_planner::CommandPlanner", "pilz_industrial_motion_planner/CommandPlanner")
_PARAMETERS = [
    Parameter("simplify_solutions", bool, True, description="Flag indicating whether computed motion plans are also simplified"),
    Parameter("minimum_waypoint_count", int, 2, 2, 10000, "Set the minimum number of waypoints to include in a motion plan"),
    Parameter(
        "maximum_waypoint_distance",
        float,
        0.0,
        0.0,
        50.0,
        "The maximum distance between consecutive waypoints along the solution path (0.0 means 'ignore')",
    ),
    Parameter("link_for_exploration_tree", str, "", description="Show the exploration tree for a particular link"),
    Parameter("display_random_valid_states", bool, False, description="Flag indicating whether random valid states are to be published"),
]


#: request adapters of planners that are not here, and the parameters that their configuration files give beside OMPL's
_ABSENT = {
    "chomp/OptimizerAdapter": """collision_clearance collision_threshold enable_failure_recovery joint_update_limit learning_rate
        max_iterations max_iterations_after_collision_free max_recovery_attempts min_clearance obstacle_cost_weight planning_time_limit
        pseudo_inverse_ridge_factor ridge_factor smoothness_cost_acceleration smoothness_cost_jerk smoothness_cost_velocity
        smoothness_cost_weight trajectory_initialization_method use_pseudo_inverse use_stochastic_descent""".split(),
    "stomp_moveit/StompSmoothingAdapter": ["stomp"],
}


class PipelineError(MoveItError):
    """A pipeline cannot be made; one line."""


class Pipeline:
    """One pipeline. ``name`` is its pipeline_id, ``namespace`` where its parameters are, ending in "/"."""

    def __init__(self, name: str, namespace: str, description: RobotDescription):
        self.name = name
        self.namespace = namespace
        self._description = description
        self.model = description.model
        plugin = rospy.get_param(namespace + "planning_plugin", "")
        self.plugin = str(plugin)
        self.is_pilz = self.plugin in _PILZ
        self.configs = PlannerConfigs(self.model, namespace)
        parameters = rospy.get_param(namespace.rstrip("/"), {})
        parameters = parameters if isinstance(parameters, dict) else {}
        adapters = str(parameters.get("request_adapters", "")).split()
        self.config: dict[str, Any] = {parameter.name: parameter.default for parameter in _PARAMETERS}
        self._told: set[str] = set()
        self.compiled = self._compiled(adapters)
        if self.compiled is not None:
            rospy.loginfo("Using planning interface '%s' (compiled)", self.title)
            return
        self._settings = {key: value for key, value in parameters.items() if not isinstance(value, (dict, list))}
        self._adapters = motion.Pipeline(adapters, self._settings)
        for warning in self._adapters.warnings:
            rospy.logwarn("%s", warning)
        for adapter, names in _ABSENT.items():
            unused = sorted(name for name in names if name in parameters)
            if adapter in adapters and unused:
                rospy.logwarn("parameters of %s in %s are not used here: %s", adapter, rospy.resolve_name(namespace), ", ".join(unused))
        self._server = None
        self._limits = _cartesian_limits(description)
        if not self.is_pilz:
            self._server = Server(namespace + "ompl", _PARAMETERS, self._reconfigure)
        rospy.loginfo("Using planning interface '%s'", self.title)
        for adapter in self._adapters.adapters:
            rospy.loginfo("Using planning request adapter '%s'", adapter)

    def _compiled(self, adapters: list[str]) -> CompiledPipeline | None:
        """The pipeline as C++, where its planner or one of its adapters is another package's; else None."""
        known = {name.rpartition("/")[2] for name in motion.Pipeline.ADAPTERS}
        own = self.plugin == _OMPL or self.is_pilz
        strangers = [name for name in adapters if name.rpartition("/")[2] not in known]
        if own and (self.is_pilz or not any(name in exported("adapter") for name in strangers)):
            return None
        parameter = rospy.resolve_name(self.namespace + "planning_plugin")
        if self.plugin not in exported("planner"):
            raise PipelineError(_refusal(self.plugin, parameter))
        try:
            return CompiledPipeline(self._description, rospy.resolve_name(self.namespace.rstrip("/")))
        except Exception as error:  # a third party's code and its libraries: nothing of it may take the node down
            raise PipelineError(f"Exception while loading planner '{self.plugin}': {one_line(error, 300)} ({parameter})") from error

    @property
    def title(self) -> str:
        if self.compiled is not None:
            return self.compiled.title
        return "Pilz Industrial Motion Planner" if self.is_pilz else "OMPL"

    def _reconfigure(self, config, _level) -> None:
        self.config = config

    def planner_ids(self) -> list[str]:
        """What query_planner_interface lists."""
        if self.compiled is not None:
            return self.compiled.planner_ids()
        return list(industrial.PLANNERS) if self.is_pilz else self.configs.names()

    def generate(
        self, scene: motion.PlanningScene, message: MotionPlanRequest, cancel: motion.CancelToken | None = None
    ) -> motion.PlanResult:
        """Plan ``message``, with all adapters; the result's trajectory is timed.

        :param scene: the caller's own; its state is where the robot is.
        :param cancel: ends it from another thread.
        :raises PlanningError: the request cannot be understood.
        """
        started = time.monotonic()
        if self.compiled is not None:
            self._check_group(message.group_name)
            result = self.compiled.generate(scene, message, cancel)
        else:
            result = self._generate(scene, self.request(scene, message), cancel)
        took = time.monotonic() - started
        self._warn(result.warnings)
        if result and result.trajectory is not None:
            rospy.loginfo(
                "Planned a motion of %.2f s with %d way points for group '%s' in %.3f s (%s)",
                result.trajectory.duration,
                len(result.trajectory),
                message.group_name,
                took,
                result.planner or self.title,
            )
        else:
            log = rospy.loginfo if result.code == MoveItErrorCodes.PREEMPTED else rospy.logerr
            log("No motion plan for group '%s': %s (%s, after %.3f s)", message.group_name, result.message, code_name(result.code), took)
        return result

    def _warn(self, warnings: list[str]) -> None:
        for warning in warnings:
            if warning not in self._told:
                self._told.add(warning)
                rospy.logwarn("%s", warning)

    def _generate(self, scene, request, cancel) -> motion.PlanResult:
        planner: Callable = self._pilz if self.is_pilz else motion.plan
        return self._adapters.generate(scene, request, cancel, planner)

    def _pilz(self, scene, request, cancel=None):
        return motion.pilz_plan(scene, request, cancel, self._limits)

    def sequence(self, scene, items, cancel=None) -> motion.SequenceResult:
        """Plan a sequence in ``scene``: each goes through the whole pipeline, then they are blended.

        :param items: (MotionPlanRequest, blend radius in m to the next). :param cancel: ends it from another thread.
        :raises PlanningError: one of the requests cannot be understood.
        """
        if self.compiled is not None:
            raise PlanningError(
                MoveItErrorCodes.FAILURE,
                f"pipeline '{self.name}' is compiled ({self.title}): sequences are planned by "
                "pilz_industrial_motion_planner and ompl; name one of them in pipeline_id",
            )
        requests = []
        for number, (message, radius) in enumerate(items, 1):
            try:
                request = self.request(scene, message)
            except PlanningError as error:
                raise PlanningError(error.code, f"motion {number} of the sequence: {error}") from error
            joints = message.start_state.joint_state
            if not (joints.name or joints.position or joints.velocity or joints.effort):  # then it starts where the one before ends
                request = replace(request, start=None)
            requests.append((request, float(radius)))
        result = motion.pilz_sequence(scene, requests, cancel, self._limits, plan=self._generate)
        self._warn(result.warnings)
        if not result:
            log = rospy.loginfo if result.code == MoveItErrorCodes.PREEMPTED else rospy.logerr
            log("No motion plan for the sequence: %s (%s, after %.3f s)", result.message, code_name(result.code), result.planning_time)
        return result

    # --- requests ---

    def request(self, scene: motion.PlanningScene, message: MotionPlanRequest) -> motion.MotionRequest:
        """A MotionPlanRequest ``message`` as the library takes it, in ``scene``.

        :raises PlanningError: with the code and one line.
        """
        group = message.group_name
        fields: dict[str, Any] = {}
        if self.is_pilz:
            solver = self._description.kinematics.get(group)
            message, fields["auxiliary"] = industrial.prepared(message, scene, solver is not None)
            fields["position_only"] = solver is not None and solver.position_only
        self._check_group(group)
        self._warn(self._unused(message))
        start = self._start(scene, message)
        goals = self._goals(scene, message)
        path = self._path_constraints(scene, message.path_constraints)
        name, settings = (message.planner_id, {}) if self.is_pilz else self.configs.find(group, message.planner_id)
        if not self.is_pilz:
            fields = self._planner_fields(settings)
        return motion.MotionRequest(
            group,
            goals=goals,
            start=start,
            path_constraints=None if path.empty() else path,
            planner=name if self.is_pilz else settings.pop("type"),
            planner_params=settings,
            planning_time=self._planning_time(message),
            attempts=max(1, message.num_planning_attempts),
            velocity_scaling=self._scaling(message.max_velocity_scaling_factor, "max_velocity_scaling_factor"),
            acceleration_scaling=self._scaling(message.max_acceleration_scaling_factor, "max_acceleration_scaling_factor"),
            workspace=_workspace(message),
            cartesian_link=message.cartesian_speed_limited_link,
            cartesian_speed=message.max_cartesian_speed,
            **fields,
        )

    def _unused(self, message: MotionPlanRequest) -> list[str]:
        """A line for each thing that the request says and nobody here looks at."""
        lines = [
            f"the request has {name}, which planner '{self.title}' does not use: they are ignored"
            for name, given in (
                ("trajectory_constraints", message.trajectory_constraints.constraints),
                ("reference_trajectories", message.reference_trajectories),
            )
            if given
        ]
        if message.max_cartesian_speed > 0 and "LimitMaxCartesianLinkSpeed" not in self._adapters.adapters:
            lines.append(
                "the request has max_cartesian_speed, which is ignored: there is no default_planner_request_adapters/"
                f"LimitMaxCartesianLinkSpeed in {rospy.resolve_name(self.namespace + 'request_adapters')}"
            )
        return lines

    def _check_group(self, group: str) -> None:
        if not group:
            raise PlanningError(MoveItErrorCodes.INVALID_GROUP_NAME, "the request names no group")
        if not self.model.has_group(group):
            raise PlanningError(
                MoveItErrorCodes.FAILURE,
                f"the robot '{self.model.name}' has no group '{group}'; it has: " + (", ".join(self.model.groups) or "none"),
            )

    def _planner_fields(self, settings: dict[str, str]) -> dict[str, Any]:
        fields: dict[str, Any] = {
            "simplify": self.config["simplify_solutions"],
            "maximum_waypoint_distance": self.config["maximum_waypoint_distance"],
            "minimum_waypoint_count": self.config["minimum_waypoint_count"],
        }
        for key, name, make in (
            ("longest_valid_segment_fraction", "longest_valid_segment_fraction", float),
            ("projection_evaluator", "projection", str),
            ("interpolate", "interpolate", _truth),
            ("simplify_solutions", "simplify", _truth),
            ("hybridize", "hybridize", _truth),
            ("maximum_waypoint_distance", "maximum_waypoint_distance", float),
            ("minimum_waypoint_count", "minimum_waypoint_count", int),
            ("enforce_joint_model_state_space", "enforce_joint_space", _truth),
        ):
            if key not in settings:
                continue
            text = settings.pop(key)
            try:
                fields[name] = make(text)
            except ValueError:
                rospy.logwarn("planner setting %s is '%s', which is not understood: ignored", key, one_line(text, 40))
        settings.pop("enforce_constrained_state_space", None)
        return fields

    @staticmethod
    def _planning_time(message: MotionPlanRequest) -> float:
        if message.allowed_planning_time > 0:
            return message.allowed_planning_time
        rospy.loginfo(
            "The timeout for planning must be positive (%g specified). Assuming one second instead.", message.allowed_planning_time
        )
        return 1.0

    @staticmethod
    def _scaling(value: float, name: str) -> float:
        if 0.0 < value <= 1.0:
            return value
        if value != 0.0:
            rospy.logwarn("Invalid %s = %g specified, it must be in (0, 1]; 1.0 is used", name, value)
        return 1.0

    def _start(self, scene, message: MotionPlanRequest) -> motion.RobotState:
        state = scene.state
        if states.is_empty(message.start_state):
            return state
        try:
            states.apply_robot_state(scene, state, message.start_state, attach_to_state(scene))
        except (ValueError, motion.MotionError) as error:
            raise PlanningError(MoveItErrorCodes.INVALID_ROBOT_STATE, f"start state: {error}") from error
        return state

    def _goals(self, scene, message: MotionPlanRequest) -> list[motion.Constraints]:
        goals = [self._constraints(scene, goal, MoveItErrorCodes.INVALID_GOAL_CONSTRAINTS) for goal in message.goal_constraints]
        goals = [goal for goal in goals if not goal.empty()]
        if not goals:
            raise PlanningError(
                MoveItErrorCodes.INVALID_GOAL_CONSTRAINTS,
                "the request has no goal: set a pose, joint or named target first (a target that was cleared is none)",
            )
        group = self.model.group(message.group_name)
        if not self.is_pilz:  # whose motions keep the orientation as far as the arm can
            self._loosen(message.group_name, goals)
        for constraint in {entry.joint: entry for goal in goals for entry in goal.joint}.values():
            if not self.is_pilz:  # which refuse such a goal
                self._warn_beyond(constraint)
        for goal in goals:
            full = {constraint.joint for constraint in goal.joint} >= set(group.active_joints)
            if (goal.position or goal.orientation) and not full and not self.has_kinematics(message.group_name):
                raise PlanningError(MoveItErrorCodes.FAILURE, _no_kinematics(message.group_name, self._description))
        return goals

    def _warn_beyond(self, constraint: motion.JointConstraint) -> None:
        """Say where a joint goal lies beyond the limits; planning takes the limit, as upstream does."""
        if not self.model.has_joint(constraint.joint):
            return
        joint = self.model.joint(constraint.joint)
        bounds = joint.limits[0] if len(joint.variables) == 1 else None
        if bounds is None or joint.type == "continuous" or not bounds.has_position:
            return
        if constraint.position > bounds.max_position + 1e-9 or constraint.position < bounds.min_position - 1e-9:
            limit = bounds.max_position if constraint.position > bounds.max_position else bounds.min_position
            rospy.logwarn(
                "Joint %s is constrained to be at %.4g, beyond its limits %.4g to %.4g. Assuming %.4g instead.",
                constraint.joint,
                constraint.position,
                bounds.min_position,
                bounds.max_position,
                limit,
            )

    def _loosen(self, group: str, goals: list[motion.Constraints]) -> None:
        """Where kinematics.yaml says position_only_ik, a pose goal is its position: such an arm cannot keep the rest."""
        settings = self._description.kinematics.get(group)
        if settings is None or not settings.position_only:
            return
        for goal in goals:
            placed = {constraint.link for constraint in goal.position}
            kept = [constraint for constraint in goal.orientation if constraint.link not in placed]
            if len(kept) < len(goal.orientation):
                rospy.loginfo("group '%s' has position_only_ik: the orientation of the goal is not looked at", group)
                goal.orientation = kept

    def has_kinematics(self, group: str) -> bool:
        """Whether kinematics.yaml gives the group, or groups in it, a solver."""
        return group in self._description.kinematics or bool(self._description.solved_parts(group))

    @staticmethod
    def _constraints(scene, message: Constraints, code: int) -> motion.Constraints:
        try:
            return convert.constraints(message, scene)
        except (ValueError, motion.MotionError) as error:
            raise PlanningError(code, str(error)) from error

    @staticmethod
    def _path_constraints(scene, message: Constraints) -> motion.Constraints:
        try:
            return convert.path_constraints(message, scene, rospy.logwarn)
        except (ValueError, motion.MotionError) as error:
            raise PlanningError(MoveItErrorCodes.INVALID_GOAL_CONSTRAINTS, str(error)) from error


def _no_kinematics(group: str, description: RobotDescription) -> str:
    return (
        f"group '{group}' has no kinematics solver, so a pose cannot be its goal: kinematics.yaml "
        f"({description.name}_kinematics/{group}/kinematics_solver) names none. Give it "
        f"kinematics_solver: kdl_kinematics_plugin/KDLKinematicsPlugin, or set joint values as the goal"
    )


def _truth(text: str) -> bool:
    return str(text).strip().lower() in ("1", "true", "yes", "on")


def _workspace(message: MotionPlanRequest):
    low, high = message.workspace_parameters.min_corner, message.workspace_parameters.max_corner
    corners = (low.x, low.y, low.z), (high.x, high.y, high.z)
    return corners if any(any(corner) for corner in corners) else None


def _cartesian_limits(description: RobotDescription) -> motion.CartesianLimits:
    given = description.planning("cartesian_limits", {})
    given = given if isinstance(given, dict) else {}
    names = ("max_trans_vel", "max_trans_acc", "max_trans_dec", "max_rot_vel")
    braking = {
        joint: float(limits["max_deceleration"])
        for joint, limits in description.joint_limits.items()
        if limits.get("has_deceleration_limits") and "max_deceleration" in limits
    }
    numbers = {key: float(given[key]) for key in names if isinstance(given.get(key), (int, float))}
    return motion.CartesianLimits(**numbers, joint_deceleration=braking)


def _refusal(plugin: str, parameter: str) -> str:
    if not plugin:
        return f"{parameter} is not set: this pipeline has no planner"
    there = ", ".join(sorted({_PILZ[0], *exported("planner")}))
    return (
        f"Exception while loading planner '{plugin}': it does not exist here, no package exports it; there are: {there}. "
        f"Requests for this pipeline fail; use pipeline:=ompl ({parameter})"
    )

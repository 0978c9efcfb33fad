"""Runs a benchmark: every planner on every problem, as often as asked for."""

from __future__ import annotations

import copy
import datetime
import os
import socket
import time
from dataclasses import dataclass

import motion
import numpy as np
import rospy
from moveit_core import convert, states
from moveit_core.errors import PlanningError
from moveit_core.scene_messages import SceneEditor, scene_message
from moveit_msgs.msg import Constraints, JointConstraint, MotionPlanRequest, PlanningScene
from moveit_ros_planning import robot_model
from moveit_ros_planning.planning_pipeline import Pipeline, PipelineError
from moveit_ros_warehouse.location import connect
from moveit_ros_warehouse.storage import Warehouse
from tf.transformations import quaternion_from_euler

from . import log, metrics
from .options import Options, OptionsError

_TOLD_EVERY = 10.0  # s: at which run a planner is


@dataclass
class Problem:
    """One request and its name."""

    name: str
    request: MotionPlanRequest


class Executor:
    """A benchmark on the robot of the parameters.

    :raises robot_model.DescriptionError, OptionsError: there is no robot, or it lacks what the options name.
    """

    def __init__(self, options: Options):
        self.options = options
        self._description = robot_model.load()
        self._model = self._description.model
        if not self._model.has_group(options.group):
            raise OptionsError(f"the robot '{self._model.name}' has no group '{options.group}'; it has: {', '.join(self._model.groups)}")
        self._pipelines = {name: self._pipeline(name, planners) for name, planners in options.pipelines.items()}
        self._scene = robot_model.prepare_scene(self._description)

    def _pipeline(self, name: str, planners: list[str]) -> Pipeline:
        namespace = f"~{name}/"
        if not rospy.has_param(namespace + "planning_plugin"):
            if rospy.has_param(f"~planning_pipelines/{name}/planning_plugin"):
                namespace = f"~planning_pipelines/{name}/"
            elif rospy.has_param("~planner_configs"):  # old launch files load ompl_planning.yaml beside the node
                namespace = "~"
                if not rospy.has_param("~planning_plugin"):
                    rospy.set_param("~planning_plugin", "ompl_interface/OMPLPlanner")
            else:
                raise OptionsError(
                    f"Planning pipeline '{name}' does NOT exist: {rospy.resolve_name(namespace)}planning_plugin is not "
                    f'set; include planning_pipeline.launch.xml with ns="{rospy.get_name().lstrip("/")}"'
                )
        try:
            pipeline = Pipeline(name, namespace, self._description)
        except PipelineError as error:
            raise OptionsError(str(error)) from error
        known = pipeline.planner_ids()
        for planner in planners:
            if planner not in known and f"{self.options.group}[{planner}]" not in known:
                mine = [entry[len(self.options.group) + 1 : -1] for entry in known if entry.startswith(self.options.group + "[")]
                raise OptionsError(
                    f"Planner '{planner}' does NOT exist for group '{self.options.group}' in pipeline '{name}'; "
                    f"there are: {', '.join(mine or known)}"
                )
        return pipeline

    # --- problems ---

    def load(self, warehouse: Warehouse | None) -> list[Problem]:
        """The problems: stored goals, queries and trajectory constraints with every start and path constraint.

        :param warehouse: needed where the options name something that is stored.
        :raises OptionsError: the scene is not there, or there is nothing to solve.
        """
        options = self.options
        if options.scene and warehouse is not None:
            self._load_scene(warehouse)
        starts = self._stored(warehouse, "states", options.start_states)
        paths = self._stored(warehouse, "constraints", options.path_constraints)
        found = []
        for name, goal in self._stored(warehouse, "constraints", options.goal_constraints).items():
            found += self._combined(name, self._request(goal_constraints=[self._shifted(goal)]), starts, paths)
        for name in self._queries(warehouse):
            assert warehouse is not None  # it has the queries
            request = warehouse.requests.load(name, scene=options.scene)
            self._complete(request)
            found += self._combined(name, request, starts, paths)
        for name, goal in self._stored(warehouse, "trajectory_constraints", options.trajectory_constraints).items():
            found += self._combined(name, self._request(trajectory_constraints=goal), starts, {})
        if not found:
            raise OptionsError(
                f"there is nothing to solve: scene '{options.scene}' has no query that fits '{options.queries}', and "
                f"goal_constraints names none"
            )
        return found

    def combine_poses(self) -> list[Problem]:
        """From each of the predefined poses to each other.

        :raises OptionsError: fewer than two of them exist.
        """
        group = self.options.predefined_poses_group or self.options.group
        known = self._model.group(group).named_states if self._model.has_group(group) else []
        poses = [pose for pose in self.options.predefined_poses if pose in known]
        for pose in set(self.options.predefined_poses) - set(poses):
            rospy.logerr("group '%s' has no pose '%s'; it has: %s", group, pose, ", ".join(known) or "none")
        if len(poses) < 2:
            raise OptionsError("predefined_poses must name two poses of the group or more")
        found = []
        for start in poses:
            for goal in poses:
                if start == goal:
                    continue
                state = self._model.state()
                state.set_named(group, goal)
                names = self._model.group(self.options.group).variables
                wanted = Constraints(
                    name=goal, joint_constraints=[JointConstraint(name, state.get(name), 1e-4, 1e-4, 1.0) for name in names]
                )
                first = self._model.state()
                first.set_named(group, start)
                found.append(
                    Problem(f"{start}_{goal}", self._request(goal_constraints=[wanted], start_state=states.robot_state_message(first)))
                )
        return found

    def _load_scene(self, warehouse: Warehouse) -> None:
        name = self.options.scene
        if warehouse.scenes.has(name):
            message = warehouse.scenes.load(name)
            if message.robot_model_name not in ("", self._model.name):
                message = PlanningScene(name=name, world=message.world, is_diff=True)
        elif warehouse.worlds.has(name):
            message = PlanningScene(name=name, world=warehouse.worlds.load(name), is_diff=True)
        else:
            raise OptionsError(
                f"Failed to find planning scene '{name}' in {warehouse.path}; there are: {', '.join(warehouse.scenes.names()) or 'none'}"
            )
        SceneEditor(self._scene, rospy.logwarn).planning_scene(message)

    @staticmethod
    def _stored(warehouse: Warehouse | None, what: str, pattern: str) -> dict[str, object]:
        if not pattern:
            return {}
        collection = getattr(warehouse, what)
        names = collection.names(pattern)
        if not names:
            rospy.logwarn("No stored %s fit '%s'; there are: %s", what.replace("_", " "), pattern, ", ".join(collection.names()) or "none")
        return {name: collection.load(name) for name in names}

    def _queries(self, warehouse: Warehouse | None) -> list[str]:
        if not self.options.queries or warehouse is None:
            return []
        return warehouse.requests.names(self.options.queries, scene=self.options.scene)

    def _request(self, **fields) -> MotionPlanRequest:
        request = MotionPlanRequest(**fields)
        self._complete(request)
        return request

    def _complete(self, request: MotionPlanRequest) -> None:
        request.group_name, request.allowed_planning_time = self.options.group, self.options.timeout
        request.num_planning_attempts = 1
        space = request.workspace_parameters
        corners = (space.min_corner.x, space.min_corner.y, space.min_corner.z, space.max_corner.x, space.max_corner.y, space.max_corner.z)
        if not any(corners):
            frame, low, high = self.options.workspace or ("", (-5.0,) * 3, (5.0,) * 3)
            space.header.frame_id = frame
            space.min_corner.x, space.min_corner.y, space.min_corner.z = low
            space.max_corner.x, space.max_corner.y, space.max_corner.z = high

    def _shifted(self, goal: Constraints) -> Constraints:
        """A goal with one pose, moved by the goal offset in its own frame."""
        if (
            not any(self.options.goal_offset)
            or len(goal.position_constraints) != 1
            or len(goal.orientation_constraints) != 1
            or not goal.position_constraints[0].constraint_region.primitive_poses
        ):
            return goal
        goal = copy.deepcopy(goal)
        place, turn = goal.position_constraints[0].constraint_region.primitive_poses[0], goal.orientation_constraints[0]
        place.orientation, at = turn.orientation, place.position
        pose = convert.pose(place) * motion.Pose(
            np.array(self.options.goal_offset[:3]), np.array(quaternion_from_euler(*self.options.goal_offset[3:], axes="rxyz"))
        )
        at.x, at.y, at.z = pose.position
        turn.orientation.x, turn.orientation.y, turn.orientation.z, turn.orientation.w = pose.quaternion
        return goal

    @staticmethod
    def _combined(name: str, request: MotionPlanRequest, starts, paths) -> list[Problem]:
        found = []
        for start, state in (starts or {"": None}).items():
            if start == name:  # from a goal to itself
                continue
            for path, constraints in (paths or {"": None}).items():
                own = copy.deepcopy(request)
                if state is not None:
                    own.start_state = state
                if constraints is not None:
                    own.path_constraints = constraints
                found.append(Problem("_".join(part for part in (start, name, path) if part), own))
        return found

    # --- runs ---

    def run(self, problems: list[Problem]) -> list[str]:
        """Run all ``problems``; the log files, one for each problem."""
        files: list[str] = []
        for number, problem in enumerate(problems, 1):
            rospy.loginfo("Benchmarking query '%s' (%d of %d)", problem.name, number, len(problems))
            setup = f"Motion plan request:\n{problem.request}\nPlanning scene: \n{scene_message(self._scene)}"
            started = datetime.datetime.now().isoformat()
            begun = time.monotonic()
            entry = log.Log(
                problem.name.replace(" ", "_"), socket.gethostname() or "UNKNOWN", started, setup, self.options.timeout, self.options.runs
            )
            for name, planners in self.options.pipelines.items():
                for planner in planners:
                    entry.planners[f"{planner} ({name})"] = self._runs(self._pipelines[name], planner, problem)
                    if rospy.is_shutdown():
                        return files
            entry.duration = time.monotonic() - begun
            files.append(self._write(entry))
        return files

    def _runs(self, pipeline: Pipeline, planner: str, problem: Problem) -> list[log.Run]:
        request = copy.deepcopy(problem.request)
        request.planner_id = planner
        runs, trajectories, times = [], [], []
        for number in range(1, self.options.runs + 1):
            if rospy.is_shutdown():
                break
            rospy.loginfo_throttle(_TOLD_EVERY, f"{planner} ({pipeline.name}): run {number} of {self.options.runs}")
            start, result = time.monotonic(), None
            try:
                result = pipeline.generate(self._scene.copy(), request)
            except PlanningError as error:
                rospy.logerr_once("%s: %s", problem.name, error)
            times.append(time.monotonic() - start)
            runs.append(metrics.of_run(self._scene, result, times[-1], result.planning_time if result else 0.0))
            trajectories.append(result.trajectory if result else None)
        metrics.add_similarity(runs, trajectories)
        solved = sum(trajectory is not None for trajectory in trajectories)
        rospy.loginfo(
            "%s (%s): %d of %d solved, %.3f s in the middle",
            planner,
            pipeline.name,
            solved,
            len(runs),
            float(np.median(times)) if times else 0.0,
        )
        return runs

    def _write(self, entry: log.Log) -> str:
        folder = os.path.expanduser(self.options.output_directory) or "."
        parts = (self.options.name, entry.name, entry.host, entry.started)
        file = os.path.abspath(os.path.join(folder, "_".join(part for part in parts if part).replace(os.path.sep, "_") + ".log"))
        os.makedirs(os.path.dirname(file), exist_ok=True)
        with open(file, "w", encoding="utf-8") as out:
            out.write(log.write(entry))
        rospy.loginfo("Benchmark results saved to '%s'", file)
        return file


def open_warehouse(options: Options) -> Warehouse | None:
    """The warehouse, where the options name something that is stored."""
    stored = (options.scene, options.start_states, options.goal_constraints, options.path_constraints, options.trajectory_constraints)
    return connect(options.host) if any(stored) else None

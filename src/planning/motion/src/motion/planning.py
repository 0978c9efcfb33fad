"""Planning requests, their results, and goals made easily."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from motion import _core
from motion.kinematics import AnyPose
from motion.pose import Pose
from motion.trajectory import Trajectory

# MoveItErrorCodes as upstream's OMPL interface gives them.
CODES: dict[str, int] = {
    "solved": 1,
    "approximate": -1,
    "timeout": -6,
    "cancelled": -7,
    "invalid_group": -15,
    "invalid_start": -26,
    "start_in_collision": -10,
    "start_violates_path_constraints": -11,
    "no_goal": -16,
    "invalid_goal": -27,
    "goal_in_collision": -27,
    "goal_violates_path_constraints": -27,
    "no_ik": -27,
    "unknown_link": -16,
    "unknown_frame": -21,
    "unknown_planner": -1,
    "invalid_plan": -2,
    "invalid_request": -16,
    "invalid_state": -17,
    "invalid_link": -18,
    "failed": -1,
    "no_ik_solution": -31,
    "failure": 99999,
}


@dataclass(frozen=True)
class AuxiliaryPoint:
    """What a circle goes by.

    :param kind: ``interim``, a point that it passes, or ``center``.
    :param position: (3,) m in ``frame`` ("" = model frame).
    :param link: moved along the circle where the goal is one of joint values.
    """

    kind: str
    position: Sequence[float]
    frame: str = ""
    link: str = ""


@dataclass
class MotionRequest:
    """What to plan.

    :param group: name of the planning group.
    :param goals: alternatives: any one of them is to be reached.
    :param start: the whole robot at the start; None = the scene's state.
    :param path_constraints: to be kept all the way.
    :param planner: "RRTConnect", "geometric::RRTConnect", "" (RRTConnect).
    :param planner_params: keys of ompl_planning.yaml; what the planner does not know becomes a warning of the result.
    :param planning_time: s, simplification included.
    :param attempts: planners side by side; the best of their paths is kept, parts of them joined where that is shorter.
    :param workspace: (lower (3,), upper (3,)) corner in m for planar and floating joints without limits.
    :param seed: an integer makes runs repeat exactly (several attempts then run one after the other).
    :param longest_valid_segment_fraction: of the joint space's extent, between checked states.
    :param threads: of several attempts; 0 = four.
    :param auxiliary: of CIRC; without it, its path constraints named ``interim`` or ``center`` give it.
    :param position_only: industrial motions bring their link to positions, and leave its orientation to the arm.
    :param cartesian_link: link whose speed `cartesian_speed` (m/s, 0 = any) limits; used by the Pipeline.
    """

    group: str
    goals: Sequence[_core.Constraints] = ()
    start: _core.RobotState | None = None
    path_constraints: _core.Constraints | None = None
    planner: str = ""
    planner_params: Mapping[str, object] = field(default_factory=dict)
    planning_time: float = 5.0
    attempts: int = 1
    velocity_scaling: float = 1.0
    acceleration_scaling: float = 1.0
    workspace: tuple[Sequence[float], Sequence[float]] | None = None
    seed: int | None = None
    simplify: bool = True
    interpolate: bool = True
    hybridize: bool = True
    longest_valid_segment_fraction: float = 0.01
    maximum_waypoint_distance: float = 0.0
    minimum_waypoint_count: int = 2
    projection: str = ""
    max_goal_samples: int = 10
    enforce_joint_space: bool = False
    threads: int = 0
    auxiliary: AuxiliaryPoint | None = None
    position_only: bool = False
    cartesian_link: str = ""
    cartesian_speed: float = 0.0


@dataclass
class PlanResult:
    """What planning gave; true in a condition if there is a trajectory that may be used.

    :param status: one word, see CODES; `code` is its MoveItErrorCodes value.
    :param message: one sentence for the user; "" on success.
    :param trajectory: the path (untimed from `plan`, timed from a Pipeline).
    :param planning_time: s, `simplify_time` of it for simplification.
    :param states: states checked. `goals`: goal states found.
    :param added_prefix: way points that adapters put before the planned ones.
    :param invalid: indices of way points that a later check found bad; `contacts` of the first of them.
    """

    status: str
    message: str = ""
    trajectory: Trajectory | None = None
    start: _core.RobotState | None = None
    planner: str = ""
    planning_time: float = 0.0
    simplify_time: float = 0.0
    states: int = 0
    attempts: int = 0
    goals: int = 0
    warnings: list[str] = field(default_factory=list)
    added_prefix: list[int] = field(default_factory=list)
    invalid: list[int] = field(default_factory=list)
    contacts: list[_core.Contact] = field(default_factory=list)

    @property
    def code(self) -> int:
        return CODES.get(self.status, 99999)

    @property
    def path(self) -> np.ndarray:
        """(k, n) group values; (0, 0) without a trajectory."""
        return np.zeros((0, 0)) if self.trajectory is None else self.trajectory.positions

    def __bool__(self) -> bool:
        return self.status == "solved"


def pose_goal(
    link: str, pose: AnyPose, position_tolerance: float = 1e-4, orientation_tolerance: float = 1e-3, frame: str = ""
) -> _core.Constraints:
    """``link`` at ``pose``, given in ``frame`` ("" = model frame).

    :param position_tolerance: radius of a ball, m. :param orientation_tolerance: of three angles, rad.
    :raises InvalidInputError: a quaternion of zero.
    """
    position, quaternion = pose
    region = [(_core.Sphere(position_tolerance), Pose(np.asarray(position, float), np.array([0.0, 0, 0, 1])))]
    norm = float(np.linalg.norm(quaternion))
    if not norm > 1e-6:
        raise _core.InvalidInputError("the quaternion of a pose is zero or not finite: (0, 0, 0, 1) is no rotation")
    return _core.Constraints(
        position=[_core.PositionConstraint(link, region, frame=frame)],
        orientation=[_core.OrientationConstraint(link, np.asarray(quaternion, float) / norm, (orientation_tolerance,) * 3, frame=frame)],
    )


def joint_goal(
    model: _core.RobotModel, group: str, values: Mapping[str, float] | Sequence[float], tolerance: float = 1e-4
) -> _core.Constraints:
    """Joint ``values`` of ``group``: a mapping of variables, or all of the group in the order that ``model`` has; rad or m.

    :param tolerance: to either side. :raises InvalidInputError: more or fewer values than the group has variables.
    """
    if not isinstance(values, Mapping):
        names = model.group(group).variables
        if len(values) != len(names):
            raise _core.InvalidInputError(f"group '{group}' has {len(names)} variables, but {len(values)} values were given")
        values = dict(zip(names, values))
    return _core.Constraints(joint=[_core.JointConstraint(name, float(value), tolerance, tolerance) for name, value in values.items()])


def named_goal(model: _core.RobotModel, group: str, name: str) -> _core.Constraints:
    """The state ``name`` of ``group`` in the SRDF of ``model``; joints that it does not name are where they are by default."""
    model.group(group).named_state(name)
    state = model.state()
    state.set_named(group, name)
    return joint_goal(model, group, state.get_group(group))


def planner_problem(name: str, params: Mapping[str, object] = {}) -> str:
    """What is wrong with a planner's ``name`` or its parameters ``params``; "" if nothing."""
    return _core._planner_problem(name, {str(key): _text(value) for key, value in params.items()})


def _compiled(request: MotionRequest) -> _core._PlanRequest:
    out = _core._PlanRequest()
    out.group = request.group
    out.goals = list(request.goals)
    out.path = request.path_constraints or _core.Constraints()
    out.planner = request.planner
    out.parameters = {str(key): _text(value) for key, value in request.planner_params.items()}
    out.time = float(request.planning_time)
    out.attempts = max(1, int(request.attempts))
    out.seed = None if request.seed is None else int(request.seed) % 2**63
    out.simplify, out.interpolate, out.hybridize = request.simplify, request.interpolate, request.hybridize
    out.segment_fraction = float(request.longest_valid_segment_fraction)
    out.maximum_waypoint_distance = float(request.maximum_waypoint_distance)
    out.minimum_waypoints = int(request.minimum_waypoint_count)
    out.projection = request.projection
    out.goal_samples, out.threads = int(request.max_goal_samples), int(request.threads)
    if request.workspace is not None:
        out.set_workspace(*request.workspace)
    return out


def _text(value: object) -> str:
    return str(int(value)) if isinstance(value, bool) else str(value)


def _refusal(error: _core.MotionError) -> str:
    text = str(error)
    for kind, status in (("no group", "invalid_group"), ("no link", "unknown_link"), ("no frame", "unknown_frame")):
        if isinstance(error, _core.UnknownNameError) and text.startswith(kind):
            return status
    return "invalid_request"


def plan(scene: _core.PlanningScene, request: MotionRequest, cancel: _core.CancelToken | None = None) -> PlanResult:
    """A path from the start to one of the goals that touches nothing in ``scene``. Never raises for what a request says: see status.

    A planner looks at states that are `longest_valid_segment_fraction` apart, and a path may cut a corner between them.
    Each path is therefore looked at closely in the end; one that does is planned again with a quarter of that distance.

    :param cancel: ends the search from another thread.
    """
    start = request.start if request.start is not None else scene.state
    try:
        compiled = _compiled(request)
        warnings = [p for p in [_core._planner_problem(request.planner, compiled.parameters)] if p and "has no parameter" in p]
        found = _core._plan(scene, start, compiled, cancel)
    except _core.MotionError as error:
        return PlanResult(_refusal(error), message=str(error), start=start, planner=request.planner)
    path = found.pop("path")
    trajectory = Trajectory(scene.model, request.group, start, path) if found["status"] in ("solved", "invalid_plan") else None
    found["warnings"] = warnings + found["warnings"]
    return PlanResult(trajectory=trajectory, start=start, **found)

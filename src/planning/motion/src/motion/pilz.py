"""Industrial motions as in pilz_industrial_motion_planner: point to point, along a line, along a circle."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from motion import _core
from motion.kinematics import ik
from motion.planning import AuxiliaryPoint, MotionRequest, PlanResult
from motion.pose import Pose
from motion.timing import above_zero
from motion.trajectory import Trajectory

SAMPLING = 0.1  # s, as upstream
_RADII = 1e-2  # m by which the distances of start and goal from a circle's centre may differ, as upstream
_COLLINEAR = 1e-5  # of a cross product, below which three points lie on one line, as upstream
_UNSET = 1.0  # rad/s, rad/s^2 where the robot says nothing


@dataclass(frozen=True)
class CartesianLimits:
    """Of cartesian_limits.yaml: m/s, m/s^2, m/s^2 (negative), rad/s; and of joint_limits.yaml the ``max_deceleration`` of joints that have
    one (rad/s^2 or m/s^2, negative)."""

    max_trans_vel: float = 1.0
    max_trans_acc: float = 2.25
    max_trans_dec: float = -5.0
    max_rot_vel: float = 1.57
    joint_deceleration: Mapping[str, float] = field(default_factory=dict)


class _Refused(Exception):
    def __init__(self, status: str, message: str):
        super().__init__(message)
        self.status = status


class _Trapeze:
    """Speeding up, cruising, braking along a way of some length."""

    def __init__(self, length: float, speed: float, up: float, down: float):
        if not (speed > 0 and up > 0 and down > 0):
            raise _Refused("failed", "the velocity and acceleration limits must be above 0")
        top = min(speed, float(np.sqrt(2 * length * up * down / (up + down))))
        self.length, self.top, self.up, self.down = length, top, up, down
        self.t_up, self.t_down = top / up, top / down
        self.t_cruise = max(0.0, (length - 0.5 * top * (self.t_up + self.t_down)) / top) if top > 0 else 0.0
        self.duration = self.t_up + self.t_cruise + self.t_down

    def at(self, t: float) -> tuple[float, float, float]:
        """(way, speed, acceleration) after t s."""
        left = self.duration - t
        if t <= 0 or left <= 0:
            return (0.0, 0.0, self.up) if t <= 0 else (self.length, 0.0, -self.down)
        if t < self.t_up:
            return 0.5 * self.up * t * t, self.up * t, self.up
        if left < self.t_down:
            return self.length - 0.5 * self.down * left * left, self.down * left, -self.down
        return 0.5 * self.top * self.t_up + self.top * (t - self.t_up), self.top, 0.0

    def times(self) -> np.ndarray:
        """0, every sampling time, and the end; the last interval is never so short that rounding would count in it."""
        steps: np.ndarray = np.arange(0.0, self.duration, SAMPLING)
        if len(steps) > 1 and self.duration - steps[-1] < 0.2 * SAMPLING:
            steps = steps[:-1]
        return np.append(steps, self.duration)


def _scalings(request: MotionRequest) -> tuple[float, float]:
    scalings = request.velocity_scaling, request.acceleration_scaling
    for value in scalings:
        if not 0.0001 <= value <= 1.0:
            raise _Refused("invalid_plan", f"velocity and acceleration scaling must be in [0.0001, 1], not {value:g}")
    return scalings


def _goal(scene: _core.PlanningScene, request: MotionRequest) -> _core.Constraints:
    goals = [goal for goal in request.goals if not goal.empty()]
    if len(goals) != 1:
        raise _Refused("no_goal", f"{request.planner} needs exactly one goal, not {len(goals)}")
    (goal,) = goals
    if goal.joint and (goal.position or goal.orientation):
        raise _Refused("no_goal", f"{request.planner} needs a goal of joint values or of a pose, not of both")
    for constraint in goal.joint:
        _check_joint(scene.model, request.group, constraint)
    return goal


def _check_joint(model: _core.RobotModel, group: str, constraint: _core.JointConstraint) -> None:
    if constraint.joint not in model.group(group).variables:
        raise _Refused("no_goal", f"joint '{constraint.joint}' of the goal does not belong to group '{group}'")
    limits = model.variable_limits(constraint.joint)
    if limits.has_position and not limits.min_position - 1e-6 <= constraint.position <= limits.max_position + 1e-6:
        raise _Refused(
            "no_goal",
            f"the goal is outside the limits of '{constraint.joint}': {constraint.position:.4g} is not within "
            f"{limits.min_position:.4g} to {limits.max_position:.4g}",
        )


@dataclass(frozen=True)
class _Tool:
    """The point that is moved: where it is on its link, and where it is to go (both poses have the link's axes)."""

    link: str
    in_link: Pose
    goal: Pose

    def link_at(self, pose: Pose) -> Pose:
        """The link's pose that puts the point at ``pose``."""
        return pose * self.in_link.inverse()


def _tool(scene: _core.PlanningScene, start: _core.RobotState, request: MotionRequest, link: str = "") -> _Tool:
    """What the goal asks for; a goal of joint values moves ``link``, or the group's tip."""
    goal = _goal(scene, request)
    group = scene.model.group(request.group)
    if goal.joint:
        link = link or group.tip_link
        if not link:
            raise _Refused("failed", f"group '{group.name}' is no chain: its end, which {request.planner} moves, is not known")
        if not start.has_frame(link):
            raise _Refused("invalid_link", f"the robot has no link '{link}', which {request.planner} is to move")
        state = start.copy()
        state.set({c.joint: c.position for c in goal.joint})
        return _Tool(link, Pose.identity(), state.pose(link))
    if len(goal.position) != 1 or len(goal.orientation) != 1 or goal.position[0].link != goal.orientation[0].link:
        raise _Refused("no_goal", f"{request.planner} needs a goal of joint values, or one position and one orientation of one link")
    position, orientation = goal.position[0], goal.orientation[0]
    if not position.region:
        raise _Refused("no_goal", "the position constraint of the goal has no region")
    point = scene.frame_pose(position.frame, start) * position.region[0][1].position
    turn = scene.frame_pose(orientation.frame, start) * Pose(np.zeros(3), np.asarray(orientation.quaternion))
    in_link = Pose(np.asarray(position.offset, float), np.array((0.0, 0.0, 0.0, 1.0)))
    return _Tool(position.link, in_link, Pose(point, turn.quaternion))


def slerp(a: Pose, b: Pose) -> tuple[float, Callable[[float], np.ndarray]]:
    """(angle between ``a`` and ``b``, rad; the quaternion x y z w at a share of the way, 0 to 1, the short way)."""
    qa, qb = np.asarray(a.quaternion), np.asarray(b.quaternion)
    cosine = float(np.dot(qa, qb))
    if cosine < 0:
        qb, cosine = -qb, -cosine
    half = float(np.arccos(min(1.0, cosine)))

    def at(share: float) -> np.ndarray:
        if half < 1e-9:
            return qb if share > 0.5 else qa
        q = (np.sin((1 - share) * half) * qa + np.sin(share * half) * qb) / np.sin(half)
        return q / np.linalg.norm(q)

    return 2 * half, at


def _joint_limits(scene: _core.PlanningScene, group: str, unset: float) -> tuple[np.ndarray, np.ndarray]:
    names = scene.model.group(group).variables
    limits = [scene.model.variable_limits(name) for name in names]
    for name, limit in zip(names, limits):
        above_zero(name, "velocity", limit.max_velocity if limit.has_velocity else unset)
        above_zero(name, "acceleration", limit.max_acceleration if limit.has_acceleration else unset)
    return (
        np.array([limit.max_velocity if limit.has_velocity else unset for limit in limits]),
        np.array([limit.max_acceleration if limit.has_acceleration else unset for limit in limits]),
    )


def _braking(scene: _core.PlanningScene, group: str, limits: CartesianLimits, acceleration: np.ndarray) -> np.ndarray:
    """What each joint of ``group`` may brake with, above 0: as it speeds up, where nobody says more."""
    given = [limits.joint_deceleration.get(name) for name in scene.model.group(group).variables]
    for name, value in zip(scene.model.group(group).variables, given):
        if value is not None and not value < 0:
            raise _Refused("failed", f"the max_deceleration of joint '{name}' has to be negative, it is {value:g}")
    return np.array([speeding if value is None else -value for value, speeding in zip(given, acceleration)])


def check_limits(scene: _core.PlanningScene, trajectory: Trajectory, what: str, limits: CartesianLimits) -> None:
    """Refuse a ``trajectory`` that is too fast for the joints between or at its points; what has no limit may be as fast as it likes.

    :param scene: whose robot has the limits, but for decelerations, which are those of ``limits``. :param what: it is, for the message.
    """
    velocity, acceleration = _joint_limits(scene, trajectory.group, np.inf)
    braking = _braking(scene, trajectory.group, limits, acceleration)
    assert trajectory.times is not None and trajectory.velocities is not None and trajectory.accelerations is not None
    steps = np.diff(trajectory.positions, axis=0) / np.diff(trajectory.times)[:, None]
    slowing = trajectory.velocities * trajectory.accelerations < 0
    for rows, most, name in (
        (steps, velocity, "velocity"),
        (trajectory.velocities, velocity, "velocity"),
        (np.where(slowing, 0.0, trajectory.accelerations), acceleration, "acceleration"),
        (np.where(slowing, trajectory.accelerations, 0.0), braking, "deceleration"),
    ):
        worst = np.abs(rows).max(axis=0, initial=0.0)
        if (worst > most * 1.001).any():
            joint = int(np.argmax(worst / most))
            raise _Refused(
                "failed",
                f"{what} would move joint '{trajectory.variables[joint]}' with {worst[joint]:.3g}, above its "
                f"{name} limit {most[joint]:.3g}; a smaller {'velocity' if name == 'velocity' else 'acceleration'} scaling helps",
            )


def trajectory_of(
    scene: _core.PlanningScene, group: str, start: _core.RobotState, at: Sequence[float], points: Sequence[np.ndarray]
) -> Trajectory:
    """The trajectory of ``group`` from ``start`` through ``points`` (k, n) at the times ``at`` (s), in ``scene``.

    Velocities and accelerations are those of the differences; it starts and ends at rest.
    """
    times, positions = np.asarray(at, float), np.asarray(points, float)
    velocities, accelerations = np.zeros_like(positions), np.zeros_like(positions)
    if len(times) > 2:
        velocities[1:-1] = np.gradient(positions, times, axis=0)[1:-1]
    if len(times) > 1:
        accelerations[1:] = np.diff(velocities, axis=0) / np.diff(times)[:, None]
    return Trajectory(scene.model, group, start, positions, times, velocities, accelerations)


# ---------------------------------------------------------------- the three motions


def _ptp(scene: _core.PlanningScene, start: _core.RobotState, request: MotionRequest, limits: CartesianLimits) -> Trajectory:
    goal = _goal(scene, request)
    first = start.get_group(request.group)
    if goal.joint:
        state = start.copy()
        state.set({c.joint: c.position for c in goal.joint})
        last = state.get_group(request.group)
    else:
        tool = _tool(scene, start, request)
        found = ik(
            scene,
            request.group,
            tool.link_at(tool.goal),
            link=tool.link,
            seed=start,
            position_only=request.position_only,
            timeout=1.0,
            max_restarts=500,
            avoid_collisions=True,
            random_seed=1,
            solutions=8,
        )
        if not found:
            raise _Refused("no_ik_solution", found.message)
        last = found.solutions[0]
    velocity, acceleration = _joint_limits(scene, request.group, _UNSET)
    v_scale, a_scale = _scalings(request)
    # As upstream the strictest limits hold for all joints, and all arrive together.
    way = float(np.abs(last - first).max(initial=0.0))
    if way < 1e-9:
        return trajectory_of(scene, request.group, start, [0.0], [first])
    braking = _braking(scene, request.group, limits, acceleration)
    profile = _Trapeze(way, velocity.min() * v_scale, acceleration.min() * a_scale, braking.min() * a_scale)
    times = profile.times()
    direction = (last - first) / way
    rows = np.array([profile.at(t) for t in times])
    return Trajectory(
        scene.model, request.group, start, first + rows[:, :1] * direction, times, rows[:, 1:2] * direction, rows[:, 2:] * direction
    )


def _along(
    scene: _core.PlanningScene,
    start: _core.RobotState,
    request: MotionRequest,
    tool: _Tool,
    length: float,
    angle: float,
    pose_at: Callable[[float], Pose],
    limits: CartesianLimits,
) -> Trajectory:
    """A tool along poses of a share (0 to 1) of its way."""
    v_scale, a_scale = _scalings(request)
    # Turning counts as a way on a circle whose radius makes both limits one.
    way = max(length, angle * limits.max_trans_vel / limits.max_rot_vel)
    values = start.get_group(request.group)
    if way < 1e-9:
        return trajectory_of(scene, request.group, start, [0.0], [values])
    profile = _Trapeze(way, limits.max_trans_vel * v_scale, limits.max_trans_acc * a_scale, abs(limits.max_trans_dec) * a_scale)
    times = profile.times()
    positions = [values]
    seed = start.copy()
    for now in times[1:]:
        share = profile.at(now)[0] / way
        values = follow(
            scene,
            request.group,
            tool.link,
            tool.link_at(pose_at(share)),
            seed,
            f"the {request.planner} motion cannot be followed beyond {share:.0%} of its way",
            request.position_only,
        )
        positions.append(values)
    trajectory = trajectory_of(scene, request.group, start, list(times), positions)
    check_limits(scene, trajectory, f"the {request.planner} motion", limits)
    return trajectory


def follow(
    scene: _core.PlanningScene, group: str, link: str, pose: Pose, seed: _core.RobotState, problem: str, position_only: bool = False
) -> np.ndarray:
    """(n,) joint values of ``group`` that bring ``link`` to ``pose`` in ``scene``, near those of ``seed``, which is put there.

    No joint is turned back from its limit. ``position_only``: the orientation is free.
    ``problem`` begins the message where there are none.
    """
    size = scene.model.group(group).size
    found = ik(
        scene,
        group,
        pose,
        link=link,
        seed=seed,
        timeout=0.1,
        max_restarts=0,
        tolerance=1e-6,
        consistency=[0.99 * np.pi] * size,
        position_only=position_only,
    )
    if not found:
        raise _Refused("no_ik_solution", f"{problem}: {found.message}")
    seed.set_group(group, found.solutions[0])
    return found.solutions[0]


def _lin(scene: _core.PlanningScene, start: _core.RobotState, request: MotionRequest, limits: CartesianLimits) -> Trajectory:
    tool = _tool(scene, start, request)
    origin = start.pose(tool.link) * tool.in_link
    angle, turn = slerp(origin, tool.goal)
    way = tool.goal.position - origin.position
    return _along(
        scene,
        start,
        request,
        tool,
        float(np.linalg.norm(way)),
        angle,
        lambda share: Pose(origin.position + share * way, turn(share)),
        limits,
    )


def _circle(start: np.ndarray, goal: np.ndarray, point: np.ndarray, kind: str) -> tuple[float, Callable[[float], np.ndarray]]:
    """(length, position at a share) of the arc through an interim point, or the shorter one about a centre."""
    if kind == "interim":
        a, b = point - start, goal - start
        normal = np.cross(a, b)
        if np.linalg.norm(normal) < _COLLINEAR:
            raise _Refused("invalid_plan", "start, interim point and goal of the circle lie on one line")
        centre = start + (np.dot(b, b) * np.cross(np.cross(a, b), a) + np.dot(a, a) * np.cross(b, np.cross(a, b))) / (
            2 * np.dot(normal, normal)
        )
    else:
        centre = point
        away, end = (float(np.linalg.norm(place - centre)) for place in (start, goal))
        normal = np.cross(start - centre, goal - centre)
        apart = abs(away - end)
        if apart > _RADII:
            raise _Refused("invalid_plan", f"start and goal of the circle are not equally far from its centre: by {apart:.4g} m")
        if min(away, end) < _COLLINEAR:
            raise _Refused("invalid_plan", "the circle has no radius: its centre is its start or its goal")
        if np.linalg.norm(normal) < _COLLINEAR * away * end:
            raise _Refused("invalid_plan", "start, centre and goal of the circle lie on one line: give an interim point instead")
    radius, last = (float(np.linalg.norm(place - centre)) for place in (start, goal))
    x = (start - centre) / radius
    y = np.cross(normal / np.linalg.norm(normal), x)
    angle = float(np.arctan2(np.dot(goal - centre, y), np.dot(goal - centre, x))) % (2 * np.pi)
    return (
        radius * angle,
        lambda share: centre + (radius + share * (last - radius)) * (np.cos(share * angle) * x + np.sin(share * angle) * y),
    )


def with_auxiliary_point(request: MotionRequest) -> MotionRequest:
    """A request for CIRC with its auxiliary point taken out of the path constraints, where it is by MoveIt's convention."""
    extra = request.path_constraints
    if (
        request.planner != "CIRC"
        or request.auxiliary is not None
        or extra is None
        or extra.name not in ("interim", "center")
        or len(extra.position) != 1
        or len(extra.position[0].region) != 1
    ):
        return request
    point, rest = extra.position[0], _core.Constraints(joint=extra.joint, orientation=extra.orientation, visibility=extra.visibility)
    auxiliary = AuxiliaryPoint(extra.name, point.region[0][1].position, point.frame, point.link)
    return replace(request, auxiliary=auxiliary, path_constraints=None if rest.empty() else rest)


def _circ(scene: _core.PlanningScene, start: _core.RobotState, request: MotionRequest, limits: CartesianLimits) -> Trajectory:
    auxiliary = with_auxiliary_point(request).auxiliary
    if auxiliary is None:
        raise _Refused(
            "invalid_plan",
            "CIRC needs path constraints named 'interim' or 'center' with one position constraint that has one pose: its auxiliary point",
        )
    tool = _tool(scene, start, request, auxiliary.link)
    point = scene.frame_pose(auxiliary.frame, start) * np.asarray(auxiliary.position, float)
    origin = start.pose(tool.link) * tool.in_link
    length, place = _circle(origin.position, tool.goal.position, point, auxiliary.kind)
    angle, turn = slerp(origin, tool.goal)
    return _along(scene, start, request, tool, length, angle, lambda share: Pose(place(share), turn(share)), limits)


_MOTIONS = {"PTP": _ptp, "LIN": _lin, "CIRC": _circ}


def pilz_plan(
    scene: _core.PlanningScene, request: MotionRequest, cancel: _core.CancelToken | None = None, limits: CartesianLimits = CartesianLimits()
) -> PlanResult:
    """A timed trajectory without a search: ``request.planner`` is PTP, LIN or CIRC.

    Obstacles of ``scene`` are not avoided; a Pipeline checks the result.

    :param cancel: ends it from another thread. :param limits: of the tool's speed.
    """
    begun = time.perf_counter()
    start = request.start if request.start is not None else scene.state
    try:
        motion = _MOTIONS.get(request.planner)
        if motion is None:
            raise _Refused("unknown_planner", f"there is no planner '{request.planner[:40]}' (there is: {', '.join(_MOTIONS)})")
        trajectory = motion(scene, start, request, limits)
    except _Refused as refused:
        return PlanResult(
            refused.status, message=str(refused), start=start, planner=request.planner, planning_time=time.perf_counter() - begun
        )
    except _core.UnknownNameError as error:
        status = (
            "invalid_group"
            if str(error).startswith("no group")
            else "unknown_link"
            if str(error).startswith("no link")
            else "unknown_frame"
        )
        return PlanResult(status, message=str(error), start=start, planner=request.planner)
    except _core.MotionError as error:
        return PlanResult("invalid_request", message=str(error), start=start, planner=request.planner)
    if cancel is not None and cancel.cancelled:
        return PlanResult("cancelled", message="planning was cancelled", start=start, planner=request.planner)
    return PlanResult(
        "solved",
        trajectory=trajectory,
        start=start,
        planner=request.planner,
        attempts=1,
        goals=1,
        planning_time=time.perf_counter() - begun,
    )


# ---------------------------------------------------------------- sequences

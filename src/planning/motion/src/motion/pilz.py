"""Industrial motions as in pilz_industrial_motion_planner: point to point, along a line, along a circle."""
from __future__ import annotations

import time
from dataclasses import dataclass, field
from typing import Callable, List, Optional, Sequence, Tuple

import numpy as np

from motion import _core
from motion.kinematics import ik
from motion.planning import MotionRequest, PlanResult
from motion.pose import Pose
from motion.trajectory import Trajectory

_SAMPLING = 0.1  # s, as upstream
_UNSET = 1.0     # rad/s, rad/s^2 where the robot says nothing


@dataclass(frozen=True)
class CartesianLimits:
    """Of cartesian_limits.yaml: m/s, m/s^2, m/s^2 (negative), rad/s."""

    max_trans_vel: float = 1.0
    max_trans_acc: float = 2.25
    max_trans_dec: float = -5.0
    max_rot_vel: float = 1.57


class _Refused(Exception):
    def __init__(self, status: str, message: str):
        super().__init__(message)
        self.status = status


class _Trapeze:
    """Speeding up, cruising, braking along a way of some length."""

    def __init__(self, length: float, speed: float, up: float, down: float):
        if not (speed > 0 and up > 0 and down > 0):
            raise _Refused("failed", "the velocity and acceleration limits and scalings must be above 0")
        top = min(speed, float(np.sqrt(2 * length * up * down / (up + down))))
        self.length, self.top, self.up, self.down = length, top, up, down
        self.t_up, self.t_down = top / up, top / down
        self.t_cruise = max(0.0, (length - 0.5 * top * (self.t_up + self.t_down)) / top) if top > 0 else 0.0
        self.duration = self.t_up + self.t_cruise + self.t_down

    def at(self, t: float) -> Tuple[float, float, float]:
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
        """0, every sampling time, and the end."""
        steps = np.arange(0.0, self.duration, _SAMPLING)
        return (
            np.append(steps, self.duration)
            if self.duration > 0 and self.duration - steps[-1] > 1e-9
            else np.append(steps[:-1], self.duration)
        )


def _scalings(request: MotionRequest) -> Tuple[float, float]:
    scalings = request.velocity_scaling, request.acceleration_scaling
    for value in scalings:
        if not 0.0001 <= value <= 1.0:
            raise _Refused("failed", f"velocity and acceleration scaling must be in (0, 1], not {value:g}")
    return scalings


def _goal(request: MotionRequest) -> _core.Constraints:
    goals = [goal for goal in request.goals if not goal.empty()]
    if len(goals) != 1:
        raise _Refused("no_goal", f"{request.planner} needs exactly one goal, not {len(goals)}")
    return goals[0]


def _goal_pose(scene: _core.PlanningScene, start: _core.RobotState, request: MotionRequest) -> Tuple[str, Pose]:
    """(link, its pose in the model frame) that the goal asks for."""
    goal = _goal(request)
    group = scene.model.group(request.group)
    if goal.joint:
        if not group.tip_link:
            raise _Refused("failed", f"group '{group.name}' is no chain: its end, which {request.planner} moves, is not known")
        state = start.copy()
        state.set({c.joint: c.position for c in goal.joint})
        return group.tip_link, state.pose(group.tip_link)
    if len(goal.position) != 1 or len(goal.orientation) != 1 or goal.position[0].link != goal.orientation[0].link:
        raise _Refused("no_goal", f"{request.planner} needs a goal of joint values, or one position and one orientation of one link")
    position, orientation = goal.position[0], goal.orientation[0]
    if not position.region:
        raise _Refused("no_goal", "the position constraint of the goal has no region")
    point = scene.frame_pose(position.frame, start) * position.region[0][1].position
    turn = scene.frame_pose(orientation.frame, start) * Pose(np.zeros(3), np.asarray(orientation.quaternion))
    return position.link, Pose(point - turn.rotation @ np.asarray(position.offset), turn.quaternion)


def _slerp(a: Pose, b: Pose) -> Tuple[float, Callable[[float], np.ndarray]]:
    """(angle between, quaternion at a share of the way)."""
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


def _joint_limits(scene: _core.PlanningScene, group: _core.Group) -> Tuple[np.ndarray, np.ndarray]:
    limits = [scene.model.variable_limits(name) for name in group.variables]
    return (np.array([limit.max_velocity if limit.has_velocity else _UNSET for limit in limits]),
            np.array([limit.max_acceleration if limit.has_acceleration else _UNSET for limit in limits]))


def _trajectory(scene, group: str, start: _core.RobotState, times: Sequence[float], positions: Sequence[np.ndarray]) -> Trajectory:
    """Velocities and accelerations are those of the differences; it starts and ends at rest."""
    times, positions = np.asarray(times, float), np.asarray(positions, float)
    velocities, accelerations = np.zeros_like(positions), np.zeros_like(positions)
    if len(times) > 2:
        velocities[1:-1] = (positions[2:] - positions[:-2]) / (times[2:] - times[:-2])[:, None]
    if len(times) > 1:
        accelerations[1:] = np.diff(velocities, axis=0) / np.diff(times)[:, None]
    return Trajectory(scene.model, group, start, positions, times, velocities, accelerations)


# ---------------------------------------------------------------- the three motions

def _ptp(scene: _core.PlanningScene, start: _core.RobotState, request: MotionRequest, limits: CartesianLimits) -> Trajectory:
    group = scene.model.group(request.group)
    goal = _goal(request)
    first = start.get_group(request.group)
    if goal.joint:
        state = start.copy()
        state.set({c.joint: c.position for c in goal.joint})
        if not state.in_bounds(request.group, 1e-6):
            raise _Refused("invalid_goal", "the goal is outside the limits of '%s'" % state.violations(request.group, 1e-6)[0][0])
        last = state.get_group(request.group)
    else:
        link, pose = _goal_pose(scene, start, request)
        found = ik(
            scene,
            request.group,
            pose,
            link=link,
            seed=start,
            timeout=1.0,
            max_restarts=500,
            avoid_collisions=True,
            random_seed=1,
            solutions=8,
        )
        if not found:
            raise _Refused("no_ik_solution", found.message)
        last = found.solutions[0]
    velocity, acceleration = _joint_limits(scene, group)
    v_scale, a_scale = _scalings(request)
    # As upstream the strictest limits hold for all joints, and all arrive together.
    way = float(np.abs(last - first).max(initial=0.0))
    if way < 1e-9:
        return _trajectory(scene, request.group, start, [0.0], [first])
    profile = _Trapeze(way, velocity.min() * v_scale, acceleration.min() * a_scale, acceleration.min() * a_scale)
    times = profile.times()
    direction = (last - first) / way
    rows = np.array([profile.at(t) for t in times])
    return Trajectory(
        scene.model, request.group, start, first + rows[:, :1] * direction, times, rows[:, 1:2] * direction, rows[:, 2:] * direction
    )


def _along(scene: _core.PlanningScene, start: _core.RobotState, request: MotionRequest, link: str, length: float, angle: float,
           pose_at: Callable[[float], Pose], limits: CartesianLimits) -> Trajectory:
    """A link along poses of a share (0 to 1) of its way."""
    v_scale, a_scale = _scalings(request)
    # Turning counts as a way on a circle whose radius makes both limits one.
    way = max(length, angle * limits.max_trans_vel / limits.max_rot_vel)
    values = start.get_group(request.group)
    if way < 1e-9:
        return _trajectory(scene, request.group, start, [0.0], [values])
    profile = _Trapeze(way, limits.max_trans_vel * v_scale, limits.max_trans_acc * a_scale, abs(limits.max_trans_dec) * a_scale)
    times = profile.times()
    positions = [values]
    velocity, _ = _joint_limits(scene, scene.model.group(request.group))
    seed = start.copy()
    for before, now in zip(times, times[1:]):
        pose = pose_at(profile.at(now)[0] / way)
        found = ik(scene, request.group, pose, link=link, seed=seed, timeout=0.1, max_restarts=0)
        if not found:
            raise _Refused(
                "no_ik_solution",
                f"the {request.planner} motion cannot be followed beyond {profile.at(now)[0] / way:.0%} of its way: {found.message}",
            )
        step = np.abs(found.solutions[0] - positions[-1]) / (now - before)
        if (step > velocity * 1.001).any():
            worst = int(np.argmax(step / velocity))
            raise _Refused(
                "conversion_failed",
                f"the {request.planner} motion would move joint '{scene.model.group(request.group).variables[worst]}' at "
                f"{step[worst]:.3g}, above its velocity limit {velocity[worst]:.3g}; a smaller velocity scaling helps",
            )
        positions.append(found.solutions[0])
        seed.set_group(request.group, found.solutions[0])
    return _trajectory(scene, request.group, start, times, positions)


def _lin(scene: _core.PlanningScene, start: _core.RobotState, request: MotionRequest, limits: CartesianLimits) -> Trajectory:
    link, goal = _goal_pose(scene, start, request)
    origin = start.pose(link)
    angle, turn = _slerp(origin, goal)
    way = goal.position - origin.position
    return _along(scene, start, request, link, float(np.linalg.norm(way)), angle,
                  lambda share: Pose(origin.position + share * way, turn(share)), limits)


def _circle(start: np.ndarray, goal: np.ndarray, point: np.ndarray, kind: str) -> Tuple[float, Callable[[float], np.ndarray]]:
    """(length, position at a share) of the arc through an interim point, or the shorter one about a centre."""
    if kind == "interim":
        a, b = point - start, goal - start
        normal = np.cross(a, b)
        if np.linalg.norm(normal) < 1e-9:
            raise _Refused("failed", "start, interim point and goal of the circle lie on one line")
        centre = start + (np.dot(b, b) * np.cross(np.cross(a, b), a) + np.dot(a, a) * np.cross(b, np.cross(a, b))) / (
            2 * np.dot(normal, normal)
        )
    else:
        centre = point
        normal = np.cross(start - centre, goal - centre)
        if abs(np.linalg.norm(start - centre) - np.linalg.norm(goal - centre)) > 1e-2 * max(1e-6, np.linalg.norm(start - centre)):
            raise _Refused("failed", "start and goal of the circle are not equally far from its centre")
        if np.linalg.norm(normal) < 1e-9:
            raise _Refused("failed", "start, centre and goal of the circle lie on one line: give an interim point instead")
    radius = float(np.linalg.norm(start - centre))
    x = (start - centre) / radius
    y = np.cross(normal / np.linalg.norm(normal), x)
    angle = float(np.arctan2(np.dot(goal - centre, y), np.dot(goal - centre, x))) % (2 * np.pi)
    return radius * angle, lambda share: centre + radius * (np.cos(share * angle) * x + np.sin(share * angle) * y)


def _circ(scene: _core.PlanningScene, start: _core.RobotState, request: MotionRequest, limits: CartesianLimits) -> Trajectory:
    link, goal = _goal_pose(scene, start, request)
    extra = request.path_constraints
    if extra is None or extra.name not in ("interim", "center") or len(extra.position) != 1 or not extra.position[0].region:
        raise _Refused(
            "no_goal", "CIRC needs path constraints named 'interim' or 'center' with one position constraint: its auxiliary point"
        )
    point = scene.frame_pose(extra.position[0].frame, start) * extra.position[0].region[0][1].position
    origin = start.pose(link)
    length, place = _circle(origin.position, goal.position, point, extra.name)
    angle, turn = _slerp(origin, goal)
    return _along(scene, start, request, link, length, angle, lambda share: Pose(place(share), turn(share)), limits)


_MOTIONS = {"PTP": _ptp, "LIN": _lin, "CIRC": _circ}


def pilz_plan(scene: _core.PlanningScene, request: MotionRequest, cancel: Optional[_core.CancelToken] = None,
              limits: CartesianLimits = CartesianLimits()) -> PlanResult:
    """A timed trajectory without a search: ``request.planner`` is PTP, LIN or CIRC.

    Obstacles are not avoided; a Pipeline checks the result. CIRC takes its auxiliary point from the path constraints
    named ``interim`` or ``center``.
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
    return PlanResult("solved", trajectory=trajectory, start=start, planner=request.planner, attempts=1, goals=1,
                      planning_time=time.perf_counter() - begun)


# ---------------------------------------------------------------- sequences

@dataclass
class SequenceResult:
    """One motion after the other; true in a condition if all were planned."""

    status: str
    message: str = ""
    trajectories: List[Trajectory] = field(default_factory=list)
    planning_time: float = 0.0

    @property
    def code(self) -> int:
        return PlanResult(self.status).code

    def __bool__(self) -> bool:
        return self.status == "solved"


def _blend(
    scene: _core.PlanningScene, first: Trajectory, second: Trajectory, link: str, radius: float, limits: CartesianLimits
) -> Trajectory:
    """One trajectory that leaves the first where it enters the ball about its end, and joins the second where that leaves it."""
    places = [np.array([t.state(i).pose(link).position for i in range(len(t))]) for t in (first, second)]
    corner = places[0][-1]
    inside = [np.linalg.norm(p - corner, axis=1) <= radius for p in places]
    if inside[0].all() or inside[1].all():
        raise _Refused("failed", f"the blend radius {radius:g} m is larger than a motion that it joins")
    enter = int(np.flatnonzero(~inside[0])[-1])
    leave = int(np.flatnonzero(~inside[1])[0])
    t_enter, t_leave = first.times[enter], second.times[leave]
    duration = max(first.duration - t_enter, t_leave)
    steps = max(2, int(np.ceil(duration / _SAMPLING)))
    seed = first.state(enter)
    times, positions = list(first.times[:enter + 1]), list(first.positions[:enter + 1])
    for k in range(1, steps + 1):
        t = duration * k / steps
        share = k / steps
        alpha = share ** 3 * (10 - 15 * share + 6 * share * share)
        a = first.state_at(min(first.duration, t_enter + t)).pose(link)
        b = second.state_at(min(t_leave, max(0.0, t_leave - duration + t))).pose(link)
        _, turn = _slerp(a, b)
        pose = Pose((1 - alpha) * a.position + alpha * b.position, turn(alpha))
        found = ik(scene, first.group, pose, link=link, seed=seed, timeout=0.1, max_restarts=0)
        if not found:
            raise _Refused("no_ik_solution", f"the blend between two motions cannot be followed: {found.message}")
        seed.set_group(first.group, found.solutions[0])
        times.append(t_enter + t)
        positions.append(found.solutions[0])
    times += list(times[-1] + second.times[leave + 1:] - t_leave)
    positions += list(second.positions[leave + 1:])
    return _trajectory(scene, first.group, first.start, times, positions)


def pilz_sequence(scene: _core.PlanningScene, items: Sequence[Tuple[MotionRequest, float]], cancel: Optional[_core.CancelToken] = None,
                  limits: CartesianLimits = CartesianLimits()) -> SequenceResult:
    """Motions one after the other, each from where the one before ends.

    :param items: (request, blend radius in m to the next one); the last radius must be 0. Motions of one group that follow
        each other become one trajectory.
    """
    begun = time.perf_counter()
    if items and items[-1][1] > 0:
        return SequenceResult("invalid_request", "the last motion of a sequence cannot be blended: its radius must be 0")
    state = scene.state
    out: List[Trajectory] = []
    pending = 0.0
    for index, (request, radius) in enumerate(items):
        if (
            index
            and request.start is not None
            and request.start.get_group(request.group).tolist() != state.get_group(request.group).tolist()
        ):
            return SequenceResult("invalid_request", f"motion {index + 1} of the sequence has a start state: only the first may")
        wanted = MotionRequest(**{**request.__dict__, "start": request.start if index == 0 and request.start is not None else state})
        result = pilz_plan(scene, wanted, cancel, limits)
        if not result or result.trajectory is None:
            return SequenceResult(result.status, f"motion {index + 1} of the sequence: {result.message}", out, time.perf_counter() - begun)
        trajectory = result.trajectory
        state = trajectory.state(len(trajectory) - 1)
        try:
            if out and out[-1].group == trajectory.group:
                link = scene.model.group(trajectory.group).tip_link
                out[-1] = _blend(scene, out[-1], trajectory, link, pending, limits) if pending > 0 else out[-1].append(trajectory)
            else:
                out.append(trajectory)
        except _Refused as refused:
            return SequenceResult(refused.status, f"motion {index + 1} of the sequence: {refused}", out, time.perf_counter() - begun)
        pending = radius
    return SequenceResult("solved", "", out, time.perf_counter() - begun)

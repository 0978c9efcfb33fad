"""Sequences of industrial motions, blended where they are asked to be, as in pilz_industrial_motion_planner."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from motion import _core
from motion.cartesian import explain, path_valid
from motion.pilz import SAMPLING, CartesianLimits, _Refused, check_limits, follow, pilz_plan, slerp, trajectory_of
from motion.planning import MotionRequest, PlanResult
from motion.pose import Pose
from motion.trajectory import Trajectory

Planner = Callable[[_core.PlanningScene, MotionRequest, _core.CancelToken | None], PlanResult]


@dataclass
class SequenceResult:
    """One motion after the other; true in a condition if all were planned."""

    status: str
    message: str = ""
    trajectories: list[Trajectory] = field(default_factory=list)
    planning_time: float = 0.0
    warnings: list[str] = field(default_factory=list)
    contacts: list[_core.Contact] = field(default_factory=list)

    @property
    def code(self) -> int:
        return PlanResult(self.status).code

    def __bool__(self) -> bool:
        return self.status == "solved"


def _blend(
    scene: _core.PlanningScene,
    first: Trajectory,
    second: Trajectory,
    link: str,
    radius: float,
    limits: CartesianLimits,
    position_only: bool = False,
) -> Trajectory:
    """One trajectory that leaves the first where it enters the ball about its end, and joins the second where that leaves it."""
    places = [np.array([t.state(i).pose(link).position for i in range(len(t))]) for t in (first, second)]
    corner = places[0][-1]
    inside = [np.linalg.norm(p - corner, axis=1) <= radius for p in places]
    if inside[0].all() or inside[1].all():
        raise _Refused("failed", f"the blend radius {radius:g} m is larger than a motion that it joins")
    enter = int(np.flatnonzero(~inside[0])[-1])
    leave = int(np.flatnonzero(~inside[1])[0])
    assert first.times is not None and second.times is not None  # planned motions are timed
    t_enter, t_leave = first.times[enter], second.times[leave]
    duration = max(first.duration - t_enter, t_leave)
    steps = max(2, int(np.ceil(duration / SAMPLING)))
    seed = first.state(enter)
    times, positions = list(first.times[: enter + 1]), list(first.positions[: enter + 1])
    for k in range(1, steps + 1):
        t = duration * k / steps
        share = k / steps
        alpha = share**3 * (10 - 15 * share + 6 * share * share)
        a = first.state_at(min(first.duration, t_enter + t)).pose(link)
        b = second.state_at(min(t_leave, max(0.0, t_leave - duration + t))).pose(link)
        _, turn = slerp(a, b)
        pose = Pose((1 - alpha) * a.position + alpha * b.position, turn(alpha))
        times.append(t_enter + t)
        positions.append(follow(scene, first.group, link, pose, seed, "the blend between two motions cannot be followed", position_only))
    times += list(times[-1] + second.times[leave + 1 :] - t_leave)
    positions += list(second.positions[leave + 1 :])
    blended = trajectory_of(scene, first.group, first.start, times, positions)
    check_limits(scene, blended, "the blend between two motions", limits)
    return blended


def pilz_sequence(
    scene: _core.PlanningScene,
    items: Sequence[tuple[MotionRequest, float]],
    cancel: _core.CancelToken | None = None,
    limits: CartesianLimits = CartesianLimits(),
    plan: Planner | None = None,
) -> SequenceResult:
    """Motions one after the other, each from where the one before ends.

    :param items: (request, blend radius in m to the next one); the last radius must be 0. Only the first motion of a group may
        have a start. Motions of one group that follow each other become one trajectory.
    :param plan: what plans each of them; default :func:`pilz_plan`. The result is looked at for collisions where motions are blended.
    :param scene: with the robot's state, where the first motion begins without a start of its own.
    :param cancel: ends it from another thread. :param limits: of the tool's speed.
    """
    begun = time.perf_counter()
    plan = plan or (lambda scene, request, cancel: pilz_plan(scene, request, cancel, limits))
    result = SequenceResult("solved")
    try:
        radii = _radii(scene.model, items, result.warnings)
        _plan_all(scene, items, radii, cancel, plan, result, limits)
    except _Refused as refused:
        result.status, result.message, result.trajectories = refused.status, str(refused), []
    except _core.MotionError as error:
        result.status, result.message, result.trajectories = "invalid_request", str(error), []
    result.planning_time = time.perf_counter() - begun
    return result


def _radii(model: _core.RobotModel, items: Sequence[tuple[MotionRequest, float]], warnings: list[str]) -> list[float]:
    """The blend radii that count.

    :raises _Refused: what cannot be, before anything is planned.
    """
    radii = [float(radius) for _, radius in items]
    if not all(0.0 <= radius < np.inf for radius in radii):
        raise _Refused("invalid_plan", f"blend radii must be 0 or more (m), not {', '.join(f'{radius:g}' for radius in radii)}")
    if radii and radii[-1] > 0:
        raise _Refused("invalid_plan", "the last motion of a sequence cannot be blended: its blend radius must be 0")
    groups = [request.group for request, _ in items]
    for index, (request, _) in enumerate(items):
        if request.start is not None and request.group in groups[:index]:
            raise _Refused("invalid_state", f"motion {index + 1} of the sequence has a start state: only the first of its group may")
        if index + 1 < len(items) and radii[index] > 0 and (groups[index + 1] != groups[index] or not model.group(groups[index]).tip_link):
            why = "they are of two groups" if groups[index + 1] != groups[index] else f"group '{groups[index]}' is no chain"
            warnings.append(f"motions {index + 1} and {index + 2} of the sequence are not blended: {why}")
            radii[index] = 0.0
    return radii


def _plan_all(
    scene: _core.PlanningScene,
    items: Sequence[tuple[MotionRequest, float]],
    radii: Sequence[float],
    cancel: _core.CancelToken | None,
    plan: Planner,
    result: SequenceResult,
    limits: CartesianLimits,
) -> None:
    state, out, before = scene.state, result.trajectories, None
    for index, (request, _) in enumerate(items):
        where = f"motion {index + 1} of the sequence"
        planned = plan(scene, replace(request, start=state if request.start is None else request.start), cancel)
        result.warnings += planned.warnings
        if not planned or planned.trajectory is None:
            result.contacts = planned.contacts
            raise _Refused(planned.status, f"{where}: {planned.message}")
        trajectory, radius = planned.trajectory, radii[index - 1] if index else 0.0
        state = trajectory.state(len(trajectory) - 1)
        if before is None or before.group != trajectory.group:
            out.append(trajectory)
        elif radius > 0:
            _check_overlap(before, trajectory, radius, radii[index], index)
            out[-1] = _blended(scene, out[-1], trajectory, radius, where, result, limits, request.position_only)
        else:
            out[-1] = out[-1].append(trajectory)
        before = trajectory


def _check_overlap(first: Trajectory, second: Trajectory, radius: float, later: float, index: int) -> None:
    link = second.model.group(second.group).tip_link
    corner, end = (t.state(len(t) - 1).pose(link).position for t in (first, second))
    if later > 0 and np.linalg.norm(end - corner) <= radius + later:
        raise _Refused(
            "invalid_plan",
            f"the blend radii {radius:g} m and {later:g} m at both ends of motion {index + 1} of the sequence "
            f"overlap: they are {np.linalg.norm(end - corner):.3g} m apart",
        )


def _blended(
    scene: _core.PlanningScene,
    first: Trajectory,
    second: Trajectory,
    radius: float,
    where: str,
    result: SequenceResult,
    limits: CartesianLimits,
    position_only: bool,
) -> Trajectory:
    try:
        trajectory = _blend(scene, first, second, scene.model.group(first.group).tip_link, radius, limits, position_only)
    except _Refused as refused:
        raise _Refused(refused.status, f"{where}: {refused}") from None
    bad = path_valid(scene, first.start, trajectory.group, trajectory.positions)
    if bad and bad != [0]:
        state = trajectory.state(bad[0])
        result.contacts = scene.check(state, group=trajectory.group, contacts=100).contacts
        raise _Refused("invalid_plan", f"{where}: the blend with the one before it is not free: {explain(scene, state, trajectory.group)}")
    return trajectory

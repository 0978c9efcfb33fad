"""Planning with what goes around it: MoveIt's request adapters by their names, timing, and a last check."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from motion import _core
from motion.cartesian import explain, path_valid
from motion.pilz import with_auxiliary_point
from motion.planning import MotionRequest, PlanResult, plan
from motion.timing import limit_cartesian_speed, limit_jerk, time_parameterize

Planner = Callable[[_core.PlanningScene, MotionRequest, _core.CancelToken | None], PlanResult]
_PREFIX = "default_planner_request_adapters/"


def _start(scene: _core.PlanningScene, request: MotionRequest) -> _core.RobotState:
    return request.start if request.start is not None else scene.state


def _with_start_before(result: PlanResult, start: _core.RobotState, most: float) -> PlanResult:
    """The result with the true start as a way point before its first; ``most`` s between them if it is timed."""
    trajectory = result.trajectory
    if not result or trajectory is None or not len(trajectory):
        return result
    positions = np.vstack([start.get_group(trajectory.group), trajectory.positions])
    times = None
    if trajectory.times is not None:
        mean = trajectory.duration / max(1, len(trajectory) - 1)
        times = np.concatenate([[0.0], trajectory.times - trajectory.times[0] + (min(most, mean) if mean > 0 else most)])

    def with_rest(rows: np.ndarray | None) -> np.ndarray | None:
        return None if rows is None else np.vstack([np.zeros(rows.shape[1]), rows])

    longer = trajectory.replaced(
        positions=positions,
        times=times,
        velocities=with_rest(trajectory.velocities),
        accelerations=with_rest(trajectory.accelerations),
        start=start,
    )
    return replace(result, trajectory=longer, added_prefix=[0] + [i + 1 for i in result.added_prefix])


class Pipeline:
    """A planner inside request adapters.

    :param adapters: names, the outermost first; it sees the request first and the result last. Those that are not known
        are left out and named in ``warnings``.
    :param params: what the pipeline's parameters say (start_state_max_bounds_error, jiggle_fraction ...).
    """

    NOETIC_ADAPTERS = [
        _PREFIX + name
        for name in (
            "LimitMaxCartesianLinkSpeed",
            "AddTimeParameterization",
            "ResolveConstraintFrames",
            "FixWorkspaceBounds",
            "FixStartStateBounds",
            "FixStartStateCollision",
            "FixStartStatePathConstraints",
        )
    ]

    ADAPTERS: list[str] = []  #: names of all adapters, without their prefix; from their table below

    def __init__(self, adapters: Sequence[str] = tuple(NOETIC_ADAPTERS), params: Mapping[str, Any] | None = None):
        self.params: dict[str, Any] = dict(params or {})
        self.warnings: list[str] = []
        self.adapters: list[str] = []
        for name in adapters:
            short = name.rpartition("/")[2]
            if short in _ADAPTERS:
                self.adapters.append(short)
            elif short:
                self.warnings.append(f"request adapter '{name}' is not known and left out (there is: {', '.join(sorted(_ADAPTERS))})")

    def number(self, key: str, default: float) -> float:
        """The pipeline's parameter ``key``, or ``default``. :raises InvalidInputError: it is not a number"""
        try:
            value = float(self.params.get(key, default))
        except (TypeError, ValueError):
            raise _core.InvalidInputError(f"pipeline parameter '{key}' is '{str(self.params[key])[:40]}', not a number") from None
        return value

    def generate(
        self, scene: _core.PlanningScene, request: MotionRequest, cancel: _core.CancelToken | None = None, planner: Planner = plan
    ) -> PlanResult:
        """Plan ``request`` in ``scene`` by ``planner``, time and check again. Never raises for what it says: see the result's status.

        :param cancel: ends it from another thread.
        """

        def inner(index: int) -> Planner:
            if index == len(self.adapters):
                return planner

            def call(scene: _core.PlanningScene, request: MotionRequest, cancel: _core.CancelToken | None) -> PlanResult:
                return _ADAPTERS[self.adapters[index]](self, inner(index + 1), scene, request, cancel)

            return call

        request = with_auxiliary_point(request)  # which is no constraint
        try:
            result = inner(0)(scene, request, cancel)
        except _core.MotionError as error:
            result = PlanResult("failed", message=str(error), start=_start(scene, request))
        return self._checked(scene, request, result)

    @staticmethod
    def _checked(scene: _core.PlanningScene, request: MotionRequest, result: PlanResult) -> PlanResult:
        trajectory = result.trajectory
        if not result or trajectory is None:
            return result
        bad = [
            i
            for i in path_valid(scene, _start(scene, request), trajectory.group, trajectory.positions, request.path_constraints)
            if i not in result.added_prefix
        ]
        if not bad or bad == [0]:
            return result
        state = trajectory.state(bad[0])
        found = scene.check(state, group=trajectory.group, contacts=100)
        return replace(
            result,
            status="invalid_plan",
            invalid=bad,
            contacts=found.contacts,
            message=f"the planned motion is not valid at {len(bad)} of {len(trajectory)} points; at point {bad[0] + 1}: "
            + explain(scene, state, trajectory.group, request.path_constraints),
        )


# ---------------------------------------------------------------- the adapters
# Each: (pipeline, the planner inside, scene, request, cancel) -> result
Adapter = Callable[[Pipeline, Planner, _core.PlanningScene, MotionRequest, _core.CancelToken | None], PlanResult]


def _nothing(
    pipeline: Pipeline, inside: Planner, scene: _core.PlanningScene, request: MotionRequest, cancel: _core.CancelToken | None
) -> PlanResult:
    return inside(scene, request, cancel)


def _timing(method: str) -> Adapter:
    def adapter(
        pipeline: Pipeline, inside: Planner, scene: _core.PlanningScene, request: MotionRequest, cancel: _core.CancelToken | None
    ) -> PlanResult:
        result = inside(scene, request, cancel)
        if not result or result.trajectory is None:
            return result
        try:
            timed = time_parameterize(
                scene.model,
                result.trajectory,
                method,
                velocity_scaling=request.velocity_scaling,
                acceleration_scaling=request.acceleration_scaling,
                path_tolerance=pipeline.number("path_tolerance", 0.1),
                resample_dt=pipeline.number("resample_dt", 0.1),
                min_angle_change=pipeline.number("min_angle_change", 0.001),
            )
        except _core.InvalidInputError as error:
            return replace(result, status="failed", message=str(error))
        return replace(result, trajectory=timed)

    return adapter


def _jerk(
    pipeline: Pipeline, inside: Planner, scene: _core.PlanningScene, request: MotionRequest, cancel: _core.CancelToken | None
) -> PlanResult:
    result = inside(scene, request, cancel)
    if not result or result.trajectory is None:
        return result
    if result.trajectory.times is None:
        result = _timing("time_optimal")(pipeline, lambda *_: result, scene, request, cancel)
    if not result or result.trajectory is None or result.added_prefix:  # what was put before is no part of the motion
        return result
    return replace(result, trajectory=limit_jerk(result.trajectory))


def _cartesian_speed(
    pipeline: Pipeline, inside: Planner, scene: _core.PlanningScene, request: MotionRequest, cancel: _core.CancelToken | None
) -> PlanResult:
    result = inside(scene, request, cancel)
    if result and result.trajectory is not None and request.cartesian_speed > 0:
        link = request.cartesian_link or scene.model.group(request.group).tip_link
        if link:
            return replace(result, trajectory=limit_cartesian_speed(result.trajectory, link, request.cartesian_speed))
    return result


def _workspace(
    pipeline: Pipeline, inside: Planner, scene: _core.PlanningScene, request: MotionRequest, cancel: _core.CancelToken | None
) -> PlanResult:
    if request.workspace is None or not np.any(np.asarray(request.workspace, float)):
        half = pipeline.number("default_workspace_bounds", 10.0) / 2
        request = replace(request, workspace=((-half,) * 3, (half,) * 3))
    return inside(scene, request, cancel)


def _start_bounds(
    pipeline: Pipeline, inside: Planner, scene: _core.PlanningScene, request: MotionRequest, cancel: _core.CancelToken | None
) -> PlanResult:
    start = _start(scene, request)
    fixed = start.copy()
    fixed.normalize_continuous()
    if start.in_bounds(request.group, pipeline.number("start_state_max_bounds_error", 0.05)) or fixed.in_bounds(
        request.group, pipeline.number("start_state_max_bounds_error", 0.05)
    ):
        fixed.enforce_bounds(request.group)
    moved = np.abs(fixed.get_group(request.group) - start.get_group(request.group)) % (2 * np.pi)
    result = inside(scene, replace(request, start=fixed), cancel)
    if np.minimum(moved, 2 * np.pi - moved).max(initial=0.0) > 1e-12:
        return _with_start_before(result, start, pipeline.number("start_state_max_dt", 0.5))
    return result


def _start_collision(
    pipeline: Pipeline, inside: Planner, scene: _core.PlanningScene, request: MotionRequest, cancel: _core.CancelToken | None
) -> PlanResult:
    start = _start(scene, request)
    if not scene.check(start, group=request.group):
        return inside(scene, request, cancel)
    lower, upper = scene.model.group(request.group).position_limits()
    reach = np.where(np.isfinite(upper - lower), upper - lower, 2 * np.pi) * pipeline.number("jiggle_fraction", 0.02)
    random = np.random.default_rng(request.seed)
    near = start.copy()
    values = start.get_group(request.group)
    for _ in range(int(pipeline.number("max_sampling_attempts", 100))):
        near.set_group(request.group, np.clip(values + random.uniform(-1, 1, len(values)) * reach, lower, upper))
        if not scene.check(near, group=request.group):
            return _with_start_before(
                inside(scene, replace(request, start=near), cancel), start, pipeline.number("start_state_max_dt", 0.5)
            )
    return inside(scene, request, cancel)  # which says what touches


def _start_constraints(
    pipeline: Pipeline, inside: Planner, scene: _core.PlanningScene, request: MotionRequest, cancel: _core.CancelToken | None
) -> PlanResult:
    constraints = request.path_constraints
    if constraints is None or constraints.empty():
        return inside(scene, request, cancel)
    start = _start(scene, request)
    if all(_core.evaluate(scene, start, constraints)):
        return inside(scene, request, cancel)
    first = inside(scene, replace(request, start=start, goals=[constraints], path_constraints=None), cancel)
    if not first or first.trajectory is None:
        return inside(scene, request, cancel)
    there = first.trajectory.state(len(first.trajectory) - 1)
    second = inside(scene, replace(request, start=there), cancel)
    if not second or second.trajectory is None:
        return second
    return replace(
        second,
        trajectory=first.trajectory.append(second.trajectory),
        start=start,
        planning_time=first.planning_time + second.planning_time,
        added_prefix=list(range(len(first.trajectory) - 1)),
    )


_ADAPTERS = {
    "Empty": _nothing,
    "ResolveConstraintFrames": _nothing,  # constraints take any frame as it is
    "LimitMaxCartesianLinkSpeed": _cartesian_speed,
    "AddTimeParameterization": _timing("iterative_parabolic"),
    "AddIterativeSplineParameterization": _timing("iterative_spline"),
    "AddTimeOptimalParameterization": _timing("time_optimal"),
    "AddRuckigTrajectorySmoothing": _jerk,
    "FixWorkspaceBounds": _workspace,
    "FixStartStateBounds": _start_bounds,
    "FixStartStateCollision": _start_collision,
    "FixStartStatePathConstraints": _start_constraints,
}

Pipeline.ADAPTERS = sorted(_ADAPTERS)

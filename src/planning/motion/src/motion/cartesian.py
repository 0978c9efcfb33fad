"""Straight lines of a link, and checks of whole paths."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from motion import _core
from motion.kinematics import AnyPose
from motion.pose import Pose
from motion.trajectory import Trajectory


@dataclass(frozen=True)
class CartesianResult:
    """How far a link got along its line.

    :param fraction: share of the way points reached, 0 to 1.
    :param trajectory: untimed, the start first.
    :param message: why it ended early; "" if it did not.
    """

    fraction: float
    trajectory: Trajectory
    message: str

    def __bool__(self) -> bool:
        return self.fraction >= 1.0


def cartesian_path(
    scene: _core.PlanningScene,
    group: str,
    waypoints: Sequence[AnyPose],
    *,
    link: str = "",
    start: _core.RobotState | None = None,
    max_step: float = 0.01,
    jump_threshold: float = 0.0,
    prismatic_jump: float = 0.0,
    revolute_jump: float = 0.0,
    avoid_collisions: bool = True,
    constraints: _core.Constraints | None = None,
    relative: bool = False,
    timeout: float = 0.0,
    position_only: bool = False,
) -> CartesianResult:
    """Joint values that bring a link from way point to way point along straight lines.

    :param scene: with the robot's state, which counts without a ``start``, and what it must not touch with ``avoid_collisions``.
    :param waypoints: poses of the link in the model frame, or in the link's start frame if ``relative``.
    :param link: default the last link of the group.
    :param max_step: largest distance between two steps, m.
    :param jump_threshold: the path ends before a joint-space step above this many times the mean one; 0 = any step will do.
    :param prismatic_jump: the same as an absolute step of a sliding joint, m. ``revolute_jump``: of a turning one, rad.
    :param constraints: that each step must keep; the path ends before one that does not.
    :param timeout: s that a step may search from other joint values when the last ones do not lead on; 0 = it may not.
    :param position_only: the link's orientation is free: arms with few joints.
    """
    state = start if start is not None else scene.state
    link = link or scene.model.group(group).tip_link or scene.model.group(group).links[-1]
    poses: list[AnyPose] = list(waypoints)
    if relative:
        origin = state.pose(link)
        poses = [origin * Pose(*(np.asarray(part, float) for part in pose)) for pose in poses]
    fraction, points, message = _core._cartesian_path(
        scene,
        state,
        group,
        link,
        poses,
        max_step,
        jump_threshold,
        prismatic_jump,
        revolute_jump,
        avoid_collisions,
        timeout,
        constraints,
        position_only,
    )
    return CartesianResult(fraction, Trajectory(scene.model, group, state, points), message)


def explain(
    scene: _core.PlanningScene,
    state: _core.RobotState | None = None,
    group: str = "",
    constraints: _core.Constraints | None = None,
    padded: bool = True,
) -> str:
    """Why ``state`` may not be used in ``scene``: limits, constraints, then collision; "" if it may.

    :param state: default that of the scene. :param group: whose joints and links count, "" for all.
    :param padded: the links are as thick as the scene's padding makes them.
    """
    state = state if state is not None else scene.state
    for variable, value, lower, upper in state.violations(group or None, 1e-6):
        return f"'{variable}' is at {value:.4g}, outside its limits {lower:.4g} to {upper:.4g}"
    if constraints is not None:
        for result in _core.evaluate(scene, state, constraints):
            if not result:
                return result.description
    found = scene.check(state, group=group, contacts=1, padded=padded)
    if found.contacts:
        return f"'{found.contacts[0].body_1}' and '{found.contacts[0].body_2}' touch"
    return "the robot is in collision" if found else ""


def is_valid(
    scene: _core.PlanningScene, state: _core.RobotState | None = None, group: str = "", constraints: _core.Constraints | None = None
) -> bool:
    """Whether ``state`` is within limits and ``constraints`` and touches nothing; ``scene``, ``group``: as for :func:`explain`."""
    return not explain(scene, state, group, constraints)


def path_valid(
    scene: _core.PlanningScene,
    start: _core.RobotState,
    group: str,
    path: np.ndarray | Sequence[Sequence[float]],
    constraints: _core.Constraints | None = None,
    padded: bool = True,
) -> list[int]:
    """Indices of the way points ``path`` (k, n) of ``group`` that collide in ``scene`` or break the ``constraints``.

    :param start: where all other joints are. :param padded: as for :func:`explain`.
    """
    if not len(path):
        return []
    bad = scene.check_states(group, path, start, padded)
    if constraints is not None and not constraints.empty():
        state = start.copy()
        for index, values in enumerate(path):
            state.set_group(group, values)
            bad[index] = bad[index] or not all(_core.evaluate(scene, state, constraints))
    return [int(i) for i in np.flatnonzero(bad)]

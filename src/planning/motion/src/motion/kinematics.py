"""Inverse kinematics of a group: of one pose or of one for each of its tips."""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from motion import _core
from motion.pose import Pose

AnyPose = Pose | tuple[Sequence[float], Sequence[float]]


@dataclass(frozen=True)
class IkResult:
    """What inverse kinematics found; true in a condition if there is a solution.

    :param solutions: (k, n) group values, the nearest to the seed first.
    :param error: norm of the pose error of the first solution, or the least that was reached (m and rad together).
    :param rejected: poses that were reached but then refused (collision, constraints, ``valid``).
    :param message: why there is none, for the user; "" on success.
    """

    solutions: np.ndarray
    error: float
    iterations: int
    restarts: int
    rejected: int
    time: float
    approximate: bool
    message: str

    def __bool__(self) -> bool:
        return len(self.solutions) > 0 and not self.approximate


def _targets(
    model: _core.RobotModel, group: _core.Group, pose: AnyPose | Mapping[str, AnyPose], link: str
) -> Sequence[tuple[str, AnyPose]]:
    if isinstance(pose, Mapping):
        if not pose:
            raise _core.InvalidInputError("inverse kinematics: no pose was given")
        return list(pose.items())
    if not link:
        if len(group.tips) != 1:
            raise _core.InvalidInputError(f"group '{group.name}' has {len(group.tips)} tips: say which link the pose is for")
        link = group.tips[0]
    return [(link, pose)]


def _on_robot(state: _core.RobotState, name: str, pose: AnyPose) -> tuple[str, AnyPose]:
    """The same target for the link that carries the frame ``name`` (a link, an attached body or its subframe)."""
    link, in_link = state.frame_link(name)
    return link, Pose(*(np.asarray(part, float) for part in pose)) * in_link.inverse() if link != name else pose


def ik(
    scene_or_model: _core.PlanningScene | _core.RobotModel,
    group: str,
    pose: AnyPose | Mapping[str, AnyPose],
    *,
    link: str = "",
    seed: _core.RobotState | Sequence[float] | None = None,
    timeout: float = 0.005,
    tolerance: float = 1e-5,
    position_only: bool = False,
    avoid_collisions: bool = False,
    constraints: Any | None = None,
    consistency: Sequence[float] | None = None,
    valid: Callable[[np.ndarray], bool] | None = None,
    solutions: int = 1,
    return_approximate: bool = False,
    random_seed: int | None = None,
    max_restarts: int = -1,
) -> IkResult:
    """Joint values of ``group`` that bring a link to a pose.

    :param scene_or_model: a scene is needed for ``avoid_collisions`` and ``constraints``, which the solution must keep.
    :param pose: in the model frame; a mapping {link: pose} for groups with several tips.
    :param link: the link (or attached body, or ``body/subframe``) of the pose; default the tip of the group.
    :param seed: where to start: a state, which also says where the other joints are, or (n,) group values.
    :param timeout: s. The first solution usually takes some 0.02 ms.
    :param tolerance: largest norm of the pose error, m and rad together; ``position_only`` leaves the orientation free.
    :param consistency: (n,) largest distance of each joint from the seed. :param valid: an extra test of (n,) group values.
    :param solutions: how many different ones are wanted. :param return_approximate: the nearest that was found will do.
    :param max_restarts: tries from random states, drawn by ``random_seed``, after the first from the seed; -1: until time is up.
    :raises UnknownNameError, InvalidInputError: for what no search can answer.
    """
    scene = scene_or_model if isinstance(scene_or_model, _core.PlanningScene) else None
    model = scene.model if scene is not None else scene_or_model
    start = seed if isinstance(seed, _core.RobotState) else scene.state if scene is not None else model.state()
    if seed is not None and start is not seed:
        start.set_group(group, seed)
    if scene is None and (avoid_collisions or constraints is not None):
        raise _core.InvalidInputError("inverse kinematics: collisions and constraints need a planning scene, not a model alone")
    targets = [_on_robot(start, name, p) for name, p in _targets(model, model.group(group), pose, link)]
    random_seed = random.getrandbits(63) if random_seed is None else random_seed
    found = _core._ik(
        start,
        group,
        targets,
        timeout,
        tolerance,
        position_only,
        solutions,
        max_restarts,
        return_approximate,
        consistency,
        valid,
        random_seed,
        scene if avoid_collisions else None,
        scene,
        constraints,
    )
    none = not len(found["solutions"]) or found["approximate"]
    return IkResult(message=_why(found, group, [name for name, _ in targets]) if none else "", **found)


def _why(found: Mapping[str, Any], group: str, links: Sequence[str]) -> str:
    names = ", ".join(f"'{name}'" for name in links)
    if found["rejected"]:
        return f"{found['rejected']} ways to bring {names} there were found, but all collide or break a constraint"
    return (
        f"no joint values of group '{group}' bring {names} there: the pose is out of reach "
        f"(nearest: {found['error']:.3g} off after {found['restarts']} restarts)"
    )

"""What is said of a path: its length, how smooth it is, how far from obstacles, whether it may be used at all."""

from __future__ import annotations

import motion
import numpy as np

from .log import Run


def steps(trajectory: motion.Trajectory) -> np.ndarray:
    """(k - 1, n) from each way point of ``trajectory`` to the next, endless joints the short way."""
    model = trajectory.start.model
    rows = np.diff(trajectory.positions, axis=0)
    return _short(rows, model, trajectory.group)


def _short(rows: np.ndarray, model: motion.RobotModel, group: str) -> np.ndarray:
    endless = np.array(
        [model.joint(name).type == "continuous" for name in model.group(group).active_joints for _ in model.joint(name).variables],
        dtype=bool,
    )
    rows = np.array(rows)
    rows[..., endless] -= 2 * np.pi * np.round(rows[..., endless] / (2 * np.pi))
    return rows


def smoothness(trajectory: motion.Trajectory) -> float:
    """Mean of the squared outside angles between steps of ``trajectory``, twice each, as upstream weighs them; 0 for a straight line
    (rad2).
    """
    total, lengths = 0.0, np.abs(steps(trajectory)).sum(axis=1)
    positions = trajectory.positions
    model, group = trajectory.start.model, trajectory.group
    for k in range(2, len(positions)):
        a, b = lengths[k - 2], lengths[k - 1]
        c = float(np.abs(_short(positions[k] - positions[k - 2], model, group)).sum())
        cosine = (a * a + b * b - c * c) / (2 * a * b) if a > 0 and b > 0 else 1.0
        if -1 < cosine < 1:
            total += (2 * (np.pi - np.arccos(cosine))) ** 2
    return total / max(1, len(positions))


def of_run(scene: motion.PlanningScene, result: motion.PlanResult | None, took: float, planning: float) -> Run:
    """The properties of one run in ``scene``, by the names of the log.

    :param result: None where there is none.
    :param took: s, of the whole request. :param planning: s, of the planning alone.
    """
    solved = bool(result)
    run = {"time REAL": f"{took:.9g}", "solved BOOLEAN": str(int(solved))}
    trajectory = result.trajectory if result else None
    if trajectory is None or not len(trajectory):
        return run
    states = [trajectory.state(k) for k in range(len(trajectory))]
    clearances = [max(0.0, scene.distance(state, group=trajectory.group).distance) for state in states]
    correct = all(state.in_bounds() and not scene.check(state, padded=False) for state in states)
    values = {
        "correct BOOLEAN": str(int(correct)),
        "length REAL": f"{np.abs(steps(trajectory)).sum():.9g}",
        "clearance REAL": f"{np.mean(clearances):.9g}",
        "smoothness REAL": f"{smoothness(trajectory):.9g}",
        "time REAL": f"{planning:.9g}",
    }
    for prefix in ("path_plan", "final_path"):
        run.update({f"{prefix}_{key}": value for key, value in values.items()})
    run["process_time REAL"] = f"{max(0.0, took - planning):.9g}"
    return run


def add_similarity(runs: list[Run], trajectories: list[motion.Trajectory | None]) -> None:
    """Write into ``runs`` how far each of their ``trajectories`` is from the others, on average: average_waypoint_distance."""
    solved = {i: trajectory for i, trajectory in enumerate(trajectories) if trajectory is not None and len(trajectory)}
    for i, trajectory in solved.items():
        distances = [_between(trajectory, other) for j, other in solved.items() if j != i]
        runs[i]["average_waypoint_distance REAL"] = f"{np.mean(distances) if distances else 0.0:.9g}"


def _between(one: motion.Trajectory, other: motion.Trajectory) -> float:
    """Mean distance (sum over the joints) of way points, both paths gone along so that it stays small."""
    a, b = one.positions, other.positions
    model, group = one.start.model, one.group
    table = np.abs(_short(a[:, None, :] - b[None, :, :], model, group)).sum(axis=2)
    i = j = 0
    total, count = table[0, 0], 1
    while (i, j) != (len(a) - 1, len(b) - 1):
        options = [(x, y) for x, y in ((i + 1, j + 1), (i + 1, j), (i, j + 1)) if x < len(a) and y < len(b)]
        i, j = min(options, key=lambda at: table[at])
        total, count = total + table[i, j], count + 1
    return float(total / count)

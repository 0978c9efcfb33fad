"""When to be where: times, velocities and accelerations for a path."""
from __future__ import annotations

from typing import List, Tuple

import numpy as np

from motion import _core
from motion.trajectory import Trajectory

_METHODS = ("iterative_parabolic", "time_optimal", "iterative_spline")
_UNSET = 1.0  # rad/s, rad/s^2 (m for sliding joints) where the robot says nothing, as upstream


def timing_methods() -> List[str]:
    """The names that time_parameterize understands."""
    return list(_METHODS)


def _scaling(value: float) -> float:
    """Upstream's rule: what is not in (0, 1] means 1."""
    return float(value) if 0.0 < value <= 1.0 else 1.0


def _limits(trajectory: Trajectory, velocity_scaling: float, acceleration_scaling: float, scale_unset: bool) -> Tuple[np.ndarray, np.ndarray]:
    velocity, acceleration = [], []
    for name in trajectory.variables:
        limits = trajectory.model.variable_limits(name)
        for has, most, scaling, into, what in ((limits.has_velocity, limits.max_velocity, velocity_scaling, velocity, "velocity"),
                                               (limits.has_acceleration, limits.max_acceleration, acceleration_scaling, acceleration, "acceleration")):
            if has and not most > 0:
                raise _core.InvalidInputError(f"joint '{name}' has a {what} limit of {most:g}: it must be above 0 (joint_limits.yaml)")
            into.append(most * scaling if has else _UNSET * (scaling if scale_unset else 1.0))
    return np.array(velocity), np.array(acceleration)


def time_parameterize(model: _core.RobotModel, trajectory: Trajectory, method: str = "iterative_parabolic", *,
                      velocity_scaling: float = 1.0, acceleration_scaling: float = 1.0, path_tolerance: float = 0.1,
                      resample_dt: float = 0.1, min_angle_change: float = 0.001) -> Trajectory:
    """The trajectory with times, velocities and accelerations that keep the joints' limits, starting and ending at rest.

    :param method: ``iterative_parabolic`` and ``iterative_spline`` keep the way points; ``time_optimal`` rounds the corners
        and gives new points every ``resample_dt`` seconds.
    :param velocity_scaling: share of the velocity limits to use, in (0, 1]; anything else means 1.
    :param acceleration_scaling: the same for accelerations.
    :param path_tolerance: how far ``time_optimal`` may cut a corner (norm over the joints, rad).
    :param min_angle_change: points nearer than this (largest joint, rad) to the one before are skipped by ``time_optimal``.
    :raises InvalidInputError: unknown method, or limits of zero.
    """
    if method not in _METHODS:
        raise _core.InvalidInputError(f"there is no timing method '{str(method)[:60]}' (there is: {', '.join(_METHODS)})")
    smooth = trajectory.replaced().unwind()
    velocity, acceleration = _limits(trajectory, _scaling(velocity_scaling), _scaling(acceleration_scaling), method != "time_optimal")
    times, positions, velocities, accelerations = _core._time(method, smooth.positions, velocity, acceleration,
                                                              path_tolerance, resample_dt, min_angle_change)
    return smooth.replaced(positions=positions, times=times, velocities=velocities, accelerations=accelerations)


def limit_cartesian_speed(trajectory: Trajectory, link: str, speed: float) -> Trajectory:
    """The timed trajectory with segments stretched so that ``link`` moves no faster than ``speed`` m/s between way points."""
    if not speed > 0 or trajectory.times is None or len(trajectory) < 2:
        return trajectory
    places = np.array([trajectory.state(i).pose(link).position for i in range(len(trajectory))])
    segments = np.diff(trajectory.times)
    needed = np.linalg.norm(np.diff(places, axis=0), axis=1) / speed
    stretched = np.maximum(segments, needed)
    factors = np.where(segments > 0, stretched / np.maximum(segments, 1e-12), 1.0)
    # A way point slows down as much as the slower of its two segments.
    at_points = np.maximum(np.append(factors, 1.0), np.insert(factors, 0, 1.0))[:, None]
    return trajectory.replaced(
        times=trajectory.times[0] + np.concatenate([[0.0], np.cumsum(stretched)]),
        velocities=None if trajectory.velocities is None else trajectory.velocities / at_points,
        accelerations=None if trajectory.accelerations is None else trajectory.accelerations / at_points ** 2)

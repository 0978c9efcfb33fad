"""When to be where: times, velocities and accelerations for a path."""

from __future__ import annotations

import numpy as np

from motion import _core
from motion.trajectory import Trajectory

_METHODS = ("iterative_parabolic", "time_optimal", "iterative_spline")
_JERK = 100.0  # rad/s^3 where a joint has no limit, as upstream
_UNSET = 1.0  # rad/s, rad/s^2 (m for sliding joints) where the robot says nothing, as upstream


def timing_methods() -> list[str]:
    """The names that time_parameterize understands."""
    return list(_METHODS)


def _scaling(value: float) -> float:
    """Upstream's rule: what is not in (0, 1] means 1."""
    return float(value) if 0.0 < value <= 1.0 else 1.0


def above_zero(name: str, what: str, most: float) -> None:
    """:raises InvalidInputError: ``most``, the limit of joint ``name``'s ``what`` (velocity, acceleration), is none it can move with"""
    if not most > 0:
        raise _core.InvalidInputError(f"the {what} limit of joint '{name}' is {most:g}: it must be above 0 (joint_limits.yaml)")


def _limits(
    trajectory: Trajectory, velocity_scaling: float, acceleration_scaling: float, scale_unset: bool
) -> tuple[np.ndarray, np.ndarray]:
    velocity: list[float] = []
    acceleration: list[float] = []
    for name in trajectory.variables:
        limits = trajectory.model.variable_limits(name)
        for has, most, scaling, into, what in (
            (limits.has_velocity, limits.max_velocity, velocity_scaling, velocity, "velocity"),
            (limits.has_acceleration, limits.max_acceleration, acceleration_scaling, acceleration, "acceleration"),
        ):
            if has:
                above_zero(name, what, most)
            into.append(most * scaling if has else _UNSET * (scaling if scale_unset else 1.0))
    return np.array(velocity), np.array(acceleration)


def time_parameterize(
    model: _core.RobotModel,
    trajectory: Trajectory,
    method: str = "iterative_parabolic",
    *,
    velocity_scaling: float = 1.0,
    acceleration_scaling: float = 1.0,
    path_tolerance: float = 0.1,
    resample_dt: float = 0.1,
    min_angle_change: float = 0.001,
) -> Trajectory:
    """The trajectory with times, velocities and accelerations that keep the joints' limits, starting and ending at rest.

    :param method: ``iterative_parabolic`` and ``iterative_spline`` keep the way points; ``time_optimal`` rounds the corners
        and gives new points every ``resample_dt`` seconds.
    :param velocity_scaling: share of the velocity limits to use, in (0, 1]; anything else means 1.
    :param acceleration_scaling: the same for accelerations.
    :param path_tolerance: how far ``time_optimal`` may cut a corner (norm over the joints, rad).
    :param min_angle_change: points nearer than this (largest joint, rad) to the one before are skipped by ``time_optimal``.
    :param model: whose joints' limits are kept.
    :raises InvalidInputError: unknown method, or limits of zero.
    """
    if method not in _METHODS:
        raise _core.InvalidInputError(f"there is no timing method '{str(method)[:60]}' (there is: {', '.join(_METHODS)})")
    smooth = trajectory.replaced().unwind()
    velocity, acceleration = _limits(trajectory, _scaling(velocity_scaling), _scaling(acceleration_scaling), method != "time_optimal")
    times, positions, velocities, accelerations = _core._time(
        method, smooth.positions, velocity, acceleration, path_tolerance, resample_dt, min_angle_change
    )
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
        accelerations=None if trajectory.accelerations is None else trajectory.accelerations / at_points**2,
    )


def limit_jerk(trajectory: Trajectory) -> Trajectory:
    """The timed trajectory with jerks inside the joints' limits (``max_jerk``; 100 rad/s^3 or m/s^3 where there is none).

    Each joint's motion is averaged over the last T seconds. That keeps its limits of position, velocity and acceleration, makes
    jerks at most the span of its accelerations divided by T, and takes T seconds longer; T is as short as the limits allow.
    Corners are rounded by about the acceleration times T^2 / 24.
    """
    if trajectory.times is None or trajectory.velocities is None or len(trajectory) < 2 or trajectory.duration <= 0:
        return trajectory
    smooth = trajectory.replaced().unwind()
    assert smooth.times is not None and smooth.velocities is not None  # as the trajectory's
    keep = np.concatenate([[True], np.diff(smooth.times) > 1e-9])
    times, points, speeds = smooth.times[keep] - smooth.times[0], smooth.positions[keep], smooth.velocities[keep]
    limits = [smooth.model.variable_limits(name) for name in smooth.variables]
    jerks = np.array([limit.max_jerk if limit.has_jerk and limit.max_jerk > 0 else _JERK for limit in limits])
    ends = _accelerations(times, points, speeds)
    span = np.maximum(ends.max(axis=0), 0.0) - np.minimum(ends.min(axis=0), 0.0)
    window = float((span / jerks).max())
    if window < 1e-4:
        return trajectory
    count = max(2, int(np.ceil((times[-1] + window) / max(window / 2, 0.01))) + 1)
    at = np.linspace(0.0, times[-1] + window, count)
    whole, before = _motion(times, points, speeds, at), _motion(times, points, speeds, at - window)
    positions = (whole[0] - before[0]) / window
    positions[0], positions[-1] = points[0], points[-1]
    return smooth.replaced(
        times=at + smooth.times[0],
        positions=positions,
        velocities=(whole[1] - before[1]) / window,
        accelerations=(whole[2] - before[2]) / window,
    )


def _accelerations(times: np.ndarray, points: np.ndarray, speeds: np.ndarray) -> np.ndarray:
    """(2 (k - 1), n) accelerations at both ends of the segments of cubic splines."""
    step, way = np.diff(times)[:, None], np.diff(points, axis=0)
    return np.concatenate(
        [(6 * way / step - 4 * speeds[:-1] - 2 * speeds[1:]) / step, (-6 * way / step + 2 * speeds[:-1] + 4 * speeds[1:]) / step]
    )


def _motion(times: np.ndarray, points: np.ndarray, speeds: np.ndarray, at: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Integral of the positions since the first point, positions and velocities (m, n) of cubic splines at times ``at``; the
    joints stand still before and after."""
    step, way = np.diff(times)[:, None], np.diff(points, axis=0)
    bend = (3 * way / step - 2 * speeds[:-1] - speeds[1:]) / step
    twist = (-2 * way / step + speeds[:-1] + speeds[1:]) / step**2
    areas = points[:-1] * step + speeds[:-1] * step**2 / 2 + bend * step**3 / 3 + twist * step**4 / 4
    area = np.concatenate([np.zeros((1, points.shape[1])), np.cumsum(areas, axis=0)])
    part = np.clip(np.searchsorted(times, at, side="right") - 1, 0, len(times) - 2)
    inside = np.clip(at, 0.0, times[-1])
    dt = (inside - times[part])[:, None]
    q, v, b, c = points[part], speeds[part], bend[part], twist[part]
    outside = (at - inside)[:, None]  # below 0 before the start, above 0 after the end
    place = q + v * dt + b * dt**2 + c * dt**3
    moving = outside == 0
    return (
        area[part] + q * dt + v * dt**2 / 2 + b * dt**3 / 3 + c * dt**4 / 4 + place * outside,
        place,
        np.where(moving, v + 2 * b * dt + 3 * c * dt**2, 0.0),
    )

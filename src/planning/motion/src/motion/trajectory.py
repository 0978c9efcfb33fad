"""Paths and trajectories of a group."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from motion import _core


class Trajectory:
    """Way points of ``group`` of ``model``, with or without times.

    :param start: the whole robot at the first point; what the group does not move stays as there.
    :param positions: (k, n) group values in the group's order of variables, rad or m.
    :param times: (k,) s from the first point, not falling; None while untimed.
    :param velocities: (k, n) per s; None if unknown.
    :param accelerations: (k, n) per s^2; None if unknown.
    :raises InvalidInputError: shapes that do not fit each other, numbers that are not finite.
    """

    def __init__(
        self,
        model: _core.RobotModel,
        group: str,
        start: _core.RobotState,
        positions: ArrayLike,
        times: ArrayLike | None = None,
        velocities: ArrayLike | None = None,
        accelerations: ArrayLike | None = None,
    ):
        self.model = model
        self.group = group
        self.variables: list[str] = model.group(group).variables
        size = len(self.variables)
        self.positions = _rows(positions, size, "positions")
        count = len(self.positions)
        self.times = None if times is None else np.asarray(times, float).reshape(-1)
        if self.times is not None and (len(self.times) != count or not np.isfinite(self.times).all() or (np.diff(self.times) < 0).any()):
            raise _core.InvalidInputError(f"trajectory of '{group}': {count} finite, not falling times are needed")
        self.velocities = None if velocities is None else _rows(velocities, size, "velocities", count)
        self.accelerations = None if accelerations is None else _rows(accelerations, size, "accelerations", count)
        self._start = start.copy()

    def __len__(self) -> int:
        return len(self.positions)

    @property
    def duration(self) -> float:
        """Seconds from the first to the last point; 0 while untimed."""
        return 0.0 if self.times is None or not len(self.times) else float(self.times[-1] - self.times[0])

    @property
    def start(self) -> _core.RobotState:
        return self.state(0) if len(self) else self._start.copy()

    def state(self, index: int) -> _core.RobotState:
        """The whole robot at way point ``index``."""
        state = self._start.copy()
        state.set_group(self.group, self.positions[index])
        return state

    def state_at(self, time: float) -> _core.RobotState:
        """The whole robot ``time`` seconds after the first point, between points straight in joint space."""
        if self.times is None:
            raise _core.InvalidInputError("the trajectory has no times yet")
        if len(self) == 0:
            return self._start.copy()
        after = int(np.searchsorted(self.times - self.times[0], time, side="right"))
        if after == 0 or after == len(self):
            return self.state(0 if after == 0 else len(self) - 1)
        span = self.times[after] - self.times[after - 1]
        share = (time + self.times[0] - self.times[after - 1]) / span if span > 0 else 1.0
        return self.state(after - 1).interpolate(self.state(after), float(share), self.group)

    def _continuous(self) -> np.ndarray:
        group = self.model.group(self.group)
        owners = {v: j for j in group.active_joints for v in self.model.joint(j).variables}
        return np.array([self.model.joint(owners[v]).type == "continuous" for v in self.variables], bool)

    def unwind(self, reference: _core.RobotState | None = None) -> Trajectory:
        """Takes the jumps by a turn out of continuous joints, in place; the first point comes nearest to ``reference``."""
        positions = self.positions
        turning = self._continuous()
        if len(positions) and turning.any():
            steps = np.diff(positions[:, turning], axis=0)
            steps -= 2 * np.pi * np.round(steps / (2 * np.pi))
            first = positions[0, turning]
            if reference is not None:
                there = reference.get_group(self.group)[turning]
                first = first + 2 * np.pi * np.round((there - first) / (2 * np.pi))
            positions[:, turning] = np.vstack([first, first + np.cumsum(steps, axis=0)])
        return self

    def replaced(self, **fields: object) -> Trajectory:
        """A copy with other positions, times, velocities or accelerations."""
        values: dict[str, Any] = {
            "positions": self.positions,
            "times": self.times,
            "velocities": self.velocities,
            "accelerations": self.accelerations,
            "start": self._start,
            **fields,
        }
        return Trajectory(self.model, self.group, **values)

    def reversed(self) -> Trajectory:
        """The same way back in the same time."""
        times = None if self.times is None else (self.times[-1] - self.times)[::-1]
        return self.replaced(
            positions=self.positions[::-1],
            times=times,
            velocities=None if self.velocities is None else -self.velocities[::-1],
            accelerations=None if self.accelerations is None else self.accelerations[::-1],
            start=self.state(len(self) - 1) if len(self) else self._start,
        )

    def append(self, other: Trajectory) -> Trajectory:
        """This motion and then the other; its first point is left out if it is this one's last."""
        if other.group != self.group or other.model is not self.model:
            raise _core.InvalidInputError(f"a trajectory of '{other.group}' cannot follow one of '{self.group}'")
        skip = int(bool(len(self)) and bool(len(other)) and np.abs(self.positions[-1] - other.positions[0]).max() < 1e-6)

        def joined(mine: np.ndarray | None, theirs: np.ndarray | None, shift: float = 0.0) -> np.ndarray | None:
            return None if mine is None or theirs is None else np.concatenate([mine, theirs[skip:] + shift])

        shift = 0.0 if self.times is None or not len(self.times) else float(self.times[-1])
        return self.replaced(
            positions=joined(self.positions, other.positions),
            times=joined(self.times, other.times, shift),
            velocities=joined(self.velocities, other.velocities),
            accelerations=joined(self.accelerations, other.accelerations),
        )

    def joint_limits_exceeded(self, tolerance: float = 1e-3) -> list[str]:
        """One line for each joint that leaves its limits of position, velocity or acceleration by more than ``tolerance``."""
        said = []
        for index, name in enumerate(self.variables):
            limits = self.model.variable_limits(name)
            for what, rows, limit in (
                ("velocity", self.velocities, limits.max_velocity if limits.has_velocity else np.inf),
                ("acceleration", self.accelerations, limits.max_acceleration if limits.has_acceleration else np.inf),
            ):
                worst = 0.0 if rows is None or not len(rows) else float(np.abs(rows[:, index]).max())
                if worst > limit * (1 + tolerance):
                    said.append(f"joint '{name}': {what} {worst:.4g} is above its limit {limit:.4g}")
            if limits.has_position and len(self):
                lowest, highest = self.positions[:, index].min(), self.positions[:, index].max()
                if lowest < limits.min_position - tolerance or highest > limits.max_position + tolerance:
                    said.append(
                        f"joint '{name}': positions {lowest:.4g} to {highest:.4g} leave "
                        f"{limits.min_position:.4g} to {limits.max_position:.4g}"
                    )
        return said

    def __repr__(self) -> str:
        timed = f", {self.duration:.3g} s" if self.times is not None else ", untimed"
        return f"<trajectory of '{self.group}', {len(self)} points{timed}>"


def _rows(values: ArrayLike, size: int, what: str, count: int | None = None) -> np.ndarray:
    rows = np.array(values, float).reshape(-1, size) if np.size(values) == 0 else np.array(values, float)
    if rows.ndim != 2 or rows.shape[1] != size or (count is not None and len(rows) != count) or not np.isfinite(rows).all():
        wanted = f"({'k' if count is None else count}, {size})"
        raise _core.InvalidInputError(f"trajectory: finite {what} of shape {wanted} are needed, not {np.shape(values)}")
    return rows

"""What a gripper's servos do for a width, and what width they leave. Without ROS."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field


class OutOfReach(ValueError):
    """The gripper cannot be so wide; the text says why."""


@dataclass(frozen=True)
class Jaw:
    """A finger that a servo swings: ``joint`` at ``center`` rad stands straight ahead; ``invert`` turns it the other way."""

    joint: str
    center: float = 0.0
    invert: bool = False

    def position(self, angle: float) -> float:
        return self.center + (-angle if self.invert else angle)

    def angle(self, position: float) -> float:
        return (position - self.center) * (-1.0 if self.invert else 1.0)


@dataclass(frozen=True)
class Swinging:
    """One or two swinging fingers: the opening is pad_width + 2 finger_length sin(angle), in m, between min_opening and max_opening."""

    jaws: tuple[Jaw, ...]
    pad_width: float = 0.01
    finger_length: float = 0.02
    min_opening: float = 0.0
    max_opening: float = 0.09

    @property
    def joints(self) -> list[str]:
        return [jaw.joint for jaw in self.jaws]

    def command(self, opening: float) -> dict[str, float]:
        """Positions (rad) of the joints for ``opening`` (m). :raises OutOfReach: it is beyond a limit, or the fingers are too short"""
        if not self.min_opening <= opening <= self.max_opening:
            raise OutOfReach(f"an opening of {opening:g} m is not within {self.min_opening:g} to {self.max_opening:g} m")
        sine = (opening - self.pad_width) / (2 * self.finger_length)
        if not -1.0 <= sine <= 1.0:
            low, high = self.pad_width - 2 * self.finger_length, self.pad_width + 2 * self.finger_length
            raise OutOfReach(f"fingers of {self.finger_length:g} m open by {low:g} to {high:g} m, not by {opening:g} m")
        return {jaw.joint: jaw.position(math.asin(sine)) for jaw in self.jaws}

    def opening(self, positions: Mapping[str, float]) -> float:
        """m, at these positions (rad) of the joints: the mean of what each finger makes of it."""
        angles = [jaw.angle(positions[jaw.joint]) for jaw in self.jaws]
        return sum(self.pad_width + 2 * self.finger_length * math.sin(angle) for angle in angles) / len(angles)


@dataclass(frozen=True)
class Linkage:
    """Parallel jaws that one servo moves: ``joint`` goes to center + scale * opening; the scale is not 0."""

    joint: str
    center: float = 0.0
    scale: float = 1.0

    @property
    def joints(self) -> list[str]:
        return [self.joint]

    def command(self, opening: float) -> dict[str, float]:
        return {self.joint: self.center + self.scale * opening}

    def opening(self, positions: Mapping[str, float]) -> float:
        return (positions[self.joint] - self.center) / self.scale


@dataclass(frozen=True)
class Table:
    """Parallel jaws that one servo moves by a linkage that was measured: ``points`` are (opening m, position rad), interpolated between."""

    joint: str
    low: float = 0.0
    high: float = 0.042
    #: Of the gripper that the node of this name was written for.
    points: Sequence[tuple[float, float]] = field(
        default=((0.0, 1.8097), (0.0159, 1.2167), (0.0254, 0.8997), (0.0381, 0.4499), (0.042, 0.1943))
    )

    @property
    def joints(self) -> list[str]:
        return [self.joint]

    def command(self, opening: float) -> dict[str, float]:
        if not self.low <= opening <= self.high:
            raise OutOfReach(f"an opening of {opening:g} m is not within {self.low:g} to {self.high:g} m")
        return {self.joint: _between(self.points, opening)}

    def opening(self, positions: Mapping[str, float]) -> float:
        return _between([(position, opening) for opening, position in self.points], positions[self.joint])


def _between(points: Sequence[tuple[float, float]], x: float) -> float:
    """Straight lines between ``points``, and on beyond the last of them."""
    points = sorted(points)
    i = next((i for i, (at, _) in enumerate(points[1:-1], 1) if x < at), len(points) - 1)
    (x0, y0), (x1, y1) = points[i - 1], points[i]
    return y0 + (y1 - y0) * (x - x0) / (x1 - x0)


Gripper = Swinging | Linkage | Table

"""One polynomial piece of the trajectory of one joint, in the controller's own time (seconds since it was started)."""
from __future__ import annotations

import math
from typing import List, NamedTuple, Optional, Sequence, Tuple

from joint_limits_interface import shortest_angular_distance

from .tolerances import JointTolerances

TWO_PI = 2.0 * math.pi


class State(NamedTuple):
    """Way-point of one joint: position (rad or m), and velocity and acceleration where they are specified."""

    position: float
    velocity: Optional[float] = None
    acceleration: Optional[float] = None


class Segment:
    """Polynomial of the highest order that both of its ends specify: linear, cubic or quintic.

    Before its start a segment holds its start position, after its end its end position, both at rest.

    :ivar start: seconds
    :ivar end: seconds, not before ``start``
    :ivar point_time: ``time_from_start`` of the way-point that the segment starts at (0 for bridges and holds), seconds
    :ivar goal: the action goal this segment belongs to, or None
    :ivar tolerances: the joint's tolerances while the segment is supervised
    """

    __slots__ = ("start", "end", "coefficients", "end_position", "point_time", "goal", "tolerances")

    def __init__(self, start: float, first: State, end: float, last: State, point_time: float = 0.0,
                 goal=None, tolerances: JointTolerances = JointTolerances()):
        if end < start:
            raise ValueError(f"segment ends at {end} s, before its start at {start} s")
        self.start = start
        self.end = end
        self.coefficients = _coefficients(end - start, first, last)
        self.end_position = last.position
        self.point_time = point_time
        self.goal = goal
        self.tolerances = tolerances

    def sample(self, time: float) -> Tuple[float, float, float]:
        """(position, velocity, acceleration) at ``time``. Realtime safe."""
        if time > self.end:
            return self.end_position, 0.0, 0.0
        c0, c1, c2, c3, c4, c5 = self.coefficients
        t = time - self.start
        if t < 0.0:
            return c0, 0.0, 0.0
        return (c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * c5)))),
                c1 + t * (2.0 * c2 + t * (3.0 * c3 + t * (4.0 * c4 + t * 5.0 * c5))),
                2.0 * c2 + t * (6.0 * c3 + t * (12.0 * c4 + t * 20.0 * c5)))

    def moved(self, delay: float, offset: float, goal, tolerances: JointTolerances) -> "Segment":
        """Shift this segment in place by ``delay`` seconds and ``offset`` rad or m, and give it an owner."""
        self.start += delay
        self.end += delay
        self.coefficients = (self.coefficients[0] + offset,) + self.coefficients[1:]
        self.end_position += offset
        self.goal = goal
        self.tolerances = tolerances
        return self

    def owned_by(self, goal) -> "Segment":
        """A copy that belongs to ``goal`` and keeps its tolerances."""
        copy = Segment.__new__(Segment)
        for name in Segment.__slots__:
            setattr(copy, name, getattr(self, name))
        copy.goal = goal
        return copy


def _coefficients(duration: float, first: State, last: State) -> Tuple[float, ...]:
    """Six coefficients of ascending powers of the time since the start of the segment."""
    p0, v0, a0 = first
    p1, v1, a1 = last
    if duration == 0.0:
        return (p0, v0 or 0.0, 0.5 * (a0 or 0.0), 0.0, 0.0, 0.0)
    delta = p1 - p0
    if v0 is None or v1 is None:
        return (p0, delta / duration, 0.0, 0.0, 0.0, 0.0)
    t = duration
    if a0 is None or a1 is None:
        return (p0, v0, (3.0 * delta / t - 2.0 * v0 - v1) / t, (v0 + v1 - 2.0 * delta / t) / (t * t), 0.0, 0.0)
    return (p0, v0, 0.5 * a0,
            (20.0 * delta - (8.0 * v1 + 12.0 * v0) * t - (3.0 * a0 - a1) * t * t) / (2.0 * t ** 3),
            (-30.0 * delta + (14.0 * v1 + 16.0 * v0) * t + (3.0 * a0 - 2.0 * a1) * t * t) / (2.0 * t ** 4),
            (12.0 * delta - 6.0 * (v1 + v0) * t + (a1 - a0) * t * t) / (2.0 * t ** 5))


def active_index(segments: Sequence[Segment], time: float) -> int:
    """Index of the last segment that has started by ``time``; -1 before the first one."""
    low, high = 0, len(segments)
    while low < high:
        middle = (low + high) // 2
        if segments[middle].start <= time:
            low = middle + 1
        else:
            high = middle
    return low - 1


def wraparound_offset(previous: float, following: float) -> float:
    """Multiple of 2 pi to add to ``following`` so that a continuous joint at ``previous`` turns the short way.

    When both ways are equally long, the joint turns in the direction the numbers say.
    """
    distance = shortest_angular_distance(previous, following)
    if abs(abs(distance) - math.pi) < 1e-9:
        distance = math.copysign(math.pi, following - previous)
    return round((previous + distance - following) / TWO_PI) * TWO_PI


def stop_segment(start: float, position: float, velocity: float, duration: float, goal, tolerances) -> Segment:
    """Smooth stop from a moving state, without reversing: at rest after ``duration`` seconds.

    It is the first half of the quintic that turns (position, velocity) into (position, -velocity).
    """
    if duration == 0.0:
        rest = State(position, 0.0, 0.0)
        return Segment(start, rest, start, rest, 0.0, goal, tolerances)
    end = State(position + 0.625 * velocity * duration, 0.0, -1.5 * velocity / duration)
    return Segment(start, State(position, velocity, 0.0), start + duration, end, 0.0, goal, tolerances)


def point_segments(states: Sequence[State], times: Sequence[float]) -> List[Segment]:
    """Segments between consecutive way-points of one joint, their times relative to the start of the message."""
    return [Segment(times[i], states[i], times[i + 1], states[i + 1], times[i]) for i in range(len(states) - 1)]

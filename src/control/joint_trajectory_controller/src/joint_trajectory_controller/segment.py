"""One polynomial piece of the trajectory of one joint, in the controller's own time (seconds since it was started)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from ._sampler import Spline
from .tolerances import JointTolerances


class State(NamedTuple):
    """Way-point of one joint: position (rad or m), and velocity and acceleration where they are specified."""

    position: float
    velocity: float | None = None
    acceleration: float | None = None


class Segment(Spline):
    """Polynomial of the highest order that both of its ends specify: linear, cubic or quintic (``spline_law.h``).

    Before its start a segment holds its start position, after its end its end position, both at rest.

    :param first, last: the joint's states at ``start`` and ``end``
    :ivar start: seconds
    :ivar end: seconds, not before ``start``
    :ivar point_time: ``time_from_start`` of the way-point that the segment starts at (0 for bridges and holds), seconds
    :ivar goal: the action goal this segment belongs to, or None
    :ivar tolerances: the joint's tolerances while the segment is supervised
    """

    __slots__ = ("point_time", "goal", "tolerances")

    def __init__(
        self,
        start: float,
        first: State,
        end: float,
        last: State,
        point_time: float = 0.0,
        goal=None,
        tolerances: JointTolerances = JointTolerances(),
    ):
        super().__init__(start, first, end, last)
        self.point_time = point_time
        self.goal = goal
        self.tolerances = tolerances

    @staticmethod
    def of(spline: Spline, point_time: float, goal, tolerances: JointTolerances) -> Segment:
        """A segment that moves as ``spline`` does, with ``point_time`` (s), ``goal`` and ``tolerances`` as in the class."""
        segment = Segment.__new__(Segment)
        Spline.__init__(segment, spline)
        segment.point_time = point_time
        segment.goal = goal
        segment.tolerances = tolerances
        return segment

    def moved(self, delay: float, offset: float, goal, tolerances: JointTolerances) -> Segment:
        """Shift this segment in place by ``delay`` seconds and ``offset`` rad or m, and give it ``goal``, its owner, and ``tolerances``."""
        self.move(delay, offset)
        self.goal = goal
        self.tolerances = tolerances
        return self

    def owned_by(self, goal) -> Segment:
        """A copy that belongs to ``goal`` and keeps its tolerances."""
        return Segment.of(self, self.point_time, goal, self.tolerances)


def active_index(segments: Sequence[Segment], time: float) -> int:
    """Index of the last of ``segments``, in order of time, that has started by ``time`` (s); -1 before the first one."""
    low, high = 0, len(segments)
    while low < high:
        middle = (low + high) // 2
        if segments[middle].start <= time:
            low = middle + 1
        else:
            high = middle
    return low - 1


def stop_segment(start: float, position: float, velocity: float, duration: float, goal, tolerances) -> Segment:
    """Smooth stop from a moving state, without reversing: at rest after ``duration`` seconds.

    :param start: time at which the joint is at ``position`` (rad or m) with ``velocity`` (rad/s or m/s), s
    :param goal, tolerances: of the segment, see the class
    """
    return Segment.of(Spline.stop(start, position, velocity, duration), 0.0, goal, tolerances)


def point_segments(states: Sequence[State], times: Sequence[float]) -> list[Segment]:
    """Segments between consecutive ``states`` of one joint, which it has at ``times`` (s, relative to the start of the message)."""
    return [Segment(times[i], states[i], times[i + 1], states[i + 1], times[i]) for i in range(len(states) - 1)]

"""Segments, errors, tolerances and joins: inputs, what comes out, and why. Expected values are those of ros_controllers' packages
joint_trajectory_controller and trajectory_interface (noetic), worked out by hand. Both faces run this table.
"""

from dataclasses import dataclass
from math import inf, nan, pi
from typing import Optional

State = tuple[float, float | None, float | None]


@dataclass
class SegmentCase:
    """``samples``: (time, position, velocity, acceleration)."""

    why: str
    start: float
    first: State
    end: float
    last: State
    samples: list[tuple[float, float, float, float]]


SEGMENTS = [
    SegmentCase(
        "positions alone give a line",
        1.0,
        (2.0, None, None),
        3.0,
        (6.0, None, None),
        [(1.0, 2.0, 2.0, 0.0), (2.0, 4.0, 2.0, 0.0), (3.0, 6.0, 2.0, 0.0)],
    ),
    SegmentCase(
        "before its start and after its end it rests",
        1.0,
        (2.0, None, None),
        3.0,
        (6.0, None, None),
        [(0.5, 2.0, 0.0, 0.0), (3.5, 6.0, 0.0, 0.0), (-inf, 2.0, 0.0, 0.0), (inf, 6.0, 0.0, 0.0)],
    ),
    SegmentCase("accelerations without velocities do not count", 0.0, (0.0, None, 5.0), 2.0, (4.0, None, 5.0), [(1.0, 2.0, 2.0, 0.0)]),
    SegmentCase("velocities of one end alone do not count", 0.0, (0.0, 9.0, 5.0), 2.0, (4.0, None, None), [(0.0, 0.0, 2.0, 0.0)]),
    # 3 t^2 - 2 t^3
    SegmentCase(
        "velocities give a cubic",
        0.0,
        (0.0, 0.0, None),
        1.0,
        (1.0, 0.0, None),
        [(0.0, 0.0, 0.0, 6.0), (0.5, 0.5, 1.5, 0.0), (0.25, 0.15625, 1.125, 3.0), (1.0, 1.0, 0.0, -6.0), (1.5, 1.0, 0.0, 0.0)],
    ),
    SegmentCase("accelerations of one end alone do not count", 0.0, (0.0, 0.0, 9.0), 1.0, (1.0, 0.0, None), [(0.0, 0.0, 0.0, 6.0)]),
    # 10 t^3 - 15 t^4 + 6 t^5, t in half seconds
    SegmentCase(
        "accelerations as well give a quintic",
        1.0,
        (0.0, 0.0, 0.0),
        3.0,
        (1.0, 0.0, 0.0),
        [(1.0, 0.0, 0.0, 0.0), (2.0, 0.5, 0.9375, 0.0), (3.0, 1.0, 0.0, 0.0)],
    ),
    SegmentCase(
        "a quintic has the values of both ends",
        0.0,
        (1.0, -2.0, 3.0),
        2.0,
        (-1.0, 0.5, 4.0),
        [(0.0, 1.0, -2.0, 3.0), (2.0, -1.0, 0.5, 4.0)],
    ),
    SegmentCase(
        "without duration it is its start: positions",
        1.0,
        (2.0, None, None),
        1.0,
        (5.0, None, None),
        [(0.5, 2.0, 0.0, 0.0), (1.0, 2.0, 0.0, 0.0), (1.5, 2.0, 0.0, 0.0)],
    ),
    SegmentCase(
        "without duration it is its start: velocities",
        1.0,
        (2.0, 3.0, None),
        1.0,
        (5.0, 0.0, None),
        [(1.0, 2.0, 3.0, 0.0), (1.5, 2.0, 0.0, 0.0)],
    ),
    SegmentCase(
        "without duration it is its start: accelerations",
        1.0,
        (2.0, 3.0, 4.0),
        1.0,
        (5.0, 0.0, 0.0),
        [(1.0, 2.0, 3.0, 4.0), (1.5, 2.0, 0.0, 0.0)],
    ),
    SegmentCase("no time to speak of has no numbers", 0.0, (0.0, None, None), 1.0, (1.0, None, None), [(nan, nan, nan, nan)]),
]
#: measured, desired, whether it is an angle, error
ERRORS = [
    (0.0, 1.0, True, 1.0),
    (3.0, -3.0, True, 2 * pi - 6.0),
    (3.0, -3.0, False, -6.0),
    (0.0, pi, True, pi),
    (0.0, -pi, True, pi),
    (0.0, 2 * pi, True, 0.0),
    (0.0, 2 * pi, False, 2 * pi),
    (7.0, 1.0, True, 2 * pi - 6.0),
    (0.0, nan, True, nan),
    (nan, 0.0, False, nan),
    (0.0, inf, True, nan),
    (0.0, inf, False, inf),
]
#: error, tolerance, whether it is over it
TOLERANCES = [
    (0.1, 0.1, False),
    (-0.1, 0.1, False),
    (0.2, 0.1, True),
    (-0.2, 0.1, True),
    (9.0, 0.0, False),
    (9.0, -1.0, False),
    (nan, 0.1, True),
    (nan, 0.0, False),
    (inf, 0.1, True),
    (inf, inf, False),
    (9.0, nan, False),
]
#: tolerance of the parameters, what a goal asks for, tolerance
OVERRIDES = [(0.5, 0.0, 0.5), (0.5, 0.25, 0.25), (0.5, -1.0, 0.0), (0.5, nan, 0.5), (0.5, inf, inf), (0.5, -inf, 0.0), (0.0, 0.25, 0.25)]
#: where a joint that turns without end is, where it is to go, whole turns to add
TURNS = [
    (0.0, 1.0, 0),
    (0.0, 4.5 * pi, -2),
    (0.0, -1.75 * pi, 1),
    (0.5 * pi, 4.5 * pi, -2),
    (9 * pi, 0.0, 4),
    (0.0, pi, 0),
    (0.0, -pi, 0),
    (0.0, 3 * pi, -1),
    (0.0, -3 * pi, 1),
    (pi, -pi, 1),
]
#: position, velocity, duration, time since, and where a stop is then
STOPS = [
    (2.0, 4.0, 0.0, 0.0, (2.0, 0.0, 0.0)),
    (2.0, 4.0, -1.0, 0.0, (2.0, 0.0, 0.0)),
    (2.0, 4.0, 2.0, 0.0, (2.0, 4.0, 0.0)),
    (2.0, 4.0, 2.0, 2.0, (7.0, 0.0, -3.0)),
    (2.0, 4.0, 2.0, 3.0, (7.0, 0.0, 0.0)),
    (2.0, -4.0, 2.0, 2.0, (-3.0, 0.0, 3.0)),
    (2.0, 0.0, 2.0, 1.0, (2.0, 0.0, 0.0)),
]

"""What upstream's classes do (ros_controllers 0.21), as values on paper; docs/differences.md names where it is otherwise.

The numbers are sums of powers of two wherever no sine is in them, so that they hold bit by bit.
"""

from math import cos, inf, nan, pi, sin, tan
from typing import NamedTuple, Optional

Bounds = tuple[float, float] | None


class Limit(NamedTuple):
    """``steps``: (velocity wanted, dt, velocity allowed), one after the other from standstill."""

    why: str
    velocity: Bounds
    acceleration: Bounds
    jerk: Bounds
    steps: list[tuple[float, float, float]]

    def __str__(self) -> str:
        return self.why


LIMITS = [
    Limit("no limits: all passes, NaN too", None, None, None, [(123.0, 0.0, 123.0), (nan, 0.5, nan), (inf, 0.5, inf), (-1.0, -0.5, -1.0)]),
    Limit(
        "velocity", (-0.5, 1.0), None, None, [(2.0, 0.25, 1.0), (0.25, 0.25, 0.25), (-2.0, 0.25, -0.5), (inf, 0.25, 1.0), (-inf, 0.0, -0.5)]
    ),
    Limit("NaN is the lowest velocity", (-0.5, 1.0), None, None, [(0.75, 0.25, 0.75), (nan, 0.25, -0.5)]),
    Limit(
        "velocities the wrong way round: the high end", (1.0, -0.5), None, None, [(0.0, 0.25, -0.5), (2.0, 0.25, -0.5), (nan, 0.25, -0.5)]
    ),
    Limit("bounds that are NaN: of the low one comes NaN, of the high one nothing but the low", (nan, 1.0), None, None, [(0.5, 0.25, nan)]),
    Limit("a high bound that is NaN bounds nothing", (-1.0, nan), None, None, [(5.0, 0.25, 5.0), (-5.0, 0.25, -1.0)]),
    Limit(
        "acceleration counts from the last output",
        None,
        (-2.0, 1.0),
        None,
        [(9.0, 0.25, 0.25), (9.0, 0.25, 0.5), (-9.0, 0.25, 0.0), (-9.0, 0.5, -1.0)],
    ),
    Limit("an infinite command is one beyond", None, (-2.0, 1.0), None, [(inf, 0.5, 0.5), (-inf, 0.5, -0.5)]),
    Limit("NaN brakes as hard as allowed", None, (-2.0, 1.0), None, [(9.0, 1.0, 1.0), (nan, 0.25, 0.5)]),
    Limit("in no time nothing changes", None, (-2.0, 1.0), None, [(9.0, 0.5, 0.5), (9.0, 0.0, 0.5), (-9.0, 0.0, 0.5)]),
    Limit("nor with infinite limits", None, (-inf, inf), None, [(9.0, 0.5, 9.0), (3.0, 0.0, 9.0), (3.0, 0.5, 3.0)]),
    Limit(
        "backwards the bounds change places, and the high one counts",
        None,
        (-2.0, 1.0),
        None,
        [(1.0, 1.0, 1.0), (5.0, -0.5, 0.5), (-5.0, -0.5, 0.0)],
    ),
    Limit("dt that is NaN", None, (-2.0, 1.0), None, [(1.0, nan, nan)]),
    Limit("infinite dt", None, (-2.0, 1.0), None, [(7.0, inf, 7.0)]),
    Limit("accelerations the wrong way round: the high end", None, (1.0, -1.0), None, [(0.0, 0.5, -0.5), (0.0, 0.5, -1.0)]),
    Limit(
        "jerk bounds the change of the change",
        None,
        None,
        (-4.0, 4.0),
        [(9.0, 0.25, 0.5), (9.0, 0.25, 1.5), (9.0, 0.25, 3.0), (0.0, 0.25, 4.0)],
    ),
    Limit("jerk knows no direction of time", None, None, (-4.0, 4.0), [(9.0, -0.25, 0.5), (9.0, 0.25, 1.5)]),
    Limit("jerk in no time: on as before", None, None, (-inf, inf), [(1.0, 0.5, 1.0), (9.0, 0.0, 2.0), (2.0, 0.0, 3.0)]),
    Limit("NaN is the lowest jerk", None, None, (-4.0, 8.0), [(nan, 0.5, -2.0)]),
    Limit("jerk, then acceleration, then velocity", (-0.375, 0.375), (-1.0, 1.0), (-64.0, 64.0), [(9.0, 0.25, 0.25), (9.0, 0.25, 0.375)]),
    Limit("the velocity's word is the last one, whatever the acceleration", (-1.0, -0.5), (-1.0, 1.0), None, [(0.0, 0.25, -0.5)]),
    Limit("nothing but no velocity", (0.0, 0.0), (-1.0, 1.0), None, [(5.0, 0.25, 0.0), (nan, 0.25, 0.0)]),
]


class Drive(NamedTuple):
    """``base``: ("sides", window, separation, radius, radius) or ("axle", window, wheel base, radius).

    ``steps``: ("init", time), ("update", left or wheel rad, right or steering rad, time), ("open", m/s, rad/s, time).
    ``expected``: (x, y, heading, linear, angular) after the steps.
    """

    why: str
    base: tuple
    steps: list[tuple]
    expected: tuple[float, float, float, float, float]

    def __str__(self) -> str:
        return self.why


_RIGHT = tan(-0.5) / 2.0  # rad of a car with 2 m between its axles after 1 m
SIDES = ("sides", 1, 0.5, 0.5, 0.5)


def ways(*turns, base_time=0.0, dt=1.0):
    """From wheels at 0, both of the pairs of ``turns`` one after the other."""
    return [
        ("init", base_time),
        ("update", 0.0, 0.0, base_time),
        *(("update", *turn, base_time + dt * number) for number, turn in enumerate(turns, 1)),
    ]


DRIVES = [
    Drive("straight on", SIDES, ways((2.0, 2.0), (4.0, 4.0)), (2.0, 0.0, 0.0, 1.0, 0.0)),
    Drive("backwards", SIDES, ways((-2.0, -2.0)), (-1.0, 0.0, 0.0, -1.0, 0.0)),
    Drive("on the spot", SIDES, ways((-0.5, 0.5)), (0.0, 0.0, 1.0, 0.0, 1.0)),
    Drive("a quarter of a circle about the left side, exact in one step", SIDES, ways((0.0, pi / 2)), (0.25, 0.25, pi / 2, pi / 8, pi / 2)),
    Drive("and in seven", SIDES, ways(*((0.0, pi / 2 * i / 7) for i in range(1, 8))), (0.25, 0.25, pi / 2, pi / 56, pi / 14)),
    Drive("radii that differ", ("sides", 1, 0.5, 0.25, 0.5), ways((4.0, 2.0)), (1.0, 0.0, 0.0, 1.0, 0.0)),
    Drive(
        "two turns: the heading is not wrapped",
        SIDES,
        ways(*((-i * pi / 4, i * pi / 4) for i in range(1, 9))),
        (0.0, 0.0, 4 * pi, 0.0, pi / 2),
    ),
    Drive(
        "nearly straight: the arc that does not divide by nothing",
        SIDES,
        ways((2.0, 2.0 + 2**-22)),
        (1.0 + 2**-24, 2**-23, 2**-22, 1.0 + 2**-24, 2**-22),
    ),
    Drive(
        "the first position is where it begins",
        SIDES,
        [("init", 0.0), ("update", 7.0, 9.0, 0.5), ("update", 9.0, 11.0, 1.5)],
        (1.0, 0.0, 0.0, 1.0, 0.0),
    ),
    Drive("nothing before the first position", SIDES, [("init", 0.0)], (0.0,) * 5),
    Drive("a mean of two", ("sides", 2, 0.5, 0.5, 0.5), ways((2.0, 2.0), (6.0, 6.0), (14.0, 14.0)), (7.0, 0.0, 0.0, 3.0, 0.0)),
    Drive(
        "a window that is not full is a mean of what there is",
        ("sides", 10, 0.5, 0.5, 0.5),
        [("init", 0.0), ("update", 0.0, 0.0, 0.5), ("update", 2.0, 2.0, 1.5)],
        (1.0, 0.0, 0.0, 0.5, 0.0),
    ),
    Drive("a window of none is one of one", ("sides", 0, 0.5, 0.5, 0.5), ways((2.0, 2.0), (6.0, 6.0)), (3.0, 0.0, 0.0, 2.0, 0.0)),
    Drive(
        "too short for a velocity, not for a way", SIDES, [*ways((2.0, 2.0)), ("update", 4.0, 4.0, 1.0 + 2**-14)], (2.0, 0.0, 0.0, 1.0, 0.0)
    ),
    Drive("no time at all", SIDES, [*ways((2.0, 2.0)), ("update", 4.0, 4.0, 1.0)], (2.0, 0.0, 0.0, 1.0, 0.0)),
    Drive(
        "the short interval is counted on",
        SIDES,
        [*ways((2.0, 2.0)), ("update", 4.0, 4.0, 1.0), ("update", 8.0, 8.0, 3.0)],
        (4.0, 0.0, 0.0, 1.0, 0.0),
    ),
    Drive("time that goes back: a way without velocity", SIDES, [*ways((2.0, 2.0)), ("update", 4.0, 4.0, 0.5)], (2.0, 0.0, 0.0, 1.0, 0.0)),
    Drive("begun again: the pose stays, the velocity does not", SIDES, [*ways((2.0, 2.0)), ("init", 5.0)], (1.0, 0.0, 0.0, 0.0, 0.0)),
    Drive(
        "and the means begin again",
        ("sides", 10, 0.5, 0.5, 0.5),
        [*ways((2.0, 2.0)), ("init", 5.0), ("update", 10.0, 10.0, 6.0)],
        (5.0, 0.0, 0.0, 4.0, 0.0),
    ),
    *(
        Drive(
            f"an encoder that jumps to {far} has not moved the base",
            SIDES,
            [*ways((2.0, 2.0)), ("update", far, 2.0, 2.0)],
            (1.0, 0.0, 0.0, 1.0, 0.0),
        )
        for far in (nan, inf, -inf, 1e300)
    ),
    Drive(
        "after NaN it counts from where it is",
        SIDES,
        [*ways((2.0, 2.0), (nan, nan)), ("update", 8.0, 8.0, 3.0), ("update", 10.0, 10.0, 4.0)],
        (2.0, 0.0, 0.0, 1.0, 0.0),
    ),
    Drive("a separation of 0: no way", ("sides", 1, 0.0, 0.5, 0.5), ways((2.0, 2.0), (4.0, 6.0)), (0.0,) * 5),
    Drive("open loop", SIDES, [("init", 0.0), ("open", 1.0, pi / 2, 1.0)], (2 / pi, 2 / pi, pi / 2, 1.0, pi / 2)),
    Drive(
        "open loop back in time: back on the same way",
        SIDES,
        [("init", 0.0), ("open", 2.0, 0.0, 1.0), ("open", 2.0, 0.0, 0.5)],
        (1.0, 0.0, 0.0, 2.0, 0.0),
    ),
    Drive("open loop in no time", SIDES, [("init", 1.0), ("open", 2.0, 1.0, 1.0)], (0.0, 0.0, 0.0, 2.0, 1.0)),
    *(
        Drive(
            f"an open loop of {far} moves nothing",
            SIDES,
            [("init", 0.0), ("open", 1.0, 0.0, 1.0), ("open", far, 0.0, 2.0), ("open", 0.0, far, 3.0)],
            (1.0, 0.0, 0.0, 1.0, 0.0),
        )
        for far in (nan, inf, -inf, 1e300)
    ),
    Drive("a car straight on", ("axle", 1, 2.0, 0.5), ways((2.0, 0.0)), (1.0, 0.0, 0.0, 1.0, 0.0)),
    Drive("a car in a circle", ("axle", 1, 2.0, 0.5), ways((pi * 2.0, pi / 4)), (2.0, 2.0, pi / 2, pi, pi / 2)),
    Drive(
        "a car to the right",
        ("axle", 1, 2.0, 0.5),
        ways((2.0, -0.5)),
        (sin(_RIGHT) / _RIGHT, (1 - cos(_RIGHT)) / _RIGHT, _RIGHT, 1.0, _RIGHT),
    ),
    Drive("steered while it stands", ("axle", 1, 2.0, 0.5), ways((0.0, 1.0)), (0.0,) * 5),
    Drive("steering that is NaN", ("axle", 1, 2.0, 0.5), ways((2.0, 0.0), (4.0, nan)), (1.0, 0.0, 0.0, 1.0, 0.0)),
]

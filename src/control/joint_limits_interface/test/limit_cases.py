"""What joint limits make of commands: inputs, what comes out, and why. Expected values are those of ros_control's joint_limits_interface
(noetic), worked out by hand; where that lets through what is no number, what limit_law.h says. All faces run this table.
"""

from dataclasses import dataclass
from math import inf, nan
from typing import Optional

from joint_limits_interface import JointLimits, SoftJointLimits


@dataclass
class Case:
    """``steps``: (command, position, velocity, dt, allowed), or "reset"."""

    why: str
    kind: str
    limits: JointLimits
    steps: list[object]
    soft: SoftJointLimits | None = None
    warns: bool = False

    def __str__(self) -> str:
        return f"{self.kind}, {'soft' if self.soft else 'hard'}: {self.why}"


def hard(
    position: tuple[float, float] | None = None,
    velocity: float | None = None,
    acceleration: float | None = None,
    effort: float | None = None,
) -> JointLimits:
    low, high = position or (0.0, 0.0)
    return JointLimits(
        min_position=low,
        max_position=high,
        max_velocity=velocity or 0.0,
        max_acceleration=acceleration or 0.0,
        max_effort=effort or 0.0,
        has_position_limits=position is not None,
        has_velocity_limits=velocity is not None,
        has_acceleration_limits=acceleration is not None,
        has_effort_limits=effort is not None,
    )


BOX = hard((-1.0, 1.0), 2.0, effort=8.0)
ENDLESS = hard(None, 2.0, effort=8.0)
CROSSED = hard((1.0, -1.0), 2.0, effort=8.0)
RAMP = hard((-1.0, 1.0), 2.0, 4.0, 8.0)
WINDOW = SoftJointLimits(-0.75, 0.75, 16.0, 32.0)
CROSSED_WINDOW = SoftJointLimits(0.5, -0.5, 16.0, 32.0)

POSITION = [
    Case(
        "the first step starts at the measured position, the others at the last command",
        "position",
        BOX,
        [(5.0, 0.25, 0.0, 0.125, 0.5), (5.0, -0.9, 0.0, 0.125, 0.75), (0.625, -0.9, 0.0, 0.125, 0.625)],
    ),
    Case("the hard limits end the way", "position", BOX, [(5.0, 0.875, 0.0, 0.125, 1.0), (-5.0, 0.0, 0.0, 10.0, -1.0)]),
    Case(
        "after a reset it starts at the measured position again",
        "position",
        BOX,
        [(5.0, 0.0, 0.0, 0.125, 0.25), "reset", (5.0, -0.5, 0.0, 0.125, -0.25)],
    ),
    Case(
        "without a velocity limit a command may jump",
        "position",
        hard((-1.0, 1.0)),
        [(0.9, -0.9, 0.0, 0.001, 0.9), (9.0, 0.0, 0.0, 0.001, 1.0)],
    ),
    Case("without limits all is allowed", "position", hard(), [(1e6, 0.0, 0.0, 0.001, 1e6)]),
    Case("an endless joint has no turn to wrap at", "position", ENDLESS, [(9.0, 6.25, 0.0, 0.125, 6.5)]),
    Case("no time, no step", "position", BOX, [(5.0, 0.25, 0.0, 0.0, 0.25)]),
    Case("time that runs back empties the corridor: its high end counts", "position", BOX, [(5.0, 0.25, 0.0, -0.125, 0.0)]),
    Case("limits the wrong way round: the upper one counts", "position", CROSSED, [(0.0, 0.0, 0.0, 0.125, -1.0)]),
    Case("infinite: as far as the limits let it", "position", BOX, [(inf, 0.0, 0.0, 0.125, 0.25), (-inf, 0.0, 0.0, 0.125, 0.0)]),
    Case("infinite without limits: held", "position", hard(), [(0.5, 0.0, 0.0, 0.125, 0.5), (inf, 0.0, 0.0, 0.125, 0.5)], warns=True),
    Case(
        "NaN: held",
        "position",
        BOX,
        [(0.125, 0.0, 0.0, 0.125, 0.125), (nan, 0.5, 0.0, 0.125, 0.125), (0.25, 0.5, 0.0, 0.125, 0.25)],
        warns=True,
    ),
    Case("NaN at first: where the joint is", "position", BOX, [(nan, 0.5, 0.0, 0.125, 0.5)], warns=True),
    Case("NaN at first, beyond the limit: at the limit", "position", BOX, [(nan, 1.5, 0.0, 0.125, 1.0)], warns=True),
    Case("NaN is measured: the hard limits hold still", "position", BOX, [(5.0, nan, 0.0, 0.125, 1.0), (-5.0, 0.0, 0.0, 0.125, 0.75)]),
    Case(
        "endless speed and no time is no number: the hard limits hold still",
        "position",
        hard((-1.0, 1.0), inf),
        [(5.0, 0.0, 0.0, 0.0, 1.0)],
    ),
    Case("a limit that is no place", "position", hard((inf, inf)), [(0.5, 0.25, 0.0, 0.125, 0.25)], warns=True),
    Case("far from the soft limits: the velocity limit", "position", BOX, [(5.0, 0.0, 0.0, 0.125, 0.25)], WINDOW),
    Case("near them: in proportion", "position", BOX, [(5.0, 0.6875, 0.0, 0.03125, 0.71875)], WINDOW),
    Case("beyond them: back", "position", BOX, [(5.0, 0.8125, 0.0, 0.0625, 0.75)], WINDOW),
    Case("an endless joint has no window", "position", ENDLESS, [(10.0, 9.0, 0.0, 0.125, 9.25)], WINDOW),
    Case("soft limits beyond the hard ones", "position", BOX, [(5.0, 0.9375, 0.0, 0.125, 1.0)], SoftJointLimits(-3.0, 3.0, 16.0, 32.0)),
    Case("a window the wrong way round: its upper end counts", "position", BOX, [(0.0, 0.0, 0.0, 0.0625, -0.125)], CROSSED_WINDOW),
    Case("a negative velocity limit: always at it", "position", hard((-1.0, 1.0), -2.0), [(0.5, 0.0, 0.0, 0.0625, -0.125)], WINDOW),
    Case("no time, no step", "position", BOX, [(5.0, 0.25, 0.0, 0.0, 0.25)], WINDOW),
    Case("NaN: held", "position", BOX, [(0.125, 0.0, 0.0, 0.125, 0.125), (nan, 0.5, 0.0, 0.125, 0.125)], WINDOW, warns=True),
    Case(
        "NaN is measured: the velocity limit bounds nothing, the hard limits do", "position", BOX, [(-5.0, nan, 0.0, 0.125, -1.0)], WINDOW
    ),
]
VELOCITY = [
    Case("the limit", "velocity", BOX, [(9.0, 5.0, 0.0, 0.125, 2.0), (-9.0, 5.0, 0.0, 0.125, -2.0), (1.5, 5.0, 0.0, 0.125, 1.5)]),
    Case(
        "acceleration: steps from the last command, first from 0",
        "velocity",
        RAMP,
        [(9.0, 0.0, 1.5, 0.125, 0.5), (9.0, 0.0, 1.5, 0.125, 1.0), (-9.0, 0.0, 1.5, 0.25, 0.0)],
    ),
    Case("after a reset from 0", "velocity", RAMP, [(9.0, 0.0, 0.0, 0.25, 1.0), "reset", (9.0, 0.0, 0.0, 0.125, 0.5)]),
    Case("no time, no step", "velocity", RAMP, [(9.0, 0.0, 0.0, 0.0, 0.0)]),
    Case("time that runs back empties the corridor: its high end counts", "velocity", RAMP, [(9.0, 0.0, 0.0, -0.125, -0.5)]),
    Case("a negative limit: always at it", "velocity", hard(None, -1.0), [(9.0, 0.0, 0.0, 0.125, -1.0), (0.0, 0.0, 0.0, 0.125, -1.0)]),
    Case("infinite: as fast as the limit", "velocity", BOX, [(inf, 0.0, 0.0, 0.125, 2.0), (-inf, 0.0, 0.0, 0.125, -2.0)]),
    Case(
        "infinite without a limit: held",
        "velocity",
        hard(None, inf),
        [(3.0, 0.0, 0.0, 0.125, 3.0), (inf, 0.0, 0.0, 0.125, 3.0)],
        warns=True,
    ),
    Case("NaN at first: stands", "velocity", BOX, [(nan, 0.0, 1.0, 0.125, 0.0)], warns=True),
    Case("NaN: held", "velocity", RAMP, [(0.25, 0.0, 0.0, 0.125, 0.25), (nan, 0.0, 0.0, 0.125, 0.25)], warns=True),
    Case("the window slows it down", "velocity", BOX, [(9.0, 0.6875, 0.0, 0.125, 1.0), (-9.0, 0.6875, 0.0, 0.125, -2.0)], WINDOW),
    Case("beyond it: back", "velocity", BOX, [(9.0, 0.8125, 0.0, 0.125, -1.0)], WINDOW),
    Case("acceleration: steps from the measured speed", "velocity", RAMP, [(9.0, 0.0, 1.0, 0.125, 1.5)], WINDOW),
    Case("a window the wrong way round: its upper end counts", "velocity", BOX, [(0.0, 0.0, 0.0, 0.125, -2.0)], CROSSED_WINDOW),
    Case("without a velocity limit", "velocity", hard((-1.0, 1.0)), [(99.0, 0.5, 0.0, 0.125, 4.0)], WINDOW),
    Case("NaN is measured: the other limit holds still", "velocity", RAMP, [(9.0, nan, nan, 0.125, 2.0)], WINDOW),
    Case("NaN: held", "velocity", BOX, [(0.25, 0.0, 0.0, 0.125, 0.25), (nan, 0.0, 0.0, 0.125, 0.25)], WINDOW, warns=True),
]
EFFORT = [
    Case("the limit", "effort", BOX, [(9.0, 0.0, 0.0, 0.125, 8.0), (-9.0, 0.0, 0.0, 0.125, -8.0), (3.0, 0.0, 0.0, 0.125, 3.0)]),
    Case(
        "outside nothing pushes further out",
        "effort",
        BOX,
        [(9.0, 1.5, 0.0, 0.125, 0.0), (-9.0, 1.5, 0.0, 0.125, -8.0), (-9.0, -1.5, 0.0, 0.125, 0.0)],
    ),
    Case(
        "too fast: nothing makes it faster",
        "effort",
        BOX,
        [(9.0, 0.0, 2.5, 0.125, 0.0), (-9.0, 0.0, -2.5, 0.125, 0.0), (9.0, 0.0, -2.5, 0.125, 8.0)],
    ),
    Case("an endless joint has no outside", "effort", ENDLESS, [(9.0, 99.0, 0.0, 0.125, 8.0)]),
    Case(
        "limits the wrong way round: the lower one is asked alone",
        "effort",
        CROSSED,
        [(9.0, 0.0, 0.0, 0.125, 8.0), (-9.0, 0.0, 0.0, 0.125, 0.0)],
    ),
    Case("a negative effort limit: always at it", "effort", hard(None, 2.0, effort=-3.0), [(0.0, 0.0, 0.0, 0.125, -3.0)]),
    Case("dt plays no part", "effort", BOX, [(9.0, 0.0, 0.0, 0.0, 8.0), (9.0, 0.0, 0.0, -1.0, 8.0)]),
    Case("infinite: the limit", "effort", BOX, [(inf, 0.0, 0.0, 0.125, 8.0)]),
    Case("infinite without a limit: held", "effort", hard(None, inf, effort=inf), [(-inf, 0.0, 0.0, 0.125, 0.0)], warns=True),
    Case(
        "NaN: held, within what is allowed now",
        "effort",
        BOX,
        [(5.0, 0.0, 0.0, 0.125, 5.0), (nan, 0.0, 0.0, 0.125, 5.0), (nan, 1.5, 0.0, 0.125, 0.0)],
        warns=True,
    ),
    Case("NaN is measured: the effort limit holds", "effort", BOX, [(9.0, nan, nan, 0.125, 8.0)]),
    Case(
        "the window brakes: 32 (2 - 0.1 * 16) is beyond 8, and at its edge nothing pushes",
        "effort",
        BOX,
        [(9.0, 0.0, 0.0, 0.125, 8.0), (9.0, 0.75, 0.0, 0.125, 0.0), (9.0, 0.75, 0.125, 0.125, -4.0)],
        WINDOW,
    ),
    Case("beyond it: back", "effort", BOX, [(9.0, 0.875, 0.0, 0.125, -8.0), (-9.0, -0.765625, 0.0, 0.125, 8.0)], WINDOW),
    Case("an endless joint brakes at its velocity limit", "effort", ENDLESS, [(9.0, 99.0, 2.125, 0.125, -4.0)], WINDOW),
    Case("a window the wrong way round: its upper end counts", "effort", BOX, [(0.0, 0.0, 0.0, 0.125, -8.0)], CROSSED_WINDOW),
    Case("NaN is measured: the effort limit holds", "effort", BOX, [(99.0, 0.0, nan, 0.125, 8.0), (-99.0, nan, 0.0, 0.125, -8.0)], WINDOW),
    Case("NaN: held", "effort", BOX, [(5.0, 0.0, 0.0, 0.125, 5.0), (nan, 0.0, 0.0, 0.125, 5.0)], WINDOW, warns=True),
]
CASES = POSITION + VELOCITY + EFFORT

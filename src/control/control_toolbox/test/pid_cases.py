"""What the PID makes of errors: inputs, what comes out, and why. Expected values are those of control_toolbox (noetic), worked out by
hand; where that has NaN for good, what pid_law.h says. Both faces run this table.
"""

from dataclasses import dataclass
from math import inf, nan

from control_toolbox import Gains


@dataclass
class Case:
    """``steps``: (error, dt, command), (error, derivative, dt, command), "reset", or ("past", derivative, integral)."""

    why: str
    gains: Gains
    steps: list[tuple]

    def __str__(self) -> str:
        return self.why


ALL = Gains(2.0, 4.0, 8.0, 100.0, -100.0)
CASES = [
    Case(
        "the sum of its terms; the first derivative is from an error of 0",
        ALL,
        [(1.0, 0.5, 2.0 + 4.0 * 0.5 + 8.0 * 2.0), (1.0, 0.5, 2.0 + 4.0 * 1.0), (0.0, 0.5, 4.0 * 1.0 - 8.0 * 2.0)],
    ),
    Case(
        "the integral term is clamped, the integral goes on",
        Gains(0.0, 1.0, 0.0, 1.0, -1.0),
        [(5.0, 1.0, 1.0), (-3.0, 1.0, 1.0), (-1.5, 1.0, 0.5)],
    ),
    Case(
        "with antiwindup the integral stops there",
        Gains(0.0, 2.0, 0.0, 1.0, -1.0, True),
        [(5.0, 1.0, 1.0), (-0.25, 1.0, 0.5), (-9.0, 1.0, -1.0)],
    ),
    Case("with antiwindup and a negative gain", Gains(0.0, -2.0, 0.0, 1.0, -3.0, True), [(9.0, 1.0, -3.0), (-9.0, 1.0, 1.0)]),
    Case("with antiwindup and no integral gain nothing is clamped", Gains(1.0, 0.0, 0.0, 0.0, 0.0, True), [(5.0, 1.0, 5.0)]),
    Case("both bounds 0: no integral part", Gains(1.0, 9.0, 0.0, 0.0, 0.0), [(5.0, 1.0, 5.0)]),
    Case("bounds the wrong way round: the lower one is asked first", Gains(0.0, 1.0, 0.0, -1.0, 1.0), [(0.5, 1.0, 1.0), (5.0, 1.0, -1.0)]),
    Case("bounds the wrong way round with antiwindup: sorted", Gains(0.0, 1.0, 0.0, -1.0, 1.0, True), [(5.0, 1.0, 1.0), (-9.0, 1.0, -1.0)]),
    Case("no time: nothing", ALL, [(1.0, 0.5, 20.0), (7.0, 0.0, 0.0), (1.0, 0.5, 6.0)]),
    Case(
        "time that runs back: the last derivative again, the integral runs back, the last error stays",
        ALL,
        [(1.0, 0.5, 20.0), (3.0, -0.25, 6.0 + 4.0 * (0.5 - 0.75) + 8.0 * 2.0), (2.0, 0.5, 4.0 + 4.0 * 0.75 + 8.0 * 2.0)],
    ),
    Case("time that runs back at first: no derivative yet", ALL, [(1.0, -0.5, 2.0 - 4.0 * 0.5), (1.0, 0.5, 2.0 + 16.0)]),
    Case("NaN: nothing, and nothing is left of it", ALL, [(1.0, 0.5, 20.0), (nan, 0.5, 0.0), (1.0, 0.5, 6.0)]),
    Case("infinite: the same", ALL, [(1.0, 0.5, 20.0), (inf, 0.5, 0.0), (-inf, 0.5, 0.0), (1.0, 0.5, 6.0)]),
    Case(
        "a derivative that overflows: nothing is integrated; the error counts as the last one",
        Gains(1.0, 1.0, 1.0, 100.0, -100.0),
        [(1.0, 1.0, 1.0 + 1.0 + 1.0), (-1.7e308, 1e-9, 0.0), (-1.7e308, -0.5, 0.0)],
    ),
    Case(
        "an overflowing derivative leaves the integral as it was",
        Gains(0.0, 1.0, 0.0, 100.0, -100.0),
        [(2.0, 1.0, 2.0), (1.7e308, 0.001, 0.0), ("past", 0.0, 2.0), (1.0, 1.0, 3.0)],
    ),
    Case("a derivative of the caller's", ALL, [(1.0, 3.0, 0.5, 2.0 + 2.0 + 24.0), (1.0, -1.0, 0.5, 2.0 + 4.0 - 8.0)]),
    Case("one that is no number: nothing", ALL, [(1.0, nan, 0.5, 0.0), (1.0, -inf, 0.5, 0.0), (1.0, 0.0, 0.5, 2.0 + 2.0)]),
    Case("after a reset as at first", ALL, [(1.0, 0.5, 20.0), "reset", (1.0, 0.5, 20.0)]),
    Case(
        "after a reset with a past that derivative, then quotients",
        ALL,
        [(1.0, 0.5, 20.0), ("past", 0.25, 1.0), (1.0, 0.5, 2.0 + 4.0 * 1.5 + 2.0), (1.0, 0.5, 2.0 + 4.0 * 2.0)],
    ),
    Case("a command that overflows is none", Gains(10.0), [(1e308, 1.0, 0.0), (1.0, 1.0, 10.0)]),
    Case("an integral that overflows begins at 0 again", Gains(0.0, 1.0, 0.0, inf, -inf), [(1e308, 10.0, 0.0), (1.0, 1.0, 1.0)]),
]

"""The laws of trajectories through both faces, the classes of C++ that have upstream's names and those of Python: one table, and the same
bits."""

import math
import pathlib
import random
import struct
import subprocess

import pytest
from joint_trajectory_controller import _sampler
from joint_trajectory_controller._sampler import position_error, turns_to_add
from joint_trajectory_controller.segment import Segment, State, stop_segment
from joint_trajectory_controller.tolerances import JointTolerances, StateTolerance, overridden
from trajectory_cases import ERRORS, OVERRIDES, SEGMENTS, STOPS, TOLERANCES, TURNS

PROGRAM = pathlib.Path(_sampler.__file__).parents[3] / "joint_trajectory_controller" / "trajectory_faces"  # devel/lib


def in_cpp(*lines):
    """The numbers of each line that is answered."""
    assert PROGRAM.exists(), f"{PROGRAM} was not built; it needs Debian's libgtest-dev"
    text = "\n".join(" ".join(map(str, line)) for line in lines)
    run = subprocess.run([str(PROGRAM)], input=text, capture_output=True, text=True, timeout=60, check=True)
    return [tuple(map(float.fromhex, line.split())) for line in run.stdout.splitlines()]


def segment_line(case_start, first, case_end, last):
    """The order goes first: how many of position, velocity and acceleration there are; those of upstream come all at once."""
    numbers = [0.0 if value is None else value for value in (*first, *last)]
    flags = [int(value is not None) for value in (*first[1:], *last[1:])]
    return ("segment", case_start, case_end, *numbers, *flags)


def bits(numbers):
    return [struct.pack("d", number) for number in numbers]


@pytest.mark.parametrize("case", SEGMENTS, ids=lambda case: case.why)
def test_segments(case):
    segment = Segment(case.start, State(*case.first), case.end, State(*case.last))
    answers = in_cpp(segment_line(case.start, case.first, case.end, case.last), *(("sample", time) for time, *_ in case.samples))
    for (time, *expected), answer in zip(case.samples, answers):
        assert segment.sample(time) == pytest.approx(expected, abs=1e-12, nan_ok=True)
        assert bits(answer) == bits(segment.sample(time))


def test_segments_by_chance_give_the_same_bits():
    dice = random.Random(1)
    for _ in range(3):
        lines, expected = [], []
        for _ in range(200):
            start, orders = dice.uniform(0.0, 2.0), [dice.choice((1, 2, 3)) for _ in range(2)]
            end = start + dice.choice((0.0, dice.uniform(0.01, 3.0)))
            ends = [[dice.uniform(-3.0, 3.0) for _ in range(order)] + [None] * (3 - order) for order in orders]
            segment = Segment(start, State(*ends[0]), end, State(*ends[1]))
            lines.append(segment_line(start, ends[0], end, ends[1]))
            for time in (dice.uniform(-0.5, 6.0), start, end, math.nextafter(end, math.inf)):
                lines.append(("sample", time))
                expected.append(segment.sample(time))
        assert [bits(answer) for answer in in_cpp(*lines)] == [bits(sample) for sample in expected]


def test_errors():
    expected = [error for *_, error in ERRORS]
    here = [position_error(measured, desired, angular) for measured, desired, angular, _ in ERRORS]
    there = [answer[0] for answer in in_cpp(*(("error", m, d, int(angular)) for m, d, angular, _ in ERRORS))]
    assert here == pytest.approx(expected, abs=1e-12, nan_ok=True) and bits(here) == bits(there)


def test_tolerances():
    expected = [over for *_, over in TOLERANCES]
    for kind in ("position", "velocity"):
        here = [StateTolerance(**{kind: tolerance}).violation(error, error) is not None for error, tolerance, _ in TOLERANCES]
        assert here == expected
        assert [answer == (1.0,) for answer in in_cpp(*((kind, error, tolerance) for error, tolerance, _ in TOLERANCES))] == expected


def test_what_a_goal_asks_for():
    expected = [result for *_, result in OVERRIDES]
    assert [_sampler.overridden(tolerance, asked) for tolerance, asked, _ in OVERRIDES] == expected
    assert [answer[0] for answer in in_cpp(*(("override", *row[:2]) for row in OVERRIDES))] == expected

    class Tolerance:
        name, velocity, acceleration = "j", -1.0, 0.0

        def __init__(self, position):
            self.position = position

    class Goal:
        goal_tolerance = ()

        class goal_time_tolerance:  # noqa: N801 - as the message names it
            to_sec = staticmethod(lambda: 0.0)

        def __init__(self, position):
            self.path_tolerance = [Tolerance(position)]

    for tolerance, asked, result in OVERRIDES:
        defaults = [JointTolerances(StateTolerance(tolerance, 1.0, 1.0))]
        if math.isnan(asked):
            with pytest.raises(ValueError, match="is NaN; use -1"):
                overridden(defaults, ["j"], Goal(asked))
        else:
            assert overridden(defaults, ["j"], Goal(asked))[0].path == StateTolerance(result, 0.0, 1.0)


def test_turns():
    expected = [turns * 2 * math.pi for *_, turns in TURNS]
    here = [turns_to_add(start, end) for start, end, _ in TURNS]
    there = [answer[0] for answer in in_cpp(*(("turns", start, end) for start, end, _ in TURNS))]
    assert here == pytest.approx(expected) and bits(here) == bits(there)


@pytest.mark.parametrize("position, velocity, duration, since, expected", STOPS)
def test_stops(position, velocity, duration, since, expected):
    here = stop_segment(8.0, position, velocity, duration, None, JointTolerances()).sample(8.0 + since)
    there = in_cpp(("stop", 8.0, position, velocity, duration, 8.0 + since))[0]
    assert here == pytest.approx(expected) and bits(here) == bits(there)

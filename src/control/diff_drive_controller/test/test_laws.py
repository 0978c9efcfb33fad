"""The laws of wheeled bases through both faces, upstream's classes in C++ and those of Python: one table each, and the same bits."""

import math
import pathlib
import random
import struct
import subprocess

import pytest
from base_cases import DRIVES, LIMITS, SIDES, Drive, Limit
from diff_drive_controller import laws

PROGRAM = pathlib.Path(laws.__file__).parents[3] / "diff_drive_controller" / "base_faces"  # devel/lib


def allowed_in_python(case):
    limiter = laws.SpeedLimiter(*case[1:4])
    return [limiter.limit(velocity, dt) for velocity, dt, _ in case.steps]


def driven_in_python(case):
    kind, window, *lengths = case.base
    odometry, travel, states = laws.PlanarOdometry(window), (laws.WheelTravel(), laws.WheelTravel()), []
    for word, *numbers in case.steps:
        if word == "init":
            odometry.restart(*numbers)
        elif word == "open":
            odometry.commanded(*numbers)
        elif kind == "sides":
            ways = (one(turn) * radius for one, turn, radius in zip(travel, numbers, lengths[1:]))
            odometry.travelled(*laws.differential(*ways, lengths[0]), numbers[2])
        else:
            odometry.travelled(*laws.bicycle(travel[0](numbers[0]) * lengths[1], numbers[1], lengths[0]), numbers[2])
        states.append((odometry.x, odometry.y, odometry.heading, odometry.linear, odometry.angular))
    return states


def in_cpp(lines):
    assert PROGRAM.exists(), f"{PROGRAM} was not built"
    text = "\n".join(" ".join(map(str, line)) for line in lines)
    run = subprocess.run([str(PROGRAM)], input=text, capture_output=True, text=True, timeout=60, check=True)
    return [tuple(map(float.fromhex, line.split())) for line in run.stdout.split("\n")[:-1] if line != "new"]


def allowed_in_cpp(case):
    """What came out is what goes in as the last ones, as upstream's controllers have it."""
    bounds = [part for limits in case[1:4] for part in ((1.0, *limits) if limits else (0.0, 0.0, 0.0))]
    outputs = [0.0, 0.0]
    for velocity, dt, _ in case.steps:
        ((one,),) = in_cpp([("limiter", *bounds), ("limit", velocity, outputs[-1], outputs[-2], dt)])
        outputs.append(one)
    return outputs[2:]


def driven_in_cpp(case):
    return in_cpp([case.base, *case.steps])


def bits(numbers):
    return [struct.pack("d", number) if not math.isnan(number) else "nan" for number in numbers]


@pytest.mark.parametrize("face", [allowed_in_python, allowed_in_cpp])
@pytest.mark.parametrize("case", LIMITS, ids=str)
def test_speed_limits(case, face):
    assert bits(face(case)) == bits([step[-1] for step in case.steps])


@pytest.mark.parametrize("face", [driven_in_python, driven_in_cpp])
@pytest.mark.parametrize("case", DRIVES, ids=str)
def test_odometry(case, face):
    assert face(case)[-1] == pytest.approx(case.expected, abs=1e-14, rel=1e-14)


def test_both_faces_give_the_same_bits():
    chance = random.Random(1)

    def number(size):
        return chance.choice((math.nan, math.inf, -1e308, 0.0)) if chance.random() < 0.05 else chance.uniform(-size, size)

    def dt():
        return chance.choice((0.01, 0.001, 0.00001, 0.0, -0.01))

    for bounds in ((None, (-1.0, 2.0), None), ((-1.0, 2.0), (-3.0, 1.5), (-9.0, 9.0)), ((1.0, -1.0), None, (5.0, -5.0))):
        case = Limit("chance", *bounds, [(number(3.0), dt(), 0.0) for _ in range(20)])
        assert bits(allowed_in_python(case)) == bits(allowed_in_cpp(case))
    for base in (SIDES, ("sides", 7, 0.41, 0.1, 0.11), ("axle", 3, 2.5, 0.3)):
        time, steps = 0.0, [("init", 0.0)]
        for _ in range(500):
            time = max(0.0, round(time + dt(), 5))
            steps.append(("open" if chance.random() < 0.2 else "update", number(9.0), number(1.0), time))
        case = Drive("chance", base, steps, ())
        for one, other in zip(driven_in_python(case), driven_in_cpp(case)):
            assert one == pytest.approx(other, rel=1e-9, abs=1e-9)  # times are in ns there


def test_a_base_that_moves_sideways():
    """On a quarter of a circle, and straight to the left; the heading of the middle of the step is that of the chord."""
    odometry = laws.PlanarOdometry(1)
    odometry.moved(1.0, 0.0, math.pi / 2, 1.0)
    assert (odometry.x, odometry.y, odometry.heading) == pytest.approx((math.sqrt(0.5), math.sqrt(0.5), math.pi / 2))
    odometry.moved(1.0, 2.0, 0.0, 2.0)
    assert (odometry.x, odometry.y) == pytest.approx((math.sqrt(0.5) - 2.0, math.sqrt(0.5) + 1.0))
    odometry.moved(5.0, 3.0, 1.0, 2.0)
    assert (odometry.linear, odometry.linear_y, odometry.angular) == (5.0, 3.0, 1.0), "no time, yet a velocity"
    for far in (math.nan, math.inf, 1e300):
        odometry.moved(0.0, far, 0.0, 3.0)
    assert (odometry.linear_y, odometry.heading) == (3.0, pytest.approx(math.pi / 2))
    assert odometry.interval(1.5) == -0.5


def test_a_wheel_begins_where_it_is_and_where_it_is_restarted():
    travel = laws.WheelTravel()
    assert [travel(position) for position in (5.0, 5.5, 5.25)] == [0.0, 0.5, -0.25]
    travel.restart()
    assert [travel(0.0), travel(1.0)] == [0.0, 1.0]


@pytest.mark.parametrize("window", [2, 1, 0, -3])
def test_rolling_mean(window):
    mean = laws.RollingMean(window)
    assert [mean(value) for value in (1.0, 3.0, 5.0, 7.0)] == ([1.0, 2.0, 4.0, 6.0] if window == 2 else [1.0, 3.0, 5.0, 7.0])
    mean.clear()
    assert mean(9.0) == 9.0


def test_what_passed_through_a_mean_is_gone():
    mean = laws.RollingMean(2)
    for value in (math.inf, math.nan, 1.0):
        mean(value)
    assert mean(3.0) == 2.0

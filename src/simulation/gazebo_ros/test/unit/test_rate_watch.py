"""What a camera says of a rate that it cannot keep, and when it is silent."""

import pytest
from gazebo_ros.rate_watch import RateWatch

MS = 1_000_000


def told(times_ms, taken=lambda i: True, sensor=30.0, plugin=0.0, dt=0.001):
    watch = RateWatch()
    said = [watch.asked(at * MS, taken(i), sensor, plugin, dt) for i, at in enumerate(times_ms)]
    return [line for line in said if line]


def test_a_rate_that_is_kept_is_not_spoken_of():
    assert told(range(0, 20000, 33)) == []
    assert told(range(0, 20000, 1), sensor=0.0) == []


def test_pictures_left_out_are_told_once():
    (line,) = told(range(0, 30000, 33), taken=lambda i: i % 3 == 0)
    assert line.startswith("gives 9.99 pictures") and "not the 30 that are asked for" in line and "61 of 91 were left out" in line


def test_a_single_picture_left_out_is_nothing():
    assert told(range(0, 30000, 33), taken=lambda i: i % 20) == []


def test_a_step_that_is_longer_than_the_period():
    (line,) = told(range(0, 9000, 50), dt=0.05)
    assert (
        line == "gives 20 pictures a second of simulated time, not the 30 that are asked for: one is taken after a step of "
        "the physics, which is 0.05 s long"
    )


def test_rates_that_do_not_divide():
    (line,) = told(range(0, 9000, 66), plugin=20.0)
    assert "gives 15.2 pictures" in line and "not the 20" in line and "Give both the same number" in line


def test_the_same_rate_twice():
    """Pictures of 30 a second are 34, 33 and 33 ms apart: of those only each that is 1/30 s after the last is taken."""
    (line,) = told(range(0, 9000, 50), plugin=30.0)
    assert "gives 20 pictures" in line and line.endswith("Leave <updateRate> out")


def test_periods_are_whole_steps():
    (line,) = told(range(0, 9000, 40), dt=0.02)
    assert line.endswith("one is taken after a step of the physics, which is 0.02 s long")


def test_a_moment_in_which_nobody_listened_is_no_fault_of_the_rates():
    assert told([*range(0, 2000, 200), *range(2800, 9000, 200)], sensor=5.0, dt=0.002) == []


@pytest.mark.parametrize(
    "times",
    [
        [*range(0, 2500, 33), *range(9000, 11500, 33)],  # nobody listened in between
        [*range(0, 2500, 33), *range(0, 2500, 33)],  # a reset
        range(0, 60000, 2000),
    ],
)  # one picture now and then
def test_counting_starts_anew_after_a_pause(times):
    assert told(times) == []

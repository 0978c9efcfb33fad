import pytest
from gazebo_ros.throttle import Throttle

MS = 1_000_000


class Wall:
    """A wall clock that only moves when told."""

    def __init__(self):
        self.ns = 5_000 * MS

    def __call__(self):
        return self.ns


def steps_until(throttle, wall, end_ns, late_ns=0):
    """Run an ideal loop (each sleep ends ``late_ns`` late, steps cost nothing); the number of steps."""
    count = 0
    while True:
        delay = throttle.delay()
        if delay > 0:
            wall.ns += round(delay * 1e9) + late_ns
        if wall.ns >= end_ns:
            return count
        throttle.stepped()
        count += 1


@pytest.mark.parametrize("late_ns", [0, 60_000, 900_000, 3 * MS])
def test_rate_is_kept_although_every_sleep_ends_late(late_ns):
    wall = Wall()
    throttle = Throttle(1000.0, clock=wall)
    assert abs(steps_until(throttle, wall, wall.ns + 2_000 * MS, late_ns) - 2000) <= 4


def test_a_long_stall_is_not_caught_up_beyond_the_limit():
    wall = Wall()
    throttle = Throttle(1000.0, catch_up=0.1, clock=wall)
    throttle.stepped()
    wall.ns += 10_000 * MS
    count = 0
    while throttle.delay() <= 0:
        throttle.stepped()
        count += 1
    assert 99 <= count <= 103


def test_zero_rate_never_waits():
    wall = Wall()
    throttle = Throttle(0.0, clock=wall)
    for _ in range(10):
        assert throttle.delay() == 0.0
        throttle.stepped()


def test_restart_forgets_the_pause():
    wall = Wall()
    throttle = Throttle(1000.0, clock=wall)
    throttle.stepped()
    wall.ns += 60_000 * MS
    throttle.restart()
    throttle.stepped()
    assert throttle.delay() == pytest.approx(0.001)


def test_a_changed_rate_acts_from_the_next_step():
    wall = Wall()
    throttle = Throttle(1000.0, clock=wall)
    throttle.rate = 100.0
    throttle.stepped()
    assert throttle.delay() == pytest.approx(0.01)

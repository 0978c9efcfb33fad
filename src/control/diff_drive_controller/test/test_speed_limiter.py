import math

import pytest
from controller_interface import ParameterError
from hypothesis import given
from hypothesis import strategies as st

from diff_drive_controller.speed_limiter import Bounds, SpeedLimiter, load_limiter


class Parameters(dict):
    """Stands in for a NodeHandle."""

    def param(self, name, default):
        return self.get(name, default)

    def resolve(self, name):
        return f"/base/{name}"


def test_without_bounds_nothing_changes():
    assert SpeedLimiter().limit(123.0, 0.01) == 123.0


def test_velocity():
    limiter = SpeedLimiter(Bounds(-0.5, 1.0))
    assert [limiter.limit(v, 0.01) for v in (2.0, 0.3, -2.0)] == [1.0, 0.3, -0.5]


def test_acceleration_counts_from_the_last_output():
    limiter = SpeedLimiter(acceleration=Bounds(-2.0, 1.0))
    assert limiter.limit(10.0, 0.1) == pytest.approx(0.1)
    assert limiter.limit(10.0, 0.1) == pytest.approx(0.2)
    assert limiter.limit(-10.0, 0.1) == pytest.approx(0.0)
    assert limiter.last == pytest.approx(0.0)


def test_jerk_bounds_the_change_of_the_change():
    limiter = SpeedLimiter(jerk=Bounds(-5.0, 5.0))
    step = 2.0 * 5.0 * 0.1 ** 2
    assert [limiter.limit(10.0, 0.1) for _ in range(3)] == pytest.approx([step, 3 * step, 6 * step])


def test_jerk_then_acceleration_then_velocity():
    limiter = SpeedLimiter(Bounds(-0.15, 0.15), Bounds(-1.0, 1.0), Bounds(-100.0, 100.0))
    assert [limiter.limit(10.0, 0.1) for _ in range(2)] == pytest.approx([0.1, 0.15])


def test_reset_forgets_the_motion():
    limiter = SpeedLimiter(acceleration=Bounds(-1.0, 1.0))
    limiter.limit(10.0, 1.0)
    limiter.reset()
    assert limiter.limit(10.0, 0.1) == pytest.approx(0.1)


@given(st.lists(st.floats(-10.0, 10.0), min_size=1, max_size=50))
def test_output_stays_inside_velocity_and_acceleration_bounds(commands):
    limiter, last = SpeedLimiter(Bounds(-1.0, 2.0), Bounds(-3.0, 1.5)), 0.0
    for command in commands:
        velocity = limiter.limit(command, 0.01)
        assert -1.0 <= velocity <= 2.0 and -0.03 - 1e-12 <= velocity - last <= 0.015 + 1e-12
        last = velocity


def test_parameters_have_symmetric_minima_unless_given():
    limiter = load_limiter(Parameters({"linear/x/has_velocity_limits": True, "linear/x/max_velocity": 1.0,
                                       "linear/x/has_acceleration_limits": True, "linear/x/max_acceleration": 5.0,
                                       "linear/x/min_acceleration": -10.0}), "linear/x")
    assert limiter.limit(9.0, 1.0) == 1.0
    assert limiter.limit(-9.0, 1.0) == -1.0
    assert limiter.limit(9.0, 0.1) == pytest.approx(-0.5)
    assert limiter.limit(-9.0, 0.01) == pytest.approx(-0.6)


def test_flag_without_maximum_means_zero_and_maximum_without_flag_nothing():
    assert load_limiter(Parameters({"linear/x/has_velocity_limits": True}), "linear/x").limit(1.0, 0.1) == 0.0
    assert load_limiter(Parameters({"linear/x/max_velocity": 0.5}), "linear/x").limit(1.0, 0.1) == 1.0
    jerk = Parameters({"linear/x/has_jerk_limits": True})
    assert load_limiter(jerk, "linear/x", jerk=False).limit(1.0, 0.1) == 1.0


def test_bounds_the_wrong_way_round_are_refused_and_infinite_ones_are_none():
    wrong = {"linear/x/has_velocity_limits": True, "linear/x/max_velocity": -1.0}
    with pytest.raises(ParameterError, match="min_velocity is 1, more than max_velocity, which is -1"):
        load_limiter(Parameters(wrong), "linear/x")
    free = load_limiter(Parameters({f"linear/x/has_{q}_limits": True for q in ("velocity", "acceleration", "jerk")} |
                                   {f"linear/x/max_{q}": math.inf for q in ("velocity", "acceleration", "jerk")}),
                        "linear/x")
    assert (free.limit(3.0, 0.1), free.limit(2.0, 0.0)) == (3.0, 3.0)

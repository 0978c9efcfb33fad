import math

import pytest
from controller_interface import ParameterError
from diff_drive_controller.speed_limiter import load_limiter


class Parameters(dict):
    """Stands in for a NodeHandle."""

    def param(self, name, default):
        return self.get(name, default)

    def resolve(self, name):
        return f"/base/{name}"


def test_parameters_have_symmetric_minima_unless_given():
    limiter = load_limiter(
        Parameters(
            {
                "linear/x/has_velocity_limits": True,
                "linear/x/max_velocity": 1.0,
                "linear/x/has_acceleration_limits": True,
                "linear/x/max_acceleration": 5.0,
                "linear/x/min_acceleration": -10.0,
            }
        ),
        "linear/x",
    )
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
    free = load_limiter(
        Parameters(
            {f"linear/x/has_{q}_limits": True for q in ("velocity", "acceleration", "jerk")}
            | {f"linear/x/max_{q}": math.inf for q in ("velocity", "acceleration", "jerk")}
        ),
        "linear/x",
    )
    assert (free.limit(3.0, 0.1), free.limit(2.0, 0.0)) == (3.0, 3.0)

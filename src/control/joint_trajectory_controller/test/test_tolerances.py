from types import SimpleNamespace

import pytest
from joint_trajectory_controller.tolerances import JointTolerances, StateTolerance, from_parameters, overridden


def joint(name, position=0.0, velocity=0.0, acceleration=0.0):
    return SimpleNamespace(name=name, position=position, velocity=velocity, acceleration=acceleration)


def goal(path=(), end=(), time=0.0):
    return SimpleNamespace(path_tolerance=path, goal_tolerance=end, goal_time_tolerance=SimpleNamespace(to_sec=lambda: time))


def test_defaults_are_a_stopped_velocity_of_a_hundredth_and_nothing_else():
    assert from_parameters(["a"], {}) == [JointTolerances(StateTolerance(), StateTolerance(0.0, 0.01, 0.0), 0.0)]


def test_parameters():
    tolerances = from_parameters(["a", "b"], {"goal_time": 2, "stopped_velocity_tolerance": 0, "b": {"trajectory": 0.5, "goal": 0.1}})
    assert tolerances[0] == JointTolerances(StateTolerance(), StateTolerance(), 2.0)
    assert tolerances[1] == JointTolerances(StateTolerance(0.5), StateTolerance(0.1), 2.0)


@pytest.mark.parametrize(
    "constraints, name",
    [({"goal_time": "soon"}, "constraints/goal_time"), ({"a": 3}, "constraints/a"), ({"a": {"goal": float("nan")}}, "constraints/a/goal")],
)
def test_wrong_parameters_are_named(constraints, name):
    with pytest.raises(ValueError, match=name):
        from_parameters(["a"], constraints)


def test_violation_names_what_is_over():
    tolerance = StateTolerance(0.1, 0.2)
    assert tolerance.violation(0.1, -0.2) is None
    assert tolerance.violation(-0.11, 0.0) == "position error -0.11 is over the tolerance 0.1"
    assert tolerance.violation(0.0, 0.3) == "velocity error 0.3 is over the tolerance 0.2"


def test_no_tolerance_forbids_nothing_and_nan_is_over_any():
    assert StateTolerance(0.0, -1.0).violation(1e9, -1e9) is None
    assert "nan" in StateTolerance(1.0).violation(float("nan"), 0.0)


def test_goal_overrides_named_joints_only():
    defaults = from_parameters(["a", "b"], {"goal_time": 1.0, "a": {"trajectory": 0.5, "goal": 0.1}, "b": {"goal": 0.1}})
    a, b = overridden(defaults, ["a", "b"], goal(path=[joint("a", -1.0, 0.3)], end=[joint("a", 0.0, 0.0, 2.0), joint("x")], time=3.0))
    assert a == JointTolerances(StateTolerance(0.0, 0.3), StateTolerance(0.1, 0.01, 2.0), 3.0)
    assert b == JointTolerances(StateTolerance(), StateTolerance(0.1, 0.01), 3.0)


def test_goal_time_can_be_kept_or_switched_off():
    defaults = from_parameters(["a"], {"goal_time": 1.0})
    assert overridden(defaults, ["a"], goal())[0].goal_time == 1.0
    assert overridden(defaults, ["a"], goal(time=-1.0))[0].goal_time == 0.0


def test_nan_tolerance_is_refused():
    with pytest.raises(ValueError, match="'a' is NaN"):
        overridden(from_parameters(["a"], {}), ["a"], goal(end=[joint("a", float("nan"))]))

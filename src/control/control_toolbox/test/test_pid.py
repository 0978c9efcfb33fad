"""The PID law."""

import math

import pytest
from control_toolbox import Gains, Pid


def outputs(pid, errors, dt=1.0):
    return [pid.compute_command(error, dt) for error in errors]


def test_proportional():
    assert outputs(Pid(p=2.0), [-0.5, -0.5, -1.0, 0.5]) == [-1.0, -1.0, -2.0, 1.0]


def test_integral():
    pid = Pid(i=1.0, i_max=5.0, i_min=-5.0)
    assert outputs(pid, [-0.5, -0.5, 0.0, 0.0, 1.0, -0.5]) == [-0.5, -1.0, -1.0, -1.0, 0.0, -0.5]
    assert Pid(i=1.0, i_max=5.0, i_min=-5.0).compute_command(1.0, 0.25) == 0.25


def test_derivative_starts_from_an_error_of_zero():
    pid = Pid(d=1.0)
    assert outputs(pid, [-0.5, -0.5]) == [-0.5, 0.0]
    assert outputs(pid, [-0.5], dt=0.1) == [0.0]
    assert outputs(pid, [-1.0, -0.5]) == [-0.5, 0.5]


def test_all_terms_add_up():
    assert outputs(Pid(1.0, 1.0, 1.0, 5.0, -5.0), [-0.5, -0.5, -1.0]) == [-1.5, -1.5, -3.5]


def test_the_integral_term_is_clamped():
    assert outputs(Pid(i=1.0, i_max=1.0, i_min=-1.0), [-10.03, 30.0]) == [-1.0, 1.0]


def test_without_a_clamp_there_is_no_integral_part():
    assert outputs(Pid(i=100.0), [1.0, 1.0]) == [0.0, 0.0]


def test_without_antiwindup_the_integral_itself_grows_on():
    pid = Pid(i=1.0, i_max=1.0, i_min=-1.0)
    assert outputs(pid, [5.0, 5.0, -1.0, -7.0]) == [1.0, 1.0, 1.0, 1.0]
    assert pid.compute_command(-2.5, 1.0) == -0.5


def test_antiwindup():
    assert outputs(Pid(i=2.0, i_max=1.0, i_min=-1.0, antiwindup=True), [-1.0, -1.0, 0.5, -1.0]) == [-1.0, -1.0, 0.0, -1.0]


def test_antiwindup_with_a_negative_gain():
    pid = Pid(i=-2.5, i_max=0.5, i_min=-0.2, antiwindup=True)
    assert outputs(pid, [0.1, 0.1, -0.05, 0.1]) == pytest.approx([-0.2, -0.2, -0.075, -0.2])


def test_given_derivative():
    assert Pid(d=2.0).compute_command(1.0, 0.1, error_dot=3.0) == 6.0


@pytest.mark.parametrize(
    "error, dt, error_dot", [(1.0, 0.0, None), (math.nan, 1.0, None), (math.inf, 1.0, None), (1.0, 1.0, math.nan), (1.0, 1.0, -math.inf)]
)
def test_unusable_input_gives_zero_and_integrates_nothing(error, dt, error_dot):
    pid = Pid(1.0, 1.0, 1.0, 9.0, -9.0)
    pid.compute_command(1.0, 1.0)
    assert pid.compute_command(error, dt, error_dot) == 0.0
    assert pid.i_error == 1.0
    assert math.isfinite(pid.compute_command(1.0, 1.0))


def test_reset():
    pid = Pid(1.0, 1.0, 1.0, 9.0, -9.0)
    outputs(pid, [2.0, 3.0])
    pid.reset()
    assert (pid.p_error, pid.i_error, pid.d_error, pid.command) == (0.0, 0.0, 0.0, 0.0)
    assert pid.compute_command(0.5, 0.5) == 0.5 + 0.25 + 1.0
    pid.reset(d_error=0.0, i_error=2.0)
    assert pid.compute_command(0.5, 1.0) == 0.5 + 2.5 + 0.0, "the given derivative, no kick"
    assert pid.compute_command(0.5, 1.0) == 0.5 + 3.0 + 0.0


def test_gains_can_be_replaced_at_any_time():
    pid = Pid(1.0)
    pid.compute_command(1.0, 1.0)
    pid.set_gains(3.0, 0.0, 0.0, 0.0, 0.0)
    assert pid.gains == Gains(3.0) and pid.compute_command(1.0, 1.0) == 3.0


@pytest.mark.parametrize(
    "gains", [{"p": 1.0}, {"i": 1.0, "i_max": 2.0, "i_min": -2.0}, {"p": 1.0, "i": 1.0, "i_max": 2.0, "i_min": -2.0, "antiwindup": True}]
)
def test_huge_errors_leave_nothing_behind_that_is_no_number(gains):
    pid = Pid(**gains)
    outputs(pid, [1e308] * 20 + [-1e308] * 20)
    assert math.isfinite(pid.compute_command(0.5, 0.01))

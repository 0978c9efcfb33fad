"""The filters against motions that are known."""

import numpy as np
import pytest
from state_estimation.filters import PROCESS_NOISE, Ekf, Measurement, Ukf
from state_estimation.motion import ACCELERATION, ORIENTATION, POSITION, RATE, SIZE, VELOCITY, jacobian, moved, rotation, wrap

KINDS = pytest.mark.parametrize("kind", [Ekf, Ukf])


def measured(time, threshold=np.inf, variance=1e-4, **values):
    names = "x y z roll pitch yaw vx vy vz vroll vpitch vyaw ax ay az".split()
    used, filled = np.zeros(SIZE, bool), np.zeros(SIZE)
    for name, value in values.items():
        used[names.index(name)], filled[names.index(name)] = True, value
    return Measurement("test", time, used, filled, np.eye(SIZE) * variance, threshold)


def test_rotation_is_roll_then_pitch_then_yaw():
    np.testing.assert_allclose(rotation(np.array([0, 0, np.pi / 2])) @ [1, 0, 0], [0, 1, 0], atol=1e-12)
    np.testing.assert_allclose(rotation(np.array([np.pi / 2, 0, np.pi / 2])) @ [0, 1, 0], [0, 0, 1], atol=1e-12)


def test_motion_on_a_circle():
    state = np.zeros(SIZE)
    state[6], state[11] = 1.0, 0.5  # 1 m/s, 0.5 rad/s: radius 2 m
    for _ in range(2000):
        state = moved(state, np.pi / 2000)  # a quarter of the circle
    np.testing.assert_allclose(state[POSITION], [2, 2, 0], atol=3e-3)
    np.testing.assert_allclose(state[ORIENTATION], [0, 0, np.pi / 2], atol=1e-9)


def test_jacobian_follows_the_motion():
    rng = np.random.default_rng(3)
    state, shift = rng.uniform(-1, 1, SIZE), 1e-4 * rng.uniform(-1, 1, SIZE)
    np.testing.assert_allclose(moved(state + shift, 0.1) - moved(state, 0.1), jacobian(state, 0.1) @ shift, atol=1e-8)


def test_wrap():
    np.testing.assert_allclose(wrap(np.array([np.pi + 0.1, -np.pi - 0.1, 7.0])), [0.1 - np.pi, np.pi - 0.1, 7 - 2 * np.pi])


@KINDS
def test_wheels_alone_drive_a_circle(kind):
    state = kind(planar=True, process_noise=PROCESS_NOISE * 1e-3)  # the unscented mean of a wide arc lies within the circle
    for step in range(1001):
        state.process(measured(step * np.pi / 1000, vx=1.0, vy=0.0, vyaw=0.5))
    np.testing.assert_allclose(state.state[POSITION], [2, 2, 0], atol=0.01)
    assert state.state[5] == pytest.approx(np.pi / 2, abs=0.005)


@KINDS
def test_two_sensors_are_weighted_by_their_variance(kind):
    state = kind(covariance=np.eye(SIZE))
    state.time = 0.0
    state.correct(measured(0.0, variance=0.1, x=1.0))
    state.correct(measured(0.0, variance=0.1 / 3, x=2.0))
    # The prior (variance 1) at 0 counts 1, the two count 10 and 30.
    assert state.state[0] == pytest.approx((0 * 1 + 1 * 10 + 2 * 30) / 41)
    assert state.covariance[0, 0] == pytest.approx(1 / 41)


@KINDS
def test_yaw_goes_round(kind):
    state = kind(planar=True)
    for step in range(400):
        state.process(measured(step * 0.05, yaw=wrap(0.4 * step * 0.05)))
    assert abs(wrap(state.state[5] - 0.4 * 399 * 0.05)) < 0.02
    assert state.state[11] == pytest.approx(0.4, abs=0.01), "the rate is told by the yaw alone"


@KINDS
def test_on_the_ground_nothing_rises(kind):
    state = kind(planar=True)
    for step in range(100):
        state.process(measured(step * 0.02, x=0.0, z=3.0, roll=0.2, vx=0.0, az=1.0))
    np.testing.assert_allclose(state.state[[2, 3, 4, 8, 9, 10, 14]], 0, atol=1e-12)


@KINDS
def test_an_outlier_is_thrown_away(kind):
    state = kind()
    for step in range(50):
        assert state.process(measured(step * 0.02, threshold=5.0, x=0.01 * step))
    before = state.state[0]
    assert not state.process(measured(1.0, threshold=5.0, x=40.0))
    assert abs(state.state[0] - before) < 0.05


@KINDS
def test_acceleration_and_velocity_carry_on(kind):
    state = kind(process_noise=PROCESS_NOISE * 1e-3)
    for step in range(101):
        state.process(measured(step * 0.01, vx=2.0 * step * 0.01, ax=2.0))
    state.predict(0.5)
    assert state.state[6] == pytest.approx(3.0, abs=0.02)
    assert state.state[0] == pytest.approx(0.5 * 2.0 * 1.5**2, abs=0.05)


@KINDS
def test_covariance_stays_sound(kind):
    rng = np.random.default_rng(1)
    state = kind(process_noise=np.eye(SIZE) * 0.05)
    for step in range(300):
        state.process(measured(step * 0.03, vx=rng.normal(), vyaw=rng.normal(), yaw=rng.uniform(-3, 3), ax=rng.normal(), variance=0.1))
    assert np.linalg.eigvalsh((state.covariance + state.covariance.T) / 2).min() > -1e-9 * np.abs(state.covariance).max()
    assert np.isfinite(state.state).all()


def test_dynamic_noise_rests_with_the_robot():
    resting, driving = Ekf(dynamic_noise=True), Ekf(dynamic_noise=True)
    for state, speed in ((resting, 0.0), (driving, 1.0)):
        state.process(measured(0.0, vx=speed))
        state.predict(1.0)
    assert resting.covariance[1, 1] < driving.covariance[1, 1]


def test_late_measurements_do_not_turn_time_back():
    state = Ekf()
    state.process(measured(1.0, x=0.0))
    assert state.process(measured(0.5, x=0.001))
    assert state.time == 1.0
    assert state.state[VELOCITY].tolist() == [0, 0, 0] and state.state[RATE].tolist() == [0, 0, 0]
    assert state.state[ACCELERATION].tolist() == [0, 0, 0]

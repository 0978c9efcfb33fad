"""The filter against motions whose orientation is known, without ROS."""

import math

import pytest
from imu_complementary_filter import Complementary
from imu_filters.rotation import about, advanced, conjugate, product, roll_pitch_yaw, turned

FIELD = (0.4, 0.0, -0.9)


def off(a, b):
    return 2 * math.acos(min(1.0, abs(product(conjugate(a), b)[0])))


def test_complementary_follows_a_turn_and_forgets_a_wrong_start():
    filter_ = Complementary(gain_acc=0.02, gain_mag=0.02)
    q = about((1.0, 0.0, 0.0), -1.2)
    filter_.update((0.0, 0.0, 9.81), (0.0, 0.0, 0.0), FIELD, 0.0)
    for _ in range(1500):
        q = advanced(q, (0.3, -0.2, 0.5), 0.01)
        filter_.update(turned(conjugate(q), (0.0, 0.0, 9.81)), (0.3, -0.2, 0.5), turned(conjugate(q), FIELD), 0.01)
    assert off(filter_.orientation, q) < 0.02


def test_complementary_learns_the_bias_at_rest_and_only_there():
    filter_ = Complementary(bias_alpha=0.05)
    for _ in range(400):
        filter_.update((0.0, 0.0, 9.81), (0.02, 0.0, -0.03), None, 0.01)
    assert filter_.steady and filter_.bias == pytest.approx((0.02, 0.0, -0.03), abs=1e-4)
    assert roll_pitch_yaw(filter_.orientation)[:2] == pytest.approx((0.0, 0.0), abs=0.02)
    for _ in range(50):
        filter_.update((2.0, 0.0, 9.81), (0.5, 0.0, 0.0), None, 0.01)
    assert not filter_.steady and filter_.bias[0] == pytest.approx(0.02, abs=1e-4)


def test_strong_accelerations_count_for_nothing_where_the_gain_adapts():
    blind, trusting = Complementary(gain_acc=0.5), Complementary(gain_acc=0.5, adaptive=False)
    for filter_ in (blind, trusting):
        filter_.update((0.0, 0.0, 9.81), (0.0, 0.0, 0.0), None, 0.0)
        for _ in range(20):
            filter_.update((12.0, 0.0, 9.81), (0.0, 0.0, 0.0), None, 0.01)
    assert abs(roll_pitch_yaw(blind.orientation)[1]) < 1e-9 and abs(roll_pitch_yaw(trusting.orientation)[1]) > 0.5


@pytest.mark.parametrize("name", ["gain_acc", "gain_mag", "bias_alpha"])
def test_a_share_that_is_none_is_refused(name):
    for value in (-0.1, 1.1, math.nan):
        with pytest.raises(ValueError, match=f"{name} has to lie between 0 and 1"):
            Complementary(**{name: value})

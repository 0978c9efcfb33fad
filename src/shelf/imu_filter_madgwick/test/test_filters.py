"""Madgwick's filter against motions whose orientation is known, without ROS."""

import math

import pytest
from imu_filters.madgwick import Madgwick
from imu_filters.rotation import about, advanced, conjugate, level_or_north, product, roll_pitch_yaw, turned, unit

FIELD = {"enu": (0.0, 0.4, -0.9), "nwu": (0.4, 0.0, -0.9), "ned": (0.4, 0.0, 0.9)}
PLACES = [
    about(unit(axis), angle)
    for axis, angle in (((0, 0, 1), 2.5), ((1, 0, 0), -1.2), ((0, 1, 0), 1.4), ((1, 2, -1), 3.0), ((-1, 1, 1), 2.0))
]


def off(a, b):
    return 2 * math.acos(min(1.0, abs(product(conjugate(a), b)[0])))


def seen(q, world="enu"):
    return (turned(conjugate(q), (0.0, 0.0, -9.81 if world == "ned" else 9.81)), turned(conjugate(q), FIELD[world]))


@pytest.mark.parametrize("world", FIELD)
@pytest.mark.parametrize("place", PLACES)
def test_one_reading_tells_the_orientation(world, place):
    acceleration, field = seen(place, world)
    assert off(level_or_north(world, acceleration, field), place) < 1e-6
    leveled = level_or_north(world, acceleration)
    assert turned(leveled, acceleration) == pytest.approx((0, 0, -9.81 if world == "ned" else 9.81), abs=1e-9)
    assert level_or_north(world, (0.0, 0.0, 0.0)) is None
    assert level_or_north(world, acceleration, acceleration) is None


@pytest.mark.parametrize("world", FIELD)
def test_madgwick_comes_to_the_measured_orientation(world):
    filter_ = Madgwick(world, gain=0.5)
    acceleration, field = seen(PLACES[4], world)
    for _ in range(1000):
        filter_.update(acceleration, (0.0, 0.0, 0.0), field, 0.01)
    assert off(filter_.orientation, PLACES[4]) < 0.02


def test_madgwick_finds_the_bias_of_the_turn_rates():
    filter_ = Madgwick("enu", gain=0.5, zeta=0.1)
    acceleration, field = seen(PLACES[0])
    filter_.orientation = PLACES[0]
    for _ in range(2000):
        filter_.update(acceleration, (0.1, -0.05, 0.08), field, 0.01)
    assert filter_.bias == pytest.approx((0.1, -0.05, 0.08), abs=0.02)

"""The fan of rays of <ray>: which way they point, and what is told of values between them; expected are the formulas of Gazebo 11."""

import math

import numpy as np
import pytest
from ode_sim import _core


def scan(samples=1, resolution=1.0, low=0.0, high=0.0):
    return _core.RayScan(samples, resolution, low, high)


def fan(horizontal, vertical=None, near=0.1, far=5.0):
    return _core.RayFan(horizontal, vertical or scan(), near, far)


@pytest.mark.parametrize(
    ("samples", "resolution", "count", "step"),
    [
        (5, 1.0, 5, 0.25),
        (5, 2.0, 10, 1 / 9),
        (5, 0.5, 2, 1.0),  # floor(2.5)
        (5, 0.1, 1, 0.0),
        (1, 1.0, 1, 0.0),
        (0, 1.0, 1, 0.0),
    ],
)
def test_how_many_values(samples, resolution, count, step):
    across = fan(scan(samples, resolution, -0.5, 0.5)).horizontal
    assert across.count == count and across.step == pytest.approx(step, abs=1e-15)


def test_directions_are_rows_from_below():
    directions = fan(scan(3, 1.0, -0.4, 0.4), scan(2, 1.0, -0.2, 0.3)).told_directions
    expected = [[math.cos(p) * math.cos(y), math.cos(p) * math.sin(y), math.sin(p)] for p in (-0.2, 0.3) for y in (-0.4, 0.0, 0.4)]
    np.testing.assert_allclose(directions, expected, atol=1e-15)


def test_a_single_ray_looks_ahead():
    np.testing.assert_allclose(fan(scan(1, 1.0, -0.4, 0.4), scan(1, 1.0, 0.2, 0.6)).told_directions, [[1, 0, 0]])
    up = fan(scan(1, 1.0, -0.4, 0.4), scan(2, 1.0, -0.2, 0.2)).told_directions
    np.testing.assert_allclose(up, [[math.cos(0.2), 0, -math.sin(0.2)], [math.cos(0.2), 0, math.sin(0.2)]], atol=1e-15)


def test_between_rays_ranges_are_linear_and_intensities_the_mean_of_four():
    # Two rows of three rays, two and six values: in a row at 0, 0.4, 0.8, 1.2, 1.6, 2 of the rays.
    lattice = fan(scan(3, 2.0, -0.5, 0.5), scan(2, 1.0, 0.0, 0.1))
    rays = np.array([1.0, 2.0, 4.0, 5.0, 5.0, 1.0])
    np.testing.assert_allclose(lattice.between(rays), [1, 1.4, 1.8, 2.4, 3.2, 4, 5, 5, 5, 4.2, 2.6, 1], atol=1e-12)
    bright = np.array([0.0, 8.0, 4.0, 4.0, 0.0, 0.0])
    # Neighbours are rays 0 and 1 up to 0.8, 1 and 2 up to 1.6, 2 twice at the end; of a value on the upper row that row twice.
    np.testing.assert_allclose(lattice.mean(bright), [3, 3, 3, 3, 3, 2, 2, 2, 2, 0, 0, 0], atol=1e-12)


def test_one_value_for_each_ray_is_left_as_it_is():
    plain = fan(scan(3, 1.0, -0.5, 0.5))
    rays = np.array([0.1, 0.3, 5.0])
    assert plain.between(rays).tolist() == plain.mean(rays).tolist() == rays.tolist()


def test_what_is_told_of_a_range_at_and_beyond_the_limits():
    """REP 117."""
    told = fan(scan(5), near=0.1, far=5.0).told(np.array([0.1, 0.10001, 3.0, 4.99999, 5.0]))
    assert told.tolist() == [-math.inf, 0.10001, 3.0, 4.99999, math.inf]


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ((scan(5), scan(), 1.0, 1.0), "<range>"),
        ((scan(5), scan(), -1.0, 1.0), "<range>"),
        ((scan(5), scan(), math.nan, 1.0), "<range>"),
        ((scan(5), scan(), 0.0, math.nan), "<range>"),
        ((scan(5, 0.0), scan(), 0.0, 1.0), "<resolution>"),
        ((scan(5, math.nan), scan(), 0.0, 1.0), "<resolution>"),
        ((scan(5, math.inf), scan(), 0.0, 1.0), "<resolution>"),
        ((scan(2_000_000), scan(), 0.0, 1.0), "million"),
        ((scan(2000), scan(2000), 0.0, 1.0), "million"),
        ((scan(1000, 2000.0), scan(), 0.0, 1.0), "million"),
        ((scan(1000, 50.0), scan(100), 0.0, 1.0), "million"),
        ((scan(5, 1.0, math.nan, 1.0), scan(), 0.0, 1.0), "_angle"),
    ],
)
def test_what_makes_no_fan(arguments, says):
    with pytest.raises(ValueError, match=says):
        _core.RayFan(*arguments)


def test_as_many_numbers_as_rays():
    with pytest.raises(ValueError, match="3 rays, not 2"):
        fan(scan(3, 1.0, -0.5, 0.5)).between(np.array([1.0, 2.0]))

"""From where a page looks at first."""

import math

import numpy as np
import pytest
from ode_sim.math3 import from_rpy
from ode_sim_viewer.eye import view_from

NONE = np.zeros((0, 3))


def test_the_eye_of_a_world_file_looks_along_its_x_axis():
    around = np.array([[-1.0, 7.0, 0.0], [3.0, 9.0, 2.0]])  # the middle is 6 m ahead
    place, target = view_from(from_rpy(1, 2, 3, 0, 0, math.pi / 2), NONE, around)
    assert place == pytest.approx((1, 2, 3))
    assert target == pytest.approx((1, 8, 3))  # about which a hand turns it: as far as what is there


def test_an_eye_that_looks_away_from_all_turns_about_a_point_ahead():
    place, target = view_from(from_rpy(5, 0, 1, 0, 0, 0), np.array([[-1.0, -1.0, 0.0], [1.0, 1.0, 1.0]]), NONE)
    assert target - place == pytest.approx((1, 0, 0))


def test_a_plane_without_end_does_not_count():
    far = np.array([[-1e9, -1e9, 0.0], [1e9, 1e9, 0.0]])
    _, target = view_from(from_rpy(0, 0, 2, 0, 0.5, 0), far, NONE)
    assert np.isfinite(target).all() and np.linalg.norm(target) < 10

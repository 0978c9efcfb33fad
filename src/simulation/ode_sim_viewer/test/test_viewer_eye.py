"""From where a page looks at first."""

import math
import types

import numpy as np
import pytest
from ode_sim.math3 import from_rpy
from ode_sim_viewer.eye import FIELD, Eyes, view_from, view_of

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


@pytest.mark.parametrize("aspect", [0.5, 0.8, 1.4, 2.5])
def test_everything_is_in_the_view_however_narrow_the_page_is(aspect):
    corners = np.array([[x, y, z] for x in (-2.0, 4.0) for y in (0.0, 3.0) for z in (0.0, 1.0)])
    place, target = view_of(corners, NONE, aspect)
    ahead = (target - place) / np.linalg.norm(target - place)
    right = np.cross(ahead, (0.0, 0.0, 1.0))
    right /= np.linalg.norm(right)
    depths = (corners - place) @ ahead
    upper = np.abs((corners - place) @ np.cross(right, ahead)) / depths
    aside = np.abs((corners - place) @ right) / depths
    assert (depths > 0.0).all() and upper.max() < math.tan(FIELD / 2) and aside.max() < aspect * math.tan(FIELD / 2)


def test_a_narrow_page_that_nobody_has_turned_looks_from_farther_away():
    corners = (np.array([[-3.0, -3.0, 0.0], [3.0, 3.0, 1.0]]), NONE)
    server = types.SimpleNamespace(initial_camera=types.SimpleNamespace(), get_clients=dict)
    eyes = Eyes(server)
    eyes.look(lambda aspect: view_of(*corners, aspect))

    def page(aspect, position):
        return types.SimpleNamespace(camera=types.SimpleNamespace(aspect=aspect, position=position, look_at=server.initial_camera.look_at))

    usual = server.initial_camera.position
    narrow, wide, turned = page(0.5, usual), page(2.0, usual), page(0.5, usual + 1.0)
    server.get_clients = lambda: {1: narrow, 2: wide, 3: turned}
    eyes.fit()
    np.testing.assert_allclose(narrow.camera.position, view_of(*corners, 0.5)[0])
    assert wide.camera.position is usual and (turned.camera.position == usual + 1.0).all()
    narrow.camera.position = usual
    eyes.fit()
    assert narrow.camera.position is usual, "somebody went there"

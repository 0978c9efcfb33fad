"""Lens distortion: points are where the formula puts them."""

import numpy as np
import pytest
from ode_sim.description.model import Box, Sphere
from ode_sim_rendering import Camera, Distortion
from pictures import BLUE, ORIGIN, RED, bytes_of, draw, renderer, scene_of, visual


def brown(lens, x, y):
    r2 = x * x + y * y
    radial = 1 + lens.k1 * r2 + lens.k2 * r2**2 + lens.k3 * r2**3
    return (x * radial + 2 * lens.p1 * x * y + lens.p2 * (r2 + 2 * x * x), y * radial + lens.p1 * (r2 + 2 * y * y) + 2 * lens.p2 * x * y)


@pytest.mark.parametrize("lens", [Distortion(k1=-0.25, k2=0.12, p1=-0.003, p2=0.002), Distortion(k1=0.1, k3=0.02)])
def test_a_distorted_point_is_where_the_formula_puts_it(renderer, lens):
    camera = Camera(width=320, height=240, hfov=1.2, near=0.05, distortion=lens)
    for y, z in ((0.0, 0.0), (0.9, 0.6), (-0.8, 0.5), (0.7, -0.7)):
        picture = draw(renderer, scene_of(visual("dot", Sphere(0.04), (2, y, z), RED)), camera)
        rows, columns = np.nonzero(picture[..., 0] > 150)
        u, v = brown(lens, -y / 2, -z / 2)
        f = camera.focal_length
        assert columns.mean() == pytest.approx(159.5 + f * u, abs=0.7)
        assert rows.mean() == pytest.approx(119.5 + f * v, abs=0.7)


def test_crop_leaves_no_black_border(renderer):
    wall = scene_of(visual("wall", Box((0.2, 90, 90)), (3.1, 0, 0), RED))
    lens = Distortion(k1=-0.15)
    filled = draw(renderer, wall, Camera(hfov=1.2, distortion=lens))
    bordered = draw(renderer, wall, Camera(hfov=1.2, distortion=Distortion(k1=-0.15, crop=False)))
    assert (filled == bytes_of(RED)).all()
    assert (bordered[0, 0] == 0).all() and tuple(bordered[120, 160]) == bytes_of(RED)


def test_depth_under_distortion_is_not_interpolated(renderer):
    renderer.set_scene(
        scene_of(visual("near", Box((0.2, 0.5, 0.5)), (1.1, 0, 0), RED), visual("wall", Box((0.2, 90, 90)), (3.1, 0, 0), BLUE))
    )
    depth = renderer.depth(Camera(hfov=1.2, distortion=Distortion(k1=-0.15)), ORIGIN)
    assert ((np.abs(depth - 1.0) < 1e-3) | (np.abs(depth - 3.0) < 1e-3)).all()

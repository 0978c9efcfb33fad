"""Actors as a camera sees them."""

import math
import pathlib
import sys

import numpy as np
import ode_sim
import pytest
from ode_sim.description import ResourceFinder
from ode_sim.description.model import Pose
from ode_sim.math3 import quat_from_rpy
from ode_sim_rendering import Camera, render

sys.path.append(str(pathlib.Path(__file__).parents[2] / "ode_sim" / "test"))
from actor_files import actor, rig, world  # noqa: E402

FINDER = ResourceFinder(environment=False, package_path=lambda name: None)


def load(*parts):
    loaded = ode_sim.World.load(finder=FINDER, source=world(*parts))
    assert not loaded.problems, [str(problem) for problem in loaded.problems]
    return loaded


def run_to(w, time):
    w.step(round((time - w.time) / w.dt))


@pytest.fixture
def skin(tmp_path):
    path = tmp_path / "walk.dae"
    path.write_text(rig())
    return str(path)


def test_a_camera_sees_it_walk(skin):
    w = load(actor(skin))
    camera = Camera(width=64, height=64, hfov=0.8, pose=Pose((2.0, -1.0, 1.1), quat_from_rpy(0.0, 0.0, math.pi / 2)))
    middles = []
    for time in (1.5, 2.0, 2.5):
        run_to(w, time)
        picture = render(w, camera).astype(int)
        dark = np.argwhere(picture[..., 0] < 100)  # without a lamp, as its skin says no ambient colour, before the grey behind it
        assert len(dark) > 4
        middles.append(dark[:, 1].mean())
    assert middles[0] + 4 < middles[1] < middles[2] - 4  # to the right, along x

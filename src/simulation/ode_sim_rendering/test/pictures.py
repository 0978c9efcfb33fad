"""Scenes of a few coloured bodies, and their pixels."""

import numpy as np
import pytest
from ode_sim.description.model import Link, Material, Model, Scene, Visual
from ode_sim.math3 import from_rpy
from ode_sim_rendering import Camera, Renderer, arrange

RED, GREEN, BLUE, YELLOW = (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0)
BACKGROUND = (0.2, 0.4, 0.6)
FULL_AMBIENT = Scene(ambient=(1, 1, 1, 1), background=BACKGROUND + (1,), shadows=False)
CAMERA = Camera(width=160, height=120, hfov=1.2, near=0.05, far=50.0)
ORIGIN = np.array([[0, 0, 0, 0, 0, 0, 1.0]])


def visual(name, geometry, p, rgb, rpy=(0, 0, 0), **extra):
    colour = tuple(float(c) for c in rgb) + (1.0,)
    return Visual(name, from_rpy(*p, *rpy), geometry, Material(ambient=colour, diffuse=colour), **extra)


def scene_of(*visuals, lights=(), scene=FULL_AMBIENT):
    return arrange([Model("m", links=(Link("l", visuals=visuals),))], lights, scene)[0]


@pytest.fixture(scope="module")
def renderer():
    made = Renderer(backend="egl", shadows="on")
    yield made
    made.close()


def draw(renderer, scene, camera=CAMERA, poses=ORIGIN):
    renderer.set_scene(scene)
    return renderer.color(camera, poses)


def bytes_of(rgb):
    return tuple(round(255 * c) for c in rgb)


def pixel(picture, camera, p_C):
    column, row = camera.project([p_C])[0]
    return tuple(int(v) for v in picture[round(row), round(column)])

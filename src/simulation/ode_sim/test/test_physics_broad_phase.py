"""Which shapes meet: all that touch, and no others, however they came to where they are. Balls, whose contacts are known exactly."""

import math
from dataclasses import replace

import numpy as np
import ode_sim
import pytest
from ode_sim.description import model as d
from physics_models import sphere


def ball(name, place, radius, static):
    return replace(sphere(name, place, radius), static=static)


def meeting(world):
    """Pairs of model names that touch."""
    return {frozenset(world.collision(int(c[side])).link.model.name for side in ("collision1", "collision2")) for c in world.contacts()}


def expected(balls):
    """The same by distance; what is static meets nothing static."""
    return {frozenset((a, b)) for i, (a, (p, r, still)) in enumerate(balls.items()) for b, (q, s, fixed) in list(balls.items())[i + 1:]
            if math.dist(p, q) < r + s and not (still and fixed)}


@pytest.mark.parametrize("seed", range(4))
def test_all_that_touch_are_found_while_balls_come_go_and_jump(seed):
    random = np.random.default_rng(seed)
    world = ode_sim.World(d.World(physics=d.Physics(max_step_size=1e-9), gravity=(0.0, 0.0, 0.0)))
    balls, seen = {}, 0

    def draw():
        return tuple(float(x) for x in random.uniform(-1, 1, 3) * (1.0, 0.7, 0.4)), float(random.uniform(0.05, 0.3))

    def jump(number):
        for name in random.choice(list(balls), 3):
            place = draw()[0] if random.random() < 0.9 else (9e6, float(number), 0.0)  # very far, and back
            balls[name] = (place, *balls[name][1:])
            world.models[name].pose = d.Pose(place)

    for number in range(160):
        name = f"ball{number}"
        balls[name] = (*draw(), bool(random.random() < 0.4))
        world.spawn(ball(name, *balls[name]))
        if number % 4 == 0 and len(balls) > 30:
            gone = str(random.choice(list(balls)))
            world.remove(gone)
            del balls[gone]
        if number % 8 == 0:
            for _ in range(3):  # without anything new in between
                jump(number)
                snapshot = world.save()
                world.step()
                assert meeting(world) == expected(balls)
                seen += len(world.contacts())
                world.restore(snapshot)
    assert seen > 300

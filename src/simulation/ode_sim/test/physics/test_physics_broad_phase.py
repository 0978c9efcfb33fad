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
    return {
        frozenset((a, b))
        for i, (a, (p, r, still)) in enumerate(balls.items())
        for b, (q, s, fixed) in list(balls.items())[i + 1 :]
        if math.dist(p, q) < r + s and not (still and fixed)
    }


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


def test_meshes_that_were_apart_meet_as_soon_as_those_of_a_world_that_has_not_seen_them(tmp_path):
    """Whoever remembers that two are apart forgets it in time, however they tumble."""
    corners = [(x, y, z) for x in (-0.2, 0.2) for y in (-0.05, 0.05) for z in (-0.1, 0.1)]
    sides = [
        (0, 1, 2),
        (1, 3, 2),
        (4, 6, 5),
        (5, 6, 7),
        (0, 4, 1),
        (1, 4, 5),
        (2, 3, 6),
        (3, 7, 6),
        (0, 2, 4),
        (2, 6, 4),
        (1, 5, 3),
        (3, 5, 7),
    ]
    file = tmp_path / "brick.obj"
    file.write_text("".join(f"v {x} {y} {z}\n" for x, y, z in corners) + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in sides))
    random = np.random.default_rng(3)
    bricks = []
    for i in range(12):
        p, q = random.uniform(-0.8, 0.8, 3), random.normal(size=4)
        model = sphere(f"brick{i}", tuple(p))
        link = model.links[0]
        link = replace(link, collisions=(replace(link.collisions[0], geometry=d.Mesh(str(file))),))
        model = replace(model, pose=d.Pose(tuple(p), tuple(q / np.linalg.norm(q))), links=(link,))
        bricks.append((model, -2 * p, random.uniform(-20, 20, 3)))

    def made():
        world = ode_sim.World(d.World(physics=d.Physics(max_step_size=0.001), gravity=(0.0, 0.0, 0.0)))
        for model, v, w in bricks:
            world.spawn(model).links["link"].set_twist(tuple(v), tuple(w))
        return world

    world, before, met = made(), set(), 0
    for _ in range(600):
        snapshot = world.save()
        world.step()
        other = made()
        other.restore(snapshot)
        other.step()
        assert world.contacts().tobytes() == other.contacts().tobytes()
        met += len(meeting(world) - before)
        before = meeting(world)
    assert met > 20

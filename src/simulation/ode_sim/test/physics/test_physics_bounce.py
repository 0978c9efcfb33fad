"""Restitution: what falls from H rises by e^2 H (Newton), whatever its shape, the step and who moves; and it comes to rest."""

import itertools

import numpy as np
import ode_sim
import pytest
from ode_sim.description.model import Box, Collision, Cylinder, Link, Mesh, Model, Pose, Surface
from physics_models import box, box_inertia, ground, sphere
from scipy.spatial import ConvexHull

FALLS = 1.0  # m


def lively(e, threshold=0.01, **more):
    return Surface(restitution=e, bounce_threshold=threshold, **more)


def mesh_of(corners, e, path, rests):
    """A model of the convex hull of the corners, (n, 3); its lowest point is ``rests`` below its frame."""
    hull = ConvexHull(corners)
    facets = []
    for triangle, plane in zip(hull.simplices, hull.equations):
        a, b, c = corners[triangle]
        if np.dot(np.cross(b - a, c - a), plane[:3]) < 0:
            b, c = c, b
        facets.append(
            "facet normal 0 0 0\nouter loop\n"
            + "".join("vertex {:.9g} {:.9g} {:.9g}\n".format(*v) for v in (a, b, c))
            + "endloop\nendfacet\n"
        )
    path.write_text(f"solid hull\n{''.join(facets)}endsolid hull\n")
    collision = Collision("c", Pose(), Mesh(str(path), path.name), lively(e))
    link = Link("link", inertial=box_inertia(1.0, (2 * rests,) * 3), collisions=(collision,))
    return Model("hull", Pose((0, 0, FALLS + rests)), (link,))


def mesh_cube(e, tmp_path):
    corners = np.array(list(itertools.product((-0.05, 0.05), repeat=3)))
    return mesh_of(corners, e, tmp_path / "cube.stl", 0.05)


def mesh_ball(e, tmp_path):
    """With a corner below."""
    rings = [
        (0.1 * np.sin(b) * np.cos(a), 0.1 * np.sin(b) * np.sin(a), -0.1 * np.cos(b))
        for b in np.linspace(0.2, np.pi - 0.2, 9)
        for a in np.arange(0, 6.2, np.pi / 8)
    ]
    return mesh_of(np.array([(0, 0, -0.1), *rings, (0, 0, 0.1)]), e, tmp_path / "ball.stl", 0.1)


def can(e, _tmp_path):
    link = Link("link", inertial=box_inertia(0.3, (0.1,) * 3), collisions=(Collision("c", Pose(), Cylinder(0.05, 0.1), lively(e)),))
    return Model("can", Pose((0, 0, FALLS + 0.05)), (link,))


SHAPES = {
    "ball": lambda e, _tmp_path: sphere(at=(0, 0, FALLS + 0.1), mass=0.2, surface=lively(e)),
    "box": lambda e, _tmp_path: box(at=(0, 0, FALLS + 0.05), surface=lively(e)),
    "heavy box": lambda e, _tmp_path: box(at=(0, 0, FALLS + 0.05), mass=50.0, surface=lively(e)),
    "can": can,
    "mesh cube": mesh_cube,
    "mesh ball": mesh_ball,
}


def rises(world, model):
    """m, how far it comes up again after the first impact. Its lowest point begins FALLS above the floor."""
    start = model.pose.p[2]
    for _ in range(round(0.6 / world.dt)):
        world.step()
        if model.twist().linear[2] > 0:
            break
    else:
        return 0.0
    top = -np.inf
    while model.twist().linear[2] > 0:
        top = max(top, model.pose.p[2])
        world.step()
    return max(top, model.pose.p[2]) - start + FALLS


@pytest.mark.parametrize("dt", [0.001, 0.005])
@pytest.mark.parametrize("e", [0.3, 0.5, 0.8, 1.0])
@pytest.mark.parametrize("shape", SHAPES)
def test_it_rises_by_the_square_of_its_restitution(shape, e, dt, tmp_path):
    world = ode_sim.World()
    world.physics.max_step_size = dt
    world.spawn(ground(surface=lively(e)))
    model = world.spawn(SHAPES[shape](e, tmp_path))
    assert rises(world, model) == pytest.approx(e * e * FALLS, rel=0.02)
    assert not world.messages


@pytest.mark.parametrize("kind", [sphere, box])
@pytest.mark.parametrize("mass", [1.0, 20.0])
@pytest.mark.parametrize("e", [0.2, 0.8])
def test_two_that_move_part_at_their_share_of_the_speed_of_approach(kind, mass, e):
    """And their common centre of mass goes on as it went."""
    world = ode_sim.World()
    world.gravity = (0, 0, 0)
    first = world.spawn(kind("first", at=(0, 0, 1), surface=lively(e)))
    second = world.spawn(kind("second", at=(0.5, 0, 1), mass=mass, surface=lively(e)))
    first.set_twist((3.0, 0, 0), (0, 0, 0))
    world.step(400)
    v1, v2 = first.twist().linear[0], second.twist().linear[0]
    assert v2 - v1 == pytest.approx(3.0 * e, rel=0.01)
    assert v1 + mass * v2 == pytest.approx(3.0, rel=1e-6)


def test_the_less_lively_of_two_decides_and_the_lower_threshold():
    for first, second, e in ((0.8, 0.5, 0.5), (0.5, 0.8, 0.5), (0.8, 0.0, 0.0)):
        world = ode_sim.World()
        world.spawn(ground(surface=lively(second, 1e5)))
        assert rises(world, world.spawn(SHAPES["ball"](first, None))) == pytest.approx(e * e * FALLS, rel=0.02, abs=1e-3)


def test_many_feet_bounce_as_one():
    """25 of them touch at once: too many rows for the direct solver, the iterative one takes them."""
    world = ode_sim.World()
    world.spawn(ground(surface=lively(0.6)))
    feet = tuple(
        Collision(f"foot{i}", Pose((0.2 * (i % 5 - 2), 0.2 * (i // 5 - 2), 0)), Box((0.1, 0.1, 0.1)), lively(0.6)) for i in range(25)
    )
    link = Link("link", inertial=box_inertia(5.0, (1.0, 1.0, 0.1)), collisions=feet)
    table = world.spawn(Model("table", Pose((0, 0, FALLS + 0.05)), (link,)))
    assert rises(world, table) == pytest.approx(0.36 * FALLS, rel=0.02)
    assert world.core.counters.piles > 0


@pytest.mark.parametrize("threshold", [0.0, 0.01, 0.5])
@pytest.mark.parametrize("e", [0.3, 0.8])
def test_it_comes_to_rest_and_sleeps(e, threshold):
    world = ode_sim.World()
    world.spawn(ground(surface=lively(e, threshold)))
    models = [
        world.spawn(sphere(at=(1, 1, 0.3), surface=lively(e, threshold))),
        *(world.spawn(box(f"box{i}", at=(0, 0, 0.05 + 0.1 * i), surface=lively(e, threshold))) for i in range(4)),
    ]
    world.step(12000)
    assert all(model.asleep for model in models)
    assert [model.pose.p[2] for model in models] == pytest.approx([0.1, 0.05, 0.15, 0.25, 0.35], abs=1e-3)


def test_a_small_max_vel_does_not_keep_it_down_nor_a_large_one_make_it_bounce():
    """max_vel is about overlap that was put there. In Gazebo it cuts every bounce, and a large one throws what never bounced."""
    for surface, rises_to in ((lively(0.5, max_vel=0.0), 0.25), (Surface(max_vel=1000.0), 0.0), (Surface(max_vel=1000.0, kp=1e5), 0.0)):
        world = ode_sim.World()
        world.spawn(ground(surface=lively(0.5)))
        model = world.spawn(sphere(at=(0, 0, FALLS + 0.1), surface=surface))
        assert rises(world, model) == pytest.approx(rises_to, rel=0.02, abs=0.02)

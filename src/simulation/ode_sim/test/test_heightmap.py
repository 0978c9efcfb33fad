"""The ground that is drawn is the ground that one stands on, whatever the image holds."""

import time

import numpy as np
import ode_sim
import pytest
from ode_sim import math3
from ode_sim.description.model import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    DescriptionError,
    Heightmap,
    Link,
    Mesh,
    Model,
    Pose,
    Sphere,
    Surface,
    Visual,
)
from ode_sim.heightmap import load_heights, thinned

SIZE = (20.0, 10.0, 1200.0)


def hills(rows, columns, top):
    """Slopes and waves, from 0 to ``top``."""
    y, x = np.mgrid[0 : 1 : rows * 1j, 0 : 1 : columns * 1j]
    return np.round(top * (0.4 * x + 0.3 * y + 0.3 * np.sin(5 * x) ** 2 * np.cos(3 * y) ** 2))


def test_fewer_points_cover_the_same_ground():
    heights = hills(1500, 701, 1.0) + np.arange(701) / 700
    few = thinned(heights, 513)
    assert few.shape == (513, 513)
    for corner in ((0, 0), (0, -1), (-1, 0), (-1, -1)):
        assert few[corner] == heights[corner]
    assert thinned(heights, 1500) is heights
    slope = np.add.outer(np.arange(700.0), np.arange(600.0))
    assert thinned(slope, 100) == pytest.approx(np.add.outer(np.linspace(0, 699, 100), np.linspace(0, 599, 100)))


@pytest.mark.parametrize("size", ((1, 5), (5, 1)))
def test_a_row_of_pixels_is_no_ground(tmp_path, size):
    from PIL import Image

    Image.fromarray(np.zeros(size, np.uint8)).save(tmp_path / "row.png")
    with pytest.raises(DescriptionError, match="row.png: a height map must have at least 2x2 pixels"):
        load_heights(Heightmap(str(tmp_path / "row.png")))


def terrain(folder, grey, size, pose):
    """A world of a map of these grey values (rows, columns), the highest of which is ``size[2]`` high, and its triangles (n, 3, 3) in it.

    Each cell has two, on either side of the diagonal from its right end in the upper row to its left end in the lower, as in ODE's
    heightfield.cpp.
    """
    from PIL import Image

    Image.fromarray(grey.astype(np.uint16)).save(folder / "map.png")
    shape = Heightmap(str(folder / "map.png"), size=size)
    world = ode_sim.World()
    world.spawn(Model("ground", pose, (Link("l", collisions=(Collision("c", Pose(), shape),)),), static=True))
    rows, columns = grey.shape
    y, x = np.meshgrid(np.linspace(size[1] / 2, -size[1] / 2, rows), np.linspace(-size[0] / 2, size[0] / 2, columns), indexing="ij")
    points = np.stack([x, y, grey / max(1, grey.max()) * size[2]], axis=-1)
    a, b, c, d = points[:-1, :-1], points[:-1, 1:], points[1:, :-1], points[1:, 1:]
    triangles = np.concatenate([np.stack(three, axis=2).reshape(-1, 3, 3) for three in ((a, b, c), (d, c, b))])
    return world, triangles @ rotation(pose).T + pose.p


def rotation(pose):
    return np.stack([math3.quat_rotate(pose.q, axis) for axis in np.eye(3)], axis=1)


def meets(triangles, origin, direction):
    """Nearest distance at which the ray meets one of the triangles, from either side (Moeller and Trumbore)."""
    a, e, f = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    p = np.cross(direction, f)
    with np.errstate(divide="ignore", invalid="ignore"):
        scale = 1.0 / np.einsum("ij,ij->i", e, p)
        s = origin - a
        q = np.cross(s, e)
        u, v, t = scale * np.einsum("ij,ij->i", s, p), scale * (q @ direction), scale * np.einsum("ij,ij->i", f, q)
        hit = (u >= 0) & (v >= 0) & (u + v <= 1) & (t >= 0)
    return t[hit].min() if hit.any() else np.inf


@pytest.mark.parametrize("pose", (Pose(), math3.from_rpy(3.0, -2.0, 1.0, 0.3, -0.2, 0.7)))
def test_rays_meet_the_triangles_from_above_and_below(tmp_path, pose):
    rng = np.random.default_rng(1)
    world, triangles = terrain(tmp_path, rng.integers(0, 65536, (9, 17)), (8.0, 6.0, 2.0), pose)
    origins = rng.uniform((-6, -5, -3), (6, 5, 5), (2000, 3)) @ rotation(pose).T + pose.p
    directions = rng.normal(size=(2000, 3))
    ranges, _ = world.cast_rays(origins, directions, 20.0)
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    expected = np.array([meets(triangles, o, d) for o, d in zip(origins, directions)])
    expected[expected > 20.0] = np.inf
    assert 300 < np.isfinite(expected).sum() < 1800
    np.testing.assert_allclose(ranges, expected, atol=1e-8)


def test_rays_along_the_lines_of_the_grid(tmp_path):
    """Upright, along a row, along a column, along a diagonal, on the border, beside it, along a flat, below all of it."""
    ramp = np.add.outer(np.arange(5), np.zeros(5)) * 10000
    world, triangles = terrain(tmp_path, ramp, (4.0, 4.0, 4.0), Pose())  # 1 m a row, down towards +y
    for origin, direction, distance in (
        ((0, 0, 9), (0, 0, -1), 7.0),
        ((1, 1, 9), (0, 0, -1), 8.0),
        ((0, 0, 0), (0, 0, 1), 2.0),
        ((2, 2, 9), (0, 0, -1), 9.0),
        ((-2, -2, 9), (0, 0, -1), 5.0),
        ((0, 5, 1.5), (0, -1, 0), 4.5),
        ((0, -5, 1.5), (0, 1, 0), 5.5),
        ((1, 5, 3), (0, -1, 0), 6.0),
        ((2, 5, 1), (0, -1, 0), 4.0),
        ((2.01, 5, 1), (0, -1, 0), np.inf),
        ((-5, 0, 2.5), (1, 0, 0), np.inf),
        ((-5, 0.5, 1.49), (1, 0, 0), np.inf),
        ((0, 0, -0.5), (1, 0, 0), np.inf),
        ((0, 1, -3), (0, 0, -1), np.inf),
        ((1.5, -1.5, 5), (-1, 1, -2), 1.5 * 6**0.5),
    ):
        ranges, _ = world.cast_rays([origin], [direction], 50.0)
        assert ranges[0] == pytest.approx(distance, abs=1e-6), (origin, direction)
    world, _ = terrain(tmp_path, np.full((300, 300), 65535), (30.0, 30.0, 1.0), Pose())
    ranges, _ = world.cast_rays([(0, 0, 3.0), (-14, -13, 2.0)], [(0.1, 0.2, -1), (1, 0.9, -0.1)], 100.0)
    assert ranges == pytest.approx([2 * 1.05**0.5, 10 * 1.82**0.5])


@pytest.mark.parametrize("grey, height", ((((0, 65535), (65535, 0)), 0.95), (((65535, 0), (0, 65535)), 0.05)))
def test_the_ridge_that_rays_see_carries(tmp_path, grey, height):
    """Near the middle of a cell of which two opposite corners are 1 m high: a ridge or a valley, by the diagonal that divides it."""
    for above, touches in ((0.01, True), (0.05, False)):  # m, upright; the slope is 54.7 degrees: 0.006 m and 0.029 m away
        world, _ = terrain(tmp_path, np.array(grey), (1.0, 1.0, 1.0), Pose())
        ranges, _ = world.cast_rays([(0.1, 0.05, 3)], [(0, 0, -1)], 9.0)
        assert ranges[0] == pytest.approx(3.0 - height)
        ball = Link("l", collisions=(Collision("c", Pose(), Sphere(0.02)),))
        world.spawn(Model("ball", Pose((0.1, 0.05, height + above)), (ball,)))
        world.step(1)
        assert (len(world.contacts()) > 0) == touches


def cube_of_triangles(folder):
    """An STL file of 0.4 m x 0.4 m x 0.4 m."""
    corners = 0.2 * np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    lines = ["solid cube"]
    for a, b, c, d in ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)):
        for face in ((a, b, c), (a, c, d)):
            lines += [
                "facet normal 0 0 0",
                "outer loop",
                *(f"vertex {x} {y} {z}" for x, y, z in corners[list(face)]),
                "endloop",
                "endfacet",
            ]
    (folder / "cube.stl").write_text("\n".join([*lines, "endsolid cube"]))
    return Mesh(str(folder / "cube.stl"), str(folder / "cube.stl"))


SHAPES = {  # and how far below its middle it ends, m
    "ball": (lambda folder: Sphere(0.2), Pose(), 0.2),
    "box": (lambda folder: Box((0.4, 0.4, 0.4)), Pose(), 0.2),
    "capsule": (lambda folder: Capsule(0.2, 0.4), Pose(), 0.4),
    "drum": (lambda folder: Cylinder(0.2, 0.4), Pose(), 0.2),
    "wheel across": (lambda folder: Cylinder(0.2, 0.4), math3.from_rpy(0, 0, 0, 0, np.pi / 2, 0), 0.2),
    "wheel along": (lambda folder: Cylinder(0.2, 0.4), math3.from_rpy(0, 0, 0, np.pi / 2, 0, 0), 0.2),
    "mesh": (cube_of_triangles, Pose(), 0.2),
}


def settled(world, shape, turned, at, steps=1500):
    """Height of a thing without friction that is let go 5 cm above where it will rest."""
    world.spawn(Model("thing", Pose(at), (Link("l", collisions=(Collision("c", turned, shape, Surface(mu=0.0)),)),)))
    world.step(steps)
    return world.models["thing"].pose.p


@pytest.mark.parametrize("height", (0.05, 0.5, 2.0))
@pytest.mark.parametrize("name", SHAPES)
def test_what_stands_exactly_on_a_ridge_is_carried_by_it(tmp_path, name, height):
    """A ridge along y, 1 m wide at each side of its foot; it stands and falls by the middle alone, in balance."""
    make, turned, low = SHAPES[name]
    grey = np.zeros((5, 5))
    grey[:, 2] = 65535
    world, _ = terrain(tmp_path, grey, (4.0, 4.0, height), Pose())
    p = settled(world, make(tmp_path), turned, (0.0, 0.3, height + low + 0.05))
    assert p == pytest.approx((0.0, 0.3, height + low), abs=2e-3)


def test_a_peak_carries_a_ball_and_two_ridges_a_plank(tmp_path):
    grey = np.zeros((5, 5))
    grey[2, 2] = 65535
    world, _ = terrain(tmp_path, grey, (4.0, 4.0, 0.3), Pose())
    assert settled(world, Sphere(0.1), Pose(), (0.0, 0.0, 0.45))[2] == pytest.approx(0.4, abs=2e-3)
    grey = np.zeros((5, 5))
    grey[:, [1, 3]] = 65535
    world, _ = terrain(tmp_path, grey, (4.0, 4.0, 0.5), Pose())
    assert settled(world, Box((2.4, 0.2, 0.1)), Pose(), (0.1, 0.3, 0.6))[2] == pytest.approx(0.55, abs=2e-3)


def test_a_ridge_of_a_turned_map_carries(tmp_path):
    """Turned by 0.8 rad about z, so that the ridge runs slantwise."""
    grey = np.zeros((5, 5))
    grey[:, 2] = 65535
    pose = math3.from_rpy(1.0, 2.0, 0.5, 0.0, 0.0, 0.8)
    world, _ = terrain(tmp_path, grey, (4.0, 4.0, 0.5), pose)
    at = math3.compose(pose, Pose((0.0, 0.3, 0.5 + 0.25))).p
    assert settled(world, Sphere(0.2), Pose(), at) == pytest.approx((at[0], at[1], 0.5 + 0.7), abs=2e-3)


@pytest.mark.parametrize("aside", (0.0, 0.01, -0.03, 0.06))
def test_a_ball_near_a_ridge_touches_its_edge_or_its_slope_once(tmp_path, aside):
    """A ball of 0.1 m that is 2 mm deep, over slopes of 0.5 m in 1 m: within 0.1 sin(atan 0.5) = 0.045 m of the edge it is that."""
    grey = np.zeros((5, 5))
    grey[:, 2] = 65535
    world, _ = terrain(tmp_path, grey, (4.0, 4.0, 0.5), Pose())
    steep = np.array((0.5 * np.sign(aside), 0.0, 1.0)) / 1.25**0.5
    up = steep if abs(aside) > 0.045 else np.array((aside / 0.098, 0.0, (1 - (aside / 0.098) ** 2) ** 0.5))
    middle = np.array((0.0, 0.3, 0.5)) + 0.098 * up
    middle[[0, 2]] += (aside - middle[0]) * np.array((1.0, -0.5 * np.sign(aside)))  # along the slope
    world.spawn(Model("thing", Pose(tuple(middle)), (Link("l", gravity=False, collisions=(Collision("c", Pose(), Sphere(0.1)),)),)))
    world.step(1)
    (contact,) = world.contacts()
    assert abs(contact["normal"] @ up) == pytest.approx(1.0, abs=1e-3)
    assert contact["depth"] == pytest.approx(0.002, abs=1e-4)
    assert contact["position"] == pytest.approx(middle - 0.098 * up, abs=0.005)


@pytest.mark.slow
def test_a_ray_over_a_large_map_costs_what_its_cells_cost(tmp_path):
    """ODE alone looks at each of the 66 000 cells below it: 0.4 s for one ray."""
    world, _ = terrain(tmp_path, np.random.default_rng(2).integers(0, 65536, (257, 257)), (100.0, 100.0, 1.0), Pose())
    angles = np.linspace(-np.pi, np.pi, 1000)
    directions = np.stack([np.cos(angles), np.sin(angles), np.full(1000, -1e-4)], axis=1)
    begin = time.process_time()
    world.cast_rays(np.tile((0.0, 0.0, 1.01), (1000, 1)), directions, 60.0)
    assert time.process_time() - begin < 2.0


@pytest.mark.parametrize("roll, yaw", ((0.0, 0.8), (0.3, 0.0), (-0.3, 2.5)))
def test_a_map_that_is_turned_carries_to_its_corners(tmp_path, roll, yaw):
    pose = math3.from_rpy(0.0, 0.0, 0.0, roll, 0.0, yaw)
    world, _ = terrain(tmp_path, np.full((5, 5), 65535), (10.0, 10.0, 1.0), pose)
    for number, corner in enumerate(((4.5, 4.5), (-4.5, 4.5), (4.5, -4.5), (-4.5, -4.5))):
        at = math3.compose(pose, Pose((*corner, 1.12)))
        world.spawn(Model(f"box{number}", at, (Link("l", collisions=(Collision("c", Pose(), Box((0.2, 0.2, 0.2)), Surface(mu=1.0)),)),)))
    world.step(500)
    for number in range(4):
        in_map = math3.relative(pose, world.models[f"box{number}"].pose)
        assert in_map.p[2] == pytest.approx(1.1, abs=0.01)

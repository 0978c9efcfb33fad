"""Small things of mesh on large grounds of mesh: laws of motion on paper, whatever part of the ground is looked at."""

import math

import numpy as np
import ode_sim
import pytest
from ode_sim.description.model import Collision, Inertial, Link, Mesh, Model, Pose, Surface
from ode_sim.math3 import quat_from_rpy

G = 9.8
HALF = 0.05  # m, of the cube's side


def obj(path, corners, triangles):
    lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in corners] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in triangles]
    path.write_text("\n".join(lines) + "\n")
    return str(path)


def field(path, squares, side):
    """A flat square of ``side`` m round the origin, of two triangles a square."""
    at = np.linspace(-side / 2, side / 2, squares + 1)
    corners = [(x, y, 0.0) for x in at for y in at]
    triangles = []
    for i in range(squares):
        for k in range(squares):
            a = i * (squares + 1) + k
            b = a + squares + 1
            triangles += [(a, b, b + 1), (a, b + 1, a + 1)]
    return obj(path, corners, triangles)


def slab(path, squares, side, height):
    """Such a field above another one, closed round."""
    at = np.linspace(-side / 2, side / 2, squares + 1)
    n = (squares + 1) ** 2
    corners = [(x, y, z) for z in (-height / 2, height / 2) for x in at for y in at]
    triangles = []
    for i in range(squares):
        for k in range(squares):
            a = i * (squares + 1) + k
            b = a + squares + 1
            triangles += [(n + a, n + b, n + b + 1), (n + a, n + b + 1, n + a + 1), (a, b + 1, b), (a, a + 1, b + 1)]
    rim = [i * (squares + 1) for i in range(squares + 1)]
    rim += [squares * (squares + 1) + k for k in range(1, squares + 1)]
    rim += [(i + 1) * (squares + 1) - 1 for i in reversed(range(squares))]
    rim += list(reversed(range(1, squares)))
    for a, b in zip(rim, rim[1:] + rim[:1]):
        triangles += [(a, b, n + b), (a, n + b, n + a)]
    return obj(path, corners, triangles)


def cube(path):
    corners = [(x, y, z) for x in (-HALF, HALF) for y in (-HALF, HALF) for z in (-HALF, HALF)]
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return obj(path, corners, [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))])


def of_mesh(name, path, pose, mu=0.0, static=False, mass=1.0):
    shape = Collision("mesh", Pose(), Mesh(uri=name + ".obj", path=path), surface=Surface(mu=mu, mu2=mu))
    moment = mass * (2 * HALF) ** 2 / 6
    return Model(name, pose, (Link("link", Pose(), Inertial(mass, Pose(), moment, 0, 0, moment, 0, moment), (shape,)),), static=static)


@pytest.fixture(scope="module")
def field_path(tmp_path_factory):
    return field(tmp_path_factory.mktemp("field") / "field.obj", 141, 20.0)


@pytest.fixture
def slope(tmp_path, field_path):
    """A world with a field, 20 m wide, of 40 000 triangles, and a cube on it; the field is turned by yaw where it is level."""

    def make(tilt, yaw=0.3, mu=0.0, below=(0.013, 0.021)):
        world = ode_sim.World()
        turn = quat_from_rpy(0.0, tilt, 0.0)
        down = np.array([math.cos(tilt), 0.0, -math.sin(tilt)])
        up = np.array([math.sin(tilt), 0.0, math.cos(tilt)])
        field_turn = quat_from_rpy(0.0, 0.0, yaw) if tilt == 0.0 else turn
        world.spawn(of_mesh("field", field_path, Pose((0, 0, 0), field_turn), mu, static=True))
        start = up * (HALF + 1e-5) + down * below[0] + np.array([0.0, below[1], 0.0])
        model = world.spawn(of_mesh("cube", cube(tmp_path / "cube.obj"), Pose(tuple(start), turn), mu))
        return world, model, start, down, up

    return make


@pytest.mark.parametrize("degrees", [5, 20])
def test_a_cube_without_friction_slides_down_as_on_paper(slope, degrees):
    tilt = math.radians(degrees)
    world, model, start, down, up = slope(tilt)
    world.step(1000)
    way = np.array(model.pose.p) - start
    assert way @ down == pytest.approx(0.5 * G * math.sin(tilt) * 1.0**2, rel=0.01)
    assert way @ up == pytest.approx(0.0, abs=1e-3)
    assert way[1] == pytest.approx(0.0, abs=1e-3)


def test_a_cube_stays_where_friction_holds_it(slope):
    world, model, start, _, _ = slope(math.radians(20), mu=0.6)  # tan(20 deg) is 0.36
    world.step(3000)
    assert np.linalg.norm(np.array(model.pose.p) - start) < 2e-3


def test_a_cube_that_slides_stops_as_coulomb_says(slope):
    world, model, start, _, _ = slope(0.0, mu=0.3)
    world.step(200)
    before = np.array(model.pose.p)
    model.set_twist((1.5, 0.0, 0.0), (0.0, 0.0, 0.0))
    world.step(2000)
    way = np.array(model.pose.p) - before
    assert way[0] == pytest.approx(1.5**2 / (2 * 0.3 * G), rel=0.03)
    assert model.pose.p[2] == pytest.approx(HALF, abs=1e-3)


def test_over_the_edge_of_the_field_it_falls(slope):
    world, model, _, _, _ = slope(0.0, yaw=0.0, below=(9.5, 0.0))
    model.set_twist((2.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    world.step(1000)
    assert model.pose.p[0] > 10 + HALF and model.pose.p[2] < -1.0


def test_the_smaller_one_may_be_the_one_that_stands_still(tmp_path):
    """A wide plate comes down on four pegs."""
    world = ode_sim.World()
    peg = cube(tmp_path / "peg.obj")
    for i, (x, y) in enumerate(((0.3, 0.3), (-0.3, 0.3), (-0.3, -0.3), (0.3, -0.3))):
        world.spawn(of_mesh(f"peg{i}", peg, Pose((x, y, HALF)), 1.0, static=True))
    plate = world.spawn(of_mesh("plate", slab(tmp_path / "plate.obj", 40, 2.0, 0.04), Pose((0, 0, 0.15)), 1.0, mass=5.0))
    world.step(1500)
    assert plate.pose.p[2] == pytest.approx(2 * HALF + 0.02, abs=2e-3)
    before = np.array(plate.pose.p)
    world.step(1000)
    assert np.linalg.norm(np.array(plate.pose.p) - before) < 1e-3


def test_continued_from_a_snapshot_every_bit_is_the_same(slope):
    """What is known of the way there is not known after a restart."""
    world, model, _, _, _ = slope(math.radians(10), mu=0.05)
    world.step(400)
    snapshot = world.save()
    world.step(800)
    first = model.pose
    world.restore(snapshot)
    world.step(800)
    assert (first.p, first.q) == (model.pose.p, model.pose.q)

"""Search trees of collision meshes: built once, beforehand if wanted, shared."""

import gc
import math
import threading
from dataclasses import replace

import numpy as np
import ode_sim
import pytest
from ode_sim import collision_meshes, math3
from ode_sim.description.model import Box, Collision, Heightmap, Inertial, Link, Mesh, Model, Polyline, Pose
from physics_models import ground
from PIL import Image


def dome(rings, radius=0.2):
    """ASCII OBJ of a closed ball."""
    lines, n = [f"v 0 0 {radius}"], 2 * rings
    for i in range(1, rings):
        for k in range(n):
            a, b = math.pi * i / rings, 2 * math.pi * k / n
            lines.append(f"v {radius * math.sin(a) * math.cos(b)} {radius * math.sin(a) * math.sin(b)} {radius * math.cos(a)}")
    lines.append(f"v 0 0 {-radius}")
    last = 2 + n * (rings - 1)
    for k in range(n):
        right = (k + 1) % n
        lines.append(f"f 1 {2 + k} {2 + right}")
        for i in range(rings - 2):
            a, b = 2 + n * i, 2 + n * (i + 1)
            lines += [f"f {a + k} {b + k} {b + right}", f"f {a + k} {b + right} {a + right}"]
        lines.append(f"f {last} {last - n + right} {last - n + k}")
    return "\n".join(lines) + "\n"


@pytest.fixture
def ball(tmp_path):
    """A description of a ball of mesh at (x, 0, z)."""
    path = tmp_path / "ball.obj"

    def make(name, at, rings=12):
        if not path.exists():
            path.write_text(dome(rings))
        shape = Collision("mesh", Pose(), Mesh(uri="ball.obj", path=str(path)))
        return Model(name, Pose(at), (Link("link", Pose(), Inertial(1.0, Pose(), 0.02, 0, 0, 0.02, 0, 0.02), (shape,)),))

    return make


def test_models_share_one_tree_and_outlive_each_other(ball):
    world = ode_sim.World()
    world.spawn(ground())
    before = collision_meshes._load.cache_info()
    world.spawn(ball("first", (0, 0, 0.21)))
    second = world.spawn(ball("second", (1, 0, 0.21)))
    after = collision_meshes._load.cache_info()
    assert (after.misses - before.misses, after.hits - before.hits) == (1, 1)
    world.step(200)
    world.remove("first")
    collision_meshes._load.cache_clear()
    world.step(500)
    assert second.pose.p[2] == pytest.approx(0.2, abs=0.003)
    assert len(world.contacts()) > 0


def test_prepared_in_another_thread_while_the_world_steps(ball):
    world = ode_sim.World()
    model = ball("big", (0, 0, 1.0), rings=60)
    thread = threading.Thread(target=ode_sim.prepare, args=(model,))
    thread.start()
    while thread.is_alive():
        world.step()
    before = collision_meshes._load.cache_info().misses
    world.spawn(model)
    assert collision_meshes._load.cache_info().misses == before
    ranges, _ = world.cast_rays(np.array([[0, 0, 3.0]]), np.array([[0, 0, -1.0]]), 10.0)
    assert ranges[0] == pytest.approx(1.8, abs=1e-4)


def test_what_cannot_be_loaded_is_left_to_spawning():
    missing = Collision("missing", Pose(), Mesh(uri="nowhere.stl", path="/nowhere.stl"))
    box = Collision("box", Pose(), Box((0.1, 0.1, 0.1)))
    model = Model("m", Pose(), (Link("link", collisions=(missing, box)),))
    ode_sim.prepare(model)
    world = ode_sim.World()
    assert list(world.spawn(model).links["link"].collisions) == ["box"]
    assert "nowhere.stl" in world.problems[0].message


def many_meshes(tmp_path, count):
    """A model of as many different meshes, one height map and one polyline."""
    links = []
    for i in range(count):
        path = tmp_path / f"ball{i}.obj"
        path.write_text(dome(4, 0.05 + 0.001 * i))
        links.append(Link(f"l{i}", Pose((i, 0, 1)), collisions=(Collision("c", Pose(), Mesh(uri=path.name, path=str(path))),)))
    image = tmp_path / "hills.png"
    Image.fromarray(np.linspace(0, 255, 33 * 33).reshape(33, 33).astype(np.uint8)).save(image)
    hills, prism = Heightmap(str(image), size=(10.0, 10.0, 1.0)), Polyline(((0, 0), (1, 0), (0, 1)), 1.0)
    links.append(Link("ground", Pose((0, 50, 0)), collisions=(Collision("h", Pose(), hills), Collision("p", Pose((0, 9, 0)), prism))))
    return Model("many", Pose(), tuple(links), static=True)


def test_what_is_prepared_is_what_a_spawn_uses_however_much_it_is(tmp_path, monkeypatch):
    model = many_meshes(tmp_path, 150)
    ode_sim.prepare(model)
    ode_sim.prepare(many_meshes(tmp_path, 70))  # another robot comes between
    collision_meshes._load.cache_clear()

    def made_now(*args):
        raise AssertionError("read or built while the world stands still")

    for name in ("load_surface", "file_stamp", "mesh_data", "load_heights", "extrude"):
        monkeypatch.setattr(collision_meshes, name, made_now)
    world = ode_sim.World()
    spawned = world.spawn(replace(model, name="placed", pose=Pose((0, 0, 1))))  # as the simulator's services do
    assert world.problems == [] and sum(len(link.collisions) for link in spawned.links.values()) == 152
    ranges, _ = world.cast_rays(np.array([[100.0, 0, 5.0]]), np.array([[0, 0, -1.0]]), 10.0)
    assert ranges[0] == pytest.approx(5.0 - 2.0 - 0.15, abs=1e-6)


def test_what_was_prepared_goes_with_the_description(tmp_path):
    gc.collect()
    before = len(collision_meshes._ready)
    model = many_meshes(tmp_path, 3)
    ode_sim.prepare(model)
    ode_sim.prepare(model)
    assert len(collision_meshes._ready) == before + 5
    del model
    gc.collect()
    assert len(collision_meshes._ready) == before


def rod():
    """(corners (8, 3), OBJ) of a rod of 0.6 x 0.1 x 0.1 m."""
    corners = np.array([(x, y, z) for x in (-0.3, 0.3) for y in (-0.05, 0.05) for z in (-0.05, 0.05)])
    quads = ((1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4))
    return corners, "".join(f"v {x} {y} {z}\n" for x, y, z in corners) + "".join(f"f {a} {b} {c}\nf {a} {c} {d}\n" for a, b, c, d in quads)


FUNNEL = (
    "v 0 0 0\n" + "".join(f"v {x} {y} 1\n" for x, y in ((2, 2), (-2, 2), (-2, -2), (2, -2))) + "f 1 2 3\nf 1 3 4\nf 1 4 5\nf 1 5 2\n"
)  # no hull of it is empty above it: z = max(|x|, |y|) / 2


@pytest.mark.parametrize("on", ("plane", "mesh", "funnel"))
@pytest.mark.parametrize("spin", ((0.0, 9.0, 0.0), (3.0, 0.0, 7.0), (8.0, -6.0, 2.0)))
def test_a_mesh_that_falls_and_turns_touches_when_its_lowest_corner_does(tmp_path, on, spin):
    corners, text = rod()
    (tmp_path / "rod.obj").write_text(text)
    (tmp_path / "mesh.obj").write_text("v -3 -3 0\nv 3 -3 0\nv 3 3 0\nv -3 3 0\nf 1 2 3\nf 1 3 4\n")
    (tmp_path / "funnel.obj").write_text(FUNNEL)
    world = ode_sim.World()
    if on == "plane":
        world.spawn(ground())
    else:
        floor = Collision("c", Pose(), Mesh(uri=on, path=str(tmp_path / f"{on}.obj")))
        world.spawn(Model("floor", Pose(), (Link("l", collisions=(floor,)),), static=True))
    shape = Collision("mesh", Pose(), Mesh(uri="rod.obj", path=str(tmp_path / "rod.obj")))
    inertial = Inertial(1.0, Pose(), 0.1, 0, 0, 0.1, 0, 0.1)
    rods = world.spawn(Model("rod", Pose((0.0, 0.0, 1.2)), (Link("link", Pose(), inertial, (shape,)),)))
    rods.links["link"].set_twist((0.0, 0.0, 0.0), spin)

    def above():
        """m, of the lowest corner above what is below it."""
        turned = np.array([math3.transform(rods.pose, tuple(corner)) for corner in corners])
        below = np.max(np.abs(turned[:, :2]), axis=1) / 2 if on == "funnel" else 0.0
        return float(np.min(turned[:, 2] - below))

    for _ in range(2000):
        height = above()
        world.step(1)
        if height < -2e-4:
            assert len(world.contacts())
            break
        assert height < 2e-4 or not len(world.contacts()), height
    else:
        raise AssertionError("it never came down")

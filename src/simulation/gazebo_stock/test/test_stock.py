"""The models and worlds that come with the simulator."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest
from ode_sim import World, math3, mesh
from ode_sim.description import ResourceFinder, load_world
from ode_sim.description.model import Mesh

STOCK = Path(__file__).resolve().parents[1]
FINDER = ResourceFinder(environment=False, stock=str(STOCK))
MODELS = FINDER.stock_models()
WORLDS = FINDER.stock_worlds()


def included(*names, pose=""):
    body = "".join(f"<include><uri>model://{name}</uri>{pose}</include>" for name in names)
    return f"<sdf version='1.6'><world name='w'>{body}</world></sdf>"


def generated(folder, script):
    spec = importlib.util.spec_from_file_location(script, STOCK / folder / f"{script}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.files()


@pytest.mark.parametrize(
    "folder, script", [("models", "make_meshes"), ("models", "make_models"), ("models", "make_town_meshes"), ("worlds", "make_worlds")]
)
def test_files_are_what_their_script_writes(folder, script, monkeypatch):
    monkeypatch.syspath_prepend(str(STOCK / "models"))
    for name, text in generated(folder, script).items():
        assert (STOCK / folder / name).read_text() == text, f"run {folder}/{script}.py"


@pytest.mark.parametrize("name", ["cinder_block", "cinder_block_2", "cinder_block_wide"])
def test_worlds_that_were_saved_with_a_block_find_its_mesh(name):
    assert FINDER.find(f"model://{name}/meshes/cinder_block.dae")


@pytest.mark.parametrize("name", MODELS)
def test_a_model_loads_without_a_word_and_its_meshes_are_whole(name):
    world, problems = load_world(included(name), FINDER)
    assert not problems and len(world.models) + len(world.lights) == 1
    for model in world.models:
        for link in model.links:
            for shape in link.collisions + link.visuals:
                if isinstance(shape.geometry, Mesh):
                    surface = mesh.load(shape.geometry)
                    assert mesh.mass_properties(surface).volume > 0.0


@pytest.mark.parametrize("name", [name for name in MODELS if name not in ("sun", "ground_plane") and not name.startswith("number")])
def test_what_collides_is_where_it_is_seen(name):
    """The boxes around visuals and collisions of a model agree to a few centimetres."""
    import numpy as np

    def extent(shapes):
        points = []
        for shape in shapes:
            g = shape.geometry
            if isinstance(g, Mesh):
                corners = mesh.load(g).vertices
            else:
                half = (
                    tuple(v / 2 for v in g.size)
                    if hasattr(g, "size")
                    else (g.radius, g.radius, g.length / 2)
                    if hasattr(g, "length")
                    else (g.radius,) * 3
                )
                corners = [(x * half[0], y * half[1], z * half[2]) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
            points += [math3.transform(shape.pose, tuple(c)) for c in corners]
        return np.array([np.min(points, axis=0), np.max(points, axis=0)])

    link = load_world(included(name), FINDER)[0].models[0].links[0]
    assert np.abs(extent(link.collisions) - extent(link.visuals)).max() < 0.11


def test_worlds_that_were_saved_with_a_model_of_the_town_see_it_at_the_same_place(monkeypatch):
    """They hold the model's SDF, which names a mesh, its scale and its place."""
    monkeypatch.syspath_prepend(str(STOCK / "models"))
    import make_town_meshes as town

    for name in town.TOWN:
        file = town.FILES.get(name, town.File(f"{name}.dae"))
        vertices = mesh.load_surface(str(STOCK / "models" / name / "meshes" / file.name), file.scale).vertices
        pose = math3.from_rpy(*file.at, 0, 0, file.yaw)
        seen = np.array([math3.transform(pose, tuple(vertex)) for vertex in vertices])
        whole = np.concatenate([town.solid(shape).at(*shape.pose).vertices for shape in town.TOWN[name].shapes])
        np.testing.assert_allclose([seen.min(axis=0), seen.max(axis=0)], [whole.min(axis=0), whole.max(axis=0)], atol=0.02, err_msg=name)
    for name, parts in town.PARTS.items():
        for part in parts:
            assert len(mesh.load_surface(str(STOCK / "models" / name / "meshes" / f"{name}.dae"), submesh=part).vertices), (name, part)


FALLING = [name for name in MODELS if name != "sun" and not load_world(included(name), FINDER)[0].models[0].static]


CENTRED = {"euro_pallet": 0.07, "drc_practice_truss": 0.145}  # m from the ground to the origin, which the database has in the middle


@pytest.mark.parametrize("name", FALLING)
def test_what_can_fall_stands(name):
    """Put down where its file puts it, a model comes to rest upright, neither sinking in nor jumping off."""
    world = World.load(included("ground_plane", name), finder=FINDER)
    _, model = world.models.values()
    if name in CENTRED:
        model.pose = math3.from_rpy(0, 0, CENTRED[name], 0, 0, 0)
    link = next(iter(model.links.values()))
    start = link.pose.p
    world.step(1500)
    roll, pitch, _ = math3.to_rpy(model.pose)
    assert abs(roll) < 0.02 and abs(pitch) < 0.02 and math3.norm(link.com_velocity()) < 1e-3
    drop = start[2] - link.pose.p[2]
    assert 0.13 < drop < 0.14 if name == "car_wheel" else -0.01 < drop < 0.005  # the wheel lies down from its rim
    assert math3.norm(math3.sub(start, link.pose.p)[:2] + (0.0,)) < 0.005
    assert not world.messages


@pytest.mark.parametrize("name", WORLDS)
def test_a_world_loads_without_a_word_and_runs(name):
    world = World.load(name, finder=FINDER)
    assert not world.problems
    world.step(200)
    assert not world.messages and world.time > 0.0


def test_only_the_slippery_boxes_slide():
    world = World.load("worlds/friction_demo.world", finder=FINDER)
    world.step(2000)
    gone = {name for name, model in world.models.items() if math3.norm(math3.sub(model.pose.p, model.initial_pose.p)) > 0.1}
    assert gone == {"box_mu_0.05", "box_mu_0.15", "box_mu_0.25"}


def test_the_seesaw_tips_to_the_heavy_side():
    world = World.load("worlds/seesaw.world", finder=FINDER)
    world.step(3000)
    hinge = world.models["seesaw"].joints["hinge"]
    assert abs(hinge.position() - 0.45) < 0.02 and math3.norm(world.models["seesaw"].links["base"].pose.p) < 1e-6


def test_every_textured_gazebo_material_has_its_picture():
    from ode_sim.description import materials
    from PIL import Image

    pictures = {
        material.name: material.texture
        for material in (materials.gazebo_material(name, FINDER) for name in materials.NAMES)
        if material.texture
    }
    assert {"Gazebo/Wood", "Gazebo/Bricks", "Gazebo/CeilingTiled", "Gazebo/Grass", "Gazebo/Road"} <= set(pictures)
    for picture in set(pictures.values()):
        with Image.open(picture) as image:
            assert image.size in ((128, 128), (256, 256))  # roads: their lines are thin
    named = {look.texture for look in materials._LOOKS.values() if look.texture}
    assert named == {picture.rpartition("/")[2] for picture in pictures.values()}

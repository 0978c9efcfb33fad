"""The person that walks through worlds: the files are what their script writes, and the person keeps its feet on the ground."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest
from ode_sim import World, math3
from ode_sim.description import ResourceFinder
from ode_sim.mesh import load as load_mesh

STOCK = Path(__file__).resolve().parents[1]
FOLDER = STOCK / "media/models"
FINDER = ResourceFinder(environment=False, stock=str(STOCK))
PEOPLE = sorted(path.name for path in FOLDER.glob("*.dae"))
UP_TO = {"walk.dae": 1.36, "run.dae": 4.58, "moonwalk.dae": 1.24}  # m, along x in one round


def test_files_are_what_their_script_writes(monkeypatch):
    monkeypatch.syspath_prepend(str(FOLDER))
    spec = importlib.util.spec_from_file_location("make_people", FOLDER / "make_people.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    for name, text in module.files().items():
        assert (FOLDER / name).read_text() == text, "run media/models/make_people.py"
    assert PEOPLE == sorted(name for name in module.files() if "/" not in name)


def walker(name, waypoints="", along="true"):
    return (
        f"<sdf version='1.6'><world name='w'><actor name='p'><skin><filename>{name}</filename></skin><animation name='a'>"
        f"<filename>file://media/models/{name}</filename><interpolate_x>{along}</interpolate_x></animation>"
        f"<script><loop>false</loop><trajectory id='0' type='a'>{waypoints}</trajectory></script></actor></world></sdf>"
    )


@pytest.mark.parametrize("name", PEOPLE)
def test_a_person_stands_on_its_feet_and_keeps_them_all_the_time(name):
    world = World.load(walker(name), finder=FINDER)
    assert not world.problems, [str(problem) for problem in world.problems]
    actor = world.actors["p"]
    length = actor.script.length
    for part in np.linspace(0.0, 1.0, 40):
        actor._play(int(part * length * 1e9), 0.0)
        low, high = _extent(world.models["p"])
        assert -0.03 < low < (0.16 if name == "run.dae" else 0.03), (part, low)
        assert (1.25 if "sit" in name or "stand_up" in name else 1.6) < high < 1.85
    assert world.models["p"].pose.p[0] == pytest.approx(UP_TO.get(name, world.models["p"].pose.p[0]), abs=0.01)


def _heights(link):
    """Of each corner of the skin that hangs on this link."""
    corners = load_mesh(link.collisions[f"{link.name}_skin"].description.geometry).vertices
    return corners @ np.array(math3.quat_to_matrix(link.pose.q))[2] + link.pose.p[2]


def _extent(model):
    heights = np.concatenate([_heights(link) for link in model.links.values() if f"{link.name}_skin" in link.collisions])
    return heights.min(), heights.max()


#: In the axes of a foot's bone, which lies along its y and points down to the toes: where the sole points.
TOES = (0.0, 0.96, -0.28)


def test_the_feet_of_who_walks_hardly_slide():
    """With <interpolate_x> and a straight way: while the sole of a foot is on the ground its ankle stays where it is."""
    way = "<waypoint><time>0</time><pose>0 0 0 0 0 0</pose></waypoint><waypoint><time>4</time><pose>4 0 0 0 0 0</pose></waypoint>"
    world = World.load(walker("walk.dae", way), finder=FINDER)
    on_ground = {"LeftFoot": [], "RightFoot": []}
    for _ in range(110):
        world.step(34)
        for foot, found in on_ground.items():
            link = world.models["p"].links[foot]
            low = _heights(link).min()
            flat = abs(math3.rotate(link.pose, TOES)[2]) < 0.02
            found.append(link.pose.p[0] if flat and low < 0.01 else None)
    slides = [abs(b - a) for found in on_ground.values() for a, b in zip(found, found[1:]) if a is not None and b is not None]
    assert len(slides) > 30 and max(slides) < 0.012


def test_who_is_played_by_a_plugin_stands_where_it_was_put_until_then():
    text = walker("walk.dae").replace("<skin>", "<pose>3 4 1.02 0 0 0</pose><plugin name='x' filename='libx.so'/><skin>")
    model = World.load(text, finder=FINDER).models["p"]
    low, high = _extent(model)
    assert model.pose.p == (3.0, 4.0, 1.02) and abs(low) < 0.05 and high > 1.6


def test_bones_lie_along_their_y_as_those_of_gazebos_files():
    """So a skin of those files is bent by our animations, and the other way round."""
    links = World.load(walker("walk.dae"), finder=FINDER).models["p"].links
    for bone, child in (
        ("LeftUpLeg", "LeftLeg"),
        ("RightLeg", "RightFoot"),
        ("LeftArm", "LeftForeArm"),
        ("RightForeArm", "RightHand"),
        ("Spine", "Spine1"),
    ):
        along = np.subtract(links[child].pose.p, links[bone].pose.p)
        y_axis = math3.rotate(links[bone].pose, (0.0, 1.0, 0.0))
        assert np.dot(along, y_axis) / np.linalg.norm(along) > 0.99, bone

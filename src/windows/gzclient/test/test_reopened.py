"""Buildings that are known as a model only, opened for editing. No window."""

import os

import numpy as np
import pytest
import rospkg
from building_editor import sdf_model
from gzclient.building import files
from gzclient.building.plan import Plan
from gzclient.building.reopened import plan_of
from ode_sim.description import load_world, read_sdf_model
from ode_sim_viewer import Refused

LINK = """<link name='{name}'><pose frame=''>{pose}</pose>{shapes}</link>"""
SHAPE = """<collision name='{name}_Collision{end}'><geometry><box><size>{size}</size></box></geometry>
<pose frame=''>{at} 0 -0 0</pose></collision>
<visual name='{name}_Visual{end}'><pose frame=''>{at} 0 -0 0</pose><geometry><box><size>{size}</size></box></geometry>
<material><script><uri>file://media/materials/scripts/gazebo.material</uri><name>{material}</name></script>
<ambient>{ambient} 1</ambient></material>
<meta><layer>0</layer></meta></visual>"""
OTHER = """<link name='Roof'><visual name='v'><geometry><sphere><radius>1</radius></sphere></geometry></visual></link>
<link name='Wall_9'><collision name='c'><geometry><cylinder><radius>1</radius><length>1</length></cylinder></geometry></collision></link>
<link name='Wall_8'><pose>0 0 0 0.3 0 0</pose><collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision></link>"""
# the pieces that Gazebo's editor leaves of a wall of 6.15 m with a door of 1 x 2.1 m and a window of 0.8 x 0.7 m, sill 0.9 m
PIECES = (
    ("-1.95 0 1.25", "2.25 0.15 2.5"),
    ("-0.325 0 2.3", "1 0.15 0.4"),
    ("0.5 0 1.25", "0.65 0.15 2.5"),
    ("1.225 0 0.45", "0.8 0.15 0.9"),
    ("1.225 0 2.05", "0.8 0.15 0.9"),
    ("2.35 0 1.25", "1.45 0.15 2.5"),
)


def link(name, pose, *boxes, material="Gazebo/CeilingTiled", ambient="1 1 1"):
    shapes = "\n".join(
        SHAPE.format(name=name, end=f"_{number}" if len(boxes) > 1 else "", at=at, size=size, material=material, ambient=ambient)
        for number, (at, size) in enumerate(boxes)
    )
    return LINK.format(name=name, pose=pose, shapes=shapes)


def model(*links, pose="0 0 0 0 -0 0"):
    return f"<sdf version='1.6'><model name='house'><pose frame=''>{pose}</pose>{''.join(links)}<static>1</static></model></sdf>"


def plan(*links, **settings):
    document, left = plan_of(read_sdf_model(model(*links, **settings))[0])
    return Plan(document), left


@pytest.fixture
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    folder = tmp_path / "building_editor_models" / "house"
    folder.mkdir(parents=True)
    return folder


def test_the_room_of_a_course_as_its_world_has_it():
    world, _ = load_world(os.path.join(rospkg.RosPack().get_path("mbot_gazebo"), "worlds", "room.world"))
    document, left = plan_of(next(model for model in world.models if model.name == "room"))
    (level,) = Plan(document).building().levels
    assert len(level.walls) == 8 and not left
    np.testing.assert_allclose([wall.start for wall in level.walls[:3]], [(-3.17, -4.17), (5.18, -4.17), (5.18, 0.68)], atol=1e-4)
    assert [wall.end for wall in level.walls] == [wall.start for wall in (*level.walls[1:], level.walls[0])]  # joined again
    assert {wall.look.material for wall in level.walls} == {"Gazebo/CeilingTiled"}


def test_doors_and_windows_are_what_the_boxes_leave_open():
    made, left = plan(link("Wall_0", "4 1 0 0 0 1.5708", *PIECES), pose="1 0 0 0 -0 0")
    (wall,) = made.building().levels[0].walls
    assert not left and wall.start == (5.0, -2.0) and wall.end == (5.0, 4.0) and (wall.thickness, wall.height) == (0.15, 2.5)
    door, window = wall.openings
    assert (door.kind, window.kind) == ("door", "window")
    np.testing.assert_allclose((door.at, door.width, door.height, door.sill), (2.675, 1.0, 2.1, 0.0), atol=1e-5)
    np.testing.assert_allclose((window.at, window.width, window.height, window.sill), (4.225, 0.8, 0.7, 0.9), atol=1e-5)


def test_a_colour_is_kept_and_a_material_of_its_own():
    made, _ = plan(
        link("Wall_0", "0 0 0 0 0 0", ("0 0 1", "4 0.2 2"), material="Gazebo/Grey", ambient="0 0.667 0"),
        link("Wall_1", "0 5 0 0 0 0", ("0 0 1", "4 0.2 2"), material="Gazebo/Bricks"),
    )
    assert [wall.look.color for wall in made.building().levels[0].walls] == [(0.0, 0.667, 0.0), None]
    assert made.building().levels[0].walls[1].look.material == "Gazebo/Bricks"


def test_levels_stairs_and_floors_come_back():
    first = Plan()
    for start, end in (((0.0, 0.0), (6.0, 0.0)), ((6.0, 0.0), (6.0, 4.0)), ((6.0, 4.0), (0.0, 4.0)), ((0.0, 4.0), (0.0, 0.0))):
        first.add_wall(start, end, thickness=0.2, height=2.6, material="Gazebo/Bricks")
    first.add_opening("windows", 1, (6.0, 2.0), width=1.0, height=1.0, sill=0.75)
    first.add_stairs((1.0, 1.0), 1.5707963, width=1.25, depth=2.5, height=2.6, steps=10, color=(1.0, 0.0, 0.0))
    first.add_level()
    first.add_opening("doors", 0, (2.0, 0.0), width=0.75, height=2.0)
    document, left = plan_of(read_sdf_model(sdf_model.model_text(first.building()))[0])
    now, before = Plan(document).building(), first.building()
    assert not left and [level.base for level in now.levels] == [level.base for level in before.levels] == [0.0, 2.6]
    for level, other in zip(now.levels, before.levels):
        for name in ("start", "end", "thickness", "height", "look"):
            assert [getattr(wall, name) for wall in level.walls] == [getattr(wall, name) for wall in other.walls]
        holes = [
            [(o.kind, round(o.at, 4), round(o.width, 4), o.height, o.sill) for wall in part.walls for o in wall.openings]
            for part in (level, other)
        ]
        assert holes[0] == holes[1]
        assert level.floor == other.floor
    (stairs,) = now.levels[0].stairs
    assert (stairs.at, stairs.width, stairs.depth, stairs.height, stairs.steps) == ((1.0, 1.0), 1.25, 2.5, 2.6, 10)
    assert stairs.yaw == pytest.approx(1.5708, abs=1e-4) and stairs.look.color == (1.0, 0.0, 0.0)


def test_what_is_not_understood_is_named():
    made, left = plan(link("Wall_0", "0 0 0 0 0 0", ("0 0 1", "4 0.2 2")), OTHER)
    assert len(made.building().levels[0].walls) == 1
    assert left == ["Roof (no wall, stairs or floor)", "Wall_9 (not of boxes)", "Wall_8 (it leans)"]


def test_a_folder_without_a_plan_is_listed_and_opened(home):
    (home / "model.sdf").write_text(model(link("Wall_0", "0 0 0 0 0 0", ("0 0 1", "4 0.2 2")), OTHER))
    assert files.names() == ["house"]
    document, left = files.load("house")
    assert document["name"] == "house" and len(left) == 3
    files.save(document)
    assert files.load("house")[1] == [] and (home / "plan.yaml").exists()


@pytest.mark.parametrize(
    "text, why",
    [("", "no element|empty|XML"), (model(OTHER), "Wall_0"), ("<sdf version='1.6'/>", "model"), (b"\xff\xfe\x00", "utf|XML|decode")],
)
def test_what_is_no_building_is_refused_in_one_line(home, text, why):
    (home / "model.sdf").write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(Refused, match=why) as told:
        files.load("house")
    assert "\n" not in str(told.value)

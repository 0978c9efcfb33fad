"""What a hand draws with the building editor: snapping, changes and back, files that are opened again. No window."""

import math
import os

import pytest
from building_editor.building import building_of, read_plan
from gzclient.building import files
from gzclient.building.plan import Element, Plan, snapped
from ode_sim import World
from ode_sim_viewer import Refused

ROOM = ((0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0), (0.0, 0.0))


def room():
    plan = Plan()
    for start, end in zip(ROOM, ROOM[1:]):
        plan.add_wall(start, end)
    return plan


def test_snap():
    assert snapped(1.13, 0.25) == 1.25 and snapped(-0.1, 0.25) == 0.0 and snapped(1.23456, 0.0) == 1.2346
    plan = Plan()
    assert plan.snap_point((1.1, -0.9)) == (1.0, -1.0)
    assert plan.snap_end((0.0, 0.0), (3.1, 0.2)) == (3.0, 0.0)  # 15 degrees
    x, y = plan.snap_end((0.0, 0.0), (2.0, 1.9))
    assert math.degrees(math.atan2(y, x)) == pytest.approx(45.0) and math.hypot(x, y) == pytest.approx(2.75)
    plan.add_wall((0.0, 0.0), (1.3, 0.0))  # off the grid: typed, or read from a file
    assert plan.snap_end((1.3, 2.0), (1.4, 0.1)) == (1.3, 0.0)  # an end nearby wins over grid and angle
    plan.snap = plan.snap_angle = 0.0
    assert plan.snap_end((9.0, 9.0), (9.111, 9.333)) == (9.111, 9.333)


def test_walls_doors_windows_stairs_and_back():
    plan = room()
    door = plan.add_opening("doors", 0, (2.1, 0.05), width=0.9, height=2.0)
    plan.add_opening("windows", 1, (4.0, 2.95), width=0.8, height=0.8, sill=0.5)
    plan.add_stairs((1.1, 1.4), math.radians(80.0), width=1.0, depth=2.0, height=2.5, steps=10)
    (level,) = plan.building().levels
    assert [(o.kind, o.at) for wall in level.walls for o in wall.openings] == [("door", 2.0), ("window", 2.6)]
    assert level.stairs[0].at == (1.0, 1.5) and math.degrees(level.stairs[0].yaw) == pytest.approx(75.0)
    plan.move(door, "", (2.0, 0.0), (99.0, 0.0))
    assert plan.building().levels[0].walls[0].openings[0].at == pytest.approx(4.0 - 0.45)  # it stays in its wall
    plan.delete(door)
    assert not plan.building().levels[0].walls[0].openings
    for _ in range(3):
        plan.undo()
    assert plan.building().levels[0].walls[0].openings[0].at == 2.0 and not plan.building().levels[0].stairs
    plan.redo()
    assert plan.building().levels[0].stairs
    with pytest.raises(Refused, match="nothing to do again"):
        for _ in range(9):
            plan.redo()


def test_a_corner_takes_both_walls_along():
    plan = room()
    assert plan.grip(0, (3.9, 0.1)) == "to" and plan.grip(0, (2.0, 0.0)) == ""
    plan.move(Element(0, "walls", 0), "to", (4.0, 0.0), (5.1, -0.4))
    walls = plan.building().levels[0].walls
    assert walls[0].end == walls[1].start == (5.0, -0.5)
    plan.move(Element(0, "walls", 2), "", (2.0, 3.0), (2.0, 4.1))
    assert plan.building().levels[0].walls[2].start == (4.0, 4.0)


def test_levels_stand_on_each_other():
    plan = room()
    plan.change(Element(0, "walls", 0), height=3.0)
    plan.add_level()
    assert (plan.level, plan.levels, plan.base(1)) == (1, 2, 3.0)
    plan.add_wall((0.0, 1.5), (4.0, 1.5))
    assert [len(level.walls) for level in plan.building().levels] == [4, 5] and plan.building().levels[1].base == 3.0
    plan.remove_level()
    assert (plan.level, plan.levels) == (0, 1)
    with pytest.raises(Refused, match="stays"):
        plan.remove_level()


def test_what_cannot_be_built_is_taken_back():
    plan = room()
    before = plan.building()
    for wrong in (
        lambda: plan.add_wall((1.0, 1.0), (1.0, 1.0)),
        lambda: plan.add_opening("doors", 0, (1.0, 0.0), width=0.9, height=9.0),
        lambda: plan.add_opening("doors", 0, (1.0, 0.0), width=5.0, height=2.0),
        lambda: plan.change(Element(0, "walls", 0), thickness=-1.0),
        lambda: plan.delete(Element(0, "walls", 17)),
    ):
        with pytest.raises(Refused):
            wrong()
        assert plan.building() == before


def test_a_colour_takes_the_place_of_a_material():
    plan = room()
    plan.change(Element(0, "walls", 0), material="Gazebo/Bricks")
    plan.change(Element(0, "walls", 0), color=(1.0, 0.5, 0.0), material=None)
    assert plan.building().levels[0].walls[0].look.color == (1.0, 0.5, 0.0)


def test_saved_and_opened_again(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    assert files.names() == []
    plan = room()
    plan.document["name"] = "my room"
    plan.add_opening("doors", 0, (2.0, 0.0), width=0.9, height=2.0)
    plan.add_level()
    target = files.save(plan.document)
    assert target == str(tmp_path / "building_editor_models" / "my room") and files.names() == ["my room"]
    again = Plan(files.load("my room")[0])
    assert again.building() == plan.building() == read_plan(os.path.join(target, "plan.yaml"))
    world = World.load(os.path.join(target, "my room.world"))
    assert "my room" in world.models and len(world.models["my room"].links) == 9  # 2 x 4 walls, a floor


def test_a_plan_of_paths_is_opened_wall_by_wall():
    document = {
        "name": "p",
        "wall": {"height": 2.2},
        "walls": [{"path": [list(point) for point in ROOM], "doors": [{"at": 5.5}], "color": [0.1, 0.2, 0.3]}],
    }
    plan = Plan(document)
    assert plan.building() == building_of(document) and len(plan.document["walls"]) == 4
    plan.delete(Element(0, "doors", 0, 1))
    assert not any(wall.openings for wall in plan.building().levels[0].walls)


@pytest.mark.parametrize("name", ["", "..", "../evil", "a/b", "/etc", ".hidden", "a\0b", "x" * 100, "<b>"])
def test_a_name_stays_in_its_folder(name, tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    plan = room()
    plan.document["name"] = name
    for use in (lambda: files.save(plan.document), lambda: files.load(name)):
        with pytest.raises(Refused):
            use()
    assert os.listdir(tmp_path) == []


def test_nothing_drawn_is_not_saved(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    assert Plan().building() is None
    with pytest.raises(Refused, match="none"):
        files.save(Plan().document)

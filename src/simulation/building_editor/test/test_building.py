"""build_world: plans and pictures to SDF, read back by the simulator's own reader."""

import json
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from building_editor import build_world, building, preview, sdf_model
from ode_sim.description import ResourceFinder, load_world, read_sdf_model
from PIL import Image

FINDER = ResourceFinder(environment=False, stock="/nowhere")


def build(plan):
    made = building.building_of(plan)
    model, problems = read_sdf_model(sdf_model.model_text(made), finder=FINDER)
    assert not problems
    return model


def solid_at(model, x, y, z):
    """Whether the point of the world lies in a box of the model."""
    from ode_sim import math3

    for link in model.links:
        for collision in link.collisions:
            pose = math3.compose(math3.compose(model.pose, link.pose), collision.pose)
            p = math3.transform(math3.inverse(pose), (x, y, z))
            if all(abs(a) <= 0.5 * size + 1e-9 for a, size in zip(p, collision.geometry.size)):
                return True
    return False


def test_one_wall_as_the_editor_writes_it():
    model = build({"name": "m", "walls": [{"from": [0, 0], "to": [0, 4]}]})
    (link,) = model.links
    assert (model.name, model.static, link.name) == ("m", True, "Wall_0")
    assert [c.name for c in link.collisions] == ["Wall_0_Collision"]
    assert [v.name for v in link.visuals] == ["Wall_0_Visual"]
    assert link.collisions[0].geometry.size == pytest.approx((4.15, 0.15, 2.5))
    assert model.pose.p == (0.0, 2.0, 0.0) and link.collisions[0].pose.p == (0.0, 0.0, 1.25)
    assert solid_at(model, 0.0, 0.0, 0.1) and solid_at(model, 0.07, 3.9, 2.4) and not solid_at(model, 0.1, 2.0, 1.0)


def test_corners_close():
    model = build({"walls": [{"path": [[0, 0], [3, 0], [3, 2]]}]})
    assert solid_at(model, 3.07, -0.07, 1.0)


def test_a_wall_that_ends_in_another_does_not_reach_through():
    made = building.building_of({"walls": [{"from": [0, 0], "to": [6, 0]}, {"from": [3, 0], "to": [3, 2]}]})
    assert made.levels[0].walls[1].reach == (0.0, 0.075)
    assert made.levels[0].walls[0].reach == (0.075, 0.075)


def test_doors_and_windows_are_holes_and_nothing_else_is():
    model = build({"walls": [{"from": [0, 0], "to": [6, 0], "doors": [{"at": 1.5}], "windows": [{"at": 4.0}]}]})
    assert len(model.links[0].collisions) == 6
    assert model.links[0].collisions[0].name == "Wall_0_Collision_0"
    holes = {(1.5, 1.0), (1.06, 0.01), (1.94, 1.99), (4.0, 0.9), (3.61, 0.51), (4.39, 1.29)}
    walls = {(1.5, 2.01), (1.04, 1.0), (1.96, 1.0), (4.0, 0.49), (4.0, 1.31), (3.59, 0.9), (4.41, 0.9), (0.0, 0.0), (6.0, 2.4)}
    assert [p for p in holes if solid_at(model, p[0], 0.0, p[1])] == []
    assert [p for p in walls if not solid_at(model, p[0], 0.0, p[1])] == []
    volume = sum(np.prod(c.geometry.size) for c in model.links[0].collisions)
    assert volume == pytest.approx(0.15 * (6.15 * 2.5 - 0.9 * 2.0 - 0.8 * 0.8))  # no box twice, none missing


def test_openings_that_overlap_are_one_hole():
    model = build({"walls": [{"from": [0, 0], "to": [6, 0], "windows": [{"at": 2}, {"at": 2.4, "height": 1.2}]}]})
    volume = sum(np.prod(c.geometry.size) for c in model.links[0].collisions)
    assert volume == pytest.approx(0.15 * (6.15 * 2.5 - (0.4 * 0.8 + 0.8 * 1.2)))


def test_openings_on_a_path_are_measured_along_it():
    model = build({"walls": [{"path": [[0, 0], [3, 0], [3, 4]], "doors": [{"at": 5}]}]})
    assert not solid_at(model, 3.0, 2.0, 1.0) and solid_at(model, 3.0, 1.0, 1.0) and solid_at(model, 2.0, 0.0, 1.0)


def test_stairs_and_the_floor_above():
    model = build(
        {
            "walls": [{"path": [[0, 0], [6, 0], [6, 4], [0, 4], [0, 0]]}],
            "stairs": [{"at": [1, 2]}],
            "levels": [{"walls": [{"from": [0, 0], "to": [6, 0], "doors": [{"at": 3}]}], "height": 3}],
        }
    )
    assert [link.name for link in model.links] == ["Wall_0", "Wall_1", "Wall_2", "Wall_3", "Stairs_0", "Wall_4", "Floor_1"]
    stairs = model.links[4]
    assert len(stairs.collisions) == 15 and stairs.collisions[14].geometry.size[2] == pytest.approx(2.5)
    assert solid_at(model, 1.1, 2.0, 0.1) and not solid_at(model, 1.1, 2.0, 0.3) and solid_at(model, 4.4, 2.0, 2.4)
    assert solid_at(model, 5.5, 1.0, 2.45) and not solid_at(model, 2.0, 2.0, 2.45)  # a floor, open above the stairs
    assert solid_at(model, 1.0, 0.0, 3.0) and not solid_at(model, 3.0, 0.0, 3.0)  # the wall above and its door


def test_looks():
    model = build(
        {
            "wall": {"material": "Gazebo/Bricks"},
            "walls": [{"from": [0, 0], "to": [1, 0]}, {"from": [0, 1], "to": [1, 1], "color": [1, 0, 0.5]}],
        }
    )
    bricks, plain = (link.visuals[0].material for link in model.links)
    assert bricks.name == "Gazebo/Bricks" and plain.diffuse == (1.0, 0.0, 0.5, 1.0)


@pytest.mark.parametrize(
    "plan, message",
    [
        ({"walls": [{"from": [0, 0]}]}, r"walls\[0\]: 'to' is missing"),
        ({"walls": [{"from": [0, 0], "to": [0, 0]}]}, r"walls\[0\]: a wall needs two different ends"),
        ({"walls": [{"from": [0, 0], "to": [0, "a"]}]}, r"walls\[0\].to: .* is not 2 numbers"),
        (
            {"walls": [{"from": [0, 0], "to": [4, 0]}, {"from": [0, 1], "to": [4, 1], "doors": [{"at": 9}]}]},
            r"walls\[1\].doors\[0\]: 9 m is beyond the wall, which is 4 m long",
        ),
        ({"walls": [{"from": [0, 0], "to": [4, 0], "doors": [{"at": 3.9}]}]}, r"doors\[0\]: 0.9 m wide .* does not fit"),
        ({"walls": [{"from": [0, 0], "to": [4, 0], "windows": [{"at": 2, "height": 2.2}]}]}, r"windows\[0\]: reaches .* 2.5 m"),
        ({"walls": [{"from": [0, 0], "to": [4, 0], "heigth": 2}]}, r"walls\[0\]: there is no 'heigth' here; known are .*height"),
        ({"walls": [{"from": [0, 0], "to": [4, 0], "height": -2}]}, r"walls\[0\].height: -2 must be positive"),
        ({"walls": [{"from": [0, 0], "to": [4, 0], "color": [255, 0, 0]}]}, r"color: .* from 0 to 1"),
        ({"walls": []}, "walls: there are none"),
        ({"walls": "x"}, "walls: must be a list"),
        ("words", "plan: must be a mapping"),
        ({"walls": [7]}, r"walls\[0\]: must be a mapping"),
        ({"walls": [{"from": [0, 0], "to": [4, 0]}], "models": [{"at": [0, 0]}]}, r"models\[0\]: 'model' is missing"),
        ({"walls": [{"from": [0, 0], "to": [4, 0]}], "stairs": [{"at": [0, 0], "steps": 2.5}]}, r"stairs\[0\].steps"),
        ({"image": "gone.png", "resolution": 0.1}, "gone.png: No such file"),
        ({"image": "gone.png"}, "'resolution' is missing"),
    ],
)
def test_a_wrong_entry_is_named(plan, message):
    with pytest.raises(building.PlanError, match=message) as caught:
        building.building_of(plan, "/nowhere")
    assert "\n" not in str(caught.value)


@pytest.fixture
def picture(tmp_path):
    """A room of 3 m by 2 m at 5 cm a pixel, walls of 10 cm, with a gap of 1 m in the lower wall."""
    pixels = np.full((40, 60), 255, np.uint8)
    pixels[:2], pixels[-2:], pixels[:, :2], pixels[:, -2:] = 0, 0, 0, 0
    pixels[-2:, 20:40] = 255
    file = tmp_path / "room.png"
    Image.fromarray(pixels).save(file)
    return file


def test_walls_of_a_picture(picture):
    made = building.read_plan(str(picture), resolution=0.05)
    model, _ = read_sdf_model(sdf_model.model_text(made), finder=FINDER)
    assert made.name == "room" and len(made.levels[0].walls) == 5
    assert solid_at(model, 0.05, 1.0, 1.0) and solid_at(model, 0.02, 0.02, 1.0) and solid_at(model, 0.9, 0.05, 1.0)
    assert not solid_at(model, 1.5, 0.05, 1.0) and not solid_at(model, 1.5, 1.0, 1.0) and solid_at(model, 1.5, 1.95, 2.4)
    covered = sum(np.prod(c.geometry.size[:2]) for link in model.links for c in link.collisions)
    assert covered == pytest.approx(2 * 3 * 0.1 + 2 * 1.8 * 0.1 - 1.0 * 0.1)


def test_a_map_of_map_server(picture):
    (picture.parent / "map.yaml").write_text(
        "image: room.png\nresolution: 0.05\norigin: [-1.0, -1.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n"
    )
    made = building.read_plan(str(picture.parent / "map.yaml"))
    model, _ = read_sdf_model(sdf_model.model_text(made), finder=FINDER)
    assert solid_at(model, -0.95, 0.0, 1.0) and not solid_at(model, 0.5, -0.95, 1.0)


def test_a_blank_picture_and_a_text_are_refused(tmp_path):
    Image.new("L", (10, 10), 255).save(tmp_path / "blank.png")
    with pytest.raises(building.PlanError, match="dark enough"):
        building.read_plan(str(tmp_path / "blank.png"), 0.1)
    (tmp_path / "text.png").write_text("no picture")
    with pytest.raises(building.PlanError, match="no image that can be read"):
        building.read_plan(str(tmp_path / "text.png"), 0.1)


PLAN = """
name: flat
walls:
  - {from: [0, 0], to: [4, 0], doors: [{at: 2}], color: [0.2, 0.2, 0.2]}
models: [{model: table, at: [1, 2], yaw: 0.5}, {model: table, at: [3, 2]}]
"""


def test_command_writes_a_world_and_a_preview(tmp_path, capsys):
    plan, world, png = tmp_path / "plan.yaml", tmp_path / "out.world", tmp_path / "out.png"
    plan.write_text(PLAN)
    assert build_world.main([str(plan), "-o", str(world), "--preview", str(png)]) == 0
    assert capsys.readouterr().out == f"{world}: flat, 1 wall on 1 level\n"
    uris = [(e.findtext("uri"), e.findtext("name")) for e in ET.parse(world).iter("include")]
    assert uris == [("model://sun", None), ("model://ground_plane", None), ("model://table", "table"), ("model://table", "table_1")]
    loaded, problems = load_world(str(world), FINDER)
    assert [model.name for model in loaded.models] == ["flat"] and len(problems) == 3  # no stock models in this test
    with Image.open(png) as image:
        colours = {colour for _, colour in image.getcolors(1 << 24)}
    assert {preview._WALL, preview._DOOR, preview._MODEL} <= colours


@pytest.mark.parametrize("name", ["房间", "Комната", "café", "غرفة", "🏠"])
@pytest.mark.parametrize("place", ["plan", "model"])
def test_names_in_any_script_are_drawn(tmp_path, capsys, name, place):
    plan, png = tmp_path / "plan.yaml", tmp_path / "out.png"
    names = {"plan": "flat", "model": "table", place: name}
    plan.write_text(
        f"name: {json.dumps(names['plan'], ensure_ascii=False)}\nwalls:\n- {{from: [0, 0], to: [3, 0]}}\n"
        f"models: [{{model: {json.dumps(names['model'], ensure_ascii=False)}, at: [1, 2]}}]\n"
    )
    assert build_world.main([str(plan), "-o", str(tmp_path / "room.world"), "--preview", str(png)]) == 0, capsys.readouterr().err
    point = preview.draw(
        building.building_of(
            {
                "walls": [{"from": [0, 0], "to": [3, 0]}],
                "name": "." if place == "plan" else "flat",
                "models": [{"model": "." if place == "model" else "table", "at": [1, 2]}],
            }
        )
    )
    with Image.open(png) as image:
        assert (np.asarray(image) != np.asarray(point)).any(axis=2).sum() > 5, "there is something to read"


def test_without_a_font_for_it_a_name_is_question_marks(tmp_path, monkeypatch):
    monkeypatch.setattr(preview, "_FONTS", ())
    plans = [building.building_of({"name": name, "walls": [ROOM]}) for name in ("房间", "??")]
    assert preview.draw(plans[0]).tobytes() == preview.draw(plans[1]).tobytes()


def test_command_writes_a_model_directory(tmp_path):
    (tmp_path / "plan.yaml").write_text(PLAN)
    assert build_world.main([str(tmp_path / "plan.yaml"), "-o", str(tmp_path / "models/flat") + "/"]) == 0
    finder = ResourceFinder([tmp_path / "models"], environment=False, stock="/nowhere")
    loaded, problems = load_world("<sdf version='1.6'><world name='w'><include><uri>model://flat</uri></include></world></sdf>", finder)
    assert loaded.models[0].links[0].name == "Wall_0" and not problems


@pytest.mark.parametrize(
    "text, message", [("walls: [", ":2: is no YAML|:1: is no YAML"), ("walls: [{from: [0, 0], to: [1]}]", r"plan.yaml: walls\[0\].to")]
)
def test_command_names_file_and_entry(tmp_path, capsys, text, message):
    import re

    (tmp_path / "plan.yaml").write_text(text)
    assert build_world.main([str(tmp_path / "plan.yaml"), "-o", str(tmp_path / "a.world")]) == 1
    error = capsys.readouterr().err
    assert re.search(message, error) and error.count("\n") == 1 and not (tmp_path / "a.world").exists()


def test_command_refuses_an_unknown_ending(tmp_path, capsys):
    (tmp_path / "plan.yaml").write_text(PLAN)
    assert build_world.main([str(tmp_path / "plan.yaml"), "-o", str(tmp_path / "a.txt")]) == 1
    assert ".world or .sdf" in capsys.readouterr().err


# ---------------------------------------------------------------------------------------------- plans that nobody draws

ROOM = {"from": [0, 0], "to": [4, 0]}
LONG = 10**400


@pytest.mark.parametrize(
    "plan, message",
    [
        ({"walls": [{"path": [[LONG, 4.5], [0, 0]]}]}, r"walls\[0\].path\[0\]: \[1e400, 4.5\] is not 2 numbers"),
        ({"walls": [ROOM], "wall": {"thickness": LONG}}, "wall.thickness: 1e400 is not a number"),
        ({"walls": [ROOM], "wall": {"height": 2.5e300}}, "wall.height: 2.5e[+]300 is too much; at most 100000"),
        ({"walls": [{"from": [0, 0], "to": [1e6, 0]}]}, r"walls\[0\].to: .* is too far away; at most 100000 m"),
        ({"walls": [ROOM], "models": [{"model": "a", "at": [0, -1e308]}]}, r"models\[0\].at: .* is too far away"),
        ({"walls": [dict(ROOM, thickness=1e-300)]}, r"walls\[0\].thickness: 1e-300 must be positive, at least 1e-06"),
        ({"walls": [ROOM], "stairs": [{"at": [0, 0], "steps": 10**9}]}, r"stairs\[0\].steps: 1000000000 is too much; at most 1000"),
        ({"walls": [ROOM] * 5001}, "walls: 5001 entries; at most 5000 are built"),
        ({"walls": [{"path": [[i % 2, i] for i in range(4000)]}] * 2}, r"walls\[1\]: more than 5000 pieces of wall on one floor"),
        ({"walls": [ROOM], "levels": [{}] * 201}, "levels: 201 entries; at most 200 are built"),
        ({"walls": [ROOM], "levels": [{"height": 9e4}, {"height": 9e4}, {}]}, r"levels\[2\]: its floor is .* m high"),
        ({"walls": [ROOM], "name": [1]}, r"plan.name: \[1\] is no name"),
        ({"walls": [ROOM], "name": "a\0b"}, "plan.name: 'a b' is no|'a.b' is no"),
        ({"walls": [ROOM], "name": LONG}, "plan.name: 1e400 is no name"),
        ({"walls": [ROOM], "name": "\ud800"}, "is no name"),
        ({"walls": [dict(ROOM, material={"a": 1})]}, r"walls\[0\].material: {'a': 1} is no name"),
        ({"walls": [dict(ROOM, **{"k" * 9999: 1})]}, r"walls\[0\]: there is no 'kkkk"),
        ({"walls": ["w" * 9999]}, r"walls\[0\]: must be a mapping"),
        ({"walls": [ROOM], 7: 7}, "plan: there is no 7 here"),
        ({"image": "x" * 9999, "resolution": 1}, "is no name"),
        ({"image": "x\0y", "resolution": 1}, "is no name"),
        ({"image": "gone.png", "resolution": 1e4}, "plan.resolution: 10000.0 is too much"),
    ],
    ids=range(22),
)
def test_an_absurd_entry_is_named_in_one_short_line(plan, message):
    with pytest.raises(building.PlanError, match=message) as caught:
        building.building_of(plan, "/nowhere")
    assert "\n" not in str(caught.value) and len(str(caught.value)) < 400


def test_a_value_that_holds_itself_many_times_is_shown_short():
    bomb = [1]
    for _ in range(60):
        bomb = [bomb, bomb]
    for plan in ({"walls": bomb}, {"walls": [{"path": bomb}]}, {"walls": [ROOM], "name": bomb}, {"walls": [dict(ROOM, color=bomb)]}):
        with pytest.raises(building.PlanError) as caught:
            building.building_of(plan)
        assert len(str(caught.value)) < 400


MERGES = "a0: &a0 {k: 1}\n" + "".join(f"a{i}: &a{i} {{<<: [*a{i - 1}, *a{i - 1}], k{i}: 1}}\n" for i in range(1, 40))


@pytest.mark.parametrize(
    "text",
    [
        b"[" * 5000,
        b"a: " + b"[" * 100 + b"]" * 100,
        MERGES.encode(),
        b"&a {<<: *a}",
        b"&a [*a]",
        b"walls: &a [*a]",
        b"",
        b"\0",
        b"\xff\xfe\0",
        b"walls: !!python/object/apply:os.system ['true']",
        b"walls: !!timestamp x",
        b"walls: !!int ''",
        b"name: 2024-13-45",
        b"name: " + b"9" * 5000,
        b"? [a]\n: b",
        b"{[]: 1}",
        b"walls: !!binary x",
        b"- " * 3000,
        b"walls: 0x" + b"f" * 5000,
        b"%YAML 9.9\n---\nx",
        b"walls: !!bool x",
        b"!!set {a}",
        b"x" * 1_000_001,
    ],
    ids=range(23),
)
def test_any_text_is_a_plan_or_refused_at_once(tmp_path, text):
    import time

    path = tmp_path / "plan.yaml"
    path.write_bytes(text)
    begin = time.process_time()
    with pytest.raises(building.PlanError) as caught:
        building.read_plan(str(path))
    line = str(caught.value)
    assert line.startswith(str(path)) and "\n" not in line and len(line) < 500 and time.process_time() - begin < 5.0


@pytest.mark.parametrize("content", [b"", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0", b"%!PS-Adobe-3.0 EPSF-3.0\n"])
def test_a_broken_picture_is_refused(tmp_path, content):
    path = tmp_path / "plan.png"
    path.write_bytes(content)
    with pytest.raises(building.PlanError, match="plan.png"):
        building.read_plan(str(path), 0.05)


def test_a_picture_of_noise_is_refused_at_once(tmp_path):
    path = tmp_path / "noise.png"
    Image.fromarray((np.indices((3000, 3000)).sum(axis=0) % 2 * 255).astype(np.uint8)).save(path)
    with pytest.raises(building.PlanError, match="more than 5000 pieces of wall"):
        building.read_plan(str(path), 0.05)


@pytest.mark.parametrize(
    "plan",
    [
        {"walls": [{"from": [-1e5, 0], "to": [1e5, 0]}]},
        {"walls": [{"from": [0, -1e5], "to": [0, 1e5]}]},
        {"walls": [ROOM], "models": [{"model": "a", "at": [0, 1e5]}]},
        {"walls": [ROOM], "levels": [{"walls": [ROOM]}] * 200},
        {"walls": [{"from": [0, 0], "to": [2e-6, 0]}], "wall": {"thickness": 1e-6, "height": 1e-6}},
    ],
)
def test_a_preview_has_a_size_that_can_be_looked_at(plan):
    image = preview.draw(building.building_of(plan))
    assert 1 <= image.width <= 20000 and 1 <= image.height <= 12000


def test_many_walls_are_joined_quickly():
    import time

    begin = time.process_time()
    walls = (
        building.building_of({"walls": [{"from": [i, 0], "to": [i, 1]} for i in range(3000)] + [{"from": [-1, 0.5], "to": [3000, 0.5]}]})
        .levels[0]
        .walls
    )
    assert not walls[-1].butts[0] and not any(walls[5].butts) and time.process_time() - begin < 20.0


def test_command_names_a_preview_that_cannot_be_written(tmp_path, capsys):
    (tmp_path / "plan.yaml").write_text(PLAN)
    for file, message in (("a.xyz", "give it the ending .png or .jpg"), ("a", "give it the ending"), ("none/a.png", "cannot write")):
        arguments = [str(tmp_path / "plan.yaml"), "-o", str(tmp_path / "a.world"), "--preview", str(tmp_path / file)]
        assert build_world.main(arguments) == 1
        error = capsys.readouterr().err
        assert message in error and file in error and error.count("\n") == 1

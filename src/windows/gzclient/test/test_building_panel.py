"""The building editor in a page without a browser: the events that a hand makes, what is drawn, saved, put into the world."""

import io
import os
import types

import numpy as np
import pytest
from ode_sim import World, math3
from ode_sim.description import model as d

pytest.importorskip("viser")

from gzclient.building.plan import Element  # noqa: E402
from gzclient.panels.building import BuildingPanel  # noqa: E402
from ode_sim_viewer import LocalSimulation, Page  # noqa: E402
from PIL import Image  # noqa: E402

# the room of the mobile robot's course: where its walls meet; and of each wall length, middle x and y, yaw
CORNERS = ((-3.17, -4.17), (5.18, -4.17), (5.18, 0.68), (-1.17, 0.68), (-1.17, -1.67), (-6.02, -1.67), (-6.02, -3.52), (-6.02, -4.12))
ROOM = (
    (8.5, 1.005, -4.17, 0.0),
    (5.0, 5.18, -1.745, 90.0),
    (6.5, 2.005, 0.68, 180.0),
    (2.5, -1.17, -0.495, -90.0),
    (5.0, -3.595, -1.67, 180.0),
    (2.0, -6.02, -2.595, -90.0),
    (0.75, -6.02, -3.82, -90.0),
    (3.00044, -4.595, -4.145, -1.00508),
)


class Client:
    def __init__(self):
        self.told, self.client_id = [], 1
        self.camera = types.SimpleNamespace(position=(0.0, 0.0, 20.0), look_at=(0.0, 0.0, 0.0))

    def add_notification(self, title, body, **_):
        self.told.append(body)


@pytest.fixture
def editor(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    page = Page(LocalSimulation(World(d.World()), paused=True), port=0, panels=(BuildingPanel,))
    panel = page.panels[-1]
    panel._switch(True)
    yield page, panel, Client()
    page.close()


def use(handle, client, value=None):
    if value is not None:
        handle._impl.value = value
    for callback in list(handle._impl.update_cb):
        callback(types.SimpleNamespace(client=client, client_id=client.client_id, target=handle))


def turn(page):
    page.turn()
    page._do_jobs()


def click(page, panel, client, x, y, element=None):
    event = types.SimpleNamespace(client=client, client_id=1, ray_origin=(x, y, 20.0), ray_direction=(0.0, 0.0, -1.0))
    page.attempt(event, lambda: panel._click(event, element))


def drag(page, panel, client, start, end, element=None):
    event = types.SimpleNamespace(client=client, client_id=1)
    for phase, point in (("start", start), ("update", end), ("end", end)):
        page.attempt(event, lambda: panel._dragged(event, element, phase, (*start, 0.0), (*point, 0.0)))


def nodes(page):
    return {name for name in page.server.scene._handle_from_node_name if name.startswith(("/plan/", "/plan_"))}


def test_the_room_of_a_course_is_drawn_measured_saved_opened_and_simulated(editor, tmp_path):
    page, panel, client = editor
    use(panel._name, client, "room")
    use(panel._angle, client, 0.0)
    turn(page)
    for x, y in (*CORNERS, CORNERS[0]):
        click(page, panel, client, x + 0.06, y - 0.05)
    assert [wall.start for wall in panel._plan.building().levels[0].walls] != list(CORNERS)
    use(panel._tool, client, "Pick")
    turn(page)
    for number in range(len(CORNERS)):
        click(page, panel, client, 0.0, 0.0, Element(0, "walls", number))
        use(panel._place._to, client, (CORNERS * 2)[number + 1])
        turn(page)
    assert not client.told
    use(panel._save, client)
    use(panel._open, client, "Open")
    turn(page)
    assert [wall.start for wall in panel._plan.building().levels[0].walls] == list(CORNERS)
    world = World.load(str(tmp_path / "building_editor_models" / "room" / "room.world"))
    room = world.models["room"]
    assert list(room.links) == [f"Wall_{number}" for number in range(len(ROOM))] and room.static
    for link, (length, x, y, yaw) in zip(room.links.values(), ROOM):
        np.testing.assert_allclose(link.pose.p[:2], (x, y), atol=1e-6)
        assert (np.degrees(math3.to_rpy(link.pose)[2]) - yaw + 180.0) % 360.0 == pytest.approx(180.0, abs=1e-3)
        assert link.description.collisions[0].geometry.size == pytest.approx((length, 0.15, 2.5), abs=1e-5)
        assert link.description.visuals[0].material.name == "Gazebo/CeilingTiled"


def test_a_number_moves_what_was_there_when_it_was_picked(editor):
    page, panel, client = editor
    for x, y in ((0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (4.0, 3.0)):
        click(page, panel, client, x, y)
    click(page, panel, client, 1.0, 5.0)  # another wall, alone
    click(page, panel, client, 2.0, 5.0)
    use(panel._tool, client, "Pick")
    turn(page)
    click(page, panel, client, 0.0, 0.0, Element(0, "walls", 0))
    for typed in ((1.0, 5.0), (1.5, 0.5)):  # over the end of another wall, and on
        use(panel._place._to, client, typed)
        turn(page)
    assert [(wall.start, wall.end) for wall in panel._plan.building().levels[0].walls] == [
        ((0.0, 0.0), (1.5, 0.5)),
        ((1.5, 0.5), (4.0, 3.0)),
        ((1.0, 5.0), (2.0, 5.0)),
    ]
    use(panel._place._to, client, (0.0, 0.0))
    turn(page)
    assert "two different ends" in panel._note.content
    use(panel._place._length, client, 3.0)
    turn(page)
    assert panel._plan.building().levels[0].walls[0].length == pytest.approx(3.0)
    use(panel._tool, client, "Door")
    turn(page)
    click(page, panel, client, 1.5, 5.0, Element(0, "walls", 2))
    assert not panel._place._from.visible and panel._place._at.visible
    use(panel._place._at, client, 0.487)
    turn(page)
    assert panel._plan.building().levels[0].walls[2].openings[0].at == 0.487
    use(panel._history, client, "Undo")
    use(panel._history, client, "Undo")
    turn(page)
    assert panel._picked is None and not panel._place._folder.visible


def test_clicks_make_a_path_that_a_click_on_its_end_ends(editor):
    page, panel, client = editor
    for x, y in ((0.0, 0.0), (3.1, 0.1), (3.0, 2.1), (3.02, 1.95)):
        click(page, panel, client, x, y)
    assert panel._start is None and "/plan_ghost" not in nodes(page)
    (level,) = panel._plan.building().levels
    assert [wall.end for wall in level.walls] == [(3.0, 0.0), (3.0, 2.0)]
    assert {"/plan/w0_0", "/plan/w0_1", "/plan/sheet"} <= nodes(page)


def test_doors_levels_colours_undo_and_the_end(editor):
    page, panel, client = editor
    drag(page, panel, client, (0.0, 0.0), (4.0, 0.0))
    use(panel._tool, client, "Door")
    turn(page)
    click(page, panel, client, 1.0, 3.0)
    assert "Click on a wall" in client.told.pop()
    click(page, panel, client, 2.0, 0.0, Element(0, "walls", 0))
    assert "/plan/doors0_0_0" in nodes(page) and panel._folder.label == "Picked: door"
    use(panel._door, client, (1.5, 2.1))
    turn(page)
    assert panel._plan.building().levels[0].walls[0].openings[0].width == 1.5
    use(panel._levels, client, "Add level")
    turn(page)
    assert panel._level.value == "1" and "/plan/w1_0" in nodes(page) and "/plan/f1" not in nodes(page)
    use(panel._views, client, "3-D")
    turn(page)
    assert "/plan/f1" in nodes(page)
    use(panel._history, client, "Undo")
    turn(page)
    assert "/plan/w1_0" not in nodes(page) and not client.told
    use(panel._on, client, False)
    turn(page)
    assert not nodes(page)


def test_it_is_put_into_the_world_where_it_was_drawn(editor):
    page, panel, client = editor
    drag(page, panel, client, (2.0, 1.0), (6.0, 1.0))
    use(panel._name, client, "hall")
    use(panel._put, client)
    assert not client.told
    assert page.simulation.call(lambda world: world.models["hall"].links["Wall_0"].pose.p) == (4.0, 1.0, 0.0)


def test_a_floor_plan_lies_under_the_walls_and_is_scaled(editor):
    page, panel, client = editor
    stream = io.BytesIO()
    Image.new("RGB", (400, 300), "white").save(stream, "PNG")
    upload = types.SimpleNamespace(name="plan.png", content=stream.getvalue())
    panel._take_picture(upload)
    turn(page)
    assert panel._drawing._picture.render_width == pytest.approx(8.0)
    drag(page, panel, client, (0.0, 0.0), (4.0, 0.0))
    use(panel._scale, client, 6.0)
    turn(page)
    assert panel._drawing._picture.render_width == pytest.approx(12.0) and panel._plan.building() is None
    for content in (b"", b"no picture", stream.getvalue()[:60]):
        with pytest.raises(ValueError, match="no picture"):
            panel._take_picture(types.SimpleNamespace(name="x", content=content))


def test_names_of_a_page_stay_in_the_folder(editor, tmp_path):
    page, panel, client = editor
    drag(page, panel, client, (0.0, 0.0), (4.0, 0.0))
    use(panel._name, client, "../../evil")
    use(panel._save, client)
    use(panel._saved, client, "../../etc")
    use(panel._open, client, "Open")
    turn(page)
    assert len(client.told) == 2 and os.listdir(tmp_path) == []

"""The page without a browser: who may open it, what is drawn and what clicks do. A world of this process, no ROS."""

import contextlib
import gzip
import http.client
import io
import socket
import threading
import time
from dataclasses import replace

import numpy as np
import pytest
from ode_sim import World, math3
from ode_sim.description import model as d
from ode_sim.description.sdf_writer import model_text
from ode_sim.math3 import Pose
from PIL import Image

viser = pytest.importorskip("viser")

from ode_sim_viewer import (  # noqa: E402
    LocalSimulation,
    Page,
    Refused,
    drawing,  # noqa: E402
)
from ode_sim_viewer.overlays import Overlays, inertia_box  # noqa: E402
from ode_sim_viewer.panels.base import escaped, free_name  # noqa: E402
from ode_sim_viewer.panels.play import clock  # noqa: E402
from ode_sim_viewer.selection import History  # noqa: E402
from ode_sim_viewer.shapes import shape_model  # noqa: E402
from ode_sim_viewer.website import Guard, Website  # noqa: E402
from viewer_page import EVIL, Client, page, panel, position, use, wait  # noqa: E402, F401

# ---------------------------------------------------------------------------------------------- who may open it


def test_guard_of_the_loopback_page():
    guard = Guard()
    assert guard.refuse("/", {"Host": "localhost:1234"}) is None
    assert guard.refuse("/", {"Host": "[::1]:1234", "Origin": "http://[::1]:1234"}) is None
    assert guard.refuse("/", {"Host": "evil.example:1234"})[0] == 403  # a name that was made to lead here
    assert guard.refuse("/", {"Host": "localhost:1234", "Origin": "http://evil.example"})[0] == 403
    assert guard.refuse("/", {})[0] == 403


def test_guard_with_a_token():
    guard = Guard("secret")
    host = {"Host": "robot:1234"}
    assert guard.refuse("/", host)[0] == 403
    assert guard.refuse("/?token=wrong", host)[0] == 403
    status, headers, _ = guard.refuse("/?token=secret", host)
    assert status == 303 and headers["Location"] == "/" and "HttpOnly" in headers["Set-Cookie"]
    cookie = headers["Set-Cookie"].split(";")[0]
    assert guard.refuse("/", {**host, "Cookie": cookie}) is None
    assert guard.refuse("/", {**host, "Cookie": cookie, "Origin": "http://evil.example"})[0] == 403
    assert guard.refuse("/", {**host, "Cookie": cookie.replace("secret", "wrong")})[0] == 403


def test_guard_of_a_page_on_a_machine_of_many_users():
    """On the loopback interface alone, and with a token, as notebooks do: a user of the machine who does not know it stays outside."""
    website = Website(port=0, token=True)
    try:
        assert website._door.getsockname()[0] == "127.0.0.1"
        assert website.address == website.local_address == f"http://localhost:{website.port}/?token={website.guard.token}"
        host = {"Host": f"localhost:{website.port}"}
        assert len(website.guard.token) >= 20 and website.guard.refuse("/", host)[0] == 403
        status, headers, _ = website.guard.refuse(f"/?token={website.guard.token}", host)
        assert status == 303 and website.guard.refuse("/", {**host, "Cookie": headers["Set-Cookie"].split(";")[0]}) is None
        assert website.guard.refuse(f"/?token={website.guard.token}", {"Host": "evil.example"})[0] == 403  # a name made to lead here
        with socket.create_connection(("127.0.0.1", website.port)) as stranger:
            stranger.sendall(b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n")
            assert b" 403 " in stranger.recv(1000).partition(b"\r\n")[0] + b" "
    finally:
        website.close()


def test_the_guard_stands_before_every_request():
    website = Website(port=0, title="The <lab>")
    website.open()
    try:

        def ask(path, **headers):
            connection = http.client.HTTPConnection("127.0.0.1", website.port, timeout=30)
            connection.request("GET", path, headers=headers)
            answer = connection.getresponse()
            return answer.status, answer.read()

        status, text = ask("/")
        assert status == 200 and b"<title>The &lt;lab&gt;</title>" in text
        status, packed = ask("/", **{"Accept-Encoding": "gzip"})
        assert status == 200 and gzip.decompress(packed) == text
        assert ask("/", Host="evil.example")[0] == 403
        upgrade = {
            "Connection": "Upgrade",
            "Upgrade": "websocket",
            "Sec-WebSocket-Version": "13",
            "Sec-WebSocket-Key": "AAAAAAAAAAAAAAAAAAAAAA==",
            "Origin": "http://evil.example",
        }
        assert ask("/", **upgrade)[0] == 403
        for path in ("/../../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/etc/passwd"):
            assert ask(path)[0] == 404
        handlers = website.viser._websock_server._incoming_handlers
        assert not [kind for kind in handlers if kind.__name__.startswith("ShareUrl")]  # no tunnel into the internet
    finally:
        website.close()


@pytest.mark.slow
def test_the_page_is_given_to_whoever_knocks_first_and_what_comes_next_waits_for_the_server():
    website = Website(port=0, title="The <lab>")

    def ask(**headers):
        connection = http.client.HTTPConnection("127.0.0.1", website.port, timeout=30)
        connection.request("GET", "/", headers=headers)
        return connection

    try:
        assert not website.knocked(0.0) and website.viser is None
        with socket.create_connection(("127.0.0.1", website.port)):  # says nothing: holds nobody up
            assert ask(Host="evil.example").getresponse().status == 403
            assert ask(Upgrade="websocket").getresponse().status == 503  # a page that lost its server asks again
            assert website.knocked(5.0) and website.viser is None
            page = ask().getresponse()
            assert page.status == 200 and b"<title>The &lt;lab&gt;</title>" in page.read()
        waiting = ask()
        website.open()
        assert waiting.getresponse().status == 200
        second = Website(port=website.port)  # taken: the next one
        assert second.port > website.port
        second.close()
    finally:
        website.close()


def test_what_is_no_request_ends_nothing():
    website = Website(port=0)
    try:
        for bad in (b"\r\n\r\n", b"GET\r\n\r\n", b"\xff" * 70000, b"GET / HTTP/1.1\r\nHost"):
            with socket.create_connection(("127.0.0.1", website.port), timeout=30) as connection:
                with contextlib.suppress(OSError):
                    connection.sendall(bad)
                    connection.shutdown(socket.SHUT_WR)
                    assert connection.recv(100)[:12] in (b"", b"HTTP/1.1 403")
        connection = http.client.HTTPConnection("127.0.0.1", website.port, timeout=30)
        connection.request("GET", "/")
        assert connection.getresponse().status == 200
    finally:
        website.close()


# ---------------------------------------------------------------------------------------------- what is drawn


def test_models_are_drawn_and_follow(page):
    drawn = page.drawing.model_root("box")
    assert len(drawn.meshes) == 1 and len(drawn.links) == 1
    page.simulation.set_pose("box", Pose((1.0, 2.0, 3.0), math3.quat_from_rpy(0.0, 0.0, 1.0)))
    node = next(iter(drawn.links.values()))
    wait(page, lambda: np.allclose(node.position, (1.0, 2.0, 3.0), atol=1e-5))
    assert np.allclose(node.wxyz, (np.cos(0.5), 0.0, 0.0, np.sin(0.5)), atol=1e-5)


def test_the_colour_behind_all_is_the_scenes_or_its_skys(page, monkeypatch):
    seen = []
    monkeypatch.setattr(drawing, "fading_png", lambda *colours: seen.append(colours) or b"")
    for scene in (d.Scene(background=(1.0, 0.0, 0.0, 1.0)), d.Scene(sky=True), d.Scene()):
        page.drawing.update(replace(page.world, scene=scene))
    assert seen[0] == ((255, 0, 0), (255, 0, 0))
    for (red, _, blue), horizon in seen[1:]:
        assert blue > red and min(horizon) > red  # a sky is blue, and lighter at the horizon


def test_the_picture_behind_all_fades_from_above_to_the_horizon():
    image = np.asarray(Image.open(io.BytesIO(drawing.fading_png((0, 50, 100), (200, 200, 200))))).astype(int)[:, 0]
    assert tuple(image[0]) == (0, 50, 100) and (image[len(image) // 2 :] == 200).all() and (np.diff(image, axis=0) >= 0).all()


def test_what_stands_still_is_not_sent(page):
    page.drawing.move(page.frame)
    assert page.drawing.move(page.frame) == 0


def test_names_of_people_stay_out_of_nodes_and_markup(page):
    assert not any("<" in name for name in page.server.scene._handle_from_node_name)
    assert escaped(EVIL) == "&lt;img src=x onerror=alert(1)&gt;"


def test_models_come_and_go(page):
    client = Client()
    insert = panel(page, "InsertPanel")
    use(insert._by_hand, client, False)
    use(insert._shapes, client, "Sphere")
    wait(page, lambda: page.world.model("unit_sphere") is not None)
    assert page.drawing.model_root("unit_sphere") is not None and not client.told
    page.simulation.delete("unit_sphere")
    wait(page, lambda: page.world.model("unit_sphere") is None)
    assert page.drawing.model_root("unit_sphere") is None


@pytest.mark.parametrize("kind", Overlays.KINDS)
def test_overlays_are_drawn_and_taken_away(page, kind):
    before = set(page.server.scene._handle_from_node_name)
    page.overlays.show(kind, True)
    added = set(page.server.scene._handle_from_node_name) - before
    page.overlays.show(kind, False)
    assert set(page.server.scene._handle_from_node_name) == before
    assert added or kind == "joints"  # these models have none


def test_box_of_an_inertia():
    pose, size = inertia_box(shape_model("b", d.Box((1.0, 2.0, 3.0)), mass=5.0).links[0].inertial)
    extents = np.abs(np.array(math3.quat_to_matrix(pose.q)) @ np.array(size))
    np.testing.assert_allclose(sorted(extents), (1.0, 2.0, 3.0), rtol=1e-6)
    assert inertia_box(d.Inertial(1.0, ixx=1e8, iyy=1.0, izz=1.0)) is None  # no body has it


# ---------------------------------------------------------------------------------------------- what clicks do


def test_play_pause_step_reset(page):
    client, play = Client(), panel(page, "PlayPanel")
    use(play._count, client, 5)
    use(play._run, client, "Step")
    wait(page, lambda: page.frame.iterations == 5)
    use(play._run, client, "Play")
    wait(page, lambda: page.frame.iterations > 20 and not page.frame.paused)
    use(play._run, client, "Pause")
    wait(page, lambda: page.frame.paused)
    taken = page.frame.iterations
    use(play._reset, client, "Time")
    wait(page, lambda: page.frame.sim_time == 0.0)
    assert page.frame.iterations == taken
    use(play._reset, client, "All")
    wait(page, lambda: page.frame.iterations == 0)
    assert not client.told


def test_one_page_may_hold_the_controls(page):
    one, two, play = Client(1), Client(2), panel(page, "PlayPanel")
    use(play._hold, one, True)
    use(play._run, two, "Step")
    assert page.frame.iterations == 0 and "holds the controls" in two.told[0]
    use(play._run, one, "Step")
    wait(page, lambda: page.frame.iterations == 1)
    page._on_disconnect(one)
    assert play._hold.value is False
    use(play._run, two, "Step")
    wait(page, lambda: page.frame.iterations == 2)


def test_pick_move_copy_delete_undo(page):
    client, world = Client(), panel(page, "PickedPanel")
    page.selection.select("box")
    world._properties.position._impl.value = (4.0, 0.0, 2.0)
    use(world._properties.position, client)
    wait(page, lambda: np.allclose(position(page, "box"), (4.0, 0.0, 2.0), atol=1e-5))
    use(world._edit, client, "Copy")
    wait(page, lambda: page.world.model("box_0") is not None)
    assert np.allclose(position(page, "box_0"), (5.0, 0.0, 2.0), atol=1e-5)
    use(world._edit, client, "Delete")
    wait(page, lambda: page.world.model("box") is None)
    use(world._history, client, "Undo")  # the delete
    wait(page, lambda: page.world.model("box") is not None)
    assert np.allclose(position(page, "box"), (4.0, 0.0, 2.0), atol=1e-5)
    use(world._history, client, "Undo")  # the copy
    wait(page, lambda: page.world.model("box_0") is None)
    use(world._history, client, "Redo")
    wait(page, lambda: page.world.model("box_0") is not None)
    assert not client.told


def test_a_click_on_what_has_just_gone_counts_when_it_comes_back(page, monkeypatch):
    """The page of a browser is always a little behind: its buttons must not have gone under the hand."""
    client, world = Client(), panel(page, "PickedPanel")
    tree = panel(page, "WorldPanel")
    row = tree._rows[("box", "box", "", "")]
    page.simulation.delete("box")
    wait(page, lambda: page.world.model("box") is None)
    assert not row.visible
    use(row, client)
    page.turn()
    assert page.selection.model == "" and world._properties is None and not client.told
    page.simulation.insert("box", model_text(shape_model("box", d.Box())), Pose())
    wait(page, lambda: page.selection.model == "box")
    assert tree._rows[("box", "box", "", "")] is row and row.visible and world._properties.mass.value == 1.0
    page.selection.select()
    page.simulation.delete("box")
    wait(page, lambda: page.world.model("box") is None)
    now = time.monotonic()
    monkeypatch.setattr(time, "monotonic", lambda: now + 100.0)
    tree.on_frame(page.frame)
    assert ("box", "box", "", "") not in tree._rows and not tree._hidden


def test_a_copy_right_after_the_undo_of_a_delete_waits_for_the_world_to_tell_of_it(page, monkeypatch):
    client, world, simulation = Client(), panel(page, "PickedPanel"), page.simulation
    newest, turns = simulation.frame, []
    page.selection.select("box")
    now = time.monotonic()
    monkeypatch.setattr(time, "monotonic", lambda: now)  # however slow this machine is, the box is away for a moment only
    use(world._edit, client, "Delete")
    wait(page, lambda: page.world.model("box") is None)
    gone = page.frame
    use(world._history, client, "Undo")
    monkeypatch.setattr(simulation, "frame", lambda: newest() if len(turns) > 3 else gone)
    monkeypatch.setattr(page, "catch_up", lambda: turns.append(page.turn()) or True)  # as the thread that draws would
    use(world._edit, client, "Copy")
    assert len(turns) > 3 and not client.told
    wait(page, lambda: page.world.model("box_0") is not None)
    assert np.allclose(position(page, "box_0"), (1.0, 0.0, 0.0), atol=1e-5)


def test_a_job_that_stumbles_does_not_take_the_others_along():
    said, done = [], []
    page = Page(LocalSimulation(World(d.World()), paused=True), port=0, say=said.append)
    try:
        page.later(lambda: 1 // 0)
        page.later(lambda: done.append(True))
        page.turn()
        assert done and "ZeroDivisionError" in said[0]
    finally:
        page.close()


def test_mass_and_light_are_set(page):
    client, world = Client(), panel(page, "PickedPanel")
    page.selection.select("box")
    use(world._properties.mass, client, 4.0)
    now = page.simulation.link_properties("box", "link")
    assert now.mass == 4.0 and now.inertia[0] == pytest.approx(4.0 / 6)
    page.selection.select(light="sun")
    use(world._properties.diffuse, client, (255, 0, 0))
    wait(page, lambda: page.world.lights[0].diffuse == (1.0, 0.0, 0.0, 1.0))


def test_a_refusal_is_told_to_the_page_that_asked(page):
    client, world = Client(), panel(page, "PickedPanel")
    use(world._edit, client, "Delete")
    assert client.told == ["Pick a model or light first: click on it, or on its name in the tree."]
    physics = panel(page, "PhysicsPanel")
    use(physics._gravity, client, (float("nan"), 0.0, 0.0))
    assert len(client.told) == 2 and page.simulation.physics()[1] == (0.0, 0.0, -9.8)


def test_joints_are_put_and_driven():
    arm = d.Model(
        "arm",
        links=(d.Link("base"), d.Link("tip", inertial=d.Inertial(1.0, ixx=0.1, iyy=0.1, izz=0.1))),
        joints=(
            d.Joint("fix", "fixed", "world", "base"),
            d.Joint("hinge", "revolute", "base", "tip", axes=(d.Axis((0.0, 0.0, 1.0), -2.0, 2.0),)),
        ),
    )
    page = Page(LocalSimulation(World(d.World(models=(arm,))), paused=True), port=0)
    try:
        client = Client()
        wait(page, lambda: page.frame is not None)
        page.selection.select("arm")
        joints = panel(page, "JointsPanel")
        slider = joints._sliders["hinge"]
        assert (slider.min, slider.max) == (-2.0, 2.0)
        use(slider, client, 0.5)
        row = page.world.model("arm").joints["hinge"]
        wait(page, lambda: abs(page.frame.joints[row] - 0.5) < 1e-5)
        page.simulation.command_joint("arm", "hinge", "position", -1.0, (40.0, 0.0, 5.0))
        page.simulation.step(4000)
        wait(page, lambda: abs(page.frame.joints[row] + 1.0) < 0.01)
        use(joints._mode, client, "velocity")  # with gains that a light link bears
        wait(page, lambda: joints._sliders["hinge"] is not slider)
        use(joints._sliders["hinge"], client, 0.5)
        page.simulation.step(2000)
        wait(page, lambda: page.frame.iterations == 6000 and -0.6 < page.frame.joints[row] < 0.1)
        assert not client.told
    finally:
        page.close()


def test_save_gives_a_world_that_can_be_started(page):
    client, record = Client(), panel(page, "RecordPanel")
    use(record._save, client)
    saved = World.load(client.files["default.world"].decode())
    assert list(saved.models) == ["box", EVIL] and saved.models[EVIL].pose.p == (3.0, 0.0, 0.5)


def test_a_recording_plays_by_itself(page):
    client, record = Client(), panel(page, "RecordPanel")
    use(record._replay, client)
    page.simulation.set_pose("box", Pose((0.0, 0.0, 9.0)))
    wait(page, lambda: position(page, "box")[2] > 8.9)
    use(record._replay, client)
    replay = client.files["replay.html"]
    assert b"__VISER_EMBED_DATA__" in replay
    assert b"<title>Replay of default</title>" in replay
    assert b"window.requestAnimationFrame = " in replay  # as sparing as the page where the processor draws


def test_history_forgets_what_was_refused_and_what_is_old():
    history, log = History(), []
    with pytest.raises(Refused):
        history.undo()

    def refuse():
        raise Refused("no")

    with pytest.raises(Refused):
        history.do("x", refuse, lambda: log.append("back"))
    with pytest.raises(Refused):
        history.undo()
    for number in range(60):
        history.note(str(number), lambda: None, lambda: None)
    undone = 0
    with pytest.raises(Refused):
        while True:
            history.undo()
            undone += 1
    assert undone == 50 and not log


def test_what_is_typed_without_a_pause_is_one_step(monkeypatch):
    history, value, clock = History(), [0.0], [100.0]
    monkeypatch.setattr("ode_sim_viewer.selection.time.monotonic", lambda: clock[0])

    def step(number, what="mass", typed=True):
        before = value[0]
        history.do(what, lambda: value.__setitem__(0, number), lambda: value.__setitem__(0, before), typed)
        clock[0] += 0.3

    for key in (1.0, 12.0, 12.5):  # of 12.5
        step(key)
    history.undo()
    assert value == [0.0]
    history.redo()
    assert value == [12.5]
    step(3.0)  # after an undo or redo it is a step of its own
    clock[0] += 5.0
    step(4.0)  # after a pause, too
    step(5.0, "friction")
    step(6.0, typed=False)
    step(7.0)
    for left in (6.0, 5.0, 4.0, 3.0, 12.5, 0.0):
        history.undo()
        assert value == [left]


def test_a_redo_that_comes_at_once_waits_for_the_undo():
    history, begun, overtaken, log = History(), threading.Event(), threading.Event(), []

    def back():
        begun.set()
        overtaken.wait(0.2)
        log.append("back")

    def forth():
        overtaken.set()
        log.append("forth")

    history.do("x", forth, back)
    overtaken.clear()
    hand = threading.Thread(target=history.undo)
    hand.start()
    begun.wait(5.0)
    history.redo()
    hand.join()
    assert log == ["forth", "back", "forth"]


def test_names_and_times():
    assert free_name("a", {"b"}) == "a" and free_name("a", {"a", "a_0"}) == "a_1"
    assert clock(93784.0625) == "01 02:03:04.062"

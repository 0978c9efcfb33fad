"""What a page shows of a running world and changes in it: moments, contacts, looks, films, a pull, the first view."""

import asyncio
import math
import time
import types
from dataclasses import replace

import numpy as np
import pytest
from ode_sim import World, math3
from ode_sim.description import model as d
from ode_sim.math3 import Pose
from ode_sim.timeline import MOST, Timeline

pytest.importorskip("viser")

from ode_sim_viewer import LocalSimulation, Page, Refused  # noqa: E402
from ode_sim_viewer.arrows import arrow_points  # noqa: E402
from ode_sim_viewer.eye import FIELD, view_of  # noqa: E402
from ode_sim_viewer.shapes import shape_model  # noqa: E402
from ode_sim_viewer.simulation import SurfaceProperties  # noqa: E402
from viewer_page import Client, page, panel, position, use, wait  # noqa: E402, F401

GROUND = d.Model("ground", static=True, links=(d.Link("l", collisions=(d.Collision("c", Pose(), d.Plane()),)),))


def falling():
    """A ball on the ground that never falls asleep: contacts of sleepers are not told."""
    ball = replace(shape_model("ball", d.Sphere(0.5)), pose=Pose((0.0, 0.0, 0.5)), allow_auto_disable=False)
    return World(d.World(models=(GROUND, ball)))


# ---------------------------------------------------------------------------------------------- going back


def test_a_timeline_gives_back_the_same_bits():
    world = falling()
    world.models["ball"].pose = Pose((0.0, 0.0, 5.0))
    timeline = Timeline(world)
    world.after_step.append(lambda world: timeline.after_step())
    timeline.record(0.1)
    world.step(450)
    assert [round(moment.time_ns * 1e-9, 9) for moment in timeline.moments] == [0.0, 0.1, 0.2, 0.3, 0.4]
    world.step(50)
    then = bytes(world.save())
    moment = timeline.moments[2]
    world.restore(moment.snapshot)
    timeline.went_back(moment)
    assert world.time == pytest.approx(0.2)
    world.step(300)
    assert bytes(world.save()) == then


def test_what_comes_after_going_back_is_the_only_future():
    world = falling()
    timeline = Timeline(world)
    for _ in range(4):
        timeline.keep()
        world.step(100)
    world.restore(timeline.moments[1].snapshot)
    world.step(50)
    kept = timeline.keep()
    assert [moment.time_ns for moment in timeline.moments] == [0, 100_000_000, 150_000_000]
    assert timeline.find(kept.number) is kept
    with pytest.raises(ValueError, match="not kept"):
        timeline.find(999)


def test_memory_is_bounded_and_a_new_model_begins_anew():
    world = falling()
    timeline = Timeline(world)
    for _ in range(MOST + 5):
        timeline.keep()
        world.step(1)
    assert len(timeline.moments) == MOST and timeline.moments[0].number == 6
    world.spawn(shape_model("late", d.Box()))
    assert not timeline.moments
    for period in (-1.0, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="period"):
            timeline.record(period)


def test_the_page_goes_back(page):
    client, timeline = Client(), panel(page, "TimelinePanel")
    page.simulation.set_pose("box", Pose((0.0, 0.0, 9.0)))
    use(timeline._keep, client)
    page.simulation.step(300)
    wait(page, lambda: position(page, "box")[2] < 8.9)
    use(timeline._keep, client)
    use(timeline._steps, client, "Back")
    wait(page, lambda: position(page, "box")[2] == 9.0 and page.frame.iterations == 0)
    use(timeline._steps, client, "On")
    wait(page, lambda: page.frame.iterations == 300)
    use(timeline._slider, client, 0)
    wait(page, lambda: page.frame.iterations == 0)
    assert not client.told


# ---------------------------------------------------------------------------------------------- contacts and looks


def borne(simulation, newtons, seconds=10.0):
    """Wait for a frame in which the contacts bear that much."""
    end = time.monotonic() + seconds
    while abs(np.abs(simulation.contacts()[:, 5]).sum() - newtons) > 0.01 * newtons:
        assert time.monotonic() < end, simulation.contacts()
        time.sleep(0.02)


def test_contacts_bear_the_weight_and_change_no_bit():
    plain, watched = falling(), falling()
    simulation = LocalSimulation(watched, paused=True)
    try:
        simulation.watch_contacts(True)
        plain.step(2000)
        simulation.step(2000)
        borne(simulation, 9.8)
        assert np.allclose(simulation.contacts()[:, 2], 0.0, atol=0.01)
        assert (simulation.contacts()[:, 5] > 0.0).all()  # on the ball, not on the ground below it, where no arrow is seen
        assert simulation.call(lambda world: bytes(world.save())) == bytes(plain.save())
        simulation.insert(
            "late",
            "<sdf version='1.6'><model name='m'><allow_auto_disable>0</allow_auto_disable><link name='l'>"
            "<collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision></link></model></sdf>",
            Pose((4.0, 0.0, 0.5)),
        )
        simulation.step(500)
        borne(simulation, 2 * 9.8)
        simulation.watch_contacts(False)
        assert not len(simulation.contacts())
        assert not any(
            collision.core.watched
            for collision in simulation.call(lambda world: list(world.models["ball"].links["link"].collisions.values()))
        )
    finally:
        simulation.close()


def test_arrows_are_cut_and_small_ones_left_out():
    points = arrow_points(np.zeros((4, 3)), np.array([(0, 0, 10.0), (0, 0, 0.1), (0, 0, 1e9), (np.nan, 0, 0)]), 0.01)
    np.testing.assert_allclose(points[:, 1], [(0, 0, 0.1), (0, 0, 2.0)], rtol=1e-6)


def test_contacts_are_drawn_and_taken_away(page):
    before = set(page.server.scene._handle_from_node_name)
    page.simulation.insert(
        "ground",
        "<sdf version='1.6'><model name='g'><static>1</static><link name='l'><collision "
        "name='c'><geometry><plane/></geometry></collision></link></model></sdf>",
        Pose(),
    )
    wait(page, lambda: page.world.model("ground") is not None)
    page.simulation.set_pose("box", Pose((0.0, 0.0, 0.5)))
    page.overlays.contacts(True)
    page.simulation.step(100)
    wait(page, lambda: "/contacts/arrows" in page.server.scene._handle_from_node_name)
    page.overlays.contacts(False)
    assert not {name for name in set(page.server.scene._handle_from_node_name) - before if "contacts/" in name}


def test_roads_are_drawn_and_hidden_with_the_rest():
    street = d.Visual("street", Pose(), d.Ribbon(((0.0, 0.0, 0.0), (5.0, 0.0, 0.0)), 2.0), d.Material(diffuse=(1.0, 0.0, 0.0, 1.0)))
    page = Page(LocalSimulation(World(d.World(scene=d.Scene(roads=(street,)))), paused=True), port=0)
    try:
        nodes = page.server.scene._handle_from_node_name
        wait(page, lambda: "/road0_0" in nodes)
        page.drawing.hide(True)
        assert not nodes["/road0_0"].visible
        page.drawing.hide(False)
        assert nodes["/road0_0"].visible
        page.drawing.wireframe = True
        page.drawing.redraw(page.world)
        assert nodes["/road0_0"].wireframe
    finally:
        page.close()


def test_colour_and_friction_are_changed_and_saved(page):
    client, world = Client(), panel(page, "PickedPanel")
    page.selection.select("box", "link")
    use(world._properties.colour, client, (255, 0, 0, 128))
    wait(page, lambda: page.world.model("box").description.links[0].visuals[0].material.diffuse == (1.0, 0.0, 0.0, 1.0))
    use(world._properties.friction, client, (0.25, 0.5))
    assert page.simulation.surface("box", "link") == SurfaceProperties(0.25, 0.5, 0.0)
    use(world._history, client, "Undo")
    assert page.simulation.surface("box", "link") == SurfaceProperties(1.0, 1.0, 0.0)
    use(world._history, client, "Redo")
    now = page.simulation.link_properties("box", "link")
    page.simulation.set_link_properties("box", "link", now.__class__(3.0, now.com, now.inertia, now.gravity))
    saved = World.load(page.simulation.save()).models["box"].description.links[0]
    assert saved.visuals[0].transparency == pytest.approx(127 / 255)
    assert (saved.collisions[0].surface.mu, saved.collisions[0].surface.mu2) == (0.25, 0.5)
    assert saved.inertial.mass == 3.0 and not client.told
    with pytest.raises(Refused):
        page.simulation.paint("nobody", "", (1.0, 0.0, 0.0, 1.0))


# ---------------------------------------------------------------------------------------------- films


@pytest.mark.parametrize("shadows", (True, False))
def test_the_box_for_shadows_says_what_is_drawn(shadows):
    page = Page(LocalSimulation(World(d.World()), paused=True), port=0, shadows=shadows)
    try:
        shown = [handle.value for handle in page.server.gui._gui_input_handle_from_uuid.values() if handle.label == "Shadows"]
        assert shown == [shadows] == [page.drawing.shadows]
    finally:
        page.close()


def test_a_film_shows_what_moved(page, tmp_path):
    cv2 = pytest.importorskip("cv2")
    client, record = Client(), panel(page, "RecordPanel")
    client.camera = types.SimpleNamespace(position=(4.0, -4.0, 3.0), look_at=(0.0, 0.0, 0.5), fov=FIELD, image_width=161, image_height=120)
    use(record._film, client)
    page.simulation.set_pose("box", Pose((0.0, 0.0, 0.5)))
    wait(page, lambda: len(record._movie.shots) > 3)
    page.simulation.set_pose("box", Pose((0.0, 1.5, 0.5)))
    page.simulation.insert("late", "<sdf version='1.6'><model name='m'><link name='l'/></model></sdf>", Pose())
    many = len(record._movie.shots)
    wait(page, lambda: len(record._movie.shots) > many + 3 and len(record._movie.scenes) == 2)
    use(record._film, client)
    assert not client.told
    file = tmp_path / "film.mp4"
    file.write_bytes(client.files["film.mp4"])
    film, pictures = cv2.VideoCapture(str(file)), []
    while (read := film.read())[0]:
        pictures.append(read[1])
    assert len(pictures) > many + 3 and pictures[0].shape == (120, 160, 3)
    assert np.abs(pictures[1].astype(int) - pictures[-1]).mean() > 2.0 and pictures[0].std() > 5.0


# ---------------------------------------------------------------------------------------------- a pull, the first view


class Hand:
    """What a browser says when the mouse drags a link."""

    def __init__(self, page, model, link):
        self._page, self._heard = page, {}
        page.pull.attach(self, model, link)

    def on_drag(self, button, modifier):
        return lambda heard: self._heard.setdefault(modifier, heard)

    def drag(self, **event):
        asyncio.run(self._heard[event["modifier"]](types.SimpleNamespace(**event)))
        self._page.turn()


def test_a_pull_takes_the_body_to_the_pointer():
    page = Page(LocalSimulation(falling(), paused=True), port=0)
    try:
        page.simulation.set_pose("ball", Pose((0.0, 0.0, 0.5)))
        wait(page, lambda: page.frame is not None)
        client = Client()

        hand = Hand(page, "ball", "link")

        def drag(phase):
            hand.drag(
                client=client, client_id=1, phase=phase, modifier="cmd/ctrl", end_position=(2.0, 0.0, 1.5), start_position=(0.0, 0.0, 0.5)
            )

        drag("start")
        for number in range(150):
            page.simulation.step(20)
            wait(page, lambda: page.frame.iterations == 20 * (number + 1))
        x, _, z = position(page, "ball")
        assert x == pytest.approx(2.0, abs=0.2) and z == pytest.approx(1.5 - 9.8 / 30.0, abs=0.2)
        drag("end")
        assert "/pull/arrows" not in page.server.scene._handle_from_node_name and not client.told
    finally:
        page.close()


def test_with_shift_a_pull_only_turns():
    page = Page(LocalSimulation(falling(), paused=True), port=0)
    try:
        page.simulation.set_pose("ball", Pose((0.0, 0.0, 5.0)))
        wait(page, lambda: page.frame is not None)
        Hand(page, "ball", "link").drag(
            client=Client(),
            client_id=1,
            phase="start",
            modifier="cmd/ctrl+shift",
            start_position=(0.1, 0.0, 5.0),
            end_position=(0.1, 0.3, 5.0),
        )
        page.simulation.step(50)
        wait(page, lambda: page.frame.iterations == 50)
        pose = page.frame.pose(page.world.model("ball").links["link"])
        assert math3.quat_to_rpy(pose.q)[2] > 0.001 and pose.p[:2] == pytest.approx((0.0, 0.0), abs=1e-9)
    finally:
        page.close()


def test_a_hand_that_rotates_is_kept_to_steps():
    page = Page(LocalSimulation(falling(), paused=True), port=0)
    try:
        wait(page, lambda: page.frame is not None)
        page.selection.select("ball")
        page.selection.gizmo(True, 0.5, math.radians(15.0))
        event = types.SimpleNamespace(client=Client(), client_id=1)
        for phase in ("start", "update", "end"):
            page.selection._drag(event, Pose((0.7, -0.2, 2.1), math3.quat_from_rpy(0.1, 0.3, 1.0)), phase)
        pose = page.simulation.call(lambda world: world.models["ball"].pose)
        assert pose.p == pytest.approx((0.5, 0.0, 2.0), abs=1e-9)
        assert np.degrees(math3.quat_to_rpy(pose.q)) == pytest.approx((0.0, 15.0, 60.0), abs=1e-6)
    finally:
        page.close()


@pytest.mark.parametrize("low, high", [((0, 0, 0), (0.2, 0.2, 1.0)), ((-6, -4, 0), (5, 1, 2.5)), ((9, 9, 9), (10, 10, 10))])
def test_the_first_view_has_all_of_it(low, high):
    corners = np.array([(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])], float)
    eye, target = view_of(corners, np.zeros((0, 3)))
    ahead = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(ahead, (0.0, 0.0, 1.0)) / np.linalg.norm(np.cross(ahead, (0.0, 0.0, 1.0)))
    depth = (corners - eye) @ ahead
    assert (depth > 0.0).all()
    tall = np.abs((corners - eye) @ np.cross(right, ahead)) / depth
    wide = np.abs((corners - eye) @ right) / depth
    assert tall.max() < np.tan(FIELD / 2) and wide.max() < 1.4 * np.tan(FIELD / 2)
    assert max(tall.max(), wide.max() / 1.4) > 0.4 * np.tan(FIELD / 2)  # and is not far off


def test_in_a_huge_world_the_eye_looks_at_the_robot():
    wall = np.array([(-500.0, 0.0, 0.0), (500.0, 0.0, 3.0)])
    robot = np.array([(1.0, 1.0, 0.0), (1.5, 1.5, 1.0)])
    eye, target = view_of(wall, robot)
    assert np.linalg.norm(eye - target) < 5.0 and np.allclose(target, (1.25, 1.25, 0.5))
    assert np.isfinite(view_of(np.zeros((0, 3)), np.zeros((0, 3)))[0]).all()


def test_a_texture_is_encoded_once_for_all_meshes_that_show_it():
    import io

    from ode_sim_viewer.drawing import _picture
    from PIL import Image

    pixels = np.zeros((8, 6, 4), np.uint8)
    pixels[..., 0], pixels[:4, :, 1], pixels[..., 3] = 200, 90, 255
    for alpha, kind, name in ((255, b"\xff\xd8", "JPEG"), (80, b"\x89PNG", None)):
        pixels[..., 3] = alpha
        picture, files = _picture(pixels), (io.BytesIO(), io.BytesIO())
        for file in files:
            picture.save(file, format=name or "png")
        assert files[0].getvalue() == files[1].getvalue() and files[0].getvalue().startswith(kind) and picture.format == name
        assert np.abs(np.asarray(Image.open(files[0]).convert("RGBA"), int) - pixels).mean() < (5 if name else 1e-9)


@pytest.mark.parametrize(
    "look, shade",
    [
        (d.Material(texture="t.png", diffuse=(0.4, 0.4, 0.4, 1.0)), 102),
        (
            d.Material(texture="t.png", diffuse=(0.4, 0.4, 0.4, 1.0), lighting=False),
            255,
        ),  # as bright as its texture, as in cameras' pictures
    ],
)
def test_a_texture_is_as_bright_as_its_material(look, shade):
    from ode_sim_rendering.assets import Assets
    from ode_sim_viewer.drawing import _textured
    from PIL import Image

    assets = Assets()
    (part,) = assets.parts(d.Visual("v", Pose(), d.Box((1.0, 1.0, 1.0)), look), "m::l::v")
    made = _textured(assets.meshes[part.key], part, Image.new("RGBA", (2, 2)), part.look, 1.0)
    assert list(made.visual.material.baseColorFactor) == [shade, shade, shade, 255]


def test_who_comes_in_while_a_large_world_is_drawn_goes_on_seeing_it(page, monkeypatch):
    """The first drawing took longer than the page waits for a browser, which came in just then."""
    looks = []
    monkeypatch.setattr(page.simulation, "look", looks.append)
    monkeypatch.setattr(page.server, "get_clients", lambda: {7: Client(7)})
    page._begun, page._pages = time.monotonic() - 100.0, 0
    page.turn()
    assert looks == [True] and page._pages == 1

"""Sizes, inertia, lights and physics, changed in a page without a browser; each a step that can be undone."""

import asyncio
import threading
import types

import numpy as np
import pytest

pytest.importorskip("viser")

from ode_sim.description import model as d  # noqa: E402
from ode_sim.description.sdf_writer import model_text  # noqa: E402
from ode_sim.math3 import Pose  # noqa: E402
from ode_sim_viewer import Refused  # noqa: E402
from ode_sim_viewer.panels import physics as physics_module  # noqa: E402
from ode_sim_viewer.resizing import resized, shape_of, size_of, with_size  # noqa: E402
from ode_sim_viewer.shapes import shape_model  # noqa: E402
from viewer_page import Client, page, panel, position, use, wait  # noqa: E402, F401


def size(page):
    return size_of(shape_of(page.world.model("box").description)[0])


def knobs(page):
    return sorted(name for name in page.server.scene._handle_from_node_name if name.startswith("/knob"))


@pytest.mark.parametrize(
    "shape, axis, length, now",
    [
        (d.Box((1.0, 2.0, 3.0)), 1, 5.0, (1.0, 5.0, 3.0)),
        (d.Sphere(0.5), 2, 3.0, (3.0, 3.0, 3.0)),
        (d.Cylinder(0.5, 2.0), 0, 3.0, (3.0, 3.0, 2.0)),
        (d.Cylinder(0.5, 2.0), 2, 3.0, (1.0, 1.0, 3.0)),
    ],
)
def test_round_stays_round_and_the_inertia_follows(shape, axis, length, now):
    made = resized(shape_model("m", shape, 2.0), with_size(shape, axis, length))
    assert size_of(shape_of(made)[0]) == now and shape_of(made)[1] == Pose()
    assert made.links[0].inertial.mass == 2.0
    assert made.links[0].inertial.ixx == shape_model("m", shape_of(made)[0], 2.0).links[0].inertial.ixx
    for wrong in (0.0, -1.0, float("nan"), 1e9):
        with pytest.raises(Refused):
            with_size(shape, axis, wrong)


def test_only_simple_shapes_have_sizes():
    one = shape_model("m", d.Box())
    two = d.Model("m", links=(*one.links, d.Link("other")))
    odd = d.Model("m", links=(d.Link("l", visuals=(d.Visual("v", Pose(), d.Mesh("a.stl", "a.stl")),)),))
    assert shape_of(two) is None and shape_of(odd) is None and shape_of(d.Model("m")) is None


def test_a_size_is_typed_and_undone(page):
    client, world = Client(), panel(page, "PickedPanel")
    page.simulation.set_pose("box", Pose((2.0, 0.0, 1.0)))
    wait(page, lambda: position(page, "box") == pytest.approx((2.0, 0.0, 1.0)))
    page.selection.select("box")
    use(world._properties.size, client, (1.0, 3.0, 1.0))
    wait(page, lambda: page.world.model("box") is not None and size(page) == (1.0, 3.0, 1.0))
    assert page.selection.model == "box" and position(page, "box") == pytest.approx((2.0, 0.0, 1.0))
    use(world._history, client, "Undo")
    wait(page, lambda: page.world.model("box") is not None and size(page) == (1.0, 1.0, 1.0))
    use(world._properties.size, client, (1.0, 1.0, 0.001))
    assert "A side is" in client.told[-1]


def test_a_knob_is_dragged_with_snapping(page):
    client, world = Client(), panel(page, "PickedPanel")
    page.selection.select("box")
    use(world._resize, client, True)
    use(world._snap, client, 0.5)
    wait(page, lambda: len(knobs(page)) == 3)
    knob = page.server.scene._handle_from_node_name["/knob0"]
    assert knob.position[0] == pytest.approx(0.5 + 0.12)
    callback = knob._impl.drag_cb[0].callback
    for phase, x in (("start", 0.62), ("update", 0.9), ("end", 1.21)):
        asyncio.run(callback(types.SimpleNamespace(client=client, client_id=1, phase=phase, end_position=(x, 0.3, 0.0))))
        page._do_jobs()
        if phase == "update":
            assert world._properties.size.value == (1.5, 1.0, 1.0)  # 2 x (0.9 - 0.12) = 1.56
    wait(page, lambda: page.world.model("box") is not None and size(page) == (2.0, 1.0, 1.0))  # 2 x (1.21 - 0.12) = 2.18
    assert world._properties.size.value == (2.0, 1.0, 1.0)
    assert world._properties.diagonal.value == pytest.approx((1 / 6, 5 / 12, 5 / 12), rel=1e-3)  # of a box of 1 kg
    page.selection.select()
    wait(page, lambda: not knobs(page))
    assert not client.told


def test_inertia_is_typed(page):
    client, world = Client(), panel(page, "PickedPanel")
    page.selection.select("box")
    use(world._properties.com, client, (0.1, 0.0, 0.0))
    use(world._properties.diagonal, client, (0.4, 0.5, 0.6))
    now = page.simulation.link_properties("box", "link")
    assert now.com == pytest.approx((0.1, 0.0, 0.0)) and now.inertia == pytest.approx((0.4, 0.0, 0.0, 0.5, 0.0, 0.6))
    use(world._history, client, "Undo")
    assert page.simulation.link_properties("box", "link").inertia[0] == pytest.approx(1 / 6)
    assert not client.told


def test_lights_fade_shine_and_aim(page):
    client, world = Client(), panel(page, "PickedPanel")
    page.selection.select(light="sun")
    use(world._properties.direction, client, (1.0, 0.0, -1.0))
    wait(page, lambda: page.world.lights[0].direction == (1.0, 0.0, -1.0))
    use(world._properties.specular, client, (255, 0, 0))
    wait(page, lambda: page.world.lights[0].specular == (1.0, 0.0, 0.0, 1.0))
    use(world._history, client, "Undo")
    wait(page, lambda: page.world.lights[0].specular != (1.0, 0.0, 0.0, 1.0))
    use(world._properties.direction, client, (0.0, 0.0, 0.0))
    assert client.told == ["A direction is not zero."]


def test_two_changes_of_a_light_before_the_page_knows_of_the_first(page):
    client, world = Client(), panel(page, "PickedPanel")
    page.selection.select(light="sun")
    use(world._properties.diffuse, client, (255, 0, 0))
    use(world._properties.specular, client, (0, 255, 0))
    use(world._properties.position, client, (0.0, 0.0, 7.0))
    wait(page, lambda: page.world.lights[0].pose.p == (0.0, 0.0, 7.0))
    assert (page.world.lights[0].diffuse, page.world.lights[0].specular) == ((1.0, 0.0, 0.0, 1.0), (0.0, 1.0, 0.0, 1.0))
    for _ in range(2):
        use(world._history, client, "Undo")
    wait(page, lambda: page.world.lights[0].specular != (0.0, 1.0, 0.0, 1.0))
    assert page.world.lights[0].diffuse == (1.0, 0.0, 0.0, 1.0) and not client.told


def test_what_was_undone_is_seen_in_its_field_and_can_be_typed_again(page):
    client, world = Client(), panel(page, "PickedPanel")
    page.selection.select(light="sun")
    usual = world._properties.diffuse.value
    use(world._properties.diffuse, client, (255, 0, 0))
    use(world._history, client, "Undo")
    wait(page, lambda: world._properties.diffuse.value == usual != (255, 0, 0))
    page.selection.select("box")
    use(world._properties.mass, client, 7.0)
    use(world._history, client, "Undo")
    wait(page, lambda: world._properties.mass.value == 1.0)
    use(world._history, client, "Redo")
    wait(page, lambda: world._properties.mass.value == 7.0)
    assert not client.told


def test_a_colour_is_undone_to_what_each_visual_had(page):
    client, world = Client(), panel(page, "PickedPanel")
    looks = (None, d.Material("Gazebo/Bricks", texture="bricks.png"), d.Material(diffuse=(0.0, 0.0, 1.0, 1.0)))
    visuals = tuple(d.Visual(f"v{number}", Pose(), d.Sphere(0.1), look, 0.1 * number) for number, look in enumerate(looks))
    page.simulation.call(
        lambda other: other.spawn(d.Model("lamp", static=True, links=(d.Link("a", visuals=visuals), d.Link("b", visuals=visuals[:1]))))
    )
    wait(page, lambda: page.world.model("lamp") is not None)
    before = page.world.model("lamp").description
    page.selection.select("lamp")
    for green in (100, 200):  # a hand in the field of colours
        use(world._properties.colour, client, (0, green, 0, 255))
    wait(
        page,
        lambda: all(
            visual.material and visual.material.diffuse[1] == 200 / 255
            for link in page.world.model("lamp").description.links
            for visual in link.visuals
        ),
    )
    use(world._history, client, "Undo")
    wait(page, lambda: page.world.model("lamp").description == before)
    use(world._history, client, "Redo")
    wait(page, lambda: (look := page.world.model("lamp").description.links[1].visuals[0].material) and look.diffuse[1] == 200 / 255)
    assert not client.told


def test_what_is_made_anew_keeps_the_controls_that_somebody_types_into(page):
    client, world = Client(), panel(page, "PickedPanel")
    page.selection.select("box")
    controls, text = world._properties, model_text(page.world.model("box").description)
    page.simulation.delete("box")
    wait(page, lambda: page.world.model("box") is None)
    use(controls.size, client, (2.0, 1.0, 1.0))
    page.simulation.insert("box", text, Pose())
    wait(page, lambda: page.world.model("box") is not None)
    assert world._properties is controls and page.selection.model == "box"
    page.simulation.delete("box")
    wait(page, lambda: page.world.model("box") is None and page.selection.model == "")
    assert world._properties is None


def test_two_copies_before_the_page_knows_of_the_first(page):
    client, world = Client(), panel(page, "PickedPanel")
    page.selection.select("box")
    for _ in range(2):
        use(world._edit, client, "Copy")
    wait(page, lambda: {"box_0", "box_1"} <= {model.name for model in page.world.models})
    assert not client.told


def test_the_solver_is_set(page):
    client, physics = Client(), panel(page, "PhysicsPanel")
    use(physics._soft, client, (1e-5, 0.3))
    use(physics._contacts, client, 7)
    use(physics._layer, client, 0.002)
    now = page.simulation.physics()[0]
    assert (now.cfm, now.erp, now.max_contacts, now.contact_surface_layer) == (1e-5, 0.3, 7, 0.002)
    np.testing.assert_allclose(physics._soft.value, (1e-5, 0.3))
    assert not client.told


def test_a_number_of_the_physics_is_typed_on_while_its_first_keys_are_being_set(page):
    """Each key comes in a thread of its own; the first ones are not done when the last has come."""
    client, physics, usual = Client(), panel(page, "PhysicsPanel"), page.simulation.set_physics
    begun, go_on = threading.Event(), threading.Event()

    def slow(*arguments):
        begun.set()
        assert go_on.wait(10.0)
        usual(*arguments)

    page.simulation.set_physics = slow
    first = threading.Thread(target=lambda: use(physics._iterations, client, 7))
    first.start()
    assert begun.wait(10.0)
    physics._iterations._impl.value = 77  # typed on; the page's next message is on its way
    go_on.set()
    first.join()
    assert physics._iterations.value == 77  # else the next key is put behind what the hand did not leave there
    use(physics._iterations, client, 77)
    assert (page.simulation.physics()[0].iters, physics._iterations.value) == (77, 77) and not client.told


def test_a_number_that_is_no_step_yet_is_typed_on(page, monkeypatch):
    client, panel_of_physics = Client(), panel(page, "PhysicsPanel")
    field = panel_of_physics._step
    monkeypatch.setattr(physics_module, "PATIENCE", 0.2)
    before = page.simulation.physics()[0].max_step_size
    use(field, client, 0.0)
    assert client.told and field.value == 0.0 and page.simulation.physics()[0].max_step_size == before
    use(panel_of_physics._iterations, client, 60)  # the others go on meanwhile
    assert page.simulation.physics()[0].iters == 60
    use(field, client, 0.002)
    assert field.value == page.simulation.physics()[0].max_step_size == 0.002
    use(field, client, 0.0)
    wait(page, lambda: field.value == 0.002)  # whoever leaves it at that sees what holds


def test_a_search_is_not_filled_up_by_the_links_of_what_is_picked(page):
    tree, client = panel(page, "WorldPanel"), Client()
    house = d.Model("house", static=True, links=tuple(d.Link(f"wall_{number}") for number in range(60)))
    page.simulation.insert("house", model_text(house), Pose())
    wait(page, lambda: page.world.model("house") is not None)
    page.selection.select("house")

    def listed(search):
        use(tree._search, client, search)
        page.turn()
        return [label for (label, *_), button in tree._rows.items() if button.visible]

    assert len(listed("")) == 30 and "sun" not in listed("")
    assert listed("sun") == ["sun"]
    assert listed("wall_12") == ["house", "wall_12"]
    assert listed("house")[:3] == ["house", "wall_0", "wall_1"]


def test_a_button_means_what_was_picked_just_before(page):
    """The pick is done by the thread that draws, the button by its own: it waits."""
    client, world = Client(), panel(page, "PickedPanel")
    tree = panel(page, "WorldPanel")
    held = threading.Event()
    drawer = threading.Thread(target=page.run)
    drawer.start()
    try:
        page.later(lambda: held.wait(10.0))  # it is busy
        use(tree._rows["box", "box", "", ""], client)
        hand = threading.Thread(target=lambda: use(world._edit, client, "Delete"))
        hand.start()
        held.set()
        hand.join(10.0)
        assert not client.told and page.simulation.describe().model("box") is None
    finally:
        held.set()
        page._ended.set()
        drawer.join(10.0)

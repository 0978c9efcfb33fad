"""The model editor: what a hand does to a model, files that Gazebo opens, and the tab in a page without a browser."""
import os
import types

import numpy as np
import pytest
from ode_sim import World
from ode_sim.description import model as d
from ode_sim.math3 import Pose
from ode_sim.viewer import LocalSimulation, Page, Refused

from gzclient.modelling import draft
from gzclient.modelling.draft import Draft

STL = b"""solid t
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 2 0 0
vertex 0 1 0
endloop
endfacet
endsolid t
"""


def pendulum():
    made = Draft()
    base, arm = made.add_link(d.Box((0.2, 0.2, 1.0)), 5.0), made.add_link(d.Cylinder(0.05, 0.8), 1.0)
    made.set_pose(base, Pose((0.0, 0.0, 0.5)))
    made.set_pose(arm, Pose((0.3, 0.0, 1.0)))
    made.add_joint("fixed", "world", base)
    made.add_joint("revolute", base, arm, (0.0, 2.0, 0.0), (-1.0, 1.0))
    return made


def test_links_joints_and_inertias_are_those_of_a_robot(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    made = pendulum()
    made.add_plugin("truth", "libgazebo_ros_p3d.so", "<bodyName>link_0</bodyName>")
    assert made.link("link").inertial.ixx == pytest.approx(5.0 * (0.2 ** 2 + 1.0) / 12)
    target = made.save("swing")
    assert target == str(tmp_path / "model_editor_models" / "swing") and draft.names() == ["swing"]
    world = World()
    with open(os.path.join(target, "model.sdf"), encoding="utf-8") as stream:
        model = world.spawn_sdf(stream.read())
    joint = model.joints["link_link_0"]
    assert joint.limits() == (-1.0, 1.0) and joint.world_axis() == pytest.approx((0.0, 1.0, 0.0))
    for _ in range(500):
        joint.add_force(0.02)
        world.step()
    assert joint.position() == pytest.approx(0.5 * 0.02 / 0.0539 * 0.5 ** 2, rel=0.02)
    assert model.links["link"].pose.p == pytest.approx((0.0, 0.0, 0.5))
    again = Draft.load("swing")
    assert [link.name for link in again.model.links] == ["link", "link_0"]
    assert again.model.plugins[0].element.findtext("bodyName") == "link_0"
    assert [(j.type, j.parent, j.child, j.axes) for j in again.model.joints] == [
        (j.type, j.parent, j.child, j.axes) for j in made.model.joints]


def test_every_change_is_one_step_back():
    made = pendulum()
    before = made.model
    made.rename_link("link_0", "rod")
    assert [(joint.parent, joint.child) for joint in made.model.joints] == [("world", "link"), ("link", "rod")]
    made.set_shape("rod", d.Cylinder(0.1, 2.0), 3.0, (1.0, 0.0, 0.0, 1.0))
    assert made.link("rod").inertial.izz == pytest.approx(0.5 * 3.0 * 0.01)
    assert made.link("rod").visuals[0].material.diffuse == (1.0, 0.0, 0.0, 1.0)
    made.delete("link")
    assert [link.name for link in made.model.links] == ["rod"] and not made.model.joints
    for _ in range(3):
        made.undo()
    assert made.model == before
    made.redo()
    assert made.link("rod")


@pytest.mark.parametrize("wrong", [
    lambda m: m.add_joint("revolute", "link", "link"), lambda m: m.add_joint("revolute", "link_0", "link"),
    lambda m: m.add_joint("revolute", "world", "link_0"), lambda m: m.add_joint("glue", "link", "link_0"),
    lambda m: m.add_joint("revolute", "link", "nobody"), lambda m: m.set_shape("link", d.Box((1.0, 1.0, -1.0)), 1.0),
    lambda m: m.set_shape("link", d.Box(), float("nan")), lambda m: m.rename_link("link", "link_0"),
    lambda m: m.rename_link("link", "<b>"), lambda m: m.add_plugin("p", "lib.so", "<open>"),
    lambda m: m.add_plugin("", "", ""), lambda m: Draft().text("empty"), lambda m: m.save("../evil"),
    lambda m: Draft.load("nowhere"), lambda m: draft.keep_mesh("m", "a.exe", b""),
    lambda m: draft.keep_mesh("m", "a.stl", b"no mesh"), lambda m: draft.keep_mesh("../m", "a.stl", STL)])
def test_what_cannot_be_is_refused_and_changes_nothing(wrong, tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    made = pendulum()
    before = made.model
    with pytest.raises(Refused):
        wrong(made)
    assert made.model == before and not [file for _, _, files in os.walk(tmp_path) for file in files]


def test_a_mesh_is_kept_beside_the_model(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    made = Draft()
    made.add_link(draft.keep_mesh("thing", "../../a b.stl", STL), 2.0)
    made.save("thing")
    assert sorted(os.listdir(tmp_path / "model_editor_models" / "thing" / "meshes")) == ["a b.stl"]
    assert Draft.load("thing").link("link").visuals[0].geometry.path.endswith("a b.stl")


def test_the_tab(tmp_path, monkeypatch):
    pytest.importorskip("viser")
    from gzclient.panels.model import ModelPanel
    monkeypatch.setenv("HOME", str(tmp_path))
    page = Page(LocalSimulation(World(d.World()), paused=True), port=0, panels=(ModelPanel,))
    panel, told = page.panels[-1], []
    client = types.SimpleNamespace(add_notification=lambda title, body, **_: told.append(body))

    def use(handle, value=None):
        if value is not None:
            handle._impl.value = value
        for callback in list(handle._impl.update_cb):
            callback(types.SimpleNamespace(client=client, client_id=1, target=handle))
        page._do_jobs()
        page._do_jobs()
    try:
        use(panel._on, True)
        use(panel._shapes, "Box")
        use(panel._size, (0.4, 0.4, 0.2))
        use(panel._shapes, "Cylinder")
        use(panel._link_name, "<img src=x>")
        assert "name has letters" in panel._note.content and panel._draft.link("link_0")
        use(panel._link_name, "rod")
        use(panel._join, True)
        event = types.SimpleNamespace(client=client, client_id=1)
        for link in ("link", "rod"):
            panel._click(event, link)
            page._do_jobs()
        assert [(j.type, j.parent, j.child) for j in panel._draft.model.joints] == [("revolute", "link", "rod")]
        drag = types.SimpleNamespace(client=client, client_id=1, phase="end")
        panel._move(drag, "rod", (0.0, 0.0, 1.0), (1.0, 0.0, 0.0, 0.0))
        page._do_jobs()
        assert panel._draft.link("rod").pose.p == (0.0, 0.0, 1.0)
        use(panel._name, "toy")
        use(panel._save)
        use(panel._put)
        page.turn()
        assert not told and set(page.simulation.call(lambda world: world.models["toy"].links)) == {"link", "rod"}
        assert page.simulation.call(lambda world: world.models["toy"].links["link"].mass) == 1.0
        np.testing.assert_allclose(draft.Draft.load("toy").link("link").collisions[0].geometry.size, (0.4, 0.4, 0.2))
        use(panel._on, False)
        assert not {name for name in page.server.scene._handle_from_node_name if name.startswith(("/model/", "/model_"))}
    finally:
        page.close()

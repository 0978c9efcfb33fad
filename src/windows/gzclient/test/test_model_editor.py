"""The model editor: what a hand does to a model, files that Gazebo opens, and the tab in a page without a browser."""

import os
import shutil
import types

import numpy as np
import pytest
from gzclient.modelling import draft
from gzclient.modelling.draft import Draft
from ode_sim import World, math3
from ode_sim.description import model as d
from ode_sim.math3 import Pose
from ode_sim_viewer import LocalSimulation, Page, Refused

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
    assert made.link("link").inertial.ixx == pytest.approx(5.0 * (0.2**2 + 1.0) / 12)
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
    assert joint.position() == pytest.approx(0.5 * 0.02 / 0.0539 * 0.5**2, rel=0.02)
    assert model.links["link"].pose.p == pytest.approx((0.0, 0.0, 0.5))
    again = Draft.load("swing")
    assert [link.name for link in again.model.links] == ["link", "link_0"]
    assert again.model.plugins[0].element.findtext("bodyName") == "link_0"
    assert [(j.type, j.parent, j.child, j.axes) for j in again.model.joints] == [
        (j.type, j.parent, j.child, j.axes) for j in made.model.joints
    ]


def test_a_joint_is_where_its_anchor_is(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    made = Draft()
    made.add_link(d.Cylinder(0.05, 0.8), 1.0)
    name = made.add_joint("revolute", "world", "link", (0.0, 1.0, 0.0), anchor=(0.0, 0.0, 0.4))
    made.save("rod")
    world = World()
    world.spawn_sdf(made.text("rod"))
    joint = world.models["rod"].joints[name]
    joint.set_position(0.1)
    for _ in range(100):
        world.step()
    assert joint.position() < 0.1 and math3.transform(world.models["rod"].links["link"].pose, (0.0, 0.0, 0.4)) == pytest.approx(
        (0.0, 0.0, 0.9), abs=1e-4
    )
    assert Draft.load("rod").model.joints[0].pose.p == (0.0, 0.0, 0.4)


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


@pytest.mark.parametrize(
    "wrong",
    [
        lambda m: m.add_joint("revolute", "link", "link"),
        lambda m: m.add_joint("revolute", "link_0", "link"),
        lambda m: m.add_joint("revolute", "world", "link_0"),
        lambda m: m.add_joint("glue", "link", "link_0"),
        lambda m: m.add_joint("revolute", "link", "nobody"),
        lambda m: m.add_joint("ball", "world", "link", anchor=(float("nan"), 0.0, 0.0)),
        lambda m: m.set_shape("link", d.Box((1.0, 1.0, -1.0)), 1.0),
        lambda m: m.set_shape("link", d.Box(), float("nan")),
        lambda m: m.rename_link("link", "link_0"),
        lambda m: m.rename_link("link", "<b>"),
        lambda m: m.add_plugin("p", "lib.so", "<open>"),
        lambda m: m.add_plugin("", "", ""),
        lambda m: Draft().text("empty"),
        lambda m: m.save("../evil"),
        lambda m: Draft.load("nowhere"),
        lambda m: draft.keep_mesh("m", "a.exe", b""),
        lambda m: draft.keep_mesh("m", "a.stl", b"no mesh"),
        lambda m: draft.keep_mesh("../m", "a.stl", STL),
    ],
)
def test_what_cannot_be_is_refused_and_changes_nothing(wrong, tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    made = pendulum()
    before = made.model
    with pytest.raises(Refused):
        wrong(made)
    assert made.model == before and not [file for _, _, files in os.walk(tmp_path) for file in files]


def folder_of(home, name, below=""):
    place = home / "model_editor_models" / name / below
    return sorted(os.listdir(place))


def test_a_model_with_its_meshes_is_one_folder_that_can_be_moved(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    made = Draft()
    made.add_link(draft.keep_mesh("my_model", "../../a b.stl", STL), 2.0)
    other = made.add_link(draft.keep_mesh("my_model", "a b.stl", STL.replace(b"vertex 2", b"vertex 3")))
    assert made.add_link(draft.keep_mesh("my_model", "a b.stl", STL)) and folder_of(tmp_path, "my_model", "meshes") == [
        "a b.stl",
        "a b_0.stl",
    ]
    target = made.save("thing")
    made.save("thing")
    assert folder_of(tmp_path, "thing", "meshes") == ["a b.stl", "a b_0.stl"]
    shutil.rmtree(tmp_path / "model_editor_models" / "my_model")
    with open(os.path.join(target, "model.sdf"), encoding="utf-8") as stream:
        text = stream.read()
    assert "file:///" not in text and text.count("model://thing/meshes/a b.stl") == 4
    assert made.link(other).visuals[0].geometry.uri == "model://thing/meshes/a b_0.stl"
    shutil.move(target, tmp_path / "models" / "thing")
    monkeypatch.setenv("GAZEBO_MODEL_PATH", str(tmp_path / "models"))
    model = World().spawn_sdf(text)
    assert [str(tmp_path / "models/thing/meshes") in part.collisions[0].geometry.path for part in model.description.links] == 3 * [True]


def test_a_model_that_is_saved_under_another_name_takes_along_what_its_meshes_name(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    files = {
        "meshes/cup.obj": "mtllib cup.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n",
        "meshes/cup.mtl": "newmtl m\nmap_Kd ../materials/textures/cup.png\n",
        "materials/textures/cup.png": "picture",
        "meshes/unused.stl": "",
        "model.sdf": """<sdf version='1.6'><model name='old'><link name='l'>
        <visual name='v'><geometry><mesh><uri>model://old/meshes/cup.obj</uri></mesh></geometry></visual>
        <visual name='w'><geometry><mesh><uri>model://stock/meshes/cup.obj</uri></mesh></geometry></visual></link></model></sdf>""",
    }
    for name, content in files.items():
        file = tmp_path / "model_editor_models" / "old" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(content)
    monkeypatch.setenv("GAZEBO_MODEL_PATH", str(tmp_path / "models"))
    shutil.copytree(tmp_path / "model_editor_models" / "old", tmp_path / "models" / "stock")
    Draft.load("old").save("new")
    assert folder_of(tmp_path, "new") == ["materials", "meshes", "model.config", "model.sdf"]
    assert folder_of(tmp_path, "new", "meshes") == ["cup.mtl", "cup.obj"]
    assert folder_of(tmp_path, "new", "materials/textures") == ["cup.png"]
    shutil.rmtree(tmp_path / "model_editor_models" / "old")
    own, other = Draft.load("new").link("l").visuals
    assert own.geometry.uri == "model://new/meshes/cup.obj" and own.geometry.path and other.geometry.uri == "model://stock/meshes/cup.obj"


def test_a_broken_mesh_does_not_take_the_place_of_a_good_one(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    good = draft.keep_mesh("m", "a.stl", STL)
    with pytest.raises(Refused, match=r"^a\.stl cannot be read: mesh a\.stl"):
        draft.keep_mesh("m", "a.stl", b"no mesh")
    with open(good.path, "rb") as stream:
        assert stream.read() == STL


def test_the_inertia_of_a_mesh_is_that_of_the_solid_or_of_its_box(tmp_path, monkeypatch):
    trimesh = pytest.importorskip("trimesh")
    monkeypatch.setenv("HOME", str(tmp_path))
    solid = trimesh.creation.cone(0.3, 1.0, sections=200)
    solid.apply_translation((0.5, 0.0, 0.0))
    made = Draft()
    cone = made.add_link(draft.keep_mesh("m", "cone.stl", solid.export(file_type="stl")), 2.0)
    inertial = made.link(cone).inertial
    assert inertial.pose.p == pytest.approx((0.5, 0.0, 0.25), abs=1e-4)
    assert (inertial.mass, inertial.ixx, inertial.izz) == pytest.approx((2.0, 2.0 * (3 / 20 * 0.09 + 3 / 80), 2.0 * 0.3 * 0.09), rel=2e-3)
    sheet = made.link(made.add_link(draft.keep_mesh("m", "sheet.stl", STL), 3.0)).inertial
    assert sheet.pose.p == pytest.approx((1.0, 0.5, 0.0)) and sheet.izz == pytest.approx(3.0 * (4.0 + 1.0) / 12)


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

"""gz sdf: files are checked and printed without a simulator."""

import pytest
from gazebo_ros.commands import gz
from ode_sim.description import load_world, read_model

ROBOT = """<robot name="cart">
  <link name="base"><inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <visual><geometry><mesh filename="package://cart_description/meshes/base.dae"/></geometry></visual>
    <collision><geometry><box size="1 2 3"/></geometry></collision></link>
  <link name="wheel"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="axle" type="continuous"><parent link="base"/><child link="wheel"/><origin xyz="0 1 0"/><axis xyz="0 1 0"/></joint>
  <gazebo><plugin name="drive" filename="libdrive.so"><leftJoint>axle</leftJoint></plugin></gazebo>
  <gazebo reference="base"><mu1>0.3</mu1><sensor name="eye" type="camera"><update_rate>5</update_rate></sensor></gazebo>
</robot>"""


def printed(capsys, path):
    assert gz.main(["sdf", "-p", str(path)]) == 0
    return capsys.readouterr()


def test_a_urdf_is_printed_as_the_model_that_it_is(tmp_path, capsys):
    path = tmp_path / "cart.urdf"
    path.write_text(ROBOT)
    text, problems = printed(capsys, path)
    assert "<uri>model://cart_description/meshes/base.dae</uri>" in text and "base.dae" in problems
    model, _ = read_model(text)
    assert [link.name for link in model.links] == ["base", "wheel"] and model.links[0].sensors[0].name == "eye"
    assert model.links[0].collisions[0].geometry.size == (1.0, 2.0, 3.0) and model.links[0].collisions[0].surface.mu == 0.3
    assert model.links[1].pose.p[1] == 1.0 and model.joints[0].axes[0].xyz == (0.0, 1.0, 0.0)
    assert model.plugins[0].element.findtext("leftJoint") == "axle"


def test_a_world_is_printed_whole(tmp_path, capsys):
    path = tmp_path / "a.world"
    path.write_text(
        "<sdf version='1.4'><world name='w'><gravity>0 0 -1</gravity><include><uri>model://ground_plane</uri></include></world></sdf>"
    )
    text, _ = printed(capsys, path)
    (tmp_path / "b.world").write_text(text)
    world, problems = load_world(str(tmp_path / "b.world"))
    assert world.gravity == (0.0, 0.0, -1.0) and [model.name for model in world.models] == ["ground_plane"] and not problems


@pytest.mark.parametrize("content", [None, "<robot", "<robot name='r'/>", b"\xff\xfe\xff"])
@pytest.mark.parametrize("option", ["-p", "-k"])
def test_what_cannot_be_read_is_one_line(tmp_path, capsys, option, content):
    path = tmp_path / "bad.urdf"
    if content is not None:
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
    assert gz.main(["sdf", option, str(path)]) == 1
    text, said = capsys.readouterr()
    assert not text and said.startswith("gz sdf: ") and said.count("\n") == 1 and "bad.urdf" in said

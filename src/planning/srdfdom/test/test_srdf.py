"""SRDF documents read, changed and written."""

import pytest
from srdfdom.srdf import SRDF, DisableCollisions, ParseError

TEXT = """<?xml version="1.0"?>
<robot name="r">
  <virtual_joint name="world" type="planar" parent_frame="odom" child_link="base"/>
  <group name="arm"><chain base_link="base" tip_link="tip"/><link name="extra"/></group>
  <group name="all"><group name="arm"/><joint name="finger"/></group>
  <group_state name="home" group="arm"><joint name="a" value="0.5"/><joint name="world" value="1 2 3"/></group_state>
  <end_effector name="hand" group="fingers" parent_link="tip"/>
  <passive_joint name="wheel"/>
  <link_sphere_approximation link="base"><sphere center="0 0 1" radius="0.25"/></link_sphere_approximation>
  <disable_collisions link1="base" link2="tip" reason="Never"/>
</robot>"""


def check(robot):
    assert robot.name == "r" and list(robot.group_map) == ["arm", "all"]
    chain = robot.group_map["arm"].chains[0]
    assert (chain.base_link, chain.tip_link) == ("base", "tip")
    assert [link.name for link in robot.group_map["arm"].links] == ["extra"]
    assert [group.name for group in robot.group_map["all"].subgroups] == ["arm"]
    home = {joint.name: joint.value for joint in robot.group_state_map["home"].joints}
    assert home == {"a": [0.5], "world": [1, 2, 3]}
    assert robot.end_effectors[0].parent_group is None and robot.end_effectors[0].parent_link == "tip"
    assert robot.virtual_joints[0].type == robot.virtual_joints[0].joint_type == "planar"
    assert robot.passive_joints[0].name == "wheel"
    assert robot.link_sphere_approximations[0].spheres[0].radius == 0.25
    assert [(pair.link1, pair.link2, pair.reason) for pair in robot.disable_collisionss] == [("base", "tip", "Never")]


def test_everything_is_read():
    check(SRDF.from_xml_string(TEXT))


def test_what_is_written_is_read_again():
    check(SRDF.from_xml_string(SRDF.from_xml_string(TEXT).to_xml_string()))


def test_elements_can_be_added():
    robot = SRDF("new")
    robot.add_disable_collisions(DisableCollisions("a", "b", "Adjacent"))
    assert 'link1="a"' in robot.to_xml_string()


@pytest.mark.parametrize(
    "text, said",
    [
        ("<robot", "not XML"),
        ("<model/>", "<model>, not <robot>"),
        ("<robot><group/></robot>", "<group> has no attribute 'name'"),
        ('<robot><virtual_joint name="v" type="soft" parent_frame="a" child_link="b"/></robot>', "type 'soft'"),
        ('<robot><group_state name="s" group="g"><joint name="j" value="up"/></group_state></robot>', "'up', which is no number"),
    ],
)
def test_bad_documents_are_one_line(text, said):
    with pytest.raises(ParseError) as caught:
        SRDF.from_xml_string(text)
    assert said in str(caught.value) and "\n" not in str(caught.value)

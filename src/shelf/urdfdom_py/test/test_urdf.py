"""URDF to objects and back, with the names, defaults and messages of urdf_parser_py 0.4."""

import xml.etree.ElementTree as ElementTree

import pytest
import urdf_parser_py.xml_reflection as xmlr
from urdf_parser_py.urdf import URDF, Box, Collision, Color, Inertia, Inertial, Joint, JointLimit, Link, Material, Pose, Visual

ARM = """<?xml version="1.0" encoding="utf-8"?>
<!-- an arm -->
<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <material name="grey"><color rgba="0.5 0.5 0.5 1"/></material>
  <link name="base"/>
  <link name="upper">
    <inertial><origin xyz="0 0 0.5"/><mass value="2.5"/><inertia ixx="1" ixy="0" ixz="0" iyy="2" iyz="0" izz="3"/></inertial>
    <visual><geometry><cylinder radius="0.1" length="1"/></geometry><material name="grey"/></visual>
    <visual name="second"><geometry><mesh filename="package://arm/a.stl" scale="1 1 2"/></geometry></visual>
    <collision><origin rpy="0 0 1.5"/><geometry><box size="1 2 3"/></geometry></collision>
  </link>
  <link name="hand"/>
  <joint name="shoulder" type="revolute">
    <origin xyz="0 0 1"/><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="2" effort="30" velocity="3"/><dynamics damping="0.5"/><mimic joint="wrist" multiplier="2"/>
    <safety_controller k_velocity="10"/>
  </joint>
  <joint name="wrist" type="fixed"><parent link="upper"/><child link="hand"/></joint>
  <transmission name="t"><type>transmission_interface/SimpleTransmission</type>
    <joint name="shoulder"><hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>
    <actuator name="motor"><mechanicalReduction>50</mechanicalReduction></actuator></transmission>
  <gazebo reference="upper"><material>Gazebo/Grey</material></gazebo>
</robot>"""


@pytest.fixture
def told(monkeypatch):
    messages = []
    monkeypatch.setattr(xmlr.core, "on_error", messages.append)
    return messages


def check(robot):
    assert (robot.name, robot.version, robot.get_root()) == ("arm", "1.0", "base")
    assert list(robot.link_map) == ["base", "upper", "hand"] and list(robot.joint_map) == ["shoulder", "wrist"]
    upper, shoulder = robot.link_map["upper"], robot.joint_map["shoulder"]
    assert (upper.inertial.mass, upper.inertial.origin.xyz, upper.inertial.inertia.to_matrix()[1]) == (2.5, [0, 0, 0.5], [0, 2, 0])
    assert upper.inertial.origin.rpy == [0, 0, 0] and upper.origin is None
    assert (upper.visual.geometry.radius, upper.visuals[1].geometry.scale, upper.visuals[1].name) == (0.1, [1, 1, 2], "second")
    assert (upper.collision.geometry.size, upper.collision.origin.rpy) == ([1, 2, 3], [0, 0, 1.5])
    assert (shoulder.type, shoulder.joint_type, shoulder.axis, shoulder.parent, shoulder.child) == (
        "revolute",
        "revolute",
        [0, 0, 1],
        "base",
        "upper",
    )
    assert (shoulder.limit.lower, shoulder.limit.effort, shoulder.dynamics.damping, shoulder.dynamics.friction) == (-1, 30, 0.5, None)
    assert (shoulder.mimic.joint, shoulder.mimic.multiplier, shoulder.mimic.offset) == ("wrist", 2, None)
    assert (shoulder.safety_controller.k_velocity, shoulder.safety_controller.k_position) == (10, 0)
    assert robot.joint_map["wrist"].axis is None and robot.joint_map["wrist"].limit is None
    assert robot.parent_map == {"upper": ("shoulder", "base"), "hand": ("wrist", "upper")}
    assert robot.child_map == {"base": [("shoulder", "upper")], "upper": [("wrist", "hand")]}
    transmission = robot.transmissions[0]
    assert transmission.joints[0].hardwareInterfaces == ["hardware_interface/EffortJointInterface"]
    assert (transmission.type, transmission.actuators[0].mechanicalReduction) == ("transmission_interface/SimpleTransmission", 50)
    assert robot.gazebos[0].findtext("material") == "Gazebo/Grey" and robot.materials[0].color.rgba == [0.5, 0.5, 0.5, 1]


def test_a_robot_is_read_and_written_without_loss(told, tmp_path):
    robot = URDF.from_xml_string(ARM)
    check(robot)
    check(URDF.from_xml_string(robot.to_xml_string()))
    check(URDF().parse(ARM))
    (tmp_path / "arm.urdf").write_text(ARM)
    check(URDF.from_xml_file(str(tmp_path / "arm.urdf")))
    assert told == [] and "name: shoulder" in str(robot)


@pytest.mark.parametrize(
    "options, chain",
    [
        ({}, ["base", "shoulder", "upper", "wrist", "hand"]),
        ({"links": False}, ["shoulder", "wrist"]),
        ({"links": False, "fixed": False}, ["shoulder"]),
        ({"joints": False}, ["base", "upper", "hand"]),
    ],
)
def test_chains(options, chain):
    assert URDF.from_xml_string(ARM).get_chain("base", "hand", **options) == chain


def test_a_robot_is_made_by_hand():
    robot = URDF("made")
    link = Link("a", visual=Visual(Box([1, 1, 1]), Material("red", Color(1.0, 0.0, 0.0))), inertial=Inertial(1.0, Inertia(izz=2.0)))
    link.collision = Collision(Box([1, 1, 1]), Pose([0, 0, 1]))
    link.collision = Collision(Box([2, 1, 1]))
    robot.add_link(link)
    robot.add_link(Link("b"))
    robot.add_joint(Joint("j", "a", "b", "prismatic", limit=JointLimit(1.0, 2.0, 0.0, 0.5)))
    node = ElementTree.fromstring(robot.to_xml_string())
    assert [box.get("size") for box in node.iter("box")] == ["1 1 1", "2 1 1"]
    assert node.find("link/visual/material/color").get("rgba") == "1.0 0.0 0.0 1.0"
    assert node.find("joint/limit").attrib == {"effort": "1.0", "velocity": "2.0", "lower": "0.0", "upper": "0.5"}
    with pytest.raises(AssertionError, match="Multiple roots"):
        robot.add_link(Link("c")) or robot.get_root()


@pytest.mark.parametrize(
    "change, path, reason",
    [
        (('type="fixed"', 'type="hinge"'), "/robot[@name='arm']/joint[@name='wrist']", "Invalid joint type: hinge"),
        (('<parent link="upper"/>', ""), "/robot[@name='arm']/joint[@name='wrist']", "Required element not set in XML: parent"),
        (('<parent link="upper"/>', "<parent/>"), "/robot[@name='arm']/joint[@name='wrist']/parent", "not set in XML: link"),
        (('value="2.5"', 'value="2,5"'), "/robot[@name='arm']/link[@name='upper']/inertial/mass[@value]", "could not convert"),
        (('size="1 2 3"', 'size="1 2"'), "/robot[@name='arm']/link[@name='upper']/collision[1]/geometry/box[@size]", "must be 3 numbers"),
        (('effort="30"', ""), "/robot[@name='arm']/joint[@name='shoulder']/limit", "Required attribute not set in XML: effort"),
        (("<box size", "<cone size"), "/robot[@name='arm']/link[@name='upper']/collision[1]/geometry", "Invalid geometric tag: cone"),
        (
            ('<actuator name="motor"><mechanicalReduction>50</mechanicalReduction></actuator>', ""),
            "/robot[@name='arm']/transmission[@name='t']",
            "no actuator defined",
        ),
        (("</robot>", ""), "/robot", "no element found"),
    ],
)
def test_what_is_wrong_is_told_with_its_place_in_one_line(told, change, path, reason):
    with pytest.raises(xmlr.ParseError) as caught:
        URDF.from_xml_string(ARM.replace(*change))
    assert caught.value.path == path and reason in str(caught.value) and "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "change, message",
    [
        (('<link name="hand"/>', '<link name="hand"><wheels/></link>'), "Unknown tag \"wheels\" in /robot[@name='arm']/link[@name='hand']"),
        (('<link name="hand"/>', '<link name="hand" size="1"/>'), "Unknown attribute \"size\" in /robot[@name='arm']/link[@name='hand']"),
        (('<mass value="2.5"/>', '<mass value="2.5"/><mass value="3"/>'), "Scalar element defined multiple times: mass"),
    ],
)
def test_what_is_unknown_is_told_and_left_out(told, change, message):
    check(URDF.from_xml_string(ARM.replace(*change)))
    assert told == [message]

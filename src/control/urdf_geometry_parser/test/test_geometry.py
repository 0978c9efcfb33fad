import math

import pytest
from urdf_geometry_parser import GeometryError, RobotGeometry

URDF = """<robot name="r">
  <link name="base"/><link name="arm"/>
  <joint name="fork" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="1 2 3" rpy="0 0 1"/></joint>
  <joint name="wheel" type="continuous"><parent link="arm"/><child link="tyre"/><origin xyz="0.5 0 -1"/></joint>
  <link name="tyre"><collision><geometry><cylinder radius="0.3" length="0.1"/></geometry></collision></link>
  <joint name="ball" type="continuous"><parent link="arm"/><child link="ball"/></joint>
  <link name="ball"><collision><geometry><sphere radius="0.2"/></geometry></collision></link>
  <joint name="box" type="prismatic"><parent link="arm"/><child link="box"/></joint>
  <link name="box"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <joint name="bare" type="fixed"><parent link="arm"/><child link="bare"/></joint><link name="bare"/>
</robot>"""


@pytest.fixture
def robot():
    return RobotGeometry(URDF)


def test_joints(robot):
    joint = robot.joint("fork")
    assert (joint.type, joint.parent, joint.child, joint.origin) == ("revolute", "base", "arm", (1.0, 2.0, 3.0))
    assert robot.joint("ball").origin == (0.0, 0.0, 0.0)


def test_unknown_joint_names_those_there_are(robot):
    with pytest.raises(GeometryError, match="'elbow' is not in the URDF; it has: ball, bare, box, fork, wheel"):
        robot.joint("elbow")


def test_position_adds_up(robot):
    assert robot.position("wheel", "base") == (1.5, 2.0, 2.0)
    assert robot.position("wheel", "arm") == (0.5, 0.0, -1.0)
    with pytest.raises(GeometryError, match="'tyre' is not above joint 'wheel'"):
        robot.position("wheel", "tyre")


def test_distance(robot):
    assert robot.distance("wheel", "ball") == pytest.approx(math.sqrt(1.25))


def test_wheel_radius(robot):
    assert robot.wheel_radius("wheel") == 0.3
    assert robot.wheel_radius("ball") == 0.2
    for joint, found in (("box", "it has a box"), ("bare", "it has none")):
        with pytest.raises(GeometryError, match=found):
            robot.wheel_radius(joint)
    with pytest.raises(GeometryError, match="a cylinder with a radius, it has a sphere"):
        robot.wheel_radius("ball", shapes=("cylinder",))


@pytest.mark.parametrize(
    "text, complaint",
    [
        ("<robot", "not valid XML"),
        ("<sdf/>", "root element is <sdf>"),
        ('<robot><joint name="j"><origin xyz="1 2"/></joint></robot>', "joint 'j'"),
    ],
)
def test_what_is_no_urdf(text, complaint):
    with pytest.raises(GeometryError, match=complaint):
        RobotGeometry(text)


def test_loops_end():
    with pytest.raises(GeometryError, match="not above"):
        RobotGeometry(
            '<robot><joint name="a"><parent link="x"/><child link="y"/></joint>'
            '<joint name="b"><parent link="y"/><child link="x"/></joint></robot>'
        ).position("a", "base")

"""Every macro, called as robots call it: frames where the makers' packages have them, bodies that a simulator takes."""

import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

HERE = Path(__file__).parent
DEVICES = HERE.parent.parent
EXAMPLES = [DEVICES / name for name in ("sick_tim/urdf/example.urdf.xacro", "realsense2_description/urdf/test_d455_camera.urdf.xacro")]


def expanded(path, *arguments):
    ended = subprocess.run(["rosrun", "xacro", "xacro", str(path), *arguments], capture_output=True, text=True, timeout=240)
    assert ended.returncode == 0, ended.stderr
    assert ended.stderr == ""
    return ET.fromstring(ended.stdout)


@pytest.fixture(scope="module")
def robot():
    return expanded(HERE.parent / "urdf/all.urdf.xacro")


def numbers(element, name):
    return [float(value) for value in (element.get(name, "0 0 0") if element is not None else "0 0 0").split()]


def test_frames(robot):
    told = [line.split() for line in (HERE / "frames.txt").read_text().splitlines() if not line.startswith("#")]
    expected = {child: (parent, [float(value) for value in values]) for child, parent, *values in told}
    found = {}
    for joint in robot.iter("joint"):
        assert joint.get("type") == "fixed"
        origin = joint.find("origin")
        pose = numbers(origin, "xyz") + numbers(origin, "rpy")
        found[joint.find("child").get("link")] = (joint.find("parent").get("link"), pose)
    assert set(found) == set(expected)
    for child, (parent, pose) in expected.items():
        assert found[child][0] == parent, child
        assert found[child][1] == pytest.approx(pose, abs=6e-5), child


def test_bodies(robot):
    """Masses and inertias of real bodies, no files that are not there, one tree."""
    links = [link.get("name") for link in robot.iter("link") if link.get("name")]
    declared = {link.get("name") for link in robot.findall("link")}
    assert len(declared) == len(robot.findall("link")) and len(declared) > 100
    assert {joint.find(end).get("link") for joint in robot.iter("joint") for end in ("parent", "child")} <= declared
    for link in robot.findall("link"):
        inertial = link.find("inertial")
        if inertial is not None:
            assert float(inertial.find("mass").get("value")) > 0
            xx, yy, zz = (float(inertial.find("inertia").get(axis)) for axis in ("ixx", "iyy", "izz"))
            assert min(xx, yy, zz) > 0
    assert not list(robot.iter("mesh"))
    assert links


def test_own_mesh_is_kept(tmp_path):
    mine = tmp_path / "mine.urdf.xacro"
    mine.write_text("""<robot name="mine" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:include filename="$(find sick_tim)/urdf/sick_tim.urdf.xacro"/>
      <xacro:sick_tim name="a" ros_topic="s" length="0.06" width="0.06" height="0.08" mass="0.2" z_offset="0.05"
        min_angle="-1" max_angle="1" min_range="0.1" max_range="5" mesh="package://mine/laser.stl"/>
      <xacro:sick_tim name="b" ros_topic="s" length="0.06" width="0.06" height="0.08" mass="0.2" z_offset="0.05"
        min_angle="-1" max_angle="1" min_range="0.1" max_range="5" mesh="package://sick_tim/meshes/sick_tim551.stl"/></robot>""")
    assert [mesh.get("filename") for mesh in expanded(mine).iter("mesh")] == ["package://mine/laser.stl"]


def test_examples():
    for path in EXAMPLES:
        assert len(expanded(path).findall("link")) >= 2, path


def test_materials_are_declared_once(robot):
    """robot_state_publisher ends at a material of which there are two, whatever they say."""
    names = [material.get("name") for material in robot.findall("material")]
    assert sorted(names) == sorted(set(names))

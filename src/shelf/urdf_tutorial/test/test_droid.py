"""The tutorial's files tell of one droid, step by step."""

import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

HERE = Path(__file__).parent.parent
STEPS = sorted((HERE / "urdf").glob("0*"))


def expanded(path):
    if path.suffix != ".xacro":
        return ET.parse(path).getroot()
    ended = subprocess.run(["rosrun", "xacro", "xacro", str(path)], capture_output=True, text=True, timeout=240)
    assert (ended.returncode, ended.stderr) == (0, "")
    return ET.fromstring(ended.stdout)


def attributes(element, *names):
    """The numbers of an element's attributes; of an absent one three zeros each."""
    return [float(value) for name in names for value in (element.get(name, "0 0 0") if element is not None else "0 0 0").split()]


def facts(robot):
    """What a description says of each link and joint: words, and numbers in m, rad and kg."""
    links, joints = {}, {}
    for link in robot.findall("link"):
        shape = link.find("visual/geometry")[0]
        sizes = sorted(key for key in shape.attrib if key != "filename")
        mass = link.find("inertial/mass")
        links[link.get("name")] = (
            (shape.tag, *sizes, shape.get("filename")),
            [
                *attributes(shape, *sizes),
                *attributes(link.find("visual/origin"), "xyz", "rpy"),
                *(attributes(mass, "value") if mass is not None else []),
            ],
        )
    for joint in robot.findall("joint"):
        limit = joint.find("limit")
        limits = sorted(limit.attrib) if limit is not None else []
        ends = [joint.find(end).get("link") for end in ("parent", "child")]
        joints[joint.get("name")] = (
            (joint.get("type"), *ends, *limits),
            [*attributes(joint.find("origin"), "xyz", "rpy"), *attributes(limit, *limits), *attributes(joint.find("axis"), "xyz")],
        )
    return links, joints


def assert_same(some, others):
    assert set(some) == set(others)
    for name, (words, numbers) in some.items():
        assert words == others[name][0], name
        assert numbers == pytest.approx(others[name][1], abs=2e-4), name


def test_eight_steps():
    assert [path.name[:2] for path in STEPS] == ["01", "02", "03", "04", "05", "06", "07", "08"]


@pytest.mark.parametrize("step", STEPS, ids=lambda path: path.name)
def test_one_tree(step):
    robot = expanded(step)
    links = {link.get("name") for link in robot.findall("link")}
    children = [joint.find("child").get("link") for joint in robot.findall("joint")]
    assert len(set(children)) == len(children) and links - set(children) == {"base_link"}
    for mesh in robot.iter("mesh"):
        assert (HERE / mesh.get("filename").replace("package://urdf_tutorial/", "")).is_file()


def test_macros_make_the_same_droid():
    links, joints = facts(expanded(HERE / "urdf/08-macroed.urdf.xacro"))
    plain_links, plain_joints = facts(expanded(HERE / "urdf/07-physics.urdf"))
    for both in (links, plain_links):
        del both["box"]  # with macros it stands half its length further back
    del joints["tobox"], plain_joints["tobox"]
    assert_same(links, plain_links)
    assert_same(joints, plain_joints)


def test_joints_that_move():
    _, joints = facts(expanded(HERE / "urdf/06-flexible.urdf"))
    assert {name for name, said in joints.items() if said[0][0] != "fixed"} == {
        "head_swivel",
        "gripper_extension",
        "left_gripper_joint",
        "right_gripper_joint",
        "left_front_wheel_joint",
        "left_back_wheel_joint",
        "right_front_wheel_joint",
        "right_back_wheel_joint",
    }

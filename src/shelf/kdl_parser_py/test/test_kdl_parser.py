"""Trees of KDL against the same robots on paper."""

import math

import numpy as np
import PyKDL
import pytest
from kdl_parser_py.urdf import treeFromFile, treeFromString, treeFromUrdfModel
from urdf_parser_py.urdf import URDF

ROBOT = """<robot name="r"><link name="base"/>
<joint name="turn" type="continuous"><origin xyz="0 0 1" rpy="0 0 1.5707963267948966"/><parent link="base"/><child link="arm"/>
<axis xyz="0 1 0"/></joint>
<link name="arm"><inertial><origin xyz="0.1 0.2 0.3" rpy="0 0 1.5707963267948966"/><mass value="2"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="4" iyz="0" izz="9"/></inertial></link>
<joint name="slide" type="prismatic"><origin xyz="1 0 0"/><parent link="arm"/><child link="tip"/><axis xyz="1 0 0"/>
<limit lower="0" upper="1" effort="1" velocity="1"/></joint><link name="tip"/>
<joint name="stuck" type="fixed"><origin xyz="0 0 0.5"/><parent link="tip"/><child link="tool"/></joint><link name="tool"/></robot>"""


def place(tree, *positions):
    chain = tree.getChain("base", "tool")
    assert chain.getNrOfJoints() == len(positions)
    joints = PyKDL.JntArray(len(positions))
    for i, position in enumerate(positions):
        joints[i] = position
    frame = PyKDL.Frame()
    assert PyKDL.ChainFkSolverPos_recursive(chain).JntToCart(joints, frame) >= 0
    return list(frame.p)


def test_the_hand_is_where_it_is_on_paper(tmp_path):
    (tmp_path / "r.urdf").write_text(ROBOT)
    for done, tree in (treeFromString(ROBOT), treeFromFile(str(tmp_path / "r.urdf")), treeFromUrdfModel(URDF.from_xml_string(ROBOT))):
        assert done and (tree.getNrOfSegments(), tree.getNrOfJoints()) == (3, 2)
        np.testing.assert_allclose(place(tree, 0.0, 0.0), [0, 1, 1.5], atol=1e-12)
        np.testing.assert_allclose(place(tree, 0.0, 0.25), [0, 1.25, 1.5], atol=1e-12)
        # about its own y by 90 degrees: what lay ahead points down, what stood up points ahead, which is the base's y
        np.testing.assert_allclose(place(tree, math.pi / 2, 0.0), [0, 0.5, 0], atol=1e-12)


def test_moments_of_inertia_are_turned_and_the_centre_of_mass_is_not():
    inertia = treeFromString(ROBOT)[1].getChain("base", "tool").getSegment(0).getInertia()
    assert inertia.getMass() == 2 and list(inertia.getCOG()) == pytest.approx([0.1, 0.2, 0.3])
    moments = inertia.getRotationalInertia()  # about the link's origin: Steiner's share is m (c.c E - c c^T)
    c = np.array([0.1, 0.2, 0.3])
    expected = np.diag([4, 1, 9]) + 2 * (c @ c * np.eye(3) - np.outer(c, c))
    np.testing.assert_allclose([[moments[3 * i + j] for j in range(3)] for i in range(3)], expected, atol=1e-9)


def test_a_child_without_a_link_ends_the_tree():
    done, tree = treeFromString(ROBOT.replace('<link name="tool"/>', ""))
    assert not done and tree.getNrOfSegments() == 2


def test_an_inertia_of_the_root_is_told(capsys):
    robot = ROBOT.replace('<link name="base"/>', '<link name="base"><inertial><mass value="1"/></inertial></link>')
    assert treeFromString(robot)[0] and "The root link base has an inertia" in capsys.readouterr().err
    assert treeFromUrdfModel(URDF.from_xml_string(robot), quiet=True)[0] and capsys.readouterr().err == ""

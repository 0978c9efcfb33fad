"""The UR5's description: kinematics, limits, transmissions, meshes."""

import pathlib
import subprocess
import sys
import xml.etree.ElementTree as ET

import numpy as np
import pytest
import trimesh
from lab_tools.urdf import check, expand, pose_of

PACKAGE = pathlib.Path(__file__).resolve().parents[1]
JOINTS = ("shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3")

# lowest and highest corner of the real links' outlines, m
OUTLINES = {
    "base": ((-0.0736, -0.110, -0.003), (0.0736, 0.0736, 0.021)),
    "shoulder": ((-0.0594, -0.0597, -0.0652), (0.0595, 0.0705, 0.0685)),
    "upperarm": ((-0.0599, -0.0652, -0.0597), (0.0595, 0.0686, 0.4849)),
    "forearm": ((-0.0579, -0.0572, -0.0580), (0.0585, 0.0545, 0.4313)),
    "wrist1": ((-0.0386, 0.0475, -0.0572), (0.0389, 0.1325, 0.0475)),
    "wrist2": ((-0.0389, -0.0572, 0.0491), (0.0387, 0.0475, 0.1334)),
    "wrist3": ((-0.0375, 0.0473, -0.0375), (0.0375, 0.0818, 0.0430)),
}


def xacro(name="ur5_robot", *arguments):
    return expand(PACKAGE / "urdf" / (name + ".urdf.xacro"), *arguments)


def limits(text):
    return {
        joint.get("name"): (float(joint.find("limit").get("lower")), float(joint.find("limit").get("upper")))
        for joint in ET.fromstring(text).findall("joint[@type='revolute']")
    }


@pytest.mark.parametrize("name", ["ur5_robot", "ur5_joint_limited_robot"])
def test_check_urdf_accepts(name, tmp_path):
    check(xacro(name), tmp_path)


@pytest.mark.parametrize("tip", ["ee_link", "tool0"])
def test_stretched_out_along_x(tip):
    assert pose_of(xacro(), tip, "base_link")[:3, 3] == pytest.approx((0.81725, 0.19145, -0.005491), abs=1e-9)


def test_against_denavit_hartenberg():
    """The same pose by the arm's Denavit-Hartenberg table, from the frame `base` to `tool0`."""
    angles = (0.3, -1.1, 1.4, -0.6, 0.8, 2.0)
    table = (
        (0, 0.089159, np.pi / 2),
        (-0.425, 0, 0),
        (-0.39225, 0, 0),
        (0, 0.10915, np.pi / 2),
        (0, 0.09465, -np.pi / 2),
        (0, 0.0823, 0),
    )  # a, d, alpha
    expected = np.eye(4)
    for q, (a, d, alpha) in zip(angles, table):
        c, s, ca, sa = np.cos(q), np.sin(q), np.cos(alpha), np.sin(alpha)
        expected = expected @ np.array([[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]])
    positions = {stem + "_joint": q for stem, q in zip(JOINTS, angles)}
    pose = np.linalg.inv(pose_of(xacro(), "base", "base_link")) @ pose_of(xacro(), "tool0", "base_link", positions)
    np.testing.assert_allclose(pose, expected, atol=1e-9)


def test_limits():
    full, half = limits(xacro()), limits(xacro("ur5_joint_limited_robot"))
    assert list(full) == [stem + "_joint" for stem in JOINTS]
    for name in full:
        assert half[name] == pytest.approx((-np.pi, np.pi))
        assert full[name] == pytest.approx((-np.pi, np.pi) if name == "elbow_joint" else (-2 * np.pi, 2 * np.pi))


def test_macro_parameters(tmp_path):
    path = tmp_path / "two.urdf.xacro"
    path.write_text("""<robot name="two" xmlns:xacro="http://wiki.ros.org/xacro">
        <xacro:include filename="$(find ur_description)/urdf/ur5.urdf.xacro"/>
        <link name="world"/>
        <joint name="l" type="fixed"><parent link="world"/><child link="left_base_link"/></joint>
        <joint name="r" type="fixed"><parent link="world"/><child link="right_base_link"/></joint>
        <xacro:ur5_robot prefix="left_" joint_limited="true" elbow_joint_lower_limit="-1.5" safety_limits="true"/>
        <xacro:ur5_robot prefix="right_" joint_limited="false"
                         transmission_hw_interface="hardware_interface/EffortJointInterface"/>
        </robot>""")
    text = expand(path)
    check(text, tmp_path)
    robot = ET.fromstring(text)
    assert limits(text)["left_elbow_joint"] == pytest.approx((-1.5, np.pi))
    safety = robot.find("joint[@name='left_elbow_joint']/safety_controller")
    assert float(safety.get("soft_lower_limit")) == pytest.approx(-1.35)
    assert robot.find("joint[@name='right_elbow_joint']/safety_controller") is None
    interfaces = {joint.get("name"): joint.find("hardwareInterface").text for joint in robot.findall("transmission/joint")}
    assert interfaces == {
        **{"left_%s_joint" % stem: "hardware_interface/PositionJointInterface" for stem in JOINTS},
        **{"right_%s_joint" % stem: "hardware_interface/EffortJointInterface" for stem in JOINTS},
    }


@pytest.mark.parametrize("name", OUTLINES)
@pytest.mark.parametrize("kind", ["visual/%s.dae", "collision/%s.stl"])
def test_mesh_outlines(kind, name):
    mesh = trimesh.load(PACKAGE / "meshes" / "ur5" / (kind % name), force="mesh")
    np.testing.assert_allclose(mesh.bounds, OUTLINES[name], atol=7e-4)


@pytest.mark.slow
def test_meshes_are_in_step(tmp_path):
    subprocess.run([sys.executable, PACKAGE / "scripts" / "make_meshes.py", tmp_path], check=True)
    for drawn in tmp_path.glob("*/*"):
        shipped = trimesh.load(PACKAGE / "meshes" / "ur5" / drawn.relative_to(tmp_path), force="mesh")
        again = trimesh.load(drawn, force="mesh")
        assert len(shipped.faces) == len(again.faces), drawn
        for measure in ("bounds", "area", "volume", "moment_inertia"):  # which way a cap is cut into triangles may differ
            np.testing.assert_allclose(
                getattr(shipped, measure), getattr(again, measure), rtol=1e-4, atol=1e-8, err_msg=f"{drawn} {measure}"
            )

"""The arm's description: frames, limits, inertias, meshes, and generated files in step with their sources."""

import pathlib
import subprocess
import sys
import xml.etree.ElementTree as ET

import numpy as np
import pytest
import trimesh
from lab_tools.urdf import check, expand, numbers, pose_of

PACKAGE = pathlib.Path(__file__).resolve().parents[1]
MOVING = ("j0", "j1", "j2", "j3")

# mesh: lowest and highest corner in metres, after the URDF's scale
BOUNDS = {
    "base_link": ((-0.0452, -0.0451, -0.0313), (0.0452, 0.0449, 0.0487)),
    "base_turn": ((-0.0285, -0.0279, -0.0019), (0.0315, 0.0504, 0.0051)),
    "base_turn_table_rot": ((-0.0280, -0.0278, -0.0071), (0.0280, 0.0278, 0.0136)),
    "dyn": ((-0.0115, -0.0160, -0.0190), (0.0385, 0.0160, 0.0210)),
    "f4_n_f3": ((-0.0274, -0.0603, -0.0143), (0.0206, 0.0313, 0.0143)),
    "wrist": ((-0.0202, -0.0273, -0.0315), (0.0280, 0.0274, 0.0115)),
    "the_crawer_base": ((-0.0522, -0.0240, -0.0020), (0.0522, 0.0338, 0.0030)),
    "the_crawer": ((-0.0147, -0.0156, -0.0142), (0.0482, 0.0156, 0.0267)),
}


def xacro(*arguments):
    return expand(PACKAGE / "urdf" / "arm.urdf.xacro", *arguments)


@pytest.fixture(scope="module")
def robot():
    return ET.fromstring(xacro())


@pytest.mark.parametrize(
    "angle, link, origin",
    [
        (0.0, "dyn2", (-0.0011, 0.0045, 0.1015)),
        (0.0, "dyn3", (-0.0002, 0.0045, 0.2130)),
        (0.0, "dyn4", (0.0017, 0.0048, 0.3240)),
        (0.0, "crawer_base", (0.0007, -0.0102, 0.3875)),
        (1.0, "dyn3", (0.0783, -0.0454, 0.1618)),
        (1.0, "dyn4", (0.1644, -0.0984, 0.1158)),
        (1.0, "crawer_base", (0.1590, -0.0959, 0.0508)),
    ],
)
def test_frames(angle, link, origin):
    pose = pose_of(xacro(), link, "base_link", dict.fromkeys(MOVING, angle))
    assert pose[:3, 3] == pytest.approx(origin, abs=6e-5)  # the figures have four decimals


def test_four_joints_with_limits(robot):
    limits = {joint.get("name"): joint.find("limit").attrib for joint in robot.findall("joint[@type='revolute']")}
    assert tuple(limits) == MOVING
    assert {float(limit["velocity"]) for limit in limits.values()} == {0.1}
    assert [float(limits[name]["upper"]) for name in MOVING] == [2.57, 3.14, 3.14, 3.14]


def test_every_inertia_is_that_of_a_solid_body(robot):
    tensors = robot.findall("link/inertial/inertia")
    assert len(tensors) == 14
    for tensor in tensors:
        ixx, iyy, izz = (float(tensor.get(key)) for key in ("ixx", "iyy", "izz"))
        assert 0 < max(ixx, iyy, izz) < 1e-3
        assert ixx + iyy >= izz and iyy + izz >= ixx and izz + ixx >= iyy


def test_bolted_or_free():
    assert '<link name="world"/>' in xacro()
    free = ET.fromstring(xacro("bolted:=false"))
    assert "world" not in {link.get("name") for link in free.findall("link")}


def test_hardware_interface_reaches_every_transmission():
    robot = ET.fromstring(xacro("hardware_interface:=EffortJointInterface"))
    found = [(joint.get("name"), joint.find("hardwareInterface").text) for joint in robot.findall("transmission/joint")]
    assert found == [(name, "EffortJointInterface") for name in MOVING]


@pytest.mark.parametrize("bolted", ["true", "false"])
def test_check_urdf_accepts(tmp_path, bolted):
    check(xacro("bolted:=" + bolted), tmp_path)


def test_plain_urdf_is_in_step():
    assert (PACKAGE / "urdf" / "arm.urdf").read_text() == xacro(), "run: cd urdf && xacro arm.urdf.xacro > arm.urdf"


def test_meshes_are_in_step(tmp_path):
    subprocess.run([sys.executable, PACKAGE / "scripts" / "make_meshes.py", tmp_path], check=True)
    for name in BOUNDS:
        shipped, drawn = (trimesh.load(folder / (name + ".stl")) for folder in (PACKAGE / "meshes", tmp_path))
        assert len(shipped.faces) == len(drawn.faces), name
        for measure in ("bounds", "area", "volume", "moment_inertia"):  # which way a cap is cut into triangles may differ
            np.testing.assert_allclose(
                getattr(shipped, measure), getattr(drawn, measure), rtol=1e-5, atol=1e-3, err_msg=f"{name} {measure}"
            )


@pytest.mark.parametrize("name", BOUNDS)
def test_mesh_sizes(robot, name):
    element = robot.find(f".//visual/geometry/mesh[@filename='package://arm_description/meshes/{name}.stl']")
    mesh = trimesh.load(PACKAGE / "meshes" / (name + ".stl"))
    mesh.apply_scale(numbers(element.get("scale")))
    np.testing.assert_allclose(mesh.bounds, BOUNDS[name], atol=2e-4)

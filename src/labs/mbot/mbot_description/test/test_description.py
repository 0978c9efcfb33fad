"""Every variant of the robot: valid, standing on the floor, sensors in place; generated files in step."""

import pathlib
import subprocess
import sys
import xml.etree.ElementTree as ET

import numpy as np
import pytest
import trimesh
from lab_tools.urdf import check, expand, pose_of

PACKAGE = pathlib.Path(__file__).resolve().parents[1]
XACRO = PACKAGE / "urdf" / "xacro"
VARIANTS = [XACRO / (name + ".xacro") for name in ("mbot", "mbot_with_camera", "mbot_with_kinect", "mbot_with_laser")]
GAZEBO = [XACRO / "gazebo" / (path.stem + "_gazebo.xacro") for path in VARIANTS]
SENSORS = {  # link: (its origin in base_link, m; library of its plugin)
    "camera_link": ((0.17, 0, 0.10), "libgazebo_ros_camera.so"),
    "kinect_link": ((0.15, 0, 0.11), "libgazebo_ros_openni_kinect.so"),
    "laser_link": ((0, 0, 0.105), "libgazebo_ros_laser.so"),
}


def identify(path):
    return path.stem


@pytest.mark.parametrize("path", VARIANTS + GAZEBO, ids=identify)
def test_check_urdf_accepts(path, tmp_path):
    check(expand(path), tmp_path)


@pytest.mark.parametrize("path", VARIANTS + GAZEBO, ids=identify)
def test_stands_on_the_floor(path):
    """Wheels (0.06 m) and casters (0.015 m) all touch z = 0; left is +y, front is +x."""
    text = expand(path)
    places = {
        name: pose_of(text, name + "_link", "base_footprint")[:3, 3]
        for name in ("left_wheel", "right_wheel", "front_caster", "back_caster")
    }
    expected = {
        "left_wheel": (0, 0.19, 0.06),
        "right_wheel": (0, -0.19, 0.06),
        "front_caster": (0.18, 0, 0.015),
        "back_caster": (-0.18, 0, 0.015),
    }
    for name, place in places.items():
        assert place == pytest.approx(expected[name]), name


@pytest.mark.parametrize("path, link", zip(VARIANTS[1:], SENSORS), ids=lambda value: getattr(value, "stem", value))
def test_sensor_is_mounted(path, link):
    place, library = SENSORS[link]
    assert pose_of(expand(path), link, "base_link")[:3, 3] == pytest.approx(place)
    gazebo = ET.fromstring(expand(XACRO / "gazebo" / (path.stem + "_gazebo.xacro")))
    plugin = gazebo.find("gazebo[@reference='%s']/sensor/plugin" % link)
    assert plugin.get("filename") == library


def test_optical_frame_looks_along_the_kinect():
    pose = pose_of(expand(VARIANTS[2]), "kinect_frame_optical", "kinect_link")
    np.testing.assert_allclose(pose[:3, 2], (1, 0, 0), atol=1e-5)
    np.testing.assert_allclose(pose[:3, 0], (0, -1, 0), atol=1e-5)


def test_wheel_spins_about_its_axle():
    """The axle is the axis of the larger moment of inertia."""
    inertial = ET.fromstring(expand(VARIANTS[0])).find("link[@name='left_wheel_link']/inertial")
    moments = {key: float(inertial.find("inertia").get(key)) for key in ("ixx", "iyy", "izz")}
    assert moments == pytest.approx({"ixx": 0.000190417, "iyy": 0.000190417, "izz": 0.00036}, rel=1e-5)
    assert inertial.find("origin").get("rpy").split()[1:] == ["0", "0"]
    assert float(inertial.find("origin").get("rpy").split()[0]) == pytest.approx(np.pi / 2, abs=1e-6)


def test_drive_plugin_fits_the_wheels():
    plugin = ET.fromstring(expand(GAZEBO[0])).find("gazebo/plugin[@filename='libgazebo_ros_diff_drive.so']")
    assert float(plugin.find("wheelSeparation").text) == pytest.approx(0.38)
    assert float(plugin.find("wheelDiameter").text) == pytest.approx(0.12)
    assert [plugin.find(side + "Joint").text for side in ("left", "right")] == ["left_wheel_joint", "right_wheel_joint"]


@pytest.mark.parametrize("name, sensor", [("base", "none"), ("with_camera", "camera"), ("with_kinect", "kinect"), ("with_laser", "laser")])
def test_plain_urdf_is_in_step(name, sensor, tmp_path):
    folder = PACKAGE / "urdf" / "urdf"
    text = (folder / ("mbot_%s.urdf" % name)).read_text()
    assert text == expand(folder / "mbot.urdf.xacro", "sensor:=" + sensor)
    check(text, tmp_path)


def test_kinect_mesh(tmp_path):
    subprocess.run([sys.executable, PACKAGE / "scripts" / "make_meshes.py", tmp_path], check=True)
    drawn, shipped = (trimesh.load(folder / "kinect.dae", force="mesh") for folder in (tmp_path, PACKAGE / "meshes"))
    np.testing.assert_allclose(shipped.triangles, drawn.triangles, atol=1e-5)
    np.testing.assert_allclose(shipped.bounds, [(-0.1393, -0.0363, -0.035), (0.1393, 0.0363, 0.035)], atol=2e-4)

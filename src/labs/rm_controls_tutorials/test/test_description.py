"""The tutorial robot: what its pendulum depends on, and controllers that fit it."""

import pathlib
import xml.etree.ElementTree as ET

import pytest
import yaml
from lab_tools.urdf import check, expand, numbers, pose_of

PACKAGE = pathlib.Path(__file__).resolve().parents[1]


@pytest.fixture(scope="module")
def text():
    return expand(PACKAGE / "urdf" / "rmrobot.urdf.xacro")


def test_check_urdf_accepts(text, tmp_path):
    check(text, tmp_path)


def test_pendulum(text):
    """Mass, lever and inertia about joint1: 0.5 kg at 0.2 m, 0.030833 kg m2; level at angle 0."""
    link = ET.fromstring(text).find("link[@name='link2']/inertial")
    mass = float(link.find("mass").get("value"))
    lever = numbers(link.find("origin").get("xyz"))[2]
    about_centre = float(link.find("inertia").get("iyy"))
    assert (mass, lever) == (0.5, pytest.approx(0.2))
    assert about_centre + mass * lever**2 == pytest.approx(0.030833, abs=1e-6)
    along_bar = pose_of(text, "link2", "world")[:3, 2]
    assert along_bar == pytest.approx((1, 0, 0), abs=1e-3)  # 1.57 is not quite a right angle


def test_gearbox_reaches_the_motor(text):
    transmission = ET.fromstring(text).find("transmission")
    motor = transmission.find("actuator")
    assert float(motor.find("mechanicalReduction").text) == 19.2032
    motors = yaml.safe_load((PACKAGE / "config" / "rm_hw.yaml").read_text())["rm_hw"]["actuators"]
    assert list(motors) == [motor.get("name")]


def test_controllers_name_the_joint(text):
    joint = ET.fromstring(text).find("transmission/joint").get("name")
    controllers = yaml.safe_load((PACKAGE / "config" / "controllers.yaml").read_text())["controllers"]
    assert len(controllers) == 3
    assert all(c["joint"] == joint for name, c in controllers.items() if name != "joint_state_controller")

"""The UR5 on its pedestal: one tree from `world`, the arm on top."""

import pathlib
import xml.etree.ElementTree as ET

import pytest
from lab_tools.urdf import check, expand, pose_of

XACRO = pathlib.Path(__file__).resolve().parents[1] / "urdf" / "myur5.urdf.xacro"


def test_arm_stands_on_the_pedestal(tmp_path):
    text = expand(XACRO)
    check(text, tmp_path)
    assert pose_of(text, "tool0", "world")[:3, 3] == pytest.approx((0.81725, 0.19145, 0.994509), abs=1e-9)


def test_interface_argument():
    robot = ET.fromstring(expand(XACRO, "transmission_hw_interface:=hardware_interface/EffortJointInterface"))
    assert {element.text for element in robot.findall("transmission/joint/hardwareInterface")} == {
        "hardware_interface/EffortJointInterface"
    }

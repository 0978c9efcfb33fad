"""The plugin of cameras, on a sensor that sees through a wide-angle lens."""

import xml.etree.ElementTree as ET
from types import SimpleNamespace

import pytest
from gazebo_plugins.cameras.ros_camera import camera_of
from gazebo_ros.plugin import PluginError
from ode_sim.description.model import Pose

CAMERA = """<camera name="eye"><horizontal_fov>{fov}</horizontal_fov><image><width>320</width><height>240</height></image>
<lens><type>custom</type><custom_function><c1>1.05</c1><c2>4</c2><f>1</f><fun>tan</fun></custom_function></lens></camera>"""


def made(kind, fov):
    sensor = SimpleNamespace(
        name="eye",
        scoped_name="m::l::eye",
        link=SimpleNamespace(scoped_name="m::l"),
        model=SimpleNamespace(name="m"),
        description=SimpleNamespace(type=kind, pose=Pose()),
    )
    return camera_of(sensor, SimpleNamespace(get=lambda name, default: default), ET.fromstring(CAMERA.format(fov=fov)))


def test_the_lens_of_a_wideanglecamera_counts_and_that_of_a_plain_one_does_not():
    assert made("wideanglecamera", 3.183).lens.c2 == 4.0
    assert made("camera", 1.0).lens is None
    with pytest.raises(PluginError, match="sensor 'eye': horizontal_fov 3.183 rad; it must be between"):
        made("camera", 3.183)

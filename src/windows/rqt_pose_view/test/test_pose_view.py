"""Quaternions of messages, the picture of the box, and the window without display and master."""

import math
from io import BytesIO

import numpy as np
import pytest

from rqt_testing.in_process import errors, find, open_plugin, rospy_without_master, wait_until  # isort: skip
import rospy
from geometry_msgs.msg import Pose, PoseArray, PoseStamped, Quaternion, TransformStamped
from nav_msgs.msg import Odometry
from rqt_pose_view.poses import Camera, quaternion_path, rotation
from sensor_msgs.msg import Imu
from std_msgs.msg import String


@pytest.mark.parametrize(
    "kind, path",
    [
        (Quaternion, []),
        (Pose, ["orientation"]),
        (PoseStamped, ["pose", "orientation"]),
        (Imu, ["orientation"]),
        (Odometry, ["pose", "pose", "orientation"]),
        (TransformStamped, ["transform", "rotation"]),
        (String, None),
        (PoseArray, None),
    ],
)
def test_where_the_quaternion_is(kind, path):
    assert quaternion_path(kind) == path


def test_rotations():
    half = math.sqrt(0.5)
    assert np.allclose(rotation((0, 0, half, half)) @ [1, 0, 0], [0, 1, 0])
    assert np.allclose(rotation((0, 0, 2, 2)), rotation((0, 0, half, half)))  # any length
    assert rotation((0, 0, 0, 0)) is None and rotation((math.nan, 0, 0, 1)) is None


def test_camera_sees_z_up_and_near_things_larger():
    camera = Camera()
    origin, above, near = camera.project(np.array([[0, 0, 0], [0, 0, 1], camera.position / 2]))
    assert origin[:2].tolist() == pytest.approx([0, 0]) and above[1] > 0.1 and abs(above[0]) < 1e-9 and near[2] < origin[2]
    camera.turn(0, 100)
    assert camera.elevation < math.pi / 2


def send(gui, message):
    buffer = BytesIO()
    message.serialize(buffer)
    raw = rospy.AnyMsg()
    raw._buff, raw._connection_header = buffer.getvalue(), {"type": message._type}
    gui.plugin._receive(gui.plugin._topic, raw)


def count(widget, test):
    image = widget.grab().toImage()
    return sum(test(image.pixelColor(x, y)) for x in range(0, image.width(), 3) for y in range(0, image.height(), 3))


def test_window(tmp_path):
    rospy_without_master()
    settings = str(tmp_path / "a.ini")
    with open_plugin("rqt_pose_view", settings=settings) as gui:
        pose = find(gui, "pose")
        gui.plugin.show_topic("/odom")
        assert pose._text == "waiting for /odom"
        message = Odometry()
        message.pose.pose.orientation.z = message.pose.pose.orientation.w = math.sqrt(0.5)
        send(gui, message)
        wait_until(lambda: pose._text == "roll 0.0\u00b0  pitch 0.0\u00b0  yaw 90.0\u00b0")
        assert count(pose, lambda c: c.blue() > 220 and c.red() < 70) > 100  # its upper face
        message.pose.pose.orientation.w, message.pose.pose.orientation.z = 0.0, 0.0
        message.pose.pose.orientation.x = 1.0
        send(gui, message)
        wait_until(lambda: "roll 180.0" in pose._text)
        assert count(pose, lambda c: c.blue() > 220 and c.red() < 70) < 100 < count(pose, lambda c: c.blue() > 240 and c.red() > 140)
        send(gui, Pose())
        wait_until(lambda: "no rotation: (0, 0, 0, 0)" in pose._text)
        assert errors == []
        send(gui, String("x"))
        wait_until(lambda: errors)
        assert "/odom is of type std_msgs/String, which has no quaternion" in errors[0]
        pose.camera.turn(1.0, 0.1)
        turned = pose.camera.azimuth
    with open_plugin("rqt_pose_view", settings=settings) as gui:
        assert find(gui, "topic").text() == "/odom" and find(gui, "pose").camera.azimuth == pytest.approx(turned)
        find(gui, "pose").reset_view()
        assert find(gui, "pose").camera.azimuth == pytest.approx(math.radians(35))
    assert errors == []

"""What the tabs make of messages: pictures, plots, scans; options and the window's command. No master."""

import math

import numpy as np
import pytest
from gzclient import command_line, desktop
from gzclient.images import picture_of
from gzclient.panels.topics import number_at
from gzclient.sensor_frames import field_of_view, find_frame, optical, range_cone, scan_points
from ode_sim.description import model as d
from ode_sim.description import read_model
from ode_sim.math3 import Pose
from ode_sim_viewer import ModelRecord, Refused, WorldRecord
from sensor_msgs.msg import CompressedImage, Image, JointState, LaserScan, Range

ROBOT = """<robot name="r"><link name="base"/><link name="eye"><inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
<joint name="f" type="fixed"><parent link="base"/><child link="eye"/><origin xyz=".3 0 .2"/></joint>
<gazebo reference="eye"><sensor name="cam" type="camera"><camera><horizontal_fov>1.5</horizontal_fov></camera>
<plugin name="p" filename="libgazebo_ros_camera.so"><frameName>/robot/eye_optical</frameName></plugin></sensor></gazebo>
</robot>"""


def image(encoding, data, width, height, step):
    return Image(encoding=encoding, data=data, width=width, height=height, step=step)


@pytest.mark.parametrize(
    "encoding, data, first",
    [
        ("rgb8", [1, 2, 3, 4, 5, 6], (1, 2, 3)),
        ("bgr8", [1, 2, 3, 4, 5, 6], (3, 2, 1)),
        ("8UC3", [1, 2, 3, 4, 5, 6], (3, 2, 1)),
        ("mono8", [9, 8], (9, 9, 9)),
        ("rgba8", [1, 2, 3, 255, 4, 5, 6, 255], (1, 2, 3)),
    ],
)
def test_pictures(encoding, data, first):
    assert tuple(picture_of(image(encoding, bytes(data), 2, 1, len(data)))[0, 0]) == first


def test_rows_may_be_padded_and_big_endian():
    padded = image("mono8", bytes([1, 2, 0, 0, 3, 4, 0, 0]), 2, 2, 4)
    assert picture_of(padded)[1, 1, 0] == 4
    depth = image("16UC1", np.array([[1000, 3000]], ">u2").tobytes(), 2, 1, 4)
    depth.is_bigendian = 1
    near, far = picture_of(depth)[0, :, 0]
    assert near == 255 and far == 20


def test_depth_without_a_value_is_black():
    depth = image("32FC1", np.array([[np.nan, np.inf, 2.0]], "<f4").tobytes(), 3, 1, 12)
    assert list(picture_of(depth)[0, :, 0]) == [0, 0, 255]
    assert not picture_of(image("32FC1", np.full((1, 2), np.nan, "<f4").tobytes(), 2, 1, 8)).any()


@pytest.mark.parametrize(
    "message, said",
    [
        (image("rgb8", b"123", 2, 1, 6), "3 bytes of data"),
        (image("rgb8", b"123456", 2, 1, 3), "step is 3"),
        (image("yuv9", b"1234", 2, 1, 4), "yuv9"),
        (image("rgb8", b"", 0, 0, 0), "0x0"),
        (image("rgb8", b"", 100_000, 100_000, 300_000), "pixels"),
        (CompressedImage(format="jpeg", data=b"no"), "jpeg"),
    ],
)
def test_broken_pictures_are_refused(message, said):
    with pytest.raises(ValueError, match=said):
        picture_of(message)


def test_numbers_of_messages():
    message = JointState(name=["a"], position=[1.5, 2.5])
    message.header.stamp.secs = 3
    assert number_at(message, "position[1]") == 2.5 and number_at(message, "/header/stamp") == 3.0
    for path in ("velocity[0]", "nothing", "name", "name[0]", "position[x]", "__class__", "header.__init__"):
        with pytest.raises(Refused):
            number_at(message, path)


@pytest.fixture(scope="module")
def world():
    model = read_model(ROBOT)[0]
    other = d.Model("other", links=(d.Link("laser"),))
    return WorldRecord(1, "w", (ModelRecord("r", model), ModelRecord("other", other)))


def test_frames_of_sensors_are_found_also_when_their_link_was_merged(world):
    model, link, pose = find_frame(world, "robot/eye_optical")
    assert (model, link) == ("r", "base") and np.allclose(pose.p, (0.3, 0.0, 0.2))
    assert find_frame(world, "laser") == ("other", "laser", Pose())
    assert find_frame(world, "nowhere") is None and find_frame(world, "") is None
    assert field_of_view(world, "r", "base", "eye_optical") == 1.5
    assert field_of_view(world, "other", "laser", "laser") == 1.047


def test_an_optical_frame_looks_along_z():
    from ode_sim.math3 import rotate

    np.testing.assert_allclose(rotate(optical(Pose()), (0.0, 0.0, 1.0)), (1.0, 0.0, 0.0), atol=1e-12)
    np.testing.assert_allclose(rotate(optical(Pose()), (1.0, 0.0, 0.0)), (0.0, -1.0, 0.0), atol=1e-12)


def test_scan_and_cone():
    scan = LaserScan(
        angle_min=0.0, angle_increment=math.pi / 2, range_min=0.1, range_max=5.0, ranges=[1.0, 2.0, float("inf"), float("nan"), 0.01, 9.0]
    )
    np.testing.assert_allclose(scan_points(scan), [[1, 0, 0], [0, 2, 0]], atol=1e-6)
    many = LaserScan(angle_increment=1e-4, range_max=5.0, ranges=[1.0] * 50_000)
    assert 1000 < len(scan_points(many)) <= 4000
    rim = range_cone(Range(range=2.0, field_of_view=math.pi / 2, max_range=4.0))
    np.testing.assert_allclose(np.linalg.norm(rim[:, 1:], axis=1), 2.0, rtol=1e-6)
    assert range_cone(Range(range=float("inf"), max_range=4.0))[0, 0] == 4.0


def test_options():
    options = command_line.parse(["--verbose", "-g", "libgazebo_ros_paths_plugin.so", "-g", "libmy.so", "--bogus"])
    assert options.verbose and not options.listen
    lines = command_line.remarks(options)
    assert len(lines) == 2 and "libmy.so" in lines[0] and "--bogus" in lines[1]
    with pytest.raises(SystemExit):
        command_line.parse(["--port", "99999"])


def test_the_window_is_a_browser_with_a_profile_of_its_own(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    assert desktop.command("http://x/", "/p") is None
    (tmp_path / "firefox").touch(mode=0o755)
    words = desktop.command("http://x/", "/p")
    assert words == [str(tmp_path / "firefox"), "--no-remote", "--profile", "/p", "http://x/"]
    (tmp_path / "chromium").touch(mode=0o755)
    words = desktop.command("http://x/", "/p")
    assert words[0].endswith("chromium") and "--app=http://x/" in words and "--user-data-dir=/p" in words

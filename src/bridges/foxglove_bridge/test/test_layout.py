"""What a layout shows of what runs. The panels' names are those that Lichtblick registers."""

import io
import json
import os
import tarfile
from dataclasses import replace

import pytest
from foxglove_bridge import page
from foxglove_bridge.layout import Running, described, layout
from foxglove_bridge.settings import BridgeError
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

PANELS = "3D DiagnosticSummary Image Plot Publish RawMessages RosOut Tab Teleop".split()
ARM = Running(
    name="arm",
    frame="world",
    joints={"j0": 0.5, "j1": -0.25},
    published={"/joint_states": "sensor_msgs/JointState", "/tf": "tf2_msgs/TFMessage", "/camera/image_raw": "sensor_msgs/Image",
               "/camera/image_raw/compressed": "sensor_msgs/CompressedImage", "/diagnostics": "diagnostic_msgs/DiagnosticArray"},
    subscribed={"/arm_controller/command": "trajectory_msgs/JointTrajectory"},
    described=True,
    moved={"/arm_controller/command": ["j1"]},
)  # fmt: skip
CART = Running(
    published={"/odom": "nav_msgs/Odometry", "/scan": "sensor_msgs/LaserScan", "/cmd_vel": "geometry_msgs/Twist",
               "/front/depth/image_raw": "sensor_msgs/Image", "/rear/image_raw/compressed": "sensor_msgs/CompressedImage"},
    subscribed={"/cmd_vel": "geometry_msgs/Twist"},
)  # fmt: skip


def shown(tree):
    """Identifiers in a tree of panels."""
    return [tree] if isinstance(tree, str) else shown(tree["first"]) + shown(tree["second"])


def panels(running):
    """Identifiers that can be seen, those of tabs with them, and all settings."""
    made = json.loads(json.dumps(layout(running)))
    seen = shown(made["layout"])
    for name in list(seen):
        seen += [tab["layout"] for tab in made["configById"][name].get("tabs", [])]
    return seen, made["configById"]


@pytest.mark.parametrize("running", [Running(), ARM, CART])
def test_each_panel_is_shown_once_and_is_one_that_there_is(running):
    seen, settings = panels(running)
    assert sorted(seen) == sorted(settings)
    assert {name.split("!")[0] for name in seen} <= set(PANELS)


def test_an_arm():
    _, settings = panels(ARM)
    lines = settings["Plot!Joint positions"]["paths"]
    assert [(line["value"], line["label"]) for line in lines] == [("/joint_states.position[0]", "j0"), ("/joint_states.position[1]", "j1")]
    assert settings["3D!scene"]["followTf"] == "world"
    assert settings["3D!scene"]["topics"] == {"param:/robot_description": {"visible": True}}
    assert [settings[name]["imageMode"]["imageTopic"] for name in settings if name.startswith("Image!")] == ["/camera/image_raw"]
    assert settings["DiagnosticSummary!states"]["topicToRender"] == "/diagnostics"
    command = settings["Publish!command"]
    told = json.loads(command["value"])
    assert (command["topicName"], command["datatype"]) == ("/arm_controller/command", "trajectory_msgs/JointTrajectory")
    assert told["joint_names"] == ["j1"] and told["points"][0]["positions"] == [-0.25], "where it stands"
    assert sorted(told) == sorted(JointTrajectory.__slots__)
    assert sorted(told["points"][0]) == sorted(JointTrajectoryPoint.__slots__)


def test_a_cart():
    _, settings = panels(CART)
    assert [line["value"] for line in settings["Plot!Speeds"]["paths"]] == [
        "/odom.twist.twist.linear.x", "/odom.twist.twist.angular.z", "/cmd_vel.linear.x", "/cmd_vel.angular.z",
    ]  # fmt: skip
    assert settings["3D!scene"]["topics"] == {"/scan": {"visible": True}}
    assert settings["Image!0"]["imageMode"]["imageTopic"] == "/rear/image_raw/compressed", "colours before depth"
    assert settings["Teleop!drive"]["topic"] == "/cmd_vel"


def test_speeds_of_joints_are_plotted_where_somebody_tells_them():
    assert "Plot!Joint velocities" not in panels(ARM)[1]
    _, settings = panels(replace(ARM, velocities=True))
    assert settings["Plot!Joint velocities"]["paths"][1]["value"] == "/joint_states.velocity[1]"


def test_joints_that_change_their_places_are_not_plotted():
    assert not [name for name in panels(replace(ARM, velocities=True, one_order=False))[1] if name.startswith("Plot!")]


def test_what_a_description_says():
    urdf = """<robot name="two"><link name="base"/><link name="a"/><link name="b"/>
      <joint name="p" type="fixed"><parent link="base"/><child link="a"/><origin xyz="0 0 0.3"/></joint>
      <joint name="q" type="fixed"><parent link="a"/><child link="b"/><origin xyz="0.4 0 0.3"/></joint></robot>"""
    assert described(urdf) == ("two", "base", pytest.approx(0.8))
    assert described("<robot") == ("robot", "", 1.0)
    loop = """<robot name="l"><link name="a"/><joint name="p" type="fixed"><parent link="a"/><child link="a"/></joint></robot>"""
    assert described(loop)[0] == "l"


def archive(folder, files):
    """A .tar.gz as the releases have it, of ``files``: name -> text."""
    path = folder / "page.tar.gz"
    with tarfile.open(path, "w:gz") as out:
        for name, text in files.items():
            member = tarfile.TarInfo(name)
            member.size = len(text)
            out.addfile(member, io.BytesIO(text.encode()))
    return str(path)


def test_the_page_is_unpacked_and_nothing_beside_it(tmp_path, monkeypatch):
    monkeypatch.setenv("LICHTBLICK_PAGE", str(tmp_path / "here" / "page"))
    assert not page.installed()
    page.install(archive(tmp_path, {"./index.html": "<html>", "assets/a.js": "1", "../outside": "2", "/tmp/absolute": "3"}), print)
    assert page.installed()
    assert sorted(str(p.relative_to(tmp_path)) for p in tmp_path.rglob("*") if p.is_file()) == [
        "here/page/assets/a.js", "here/page/index.html", "page.tar.gz",
    ]  # fmt: skip


def damaged(folder):
    """An archive whose middle is other bytes."""
    path = archive(folder, {"index.html": os.urandom(5000).hex()})
    with open(path, "r+b") as file:
        file.seek(2000)
        file.write(bytes(500))
    return path


def cut(folder):
    """An archive that broke off."""
    path = archive(folder, {"index.html": os.urandom(5000).hex()})
    os.truncate(path, 2000)
    return path


@pytest.mark.parametrize(
    "make",
    [damaged, cut, lambda folder: archive(folder, {"readme": "x"}), lambda folder: str(folder / "none.tar.gz"), lambda folder: __file__],
)
def test_what_is_no_page_is_said_in_a_line(tmp_path, monkeypatch, make):
    monkeypatch.setenv("LICHTBLICK_PAGE", str(tmp_path / "page"))
    source = make(tmp_path)
    with pytest.raises(BridgeError) as caught:
        page.install(source, print)
    assert str(caught.value).startswith(source) and "\n" not in str(caught.value)
    assert not page.installed() and not any(tmp_path.glob("page.new*"))


def test_an_archive_that_is_none_leaves_the_page_that_is_there(tmp_path, monkeypatch):
    monkeypatch.setenv("LICHTBLICK_PAGE", str(tmp_path / "page"))
    page.install(archive(tmp_path, {"index.html": "old", "old.js": ""}), print)
    with pytest.raises(BridgeError):
        page.install(cut(tmp_path), print)
    assert (tmp_path / "page/index.html").read_text() == "old"
    page.install(archive(tmp_path, {"index.html": "new"}), print)
    assert [path.name for path in (tmp_path / "page").iterdir()] == ["index.html"]

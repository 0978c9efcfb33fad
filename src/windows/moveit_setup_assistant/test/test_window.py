"""The window, used by clicks and keys in this process: a package made from nothing, then opened again and edited."""

import os

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import time  # noqa: E402

import numpy as np  # noqa: E402
import pytest  # noqa: E402
from moveit_setup_assistant import headless  # noqa: E402
from moveit_setup_assistant.configuration import Configuration  # noqa: E402
from moveit_setup_assistant.robot_source import RobotSource  # noqa: E402
from moveit_setup_assistant.window import Window  # noqa: E402
from python_qt_binding.QtCore import Qt  # noqa: E402
from python_qt_binding.QtTest import QTest  # noqa: E402
from python_qt_binding.QtWidgets import QApplication, QMessageBox, QWidget  # noqa: E402
from robots import FIVE  # noqa: E402

CONFIG = """
groups:
  arm: {chain: [base, inside], solver: kdl, timeout: 0.02, planner: RRTConnect}
  wing: {joints: [swinging]}
poses:
  - {name: home, group: arm, joints: {turn: 0.5, spin: -0.25}}
end_effectors:
  - {name: hand, group: wing, parent_link: column}
virtual_joints:
  - {name: stand_here, type: fixed, parent_frame: world, child_link: base}
passive_joints: [spin]
collisions: {trials: 1000}
author: {name: Ada, email: ada@example.org}
"""


@pytest.fixture(scope="module")
def app():
    return QApplication.instance() or QApplication([])


@pytest.fixture
def urdf(tmp_path, monkeypatch):
    folder = tmp_path / "src" / "small_description"
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>small_description</name></package>")
    (folder / "small.urdf").write_text(FIVE)
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"{tmp_path / 'src'}:{os.environ.get('ROS_PACKAGE_PATH', '')}")
    return folder / "small.urdf"


class User:
    """Somebody who clicks and types."""

    def __init__(self, window):
        self.window = window

    def widget(self, name):
        found = self.window.findChild(QWidget, name)
        assert found is not None, name
        return found

    def screen(self, title):
        self.window.list.setCurrentItem(self.window.list.findItems(title, Qt.MatchExactly)[0])
        assert self.window.list.currentItem().text() == title

    def click(self, *names):
        for name in names:
            QTest.mouseClick(self.widget(name), Qt.LeftButton)

    def fill(self, **texts):
        for name, text in texts.items():
            widget = self.widget(name)
            if hasattr(widget, "setCurrentText"):
                assert widget.isEditable() or widget.findText(text) >= 0, f"{name} offers no '{text}'"
                widget.setCurrentText(text)
                widget.activated.emit(widget.currentIndex())
            elif hasattr(widget, "setValue"):
                widget.setValue(text)
            else:
                widget.setText("")
                QTest.keyClicks(widget, text)
                QTest.keyClick(widget, Qt.Key_Return)

    def mark(self, name, *texts):
        view = self.widget(name)
        view.clearSelection()
        for text in texts:
            view.findItems(text, Qt.MatchExactly)[0].setSelected(True)

    def said(self):
        return self.widget("said").text()

    def wait(self, condition, what):
        end = time.monotonic() + 60
        while not condition():
            assert time.monotonic() < end, what
            QTest.qWait(10)

    def red_pixels(self):
        """How many pixels of the picture are in the colour of a link that lights up."""
        QTest.qWait(30)
        self.wait(lambda: not self.window.view._timer.isActive(), "picture")
        image = self.window.view.picture()
        pointer = image.bits()
        pointer.setsize(image.sizeInBytes())
        pixels = np.frombuffer(bytes(pointer), np.uint8).reshape(image.height(), image.bytesPerLine())
        rgb = pixels[:, : 3 * image.width()].reshape(image.height(), image.width(), 3).astype(int)
        return int(((rgb[..., 0] > 90) & (rgb[..., 1] < rgb[..., 0] / 3) & (rgb[..., 2] < rgb[..., 0] / 3)).sum())


@pytest.fixture
def user(app):
    window = Window()
    window.show()
    yield User(window)
    window.close()


def test_clicks_and_the_command_write_the_same_files(user, urdf, tmp_path, monkeypatch):
    user.fill(start_path=str(urdf))
    user.click("start_load")
    assert "7 links, 3 joints" in user.said()
    user.screen("Self-Collisions")
    user.fill(collisions_trials=1000)
    user.click("collisions_generate")
    user.wait(lambda: "need no check" in user.said(), "collision matrix")
    user.screen("Virtual Joints")
    user.fill(virtual_joints_name="stand_here", virtual_joints_child_link="base")
    user.click("virtual_joints_add")
    user.screen("Planning Groups")
    user.click("groups_add")
    user.fill(
        groups_name="arm",
        groups_solver="kdl_kinematics_plugin/KDLKinematicsPlugin",
        groups_timeout=0.02,
        groups_planner="RRTConnect",
        groups_base_link="base",
        groups_tip_link="inside",
    )
    assert user.red_pixels() > 50, "the group's links light up"
    user.click("groups_add")
    user.fill(groups_name="wing")
    user.mark("groups_joints_available", "swinging")
    user.click("groups_joints_add")
    user.screen("Robot Poses")
    user.fill(poses_group="arm", poses_name="home", poses_value_turn=0.5, poses_value_spin=-0.25)
    user.click("poses_add")
    user.screen("End Effectors")
    user.fill(end_effectors_name="hand", end_effectors_group="wing", end_effectors_parent_link="column")
    user.click("end_effectors_add")
    user.screen("Passive Joints")
    user.mark("passive_joints_available", "spin")
    user.click("passive_joints_add")
    user.screen("Controllers")
    user.click("controllers_auto")
    user.screen("Author Information")
    user.fill(author_name="Ada", author_email="ada@example.org")
    user.screen("Configuration Files")
    clicked = tmp_path / "small_moveit_config"
    user.fill(files_folder=str(clicked))
    user.click("files_generate")
    assert user.said().startswith("Wrote 43 files"), user.said()

    (tmp_path / "config.yaml").write_text(CONFIG)
    typed = headless.configuration(RobotSource.from_file(urdf), tmp_path / "config.yaml")
    from moveit_setup_assistant import package_writer

    package_writer.write(typed, tmp_path / "typed" / "small_moveit_config")
    for file in sorted(clicked.rglob("*")):
        if file.is_file() and file.name != ".setup_assistant":
            other = tmp_path / "typed" / "small_moveit_config" / file.relative_to(clicked)
            assert file.read_text() == other.read_text(), file.name


@pytest.fixture
def package(urdf, tmp_path):
    from moveit_setup_assistant import package_writer

    (tmp_path / "config.yaml").write_text(CONFIG)
    folder = tmp_path / "small_moveit_config"
    package_writer.write(headless.configuration(RobotSource.from_file(urdf), tmp_path / "config.yaml"), folder)
    return folder


def open_package(user, package):
    user.window.edit(str(package))
    user.wait(lambda: user.window.session.config is not None, "package")


def test_a_package_is_opened_and_edited(user, package):
    open_package(user, package)
    user.screen("Planning Groups")
    user.fill(groups_name="manipulator")
    user.screen("3D Perception")
    user.fill(perception_kind="Point Cloud", perception_point_cloud_topic="/camera/points")
    user.screen("Simulation")
    user.click("simulation_generate")
    user.screen("Configuration Files")
    user.click("files_generate")
    assert user.said().startswith("Wrote"), user.said()
    again = Configuration.load(package)
    assert [group.name for group in again.semantics.groups] == ["manipulator", "wing"]
    assert again.semantics.group_states[0].group == "manipulator"
    assert again.kinematics["manipulator"].timeout == 0.02 and "arm" not in again.kinematics
    assert again.sensors[0]["point_cloud_topic"] == "/camera/points" and again.sensors[0]["max_range"] == 5.0
    assert "SimpleTransmission" in again.gazebo_urdf


def test_deleting_a_group_takes_its_poses_with_it(user, package):
    open_package(user, package)
    user.screen("Planning Groups")
    user.click("groups_delete")
    document = user.window.session.config.semantics
    assert [g.name for g in document.groups] == ["wing"] and not document.group_states
    user.screen("Robot Poses")
    assert user.widget("poses_list").count() == 0


def test_sliders_move_the_robot_and_touching_links_light_up(user, package):
    open_package(user, package)
    user.screen("Robot Poses")
    user.fill(poses_group="wing")
    before = user.window.view._poses.copy()
    user.fill(poses_value_swinging=1.0)
    assert np.abs(user.window.view._poses - before).max() > 0.1
    assert user.widget("poses_collision").text() == "" and user.red_pixels() == 0
    user.fill(poses_value_swinging=-2.95)
    assert "column - swing" in user.widget("poses_collision").text()
    assert user.red_pixels() > 50


def test_what_is_wrong_is_said_and_changes_nothing(user, package, tmp_path, monkeypatch, capsys):
    user.click("start_load")
    assert "Name the robot's URDF" in user.said()
    user.fill(start_path=str(tmp_path / "nowhere.urdf"))
    user.click("start_load")
    assert "there is no such file" in user.said() and user.window.list.item(1).isHidden()
    open_package(user, package)
    user.screen("Planning Groups")
    user.fill(groups_name="two words")
    assert "cannot be a group's name" in user.said()
    user.screen("Controllers")
    user.fill(controllers_name="c", controllers_joints="swinging nobody")
    user.click("controllers_add")
    assert "no joint 'nobody'" in user.said() and not any(c.name == "c" for c in user.window.session.config.controllers)
    user.screen("3D Perception")
    user.fill(perception_kind="Point Cloud", perception_max_range="far")
    user.window.list.setCurrentRow(0)
    assert "'far' is no number" in user.said() and user.window.list.currentItem().text() == "3D Perception"
    user.fill(perception_max_range="3")
    user.screen("Configuration Files")
    (tmp_path / "thesis").mkdir()
    (tmp_path / "thesis" / "chapter.tex").write_text("x")
    user.fill(files_folder=str(tmp_path / "thesis"))
    assert "is not empty" in user.said()
    monkeypatch.setattr(QMessageBox, "question", lambda *_: QMessageBox.Yes)
    user.click("files_generate")
    assert "Name the folder" in user.said()
    assert "moveit_setup_assistant: " in capsys.readouterr().err, "what is wrong is on the terminal too"


def test_what_is_missing_stands_below_the_screen_and_the_rest_can_be_used(user, tmp_path):
    bare = tmp_path / "bare.urdf"
    bare.write_text(
        FIVE.replace(
            '<link name="base">', '<link name="base"><visual><geometry><mesh filename="package://nobody_has/base.dae"/></geometry></visual>'
        )
    )
    user.fill(start_path=str(bare))
    user.click("start_load")
    assert "package://nobody_has/base.dae" in user.said() and "7 links" in user.said()
    user.screen("Planning Groups")
    user.click("groups_add")
    user.mark("groups_joints_available", "turn")
    user.click("groups_joints_add")
    user.screen("Robot Poses")
    user.fill(poses_value_turn=0.5)
    assert user.window.session.config.robot.name == "small"


def test_ticks_of_the_collision_table_are_kept(user, package):
    open_package(user, package)
    user.screen("Self-Collisions")
    table = user.widget("collisions_table")
    user.click("collisions_show_enabled")
    assert table.rowCount() == 10
    rows = {(table.item(r, 0).text(), table.item(r, 1).text()): r for r in range(10)}
    table.item(rows[("column", "swing")], 2).setCheckState(Qt.Checked)
    table.item(rows[("base", "column")], 2).setCheckState(Qt.Unchecked)
    pairs = {(p.link1, p.link2): p.reason for p in user.window.session.config.semantics.disable_collisionss}
    assert pairs[("column", "swing")] == "User" and ("base", "column") not in pairs

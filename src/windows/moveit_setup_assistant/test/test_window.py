"""The window, used by clicks and keys in this process: a package made from nothing, then opened again and edited."""

import numpy as np
from moveit_setup_assistant import headless, package_writer
from moveit_setup_assistant.configuration import Configuration
from moveit_setup_assistant.robot_source import RobotSource
from python_qt_binding.QtCore import Qt
from python_qt_binding.QtWidgets import QMessageBox
from robots import FIVE


def test_clicks_and_the_command_write_the_same_files(user, urdf, config_file, tmp_path):
    user.load(urdf)
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

    typed = headless.configuration(RobotSource.from_file(urdf), config_file)
    package_writer.write(typed, tmp_path / "typed" / "small_moveit_config")
    for file in sorted(clicked.rglob("*")):
        if file.is_file() and file.name != ".setup_assistant":
            other = tmp_path / "typed" / "small_moveit_config" / file.relative_to(clicked)
            assert file.read_text() == other.read_text(), file.name


def test_a_package_is_opened_and_edited(user, package):
    user.open(package)
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
    user.open(package)
    user.screen("Planning Groups")
    user.click("groups_delete")
    document = user.window.session.config.semantics
    assert [g.name for g in document.groups] == ["wing"] and not document.group_states
    user.screen("Robot Poses")
    assert user.widget("poses_list").rowCount() == 0


def test_sliders_move_the_robot_and_touching_links_light_up(user, package):
    user.open(package)
    user.screen("Robot Poses")
    user.fill(poses_group="wing")
    before = user.window.view._poses.copy()
    user.fill(poses_value_swinging=1.0)
    assert np.abs(user.window.view._poses - before).max() > 0.1
    assert user.widget("poses_collision").text() == "" and user.red_pixels() == 0
    user.fill(poses_value_swinging=-2.95)
    assert "column - swing" in user.widget("poses_collision").text()
    assert user.red_pixels() > 50


def test_what_is_wrong_is_said_and_changes_nothing(user, package, tmp_path, capsys):
    user.load(tmp_path / "nowhere.urdf")
    assert "there is no such file" in user.said() and not user.window.list.item(1).flags() & Qt.ItemIsEnabled
    user.open(package)
    user.screen("Planning Groups")
    user.fill(groups_name="two words")
    assert "cannot be a group's name" in user.said()
    user.screen("Controllers")
    user.fill(controllers_name="c", controllers_joints="swinging nobody")
    assert "no joint 'nobody'" in user.widget("controllers_hint").text() and not user.can("controllers_add")
    assert not any(c.name == "c" for c in user.window.session.config.controllers)
    user.screen("3D Perception")
    user.fill(perception_kind="Point Cloud", perception_max_range="far")
    user.window.list.setCurrentRow(0)
    assert "'far' is no number" in user.said() and user.window.list.currentItem().text() == "3D Perception"
    user.fill(perception_max_range="3")
    user.screen("Configuration Files")
    (tmp_path / "thesis").mkdir()
    (tmp_path / "thesis" / "chapter.tex").write_text("x")
    user.fill(files_folder=str(tmp_path / "thesis"))
    assert "is not empty" in user.widget("files_hint").text() and not user.can("files_generate")
    assert "moveit_setup_assistant: " in capsys.readouterr().err, "what is wrong is on the terminal too"


def test_what_is_missing_stands_below_the_screen_and_the_rest_can_be_used(user, tmp_path):
    bare = tmp_path / "bare.urdf"
    bare.write_text(
        FIVE.replace(
            '<link name="base">', '<link name="base"><visual><geometry><mesh filename="package://nobody_has/base.dae"/></geometry></visual>'
        )
    )
    user.load(bare)
    assert "package://nobody_has/base.dae" in user.said() and "7 links" in user.said()
    user.screen("Planning Groups")
    user.click("groups_add")
    user.mark("groups_joints_available", "turn")
    user.click("groups_joints_add")
    user.screen("Robot Poses")
    user.fill(poses_value_turn=0.5)
    assert user.window.session.config.robot.name == "small"


def test_ticks_of_the_collision_table_are_kept(user, package):
    user.open(package)
    user.screen("Self-Collisions")
    table = user.widget("collisions_table")
    user.click("collisions_show_enabled")
    assert table.rowCount() == 10
    rows = {(table.item(r, 0).text(), table.item(r, 1).text()): r for r in range(10)}
    table.item(rows[("column", "swing")], 2).setCheckState(Qt.Checked)
    table.item(rows[("base", "column")], 2).setCheckState(Qt.Unchecked)
    pairs = {(p.link1, p.link2): p.reason for p in user.window.session.config.semantics.disable_collisionss}
    assert pairs[("column", "swing")] == "User" and ("base", "column") not in pairs

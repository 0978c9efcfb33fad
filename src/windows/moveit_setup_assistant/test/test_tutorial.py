"""The tutorial of the UR5 on its pedestal, by clicks and keys on a private X server: the package that comes out has the same
files as the one that the command writes. ``TUTORIAL_PICTURES=FOLDER`` keeps a picture of each step."""

import os
import time
from pathlib import Path

import pytest
import rospkg
from moveit_setup_assistant import headless, package_writer
from moveit_setup_assistant.robot_source import RobotSource
from rqt_testing.desktop import Desktop

HOME = {"shoulder_lift_joint": -1.5707, "elbow_joint": 1.5707, "wrist_1_joint": -1.5707, "wrist_2_joint": -1.5707}
JOINTS = ("shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint", "wrist_1_joint", "wrist_2_joint", "wrist_3_joint")
CONFIG = f"""
groups:
  manipulator: {{chain: [pedestal, tool0], solver: kdl, planner: RRTConnect}}
virtual_joints:
  - {{name: FixedBase, type: fixed, parent_frame: world, child_link: pedestal}}
  - {{name: RobotBase, type: fixed, parent_frame: pedestal, child_link: base_link}}
poses:
  - {{name: AllZeros, group: manipulator, joints: {dict.fromkeys(JOINTS, 0.0)}}}
  - {{name: HomePose, group: manipulator, joints: {dict.fromkeys(JOINTS, 0.0) | HOME}}}
collisions: {{trials: 10000}}
controllers: auto
author: {{name: Ada, email: ada@example.org}}
"""


class Student:
    """Somebody who clicks through the assistant's window."""

    def __init__(self, desktop, window):
        self.desktop, self.window, self.count = desktop, window, 0

    def click(self, name):
        self.window.click(name)

    def screen(self, title):
        self.window.click_text(title)

    def type(self, name, text):
        self.window.click(name, at=(0.3, 0.5))
        self.desktop.keys("ctrl+a")
        self.desktop.type(f"{text}\n")
        self.window.wait(lambda: self.window.text(name).startswith(str(text)[:6]), f"{text} in {name}")

    def choose(self, name, text):
        self.window.click(name)
        time.sleep(0.3)  # the list unfolds
        self.desktop.type(f"{text}\n")
        self.window.wait(lambda: self.window.text(name) == text, f"{text} in {name}")

    def said(self, text):
        self.window.wait(lambda: text in self.window.text("said"), f"'{text}' below the screen")

    def picture(self, name):
        self.count += 1
        folder = os.environ.get("TUTORIAL_PICTURES")
        if folder:
            time.sleep(0.7)  # the robot is drawn beside the window's thread
            self.desktop.screenshot(os.path.join(folder, f"{self.count}_{name}.png"))


@pytest.fixture
def student():
    with Desktop("1200x800x24") as desktop:
        window = desktop.run(["rosrun", "moveit_setup_assistant", "moveit_setup_assistant"])
        window.window("MoveIt Setup Assistant")
        yield Student(desktop, window)
        assert window.end() == 0


@pytest.mark.slow
def test_on_a_small_screen_all_of_the_window_is_seen():
    with Desktop("900x700x24") as desktop:
        window = desktop.run(["rosrun", "moveit_setup_assistant", "moveit_setup_assistant", "--config_pkg", "myur5_moveit_config"])
        window.window("MoveIt Setup Assistant")
        window.wait(lambda: "6 joints that can move" in window.text("said"), "a robot")
        _, _, x, y, width, height = window.window("MoveIt Setup Assistant")
        assert x >= 0 and y >= 0 and x + width <= 900 and y + height <= 700
        left, top, wide, high = window.rect("robot_view")
        assert left + wide <= 900 and top + high <= 700 and wide >= 200
        assert window.end() == 0


def click_through(student, urdf, folder):
    student.click("start_new")
    student.type("start_path", urdf)
    student.click("start_load")
    student.said("6 joints that can move")
    student.picture("start")
    student.screen("Self-Collisions")
    student.click("collisions_generate")
    student.said("need no check")
    student.picture("collisions")
    student.screen("Virtual Joints")
    for name, parent, child in (("FixedBase", "world", "pedestal"), ("RobotBase", "pedestal", "base_link")):
        student.type("virtual_joints_name", name)
        student.type("virtual_joints_parent_frame", parent)
        student.choose("virtual_joints_child_link", child)
        student.click("virtual_joints_add")
    student.picture("virtual_joints")
    student.screen("Planning Groups")
    student.click("groups_add")
    student.type("groups_name", "manipulator")
    student.type("groups_solver", "kdl_kinematics_plugin/KDLKinematicsPlugin")
    student.choose("groups_planner", "RRTConnect")
    student.window.click_text("Kin. Chain")
    student.choose("groups_base_link", "pedestal")
    student.choose("groups_tip_link", "tool0")
    student.picture("groups")
    student.screen("Robot Poses")
    for name, values in (("AllZeros", {}), ("HomePose", HOME)):
        student.type("poses_name", name)
        for joint, value in values.items():
            student.type(f"poses_value_{joint}", value)
        student.click("poses_add")
    student.picture("poses")
    student.screen("Controllers")
    student.click("controllers_auto")
    student.said("1 controller added")
    student.picture("controllers")
    student.screen("Author Information")
    student.type("author_name", "Ada")
    student.type("author_email", "ada@example.org")
    student.picture("author")
    student.screen("Configuration Files")
    student.type("files_folder", folder)
    student.click("files_generate")
    student.window.window("Incomplete")  # there is no end effector: it asks
    student.picture("question")
    student.window.click_text("Yes")
    student.said("files to ~/catkin_ws/src/myur5_moveit_config. Build your workspace")
    student.picture("files")


@pytest.mark.slow
def test_clicks_and_the_command_make_the_same_package(student, tmp_path):
    urdf = Path(rospkg.RosPack().get_path("myur5_description")) / "urdf" / "myur5.urdf.xacro"
    sources = Path(student.desktop.home) / "catkin_ws" / "src"  # below ~, so that the pictures show a path as readers have it
    sources.mkdir(parents=True)
    (sources / "myur5_description").symlink_to(urdf.parent.parent)
    clicked = sources / "myur5_moveit_config"
    click_through(student, "~/catkin_ws/src/myur5_description/urdf/myur5.urdf.xacro", "~/catkin_ws/src/myur5_moveit_config")
    (tmp_path / "config.yaml").write_text(CONFIG)
    typed = tmp_path / "typed" / "myur5_moveit_config"
    package_writer.write(headless.configuration(RobotSource.from_file(urdf), tmp_path / "config.yaml"), typed)

    def files(folder):
        return {
            str(path.relative_to(folder)): path.read_text()
            for path in folder.rglob("*")
            if path.is_file() and path.name != ".setup_assistant"
        }  # which has the time in it

    assert files(clicked) == files(typed)
    pairs = files(clicked)["config/myur5.srdf"].count("<disable_collisions")
    assert pairs == 12, "8 neighbours and 4 that never meet"

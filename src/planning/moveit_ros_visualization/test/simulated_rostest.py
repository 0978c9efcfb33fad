#!/usr/bin/env python3
"""As the tutorial says: MotionPlanning is added to an empty RViz, goals are chosen, Plan and Execute are pressed,
and the arm in simulation gets there. All by clicks on a private X server. ``TUTORIAL_PICTURES=FOLDER`` keeps pictures."""

import json
import math
import os
import shutil
import tempfile
import time
import unittest

import rospy
import rostest
import yaml
from rqt_testing.desktop import Desktop
from rviz_desktop import run_rviz
from sensor_msgs.msg import JointState

HERE = os.path.dirname(os.path.abspath(__file__))
JOINTS = ("shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint", "wrist_1_joint", "wrist_2_joint", "wrist_3_joint")
HOME = dict(zip(JOINTS, (0.0, -1.5707, 1.5707, -1.5707, -1.5707, 0.0)))


class Simulated(unittest.TestCase):
    def setUp(self):
        rospy.init_node("simulated_test")
        rospy.wait_for_service("get_planning_scene", 60)
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.config = os.path.join(self.folder, "moveit.rviz")
        shutil.copy(os.path.join(HERE, "empty.rviz"), self.config)
        self.desktop = Desktop("1280x940x24")
        self.desktop.__enter__()
        self.addCleanup(self.desktop.__exit__, None, None, None)
        self.rviz = run_rviz(self.desktop, self.config, "1270x900")

    def picture(self, name):
        folder = os.environ.get("TUTORIAL_PICTURES")
        if folder:
            time.sleep(1.0)
            self.desktop.screenshot(os.path.join(folder, name + ".png"))

    def off(self, wanted):
        """The largest distance of a joint from where it is wanted, rad."""
        message = rospy.wait_for_message("joint_states", JointState, 10)
        now = dict(zip(message.name, message.position))
        return max(abs(now[name] - value) for name, value in wanted.items())

    def status(self):
        return json.loads(self.rviz.ask("text", "statuses") or "{}").get("MotionPlanning", ["", ""])

    def goal(self):
        """Joint values of the goal, from the tab Joints."""
        self.rviz.click_text("Joints")
        values = {name: math.radians(float(self.rviz.text("joint_value_" + name).rstrip("\u00b0"))) for name in JOINTS}
        self.rviz.click_text("Planning")
        return values

    def random_goal(self, before):
        self.choose("goal_state_combo_box", "<random valid>")
        self.rviz.wait(lambda: max(abs(value - before[name]) for name, value in self.goal().items()) > 0.1, "another goal")
        return self.goal()

    def saved(self):
        """Whether what RViz has written holds the display; it may be writing still."""
        try:
            with open(self.config + ".saved") as file:
                displays = yaml.safe_load(file)["Visualization Manager"]["Displays"]
        except (OSError, yaml.YAMLError, TypeError, KeyError):
            return False
        return "moveit_rviz_plugin/MotionPlanning" in [item["Class"] for item in displays]

    def choose(self, combo, entry):
        self.rviz.click(combo)
        self.rviz.click_text(entry)
        self.rviz.wait(lambda: self.rviz.text(combo) == entry, f"{entry} in {combo}")

    def press(self, button, result):
        self.rviz.click(button)
        self.rviz.wait(lambda: self.rviz.text("result_label").startswith(result), f"result {result}")

    def test_the_arm_goes_where_it_was_sent_by_clicks(self):
        self.rviz.window("RViz")
        self.picture("1_empty")
        self.rviz.click_text("Add")
        self.rviz.click_text("MotionPlanning")
        self.picture("2_add")
        self.rviz.click_text("OK")
        self.rviz.wait(lambda: self.status()[1] == "Status: Ok", "display without a complaint")
        self.picture("3_added")
        self.choose("goal_state_combo_box", "HomePose")
        self.rviz.click("velocity_scaling_factor", at=(0.3, 0.5))
        self.desktop.keys("ctrl+a")
        self.desktop.type("1\n")
        self.press("plan_button", "Time: ")
        self.picture("4_planned")
        self.assertGreater(self.off(HOME), 1.0)
        self.press("execute_button", "Executed")
        self.rviz.wait(lambda: self.off(HOME) < 0.01, "simulated arm at home")
        self.picture("5_executed")
        goal = self.random_goal(HOME)
        while goal["shoulder_lift_joint"] > 1.5:  # valid, but cut off: the pedestal is in the way, and the limits end at 180 degrees
            goal = self.random_goal(goal)
        self.press("plan_and_execute_button", "Executed")
        self.rviz.wait(lambda: self.off(goal) < 0.01, "simulated arm at the random goal")
        self.rviz.click("save_config")
        self.rviz.wait(self.saved, "saved file with the display")
        self.assertEqual(self.rviz.end(), 0)


if __name__ == "__main__":
    rostest.rosrun("moveit_ros_visualization", "simulated_test", Simulated)

#!/usr/bin/env python3
"""A package made by the command line tool plans and moves as soon as it is launched, and its collisions can be updated."""

import os
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import rospy
from moveit_commander import MoveGroupCommander, RobotCommander
from moveit_setup_assistant.semantics import Semantics

sys.path.insert(0, str(Path(__file__).parent))
from robots import FIVE  # noqa: E402

CONFIG = """
groups:
  arm: {chain: [base, inside], solver: kdl}
  wing: {joints: [swinging]}
poses:
  - {name: home, group: arm, joints: {turn: 0.5, spin: -0.25}}
  - {name: open, group: wing, joints: {swinging: 0.75}}
virtual_joints:
  - {name: stand_here, type: fixed, parent_frame: world, child_link: base}
collisions: {trials: 2000}
author: {name: Ada, email: ada@example.org}
"""


class GeneratedDemo(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        root = Path(self.folder.name)
        (root / "small_description").mkdir()
        (root / "small_description" / "package.xml").write_text("<package><name>small_description</name></package>")
        (root / "small_description" / "small.urdf").write_text(FIVE)
        (root / "config.yaml").write_text(CONFIG)
        self.root = root
        self.environment = dict(os.environ, ROS_PACKAGE_PATH=f"{root}:{os.environ['ROS_PACKAGE_PATH']}")
        self.demo = None

    def tearDown(self):
        if self.demo:
            os.killpg(self.demo.pid, signal.SIGINT)
            self.demo.wait(60)
        self.folder.cleanup()

    def run_tool(self, *words):
        done = subprocess.run(
            ["rosrun", "moveit_setup_assistant", *words],
            env=self.environment,
            cwd=self.root,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            check=False,
        )
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def test_it_plans_and_moves(self):
        said = self.run_tool("generate", "--urdf", "small_description/small.urdf", "--from", "config.yaml", "-o", "small_moveit_config")
        self.assertIn("roslaunch small_moveit_config demo.launch", said)
        self.demo = subprocess.Popen(
            ["roslaunch", "small_moveit_config", "demo.launch", "use_rviz:=false"], env=self.environment, start_new_session=True
        )
        rospy.init_node("generated_demo")
        rospy.wait_for_service("plan_kinematic_path", 200.0)
        wing = MoveGroupCommander("wing", wait_for_servers=120.0)
        arm = MoveGroupCommander("arm", wait_for_servers=120.0)
        self.assertEqual(RobotCommander().get_group_names(), ["arm", "wing"])
        wing.set_named_target("open")
        self.assertTrue(wing.go(wait=True))
        self.assertAlmostEqual(wing.get_current_joint_values()[0], 0.75, places=3)
        arm.set_joint_value_target({"turn": -0.5, "spin": 0.5})
        self.assertTrue(arm.go(wait=True))
        for wanted, got in zip((-0.5, 0.5), arm.get_current_joint_values()):
            self.assertAlmostEqual(wanted, got, places=3)

        srdf = self.root / "small_moveit_config" / "config" / "small.srdf"
        before = {(p.link1, p.link2, p.reason) for p in Semantics.load(srdf).disable_collisionss}
        said = self.run_tool("collisions_updater", "--config-pkg", "small_moveit_config", "--default", "--output", "fewer.srdf")
        self.assertIn("wrote fewer.srdf", said)
        fewer = {(p.link1, p.link2, p.reason) for p in Semantics.load(self.root / "fewer.srdf").disable_collisionss}
        self.assertEqual(fewer, {p for p in before if p[2] != "Never"}, "no trials: nothing can be called Never")


if __name__ == "__main__":
    import rostest

    rostest.rosrun("moveit_setup_assistant", "generated_demo", GeneratedDemo)

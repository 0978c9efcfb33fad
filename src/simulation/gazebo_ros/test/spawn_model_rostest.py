#!/usr/bin/env python3
"""spawn_model from the command line: options, exit codes, what it leaves in the world."""

import os
import signal
import subprocess
import tempfile
import unittest

import rosgraph
import rospy
import rostest
from simulator import Simulator, box, pose, urdf


def spawn(*arguments, stdin=None):
    """Run it to its end: (exit code, all it printed)."""
    done = subprocess.run(
        ["rosrun", "gazebo_ros", "spawn_model", *arguments],
        input=stdin,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        timeout=60,
    )
    return done.returncode, done.stdout


def runs(name):
    """Whether a node of that anonymous name runs."""
    publishers = rosgraph.Master("/spawn_model_rostest").getSystemState()[0]
    return any(node.startswith(f"/{name}_") for _, nodes in publishers for node in nodes)


class SpawnModel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.sim = Simulator()

    def spawned(self, name, *arguments, stdin=None):
        code, text = spawn("-model", name, *arguments, stdin=stdin)
        self.assertEqual(code, 0, text)
        state = self.sim.model(name)
        self.assertTrue(state.success, text)
        return state

    def test_param_pose_and_joints(self):
        rospy.set_param("robot_description", "<?xml version='1.0'?><!-- a robot -->" + urdf())
        state = self.spawned("a", *"-urdf -param robot_description -x 1 -y -2 -z 3 -Y 1.5707963 -J elbow 0.5".split())
        position, turn = state.pose.position, state.pose.orientation
        self.assertAlmostEqual(position.x, 1, 6)
        self.assertAlmostEqual(position.y, -2, 6)
        self.assertAlmostEqual(position.z, 3, 6)
        self.assertAlmostEqual(turn.z, turn.w, 6)
        self.assertAlmostEqual(self.sim.joint("elbow").position[0], 0.5, 6)

    def test_what_is_wrong_is_named_by_file_and_line(self):
        with tempfile.NamedTemporaryFile("w", suffix=".urdf") as file:
            file.write(
                "<robot name='r'>\n<link name='l'/>\n<joint name='j' type='bent'><parent link='l'/><child link='l'/></joint>\n</robot>\n"
            )
            file.flush()
            code, text = spawn("-urdf", "-file", file.name, "-model", "wrong")
        self.assertEqual(code, 1, text)
        self.assertIn(f"{file.name}:3 <joint", text)

    def test_database_and_reference_frame_and_unpause(self):
        self.assertTrue(self.sim.physics().pause)
        self.spawned("floor", "-sdf", "-database", "ground_plane", "-reference_frame", "crate", "-z", "-8", "-unpause")
        self.assertAlmostEqual(self.sim.model("floor").pose.position.x, self.sim.model("crate").pose.position.x, 6)
        self.assertFalse(self.sim.physics().pause)
        self.sim.empty("pause_physics")

    def test_bond_deletes_the_model_at_the_end(self):
        node = self.bond("bound", "-x", "30")
        self.wait(lambda: "bound" in self.sim.world().model_names)
        os.killpg(node.pid, signal.SIGINT)
        node.wait(60)
        self.wait(lambda: "bound" not in self.sim.world().model_names)

    def test_waits_for_another_model_though_time_stands_still(self):
        node = self.bond("second", "-wait", "first", "-x", "50")
        self.wait(lambda: runs("spawn_model"))
        self.assertTrue(self.sim.spawn("first", box(), pose(60, 0, 1)).success)
        self.wait(lambda: "second" in self.sim.world().model_names)
        self.assertEqual(self.sim.world().model_names[-2:], ["first", "second"])
        os.killpg(node.pid, signal.SIGINT)
        node.wait(60)
        self.wait(lambda: "second" not in self.sim.world().model_names)
        self.assertTrue(self.sim.delete("first").success)

    def test_killing_the_spawner_harms_nobody(self):
        node = self.bond("orphan", "-x", "40")
        self.wait(lambda: "orphan" in self.sim.world().model_names)
        os.killpg(node.pid, signal.SIGKILL)
        node.wait(60)
        self.assertTrue(self.sim.step(10).success)
        self.assertTrue(self.sim.delete("orphan").success)

    def bond(self, name, *arguments):
        """spawn_model -b, which stays."""
        command = ["rosrun", "gazebo_ros", "spawn_model", "-sdf", "-stdin", "-b", "-model", name, *arguments]
        node = subprocess.Popen(command, stdin=subprocess.PIPE, text=True, start_new_session=True)
        node.stdin.write(box())
        node.stdin.close()
        return node

    def wait(self, condition):
        while not condition():
            self.assertFalse(rospy.is_shutdown())
            rospy.rostime.wallsleep(0.02)

    def test_what_the_simulator_refuses_is_said_and_fails(self):
        code, text = spawn("-sdf", "-stdin", "-model", "crate", stdin=box())
        self.assertEqual(code, 1, text)
        self.assertIn("already exists", text)
        self.assertNotIn("Traceback", text)


if __name__ == "__main__":
    rospy.init_node("spawn_model_rostest")
    rostest.rosrun("gazebo_ros", "spawn_model", SpawnModel)

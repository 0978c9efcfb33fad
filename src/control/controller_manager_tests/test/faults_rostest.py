#!/usr/bin/env python3
"""What students get wrong and what dies: one line each, and the rest goes on."""

import signal
import subprocess
import unittest

import rospy
import rostest
from controller_manager_tests.client import ManagerClient, sends
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import JointState
from test_support import wait_until


class FaultsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.lines = []
        cls.subscriber = rospy.Subscriber("/rosout", Log, cls.hear)
        ManagerClient().states()  # the robot is there
        wait_until(lambda: sends("/dummy_robot", "/rosout"), "the robot's log")

    @classmethod
    def hear(cls, message):
        if message.name == "/dummy_robot" and message.level >= Log.WARN:
            cls.lines.append(message.msg)

    def setUp(self):
        self.cm = ManagerClient()
        self.addCleanup(self.cm.clear)
        self.cm.load("states")
        self.cm.start("states")
        del self.lines[:]

    def tearDown(self):
        """Whatever happened, joint states go on and the manager answers."""
        self.assertEqual(len(rospy.wait_for_message("/joint_states", JointState, 60.0).name), 8)
        self.assertEqual(self.cm.states()["states"], "running")

    def says(self, *parts):
        wait_until(lambda: any(all(part in line for part in parts) for line in self.lines), f"{parts} in {self.lines}")
        self.assertEqual(len(self.lines), 1, self.lines)
        self.assertNotIn("Traceback", self.lines[0])
        self.assertNotIn("\n", self.lines[0])

    def refused(self, name, *parts):
        self.assertFalse(self.cm.load(name))
        self.says(f"'{name}'", *parts)

    def test_unknown_type(self):
        self.refused(
            "misspelled",
            "controller_manager_tests/EffortTestControler' does not exist",
            "did you mean 'controller_manager_tests/EffortTestController'?",
            "list_controller_types",
        )

    def test_module_that_cannot_be_imported(self):
        self.refused("missing_module", "cannot be imported", "no_such_module")

    def test_parameters_not_there(self):
        self.refused("never_heard_of", "type was not specified", "/never_heard_of/type is not set", "no parameters in /never_heard_of")

    def test_parameters_without_type(self):
        self.refused("typeless", "/typeless/type is not set", "/typeless has: joint")

    def test_parameters_in_another_namespace(self):
        self.refused("lost", "/lost/type is not set", "/elsewhere/lost/type")

    def test_type_that_is_no_text(self):
        self.refused("number_as_type", "/number_as_type/type must be a text, it is 5")

    def test_long_and_broken_names_are_quoted_short_and_on_one_line(self):
        self.refused_name("x" * 100000, "type was not specified")
        self.refused_name("a\nb", "'a b': this is no valid name")
        rospy.set_param("/long_type", {"type": "y" * 100000})
        self.refused_name("long_type", "yyy' does not exist")

    def refused_name(self, name, part):
        del self.lines[:]
        self.assertFalse(self.cm.load(name))
        self.says(part)
        self.assertLess(len(self.lines[0]), 2000)

    def test_unknown_joint(self):
        self.refused("unknown_joint", "no_such_joint", "hiDOF_joint1, hiDOF_joint2")

    def test_missing_interface(self):
        self.refused("no_interface", "NoSuchInterface", "it has: hardware_interface::EffortJointInterface")

    def test_load_twice(self):
        self.cm.load("my_controller1")
        self.refused("my_controller1", "already loaded")

    def test_init_that_raises(self):
        self.refused("broken_init", "ZeroDivisionError: on purpose in init")

    def test_update_that_raises(self):
        self.cm.load("broken_update")
        self.cm.start("broken_update")
        self.says("'broken_update'", "aborted", "update() raised ZeroDivisionError")
        self.assertEqual(self.cm.states()["broken_update"], "aborted")

    def test_starting_that_raises(self):
        self.cm.load("broken_starting")
        self.assertFalse(self.cm.start("broken_starting"))
        self.says("'broken_starting'", "aborted", "starting() raised ZeroDivisionError")

    def test_stopping_that_raises(self):
        self.cm.load("broken_stopping")
        self.cm.start("broken_stopping")
        self.cm.stop("broken_stopping")
        self.says("'broken_stopping'", "aborted", "stopping() raised ZeroDivisionError")

    def test_spawner_killed_hard_and_started_again(self):
        def spawner():
            process = subprocess.Popen(
                ["rosrun", "controller_manager", "spawner", "my_controller1", "my_controller3"],
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
            )
            self.addCleanup(process.stdout.close)
            return process

        def running():
            states = self.cm.states()
            return states.get("my_controller1") == states.get("my_controller3") == "running"

        first = spawner()
        wait_until(running, "both controllers to run")
        first.send_signal(signal.SIGKILL)
        self.assertEqual(first.wait(60), -signal.SIGKILL)
        self.assertTrue(running(), "the robot keeps its controllers")
        self.cm.stop("my_controller3")  # the second spawner finds one running and one stopped
        second = spawner()
        wait_until(running, "the second spawner to start what stands still")
        second.terminate()
        self.assertEqual(second.wait(60), 0)
        text = second.stdout.read()
        self.assertIn("Failed to load my_controller1: it is already loaded (running)", text)
        self.assertIn("Failed to load my_controller3: it is already loaded (stopped)", text)
        self.assertTrue(running(), "they were not its own")


if __name__ == "__main__":
    rospy.init_node("faults_rostest")
    rostest.rosrun("controller_manager_tests", "faults", FaultsTest)

#!/usr/bin/env python3
"""A robot whose main program is C++: its manager, with controllers of Python and of C++ side by side."""

import unittest

import rosgraph
import rospy
import rostest
from controller_manager_tests.client import ManagerClient, wait_until
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64


class CppRobotTest(unittest.TestCase):
    def setUp(self):
        self.cm = ManagerClient()
        self.joints = {}
        rospy.Subscriber("/joint_states", JointState, lambda m: self.joints.update(zip(m.name, zip(m.position, m.velocity, m.effort))))

    def test_both_languages_on_a_robot_of_cpp(self):
        for name in ("states", "left", "lamp", "effort", "unwanted"):
            self.assertTrue(self.cm.load(name), name)
        self.assertIn("/cpp_robot_controller_manager", [name for _, owners in self.services() for name in owners])
        self.assertFalse(self.cm.load("missing"))
        self.assertTrue(self.cm.start("states", "left", "lamp"))
        command = rospy.Publisher("/left/command", Float64, queue_size=1, latch=True)
        command.publish(0.75)  # Python's controller moves the numbers of the robot
        wait_until(lambda: self.joints.get("left", (None,))[0] == 0.75, "the left joint")
        wait_until(lambda: self.joints["right"][1:] == (0.5, 4.0), "the compiled controller on an interface of its own")
        claimed = {entry.hardware_interface: list(entry.resources) for entry in self.controller("lamp").claimed_resources}
        self.assertEqual(
            claimed, {"hardware_interface::EffortJointInterface": ["right"], "controller_manager_tests::LampInterface": ["lamp"]}
        )
        self.assertFalse(self.cm.start("effort"), "both want the right joint")
        self.assertFalse(self.cm.switch(["unwanted"], ["left"]), "the robot's prepareSwitch refuses it")
        self.assertTrue(self.cm.switch(["effort"], ["lamp"]))
        self.assertTrue(self.cm.unload("lamp"))
        self.assertEqual(self.cm.states(), {"states": "running", "left": "running", "effort": "running", "unwanted": "initialized"})

    def test_a_loader_of_the_program(self):
        wait_until(lambda: self.cm.load("own"), "the loader, which comes after the services")
        self.assertEqual(rospy.get_param("/own/loader_asked"), 1, "once for each controller, as in upstream")
        self.assertTrue(self.cm.unload("own"))

    def controller(self, name):
        return next(controller for controller in self.cm.controllers() if controller.name == name)

    @staticmethod
    def services():
        return rosgraph.Master("/test").getSystemState()[2]


if __name__ == "__main__":
    rospy.init_node("robot_of_cpp")
    rostest.rosrun("controller_manager_tests", "robot_of_cpp", CppRobotTest)

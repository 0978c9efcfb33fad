#!/usr/bin/env python3
"""Parts by plugin name, from parameters."""

import unittest

import rospy
import rostest
from combined_robot_hw import CombinedRobotHW
from controller_interface import NodeHandle
from hardware_interface import EffortJointInterface

LEFT = {"type": "controller_manager_tests/PartialRobot", "joints": ["l1", "l2"]}
RIGHT = {"type": "controller_manager_tests/PartialRobot", "joints": ["r1"]}


class CombinedRobotHWTest(unittest.TestCase):
    def init(self, **parameters):
        rospy.set_param("/combined", parameters)
        robot = CombinedRobotHW()
        return robot.init(NodeHandle("/"), NodeHandle("/combined")), robot

    def test_two_parts(self):
        ok, robot = self.init(robot_hardware=["left", "right"], left=LEFT, right=RIGHT)
        self.assertTrue(ok)
        self.assertEqual(robot.get(EffortJointInterface).names(), ["l1", "l2", "r1"])

    def test_what_makes_it_fail(self):
        for parameters in (
            {"x": 1},
            {"robot_hardware": "left", "left": LEFT},
            {"robot_hardware": ["left"]},
            {"robot_hardware": ["left"], "left": {"type": "no/Such"}},
            {"robot_hardware": ["left"], "left": {**LEFT, "joints": []}},
            {"robot_hardware": ["left"], "left": {"type": LEFT["type"]}},
        ):
            self.assertFalse(self.init(**parameters)[0], parameters)


if __name__ == "__main__":
    rospy.init_node("combined_robot_hw_rostest")
    rostest.rosrun("combined_robot_hw", "combined_robot_hw", CombinedRobotHWTest)

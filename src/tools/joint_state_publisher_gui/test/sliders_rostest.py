#!/usr/bin/env python3
"""The window opens, and its slider publishes the joint where the parameter `zeros` wants it."""

import sys
import unittest

import rospy
import rostest
from sensor_msgs.msg import JointState


class Sliders(unittest.TestCase):
    def test_a_joint_stands_where_its_slider_does(self):
        state = rospy.wait_for_message("joint_states", JointState, timeout=120.0)
        self.assertEqual(state.name, ["hinge"])
        self.assertAlmostEqual(state.position[0], 0.3, delta=3.0 / 10000)  # a slider has 10000 places


if __name__ == "__main__":
    rospy.init_node("sliders_test")
    rostest.rosrun("joint_state_publisher_gui", "sliders", Sliders, sys.argv)

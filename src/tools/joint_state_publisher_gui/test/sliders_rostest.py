#!/usr/bin/env python3
"""The window opens, its slider publishes the joint where the parameter `zeros` wants it, and it ends when it is told."""

import os
import signal
import subprocess
import sys
import threading
import unittest

import rosnode
import rospy
import rostest
from sensor_msgs.msg import JointState


class Sliders(unittest.TestCase):
    def test_a_joint_stands_where_its_slider_does(self):
        state = rospy.wait_for_message("joint_states", JointState, timeout=120.0)
        self.assertEqual(state.name, ["hinge"])
        self.assertAlmostEqual(state.position[0], 0.3, delta=3.0 / 10000)  # a slider has 10000 places

    def ended(self, end):
        """The window in a process of its own, once it publishes, is ended by ``end(process)``."""
        told = threading.Event()
        listener = rospy.Subscriber("ended/joint_states", JointState, lambda state: told.set())
        self.addCleanup(listener.unregister)
        command = ["rosrun", "joint_state_publisher_gui", "joint_state_publisher_gui", "__name:=ended", "joint_states:=ended/joint_states"]
        environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
        process = subprocess.Popen(command, env=environment, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        self.assertTrue(told.wait(120.0), "it does not publish")
        end(process)
        _, complaint = process.communicate(timeout=20)
        self.assertNotIn("Traceback", complaint)
        self.assertNotIn("/ended", rosnode.get_node_names())

    def test_it_ends_when_it_is_told(self):
        for number in (signal.SIGTERM, signal.SIGINT):
            self.ended(lambda process, number=number: process.send_signal(number))
        self.ended(lambda process: rosnode.kill_nodes(["/ended"]))


if __name__ == "__main__":
    rospy.init_node("sliders_test")
    rostest.rosrun("joint_state_publisher_gui", "sliders", Sliders, sys.argv)

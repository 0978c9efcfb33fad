#!/usr/bin/env python3
"""arm_controller_node against a clock and joint states of our own: what it sends, what it prints, what it refuses."""

import re
import subprocess
import threading
import unittest

import rospy
import rostest
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64

NODE = ["rosrun", "arm_controller", "arm_controller_node"]


class ArmControllerNode(unittest.TestCase):
    def refused(self, *words):
        run = subprocess.run([*NODE, *words], capture_output=True, text=True, timeout=60)
        self.assertNotEqual(run.returncode, 0)
        lines = (run.stdout + run.stderr).strip().splitlines()
        self.assertEqual(len(lines), 1, lines)
        return lines[0]

    def test_wrong_number_of_arguments(self):
        self.assertIn("got 3", self.refused("1", "1", "1"))
        self.assertIn("got 0", self.refused())
        self.assertIn("got 5", self.refused("1", "1", "1", "1", "1"))

    def test_words_that_are_no_numbers(self):
        for word in ("one", "1.0x", "nan", "inf", ""):
            self.assertIn("J2 is '%s'" % word, self.refused("1", "1", word, "1"))

    def test_commands_and_printed_positions(self):
        clock = rospy.Publisher("/clock", Clock, queue_size=1)
        states = rospy.Publisher("/arm/joint_states", JointState, queue_size=1)
        got = {index: [] for index in range(4)}
        enough = threading.Event()

        def receive(message, index):
            got[index].append(message.data)
            if all(len(values) >= 5 for values in got.values()):
                enough.set()

        for index in got:
            rospy.Subscriber("/arm/joint%d_position_controller/command" % index, Float64, receive, index)

        node = subprocess.Popen([*NODE, "1", "-0.5", "0.25", "2e0"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        try:
            state = JointState(name=["j0", "j1", "j2", "j3"], position=[0.1, 0.2, 0.3, 0.4])
            sim_time = 0.0
            while not enough.wait(0.01):  # a clock that runs for as long as the node needs to have sent five times
                sim_time += 0.01
                clock.publish(Clock(rospy.Time(sim_time)))
                states.publish(state)
                self.assertIsNone(node.poll(), "the node ended by itself")
        finally:
            node.terminate()
            text = node.communicate(timeout=60)[0]
        self.assertEqual([set(got[index]) for index in range(4)], [{1.0}, {-0.5}, {0.25}, {2.0}])
        plain = re.sub(r"\x1b\[[\d;]*m", "", text)  # without the console's colours
        self.assertRegex(plain, r"Position command to joint1: -0\.50\n")
        rows = "".join(r"\n.*Position of Joint j%d: 0\.%d00000" % (index, index + 1) for index in range(4))
        self.assertRegex(plain, "Received joint_state message:" + rows)


if __name__ == "__main__":
    rospy.init_node("arm_controller_node_rostest")
    rostest.rosrun("arm_controller", "arm_controller_node", ArmControllerNode)

#!/usr/bin/env python3
"""A controller written outside of this workspace, loaded by the name of its type."""

import subprocess
import unittest

import rospy
import rostest
from controller_manager_tests.client import ManagerClient
from sensor_msgs.msg import JointState
from test_support import wait_until


class ThirdPartyTest(unittest.TestCase):
    def test_load_start_move_stop(self):
        cm = ManagerClient()
        self.assertIn("my_controllers/SineController", cm.types().types)
        for name in ("states", "sine"):
            self.assertTrue(cm.load(name))
        self.assertTrue(cm.start("states", "sine"))
        positions = []
        rospy.Subscriber("/joint_states", JointState, lambda m: positions.append(m.position[m.name.index("hiDOF_joint1")]))
        wait_until(lambda: positions and max(positions) > 0.45 and min(positions) < -0.45, "a whole swing")
        self.assertLessEqual(max(map(abs, positions)), 0.5 + 1e-9)
        subprocess.run(
            ["rostopic", "pub", "-1", "/sine/amplitude", "std_msgs/Float64", "0.0"], check=True, timeout=60, stdout=subprocess.DEVNULL
        )
        wait_until(lambda: positions[-1] == 0.0, "the new amplitude")
        self.assertTrue(cm.stop("sine"))

    def test_missing_parameter(self):
        cm = ManagerClient()
        self.assertFalse(cm.load("sine_without_joint"))


if __name__ == "__main__":
    rospy.init_node("third_party_rostest")
    rostest.rosrun("controller_manager_tests", "third_party", ThirdPartyTest)

#!/usr/bin/env python3
"""A node of ROS 2 sends the arm of the course to (1, 1, 1, 1), by the topics of its controllers, and sees it arrive."""

import struct
import unittest

import rospy
import rostest
from ros1_bridge.link import HINT, prefix
from ros2_side import Other, SameStates, wait

JOINTS = ["j0", "j1", "j2", "j3"]
ONE = "00010000" + struct.pack("<d", 1.0).hex()  # std_msgs/Float64 in CDR


@unittest.skipIf(prefix() is None, HINT)
class ArmLab(unittest.TestCase):
    def test_to_one_one_one_one(self):
        other = Other()
        self.addCleanup(other.process.kill)
        states = SameStates(other, "/arm/joint_states")
        topics = [f"/arm/joint{index}_position_controller/command" for index in range(4)]
        for topic in topics:
            other.do("advertise", topic=topic, kind="Float64")

        def arrived():
            for topic in topics:
                other.do("publish", topic=topic, data=ONE)
            return states.newest() == dict.fromkeys(JOINTS, 1.0)

        wait(arrived, "the arm at (1, 1, 1, 1) in ROS 2")  # 10 s at 0.1 rad/s
        self.assertGreater(states.compare(self), 100)


if __name__ == "__main__":
    rospy.init_node("arm_lab_rostest")
    rostest.rosrun("ros1_bridge", "bridge_arm_lab", ArmLab)

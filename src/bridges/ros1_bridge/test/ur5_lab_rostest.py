#!/usr/bin/env python3
"""A node of ROS 2 drives the course's UR5 by the action of its trajectory controller and sees the joint states that ROS 1 sees."""

import unittest

import rospy
import rostest
from ros1_bridge.link import HINT, prefix
from ros2_side import Other, SameStates, wait

TARGET = {
    "shoulder_pan_joint": 0.5,
    "shoulder_lift_joint": -1.0,
    "elbow_joint": 1.2,
    "wrist_1_joint": -0.4,
    "wrist_2_joint": -1.0,
    "wrist_3_joint": 0.3,
}
SERVER = "/arm_controller/follow_joint_trajectory"


@unittest.skipIf(prefix() is None, HINT)
class Ur5Lab(unittest.TestCase):
    def test_a_goal(self):
        other = Other()
        self.addCleanup(other.process.kill)
        states = SameStates(other, "/joint_states")
        wait(states.newest, "joint states")
        other.do("goal", name=SERVER, positions=list(TARGET.values()), joints=list(TARGET), seconds=2)
        answer = other.answer(ended=SERVER)
        self.assertEqual((answer["status"], answer["code"], answer["text"]), (4, 0, ""))  # 4: STATUS_SUCCEEDED of action_msgs
        self.assertGreater(answer["feedback"], 10)
        near = lambda: all(abs(states.newest()[name] - value) < 1e-9 for name, value in TARGET.items())
        wait(near, "the arm at its target in ROS 2")
        self.assertGreater(states.compare(self), 50)


if __name__ == "__main__":
    rospy.init_node("ur5_lab_rostest")
    rostest.rosrun("ros1_bridge", "bridge_ur5_lab", Ur5Lab)

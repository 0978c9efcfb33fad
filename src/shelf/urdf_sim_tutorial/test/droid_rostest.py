#!/usr/bin/env python3
"""The tutorial's last step, typed as it says: head, gripper and wheels do what their topics are told."""

import unittest

import rospy
import rostest
from gazebo_msgs.srv import GetModelState
from geometry_msgs.msg import Twist
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Float64MultiArray
from test_support.waiting import wait_until

ALL = 240.0  # s of wall time, which the test's own limit is as well


class Droid(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.joints = {}
        cls.subscriber = rospy.Subscriber(
            "/joint_states", JointState, lambda message: cls.joints.update(zip(message.name, message.position))
        )
        wait_until(lambda: "left_front_wheel_joint" in cls.joints, "joint states", ALL)

    def tell(self, topic, kind, message):
        publisher = rospy.Publisher(topic, kind, queue_size=1, latch=True)
        self.addCleanup(publisher.unregister)
        publisher.publish(message)

    def test_head(self):
        self.tell("/r2d2_head_controller/command", Float64, Float64(-0.707))
        wait_until(lambda: abs(self.joints["head_swivel"] + 0.707) < 1e-3, "the head", ALL)

    def test_gripper(self):
        self.tell("/r2d2_gripper_controller/command", Float64MultiArray, Float64MultiArray(data=[-0.1, 0.5, 0.5]))
        told = {"gripper_extension": -0.1, "left_gripper_joint": 0.5, "right_gripper_joint": 0.5}
        wait_until(lambda: all(abs(self.joints[name] - value) < 1e-3 for name, value in told.items()), "the gripper", ALL)

    def test_wheels(self):
        state = rospy.ServiceProxy("/gazebo/get_model_state", GetModelState)
        wheels = rospy.Publisher("/r2d2_diff_drive_controller/cmd_vel", Twist, queue_size=1)
        self.addCleanup(wheels.unregister)
        ahead = Twist()
        ahead.linear.x = 0.2

        def half_a_metre_on():
            wheels.publish(ahead)
            return state("robot", "").pose.position.x > 0.5

        wait_until(half_a_metre_on, "half a metre", ALL)
        self.assertLess(abs(state("robot", "").pose.position.y), 0.02)
        self.assertAlmostEqual(state("robot", "").pose.position.z, 0.47, delta=0.02)  # on its wheels


if __name__ == "__main__":
    rospy.init_node("droid_rostest")
    rostest.rosrun("urdf_sim_tutorial", "droid_rostest", Droid)

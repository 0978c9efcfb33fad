#!/usr/bin/env python3
"""A model plugin in C++ that stands on the headers gazebo_ros_utils.h and PubQueue.h."""

import importlib.util
import unittest

import rospy
import rostest
from gazebo_msgs.srv import SpawnModel
from geometry_msgs.msg import Pose
from std_msgs.msg import String

MODEL = """<sdf version="1.6"><model name="cart"><link name="a"/><link name="b"/><joint name="wheel" type="revolute"><parent>a</parent>
<child>b</child><axis><xyz>0 0 1</xyz></axis></joint>
<plugin name="user" filename="libgazebo_plugins_test_user.so">{more}</plugin></model></sdf>"""


@unittest.skipUnless(importlib.util.find_spec("gazebo_cpp._core"), "this system lacks what Gazebo's headers need")
class HeadersTest(unittest.TestCase):
    def spawned(self, name, more):
        rospy.wait_for_service("/gazebo/spawn_sdf_model", 60)
        done = rospy.ServiceProxy("/gazebo/spawn_sdf_model", SpawnModel)(name, MODEL.format(more=more), "", Pose(), "")
        self.assertTrue(done.success, done.status_message)

    def test_parameters_and_the_queue(self):
        self.spawned(
            "cart",
            "<wheelJoint>wheel</wheelJoint><publishOdom>false</publishOdom><turned>1</turned><side>right</side><updateRate>50</updateRate>",
        )
        told = rospy.wait_for_message("/cart/user", String, 20)
        self.assertEqual(told.data, "User(ns = cart) 50 robot7/base_footprint 0 1 2 wheel")

    def test_defaults_and_the_robots_namespace(self):
        self.spawned("second", "<wheelJoint>wheel</wheelJoint><robotNamespace>fleet</robotNamespace><robotBaseFrame>/base</robotBaseFrame>")
        told = rospy.wait_for_message("/fleet/user", String, 20)
        self.assertEqual(told.data, "User(ns = fleet) 25 base 1 0 1 wheel")


if __name__ == "__main__":
    rospy.init_node("headers_rostest")
    rostest.rosrun("gazebo_plugins", "headers", HeadersTest)

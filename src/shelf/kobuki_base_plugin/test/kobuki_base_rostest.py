#!/usr/bin/env python3
"""libgazebo_ros_kobuki.so on the wire: it drives, says so, and stops when commands stay out."""

import collections
import math
import unittest

import rospy
import rostest
from gazebo_msgs.srv import GetModelState, SpawnModel
from gazebo_ros.srv import StepWorld
from geometry_msgs.msg import Pose, Twist
from nav_msgs.msg import Odometry
from robot import sdf
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Bool, Empty
from test_support import wait_until
from test_support.hearing import heard, received


class Kobuki(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.wait_for_message("/gazebo/ready", Bool, 60)
        cls.step = staticmethod(rospy.ServiceProxy("/gazebo/step", StepWorld, persistent=True))
        cls.state = staticmethod(rospy.ServiceProxy("/gazebo/get_model_state", GetModelState, persistent=True))
        cls.spawn = staticmethod(rospy.ServiceProxy("/gazebo/spawn_sdf_model", SpawnModel))

    def setUp(self):
        self.told = collections.Counter()

    def tell(self, publisher, message):
        publisher.publish(message)
        self.told[publisher] += 1
        wait_until(lambda: received(publisher, self.told[publisher]), "that the simulator hears it")

    def drive(self, publisher, forward, turn, seconds):
        """The robot's pose (x, yaw) after that long."""
        twist = Twist()
        twist.linear.x, twist.angular.z = forward, turn
        for _ in range(round(seconds * 10)):
            self.tell(publisher, twist)
            self.now = self.step(100).sim_time
        pose = self.state("mobile_base", "").pose
        return pose.position.x, 2 * math.atan2(pose.orientation.z, pose.orientation.w)

    def test_drives_and_says_so(self):
        self.assertTrue(self.spawn("mobile_base", sdf(), "", Pose(), "world").success)
        got = {name: [] for name in ("/odom", "/joint_states", "/mobile_base/sensors/imu_data")}
        ears = [rospy.Subscriber(name, kind, got[name].append) for name, kind in zip(got, (Odometry, JointState, Imu))]
        orders = rospy.Publisher("/mobile_base/commands/velocity", Twist, queue_size=5)
        wait_until(lambda: heard(ears) and orders.get_num_connections(), "that the simulator listens and speaks")
        self.drive(orders, 0.0, 0.0, 0.5)
        x, _ = self.drive(orders, 0.3, 0.0, 2.0)
        self.assertAlmostEqual(x, 0.6, delta=0.04)
        _, before = self.drive(orders, 0.0, 0.0, 0.5)
        _, yaw = self.drive(orders, 0.0, 0.5, 2.0)
        self.assertAlmostEqual(yaw - before, 1.0, delta=0.06)
        odometry = self.newest(got["/odom"])
        self.assertAlmostEqual(odometry.pose.pose.position.x, self.state("mobile_base", "").pose.position.x, delta=0.02)
        self.assertEqual((odometry.header.frame_id, odometry.child_frame_id), ("odom", "base_footprint"))
        self.assertEqual(self.newest(got["/joint_states"]).name, ["wheel_left_joint", "wheel_right_joint"])
        pull = self.newest(got["/mobile_base/sensors/imu_data"]).linear_acceleration
        self.assertAlmostEqual(pull.z, 9.8, delta=0.3)
        self.now = self.step(1000).sim_time  # commands stay out
        self.assertLess(abs(self.newest(got["/odom"]).twist.twist.angular.z), 0.01)
        resets = rospy.Publisher("/mobile_base/commands/reset_odometry", Empty, queue_size=1)
        wait_until(resets.get_num_connections, "that the simulator listens")
        self.tell(resets, Empty())
        self.now = self.step(100).sim_time
        self.assertLess(abs(self.newest(got["/odom"]).pose.pose.position.x), 0.01)

    def newest(self, messages):
        """The last that the simulator sent; it does so every 0.02 s."""
        wait_until(lambda: messages and messages[-1].header.stamp > self.now - rospy.Duration(0.03), "a new message")
        return messages[-1]

    def test_what_is_wrong_is_said(self):
        said = []
        ear = rospy.Subscriber("/rosout", Log, lambda log: said.append(log.msg))
        wait_until(lambda: heard([ear]), "that the simulator is heard")
        self.spawn("broken", sdf(imu_name="gyro").replace("mobile_base", "broken"), "", Pose(), "world")
        wait_until(lambda: any("has no sensor 'gyro' of type imu" in text for text in said), "the reason")


if __name__ == "__main__":
    rospy.init_node("kobuki_base_rostest")
    rostest.rosrun("kobuki_base_plugin", "kobuki_base", Kobuki)

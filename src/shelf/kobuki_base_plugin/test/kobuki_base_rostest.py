#!/usr/bin/env python3
"""libgazebo_ros_kobuki.so on the wire: it drives, says so, and stops when commands stay out."""
import math
import queue
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


class Kobuki(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.wait_for_message("/gazebo/ready", Bool, 60)
        cls.step = staticmethod(rospy.ServiceProxy("/gazebo/step", StepWorld, persistent=True))
        cls.state = staticmethod(rospy.ServiceProxy("/gazebo/get_model_state", GetModelState, persistent=True))
        cls.spawn = staticmethod(rospy.ServiceProxy("/gazebo/spawn_sdf_model", SpawnModel))

    def drive(self, publisher, forward, turn, seconds):
        """The robot's pose (x, yaw) after that long."""
        twist = Twist()
        twist.linear.x, twist.angular.z = forward, turn
        for _ in range(round(seconds * 10)):
            publisher.publish(twist)
            self.step(100)
        pose = self.state("mobile_base", "").pose
        return pose.position.x, 2 * math.atan2(pose.orientation.z, pose.orientation.w)

    def test_drives_and_says_so(self):
        self.assertTrue(self.spawn("mobile_base", sdf(), "", Pose(), "world").success)
        heard = {name: queue.Queue() for name in ("/odom", "/joint_states", "/mobile_base/sensors/imu_data")}
        for name, kind in zip(heard, (Odometry, JointState, Imu)):
            rospy.Subscriber(name, kind, heard[name].put)
        orders = rospy.Publisher("/mobile_base/commands/velocity", Twist, queue_size=5)
        while not orders.get_num_connections():
            rospy.rostime.wallsleep(0.02)
        self.drive(orders, 0.0, 0.0, 0.5)
        x, _ = self.drive(orders, 0.3, 0.0, 2.0)
        self.assertAlmostEqual(x, 0.6, delta=0.04)
        _, before = self.drive(orders, 0.0, 0.0, 0.5)
        _, yaw = self.drive(orders, 0.0, 0.5, 2.0)
        self.assertAlmostEqual(yaw - before, 1.0, delta=0.06)
        odometry = self.newest(heard["/odom"])
        self.assertAlmostEqual(odometry.pose.pose.position.x, self.state("mobile_base", "").pose.position.x, delta=0.02)
        self.assertEqual((odometry.header.frame_id, odometry.child_frame_id), ("odom", "base_footprint"))
        self.assertEqual(self.newest(heard["/joint_states"]).name, ["wheel_left_joint", "wheel_right_joint"])
        pull = self.newest(heard["/mobile_base/sensors/imu_data"]).linear_acceleration
        self.assertAlmostEqual(pull.z, 9.8, delta=0.3)
        self.step(1000)  # commands stay out
        self.assertLess(abs(self.newest(heard["/odom"]).twist.twist.angular.z), 0.01)
        resets = rospy.Publisher("/mobile_base/commands/reset_odometry", Empty, queue_size=1)
        while not resets.get_num_connections():
            rospy.rostime.wallsleep(0.02)
        resets.publish()
        rospy.rostime.wallsleep(0.3)
        self.step(100)
        self.assertLess(abs(self.newest(heard["/odom"]).pose.pose.position.x), 0.01)

    def newest(self, queued):
        message = queued.get(timeout=30)
        rospy.rostime.wallsleep(0.3)
        while not queued.empty():
            message = queued.get()
        return message

    def test_what_is_wrong_is_said(self):
        said = queue.Queue()
        ear = rospy.Subscriber("/rosout", Log, lambda log: said.put(log.msg), queue_size=100)
        while ear.get_num_connections() < 2:  # the simulator and this node
            rospy.rostime.wallsleep(0.02)
        self.spawn("broken", sdf(imu_name="gyro").replace("mobile_base", "broken"), "", Pose(), "world")
        while True:
            text = said.get(timeout=30)
            if "has no sensor 'gyro' of type imu" in text:
                return


if __name__ == "__main__":
    rospy.init_node("kobuki_base_rostest")
    rostest.rosrun("kobuki_base_plugin", "kobuki_base", Kobuki)

#!/usr/bin/env python3
"""The UR5 in the simulator is jogged as the package's example says; expected is way = speed * time."""

import unittest

import numpy as np
import rospy
import rostest
import tf2_ros
from control_msgs.msg import JointJog
from controller_manager_msgs.srv import SwitchController
from controller_manager_tests.client import ManagerClient
from geometry_msgs.msg import TwistStamped, Vector3
from sensor_msgs.msg import JointState
from test_support.waiting import wait_until
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

JOINTS = ["shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint", "wrist_1_joint", "wrist_2_joint", "wrist_3_joint"]
HOME = [0.0, -1.5707, 1.5707, -1.5707, -1.5707, 0.0]
SECONDS = 2.0
PERIOD, HALTS = 0.008, 4  # of ur_simulated_config.yaml


class Ur5(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.transforms = tf2_ros.Buffer()
        cls.listener = tf2_ros.TransformListener(cls.transforms)
        cls.joints = {}
        cls.states = rospy.Subscriber("/joint_states", JointState, lambda message: cls.joints.update(zip(message.name, message.position)))
        cls.said = {"servo_server": [], "trajectories": []}
        cls.commands = [
            rospy.Subscriber("/joint_group_position_controller/command", rospy.AnyMsg, cls.said["servo_server"].append),
            rospy.Subscriber("/arm_controller/command", rospy.AnyMsg, cls.said["trajectories"].append),
        ]
        ManagerClient().wait_until_running("arm_controller")

    def switch(self, start, stop):
        rospy.wait_for_service("/controller_manager/switch_controller", timeout=60.0)
        switch = rospy.ServiceProxy("/controller_manager/switch_controller", SwitchController)
        wait_until(lambda: switch(start_controllers=[start], stop_controllers=[stop], strictness=2).ok, f"{start} to start")

    def setUp(self):
        publisher = rospy.Publisher("/arm_controller/command", JointTrajectory, queue_size=1)
        point = JointTrajectoryPoint(positions=HOME, time_from_start=rospy.Duration(1.0))
        wait_until(publisher.get_num_connections, "the trajectory controller")

        def is_there():
            publisher.publish(JointTrajectory(joint_names=JOINTS, points=[point]))
            rospy.sleep(1.5)
            return np.allclose([self.joints.get(name, 9.0) for name in JOINTS], HOME, atol=0.01)

        wait_until(is_there, "the pose to begin with")

    def tip(self):
        rospy.sleep(0.5)
        now = self.transforms.lookup_transform("world", "ee_link", rospy.Time.now(), rospy.Duration(5.0)).transform.translation
        return np.array([now.x, now.y, now.z])

    def jog(self, node, topic, message):
        """Send it for SECONDS of simulated time, then nothing more; the time, s, for which the arm was commanded to move."""
        publisher = rospy.Publisher(f"/{node}/{topic}", type(message), queue_size=1)
        wait_until(publisher.get_num_connections, node)
        said = len(self.said[node])
        rate = rospy.Rate(100)
        end = rospy.Time.now() + rospy.Duration(SECONDS - 0.1)  # it goes on for incoming_command_timeout
        while rospy.Time.now() < end:
            message.header.stamp = rospy.Time.now()
            publisher.publish(message)
            rate.sleep()
        rospy.sleep(0.5)
        time = (len(self.said[node]) - said - HALTS) * PERIOD  # a busy computer leaves periods out
        self.assertGreater(time, 0.5 * SECONDS)
        self.assertLess(time, 1.05 * SECONDS)
        return time

    def assert_jogs(self, node):
        before = self.tip()
        twist = TwistStamped()
        twist.header.frame_id = "world"
        twist.twist.linear = Vector3(0.0, 0.05, -0.04)
        time = self.jog(node, "delta_twist_cmds", twist)
        moved = self.tip() - before
        velocity = np.array([0.0, 0.05, -0.04])
        way = moved @ velocity / np.linalg.norm(velocity)
        self.assertLess(np.linalg.norm(np.cross(moved, velocity)) / np.linalg.norm(velocity), 0.006)  # aside
        # The controller loses what a busy computer brings too late; servo.test, which makes the time itself, judges the length.
        self.assertLess(way, time * np.linalg.norm(velocity) + 0.006)
        self.assertGreater(way, 0.75 * time * np.linalg.norm(velocity))
        self.assertLess(np.linalg.norm(self.tip() - before - moved), 0.001)  # it stands
        angle = self.joints["elbow_joint"]
        time = self.jog(node, "delta_joint_cmds", JointJog(joint_names=["elbow_joint"], velocities=[0.1]))
        self.tip()
        self.assertLess(self.joints["elbow_joint"] - angle, 0.1 * time + 0.01)
        self.assertGreater(self.joints["elbow_joint"] - angle, 0.075 * time)

    def test_by_the_trajectory_controller(self):
        self.assert_jogs("trajectories")

    def test_by_the_group_controller(self):
        self.switch("joint_group_position_controller", "arm_controller")
        self.addCleanup(self.switch, "arm_controller", "joint_group_position_controller")
        self.assert_jogs("servo_server")


if __name__ == "__main__":
    rospy.init_node("ur5_test")
    rostest.rosrun("moveit_servo", "ur5", Ur5)

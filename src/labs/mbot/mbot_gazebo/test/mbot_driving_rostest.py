#!/usr/bin/env python3
"""How exactly the robot drives: the way and the turns that were commanded, and none while it is parked. In simulated time."""

import math
import time
import unittest

import rospy
import rostest
from gazebo_msgs.msg import ModelState
from gazebo_msgs.srv import GetModelState, SetModelState, SpawnModel
from gazebo_ros.srv import StepWorld
from geometry_msgs.msg import Point, Pose, Quaternion, Twist
from sensor_msgs.msg import JointState
from test_support import heading

STEP = 0.001  # s
RAMP = """<sdf version="1.6"><model name="ramp"><static>true</static><link name="link"><collision name="c"><geometry><box>
    <size>4 2 0.1</size></box></geometry></collision></link></model></sdf>"""


class MbotDriving(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.wait_for_service("/gazebo/step", 60)
        cls.steps = staticmethod(rospy.ServiceProxy("/gazebo/step", StepWorld, persistent=True))
        cls.state = staticmethod(rospy.ServiceProxy("/gazebo/get_model_state", GetModelState, persistent=True))
        cls.commands = rospy.Publisher("/cmd_vel", Twist, queue_size=1)
        cls.names = None
        rospy.Subscriber("/joint_states", JointState, cls.joints)
        cls.until(lambda: cls.commands.get_num_connections(), "subscriber of /cmd_vel")

    @classmethod
    def joints(cls, message):
        if "left_wheel_joint" in message.name:
            cls.names = message.name

    @staticmethod
    def until(condition, what):
        end = time.monotonic() + 60
        while not condition():
            if time.monotonic() > end:
                raise AssertionError("no " + what)
            time.sleep(0.001)

    def wait(self, seconds):
        self.assertTrue(self.steps(round(seconds / STEP)).success)
        return self.state("mbot", "")

    def command(self, forwards, turn):
        """Sends it; steps until the speed changes. Returns the time at which it did, to 10 ms."""
        before = self.state("mbot", "").twist
        twist = Twist()
        twist.linear.x, twist.angular.z = forwards, turn
        self.commands.publish(twist)

        def changed():
            now = self.wait(0.01).twist
            return abs(now.linear.x - before.linear.x) > 0.005 or abs(now.angular.z - before.angular.z) > 0.01

        self.until(changed, "effect of the command")
        return self.state("mbot", "").header.stamp.to_sec()

    def test_1_straight(self):
        start = self.wait(0.5).pose
        began = self.command(0.5, 0)
        self.wait(10)
        ended = self.command(0, 0)  # as much way is lost speeding up as is added slowing down
        end = self.wait(1).pose
        self.assertAlmostEqual(end.position.x - start.position.x, 0.5 * (ended - began), delta=0.05)
        self.assertAlmostEqual(math.degrees(heading(end.orientation) - heading(start.orientation)), 0, delta=0.5)
        self.assertAlmostEqual(end.position.y - start.position.y, 0, delta=0.01)
        self.until(lambda: self.names, "joint states of the wheels")
        self.assertEqual(self.names, ["right_wheel_joint", "left_wheel_joint"])

    def test_2_ten_turns(self):
        start = self.wait(0.1).pose
        began = self.command(0, 2)
        turned, last = 0.0, start
        for _ in range(32):  # less than half a turn each
            pose = self.wait(10 * math.pi / 32).pose
            turned, last = turned + math.remainder(heading(pose.orientation) - heading(last.orientation), 2 * math.pi), pose
        ended = self.command(0, 0)
        end = self.wait(1).pose
        turned += math.remainder(heading(end.orientation) - heading(last.orientation), 2 * math.pi)
        self.assertAlmostEqual(turned, 2 * (ended - began), delta=0.02 * 20 * math.pi)
        self.assertAlmostEqual(math.hypot(end.position.x - start.position.x, end.position.y - start.position.y), 0, delta=0.01)

    def test_3_parked(self):
        start = self.wait(0.5).pose.position
        end = self.wait(60).pose.position
        self.assertLess(math.dist((start.x, start.y, start.z), (end.x, end.y, end.z)), 1e-4)

    def test_4_holds_on_a_ramp(self):
        """Of 10 degrees, facing up, brakes being the motors that are told to stand still."""
        slope = math.radians(10)
        turned = Quaternion(0, -math.sin(slope / 2), 0, math.cos(slope / 2))
        spawn = rospy.ServiceProxy("/gazebo/spawn_sdf_model", SpawnModel)
        self.assertTrue(spawn("ramp", RAMP, "", Pose(Point(0, 20, 1), turned), "").success)
        rospy.ServiceProxy("/gazebo/set_model_state", SetModelState)(
            ModelState("mbot", Pose(Point(0, 20, 1.05 / math.cos(slope) + 0.001), turned), Twist(), "world")
        )
        start = self.wait(1).pose.position
        end = self.wait(20).pose.position
        self.assertGreater(start.z, 0.9)
        self.assertLess(math.dist((start.x, start.y, start.z), (end.x, end.y, end.z)), 1e-3)


if __name__ == "__main__":
    rospy.init_node("mbot_driving", disable_rostime=True)
    rostest.rosrun("mbot_gazebo", "mbot_driving", MbotDriving)

#!/usr/bin/env python3
"""The robot in the room: its laser measures the walls, it drives straight, turns, and all joints are reported."""

import math
import unittest

import rospy
import rostest
from geometry_msgs.msg import Twist
from lab_tools.simulation import Topic, run_free
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState, LaserScan
from test_support import heading

NOISE = 0.01  # m, standard deviation of a ray
HALF_WALL = 0.075
WALLS = {0.0: 5.18 - HALF_WALL, math.pi / 2: 0.68 - HALF_WALL, -math.pi / 2: 4.17 - HALF_WALL}  # bearing: distance


class MbotRoom(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.odometry = Topic("/odom", Odometry)
        cls.odometry.wait_for(lambda m: True, "odometry")
        cls.commands = rospy.Publisher("/cmd_vel", Twist, queue_size=1, latch=True)
        run_free(5)  # not faster: a wall is four seconds away from a robot whose commands come late

    def drive(self, forwards, turn, seconds):
        """At full speed for so many seconds of simulated time at least, then to rest.

        :returns: odometry of the first and last moment at full speed, and the seconds between them.
        """

        def steady(odometry):
            twist = odometry.twist.twist
            return abs(twist.linear.x - forwards) < 1e-3 and abs(twist.angular.z - turn) < 1e-2

        self.odometry.messages.clear()
        self.command(forwards, turn)
        start = self.odometry.wait_for(steady, "full speed")
        end = self.odometry.wait_for(lambda m: (m.header.stamp - start.header.stamp).to_sec() >= seconds, "its end")
        self.command(0, 0)
        self.odometry.messages.clear()
        self.odometry.wait_for(lambda m: abs(m.twist.twist.linear.x) + abs(m.twist.twist.angular.z) < 1e-3, "rest")
        return start, end, (end.header.stamp - start.header.stamp).to_sec()

    def command(self, forwards, turn):
        twist = Twist()
        twist.linear.x, twist.angular.z = forwards, turn
        self.commands.publish(twist)

    def test_1_laser(self):
        scan = Topic("/scan", LaserScan).wait_for(lambda m: True, "scan")
        self.assertEqual((scan.header.frame_id, len(scan.ranges)), ("laser_link", 360))
        for bearing, distance in WALLS.items():
            ray = round((bearing - scan.angle_min) / scan.angle_increment)
            angle = scan.angle_min + ray * scan.angle_increment - bearing
            self.assertAlmostEqual(scan.ranges[ray] * math.cos(angle), distance, delta=5 * NOISE)

    def test_2_drive(self):
        start, end, seconds = self.drive(0.5, 0.0, 2.0)
        self.assertEqual((end.header.frame_id, end.child_frame_id), ("odom", "base_footprint"))
        self.assertAlmostEqual(end.pose.pose.position.x - start.pose.pose.position.x, 0.5 * seconds, delta=0.01)
        self.assertAlmostEqual(end.pose.pose.position.y, start.pose.pose.position.y, delta=0.005)
        self.assertAlmostEqual(heading(end.pose.pose.orientation), 0.0, delta=math.radians(0.5))

    def test_3_turn_on_the_spot(self):
        start, end, seconds = self.drive(0.0, 1.0, 1.5)
        turned = heading(end.pose.pose.orientation) - heading(start.pose.pose.orientation)
        self.assertAlmostEqual(turned, seconds, delta=0.02 * seconds)  # to the left
        self.assertAlmostEqual(end.pose.pose.position.x, start.pose.pose.position.x, delta=0.005)
        self.assertAlmostEqual(end.pose.pose.position.y, start.pose.pose.position.y, delta=0.005)

    def test_4_joint_states(self):
        states = Topic("/joint_states", JointState)
        for joint in ("left_wheel_joint", "right_wheel_joint", "front_caster_joint", "back_caster_joint"):
            states.wait_for(lambda m, joint=joint: joint in m.name, joint)


if __name__ == "__main__":
    rospy.init_node("mbot_room_rostest")
    rostest.rosrun("mbot_gazebo", "mbot_room", MbotRoom)

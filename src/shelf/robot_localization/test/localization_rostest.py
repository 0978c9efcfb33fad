#!/usr/bin/env python3
"""A robot drives a quarter of a circle of 2 m: wheels and an inertial unit tell the one filter, a beacon the other."""

import math
import queue
import subprocess
import unittest

import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from robot_localization.srv import GetState, SetPose
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu

SPEED, RATE = 1.0, 0.5  # m/s, rad/s
VARIANCE = 1e-4


def covariance(size):
    return [VARIANCE if index % (size + 1) == 0 else 0.0 for index in range(size * size)]


class Localization(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.now = rospy.Time(100)
        cls.clock = rospy.Publisher("/clock", Clock, queue_size=1)
        cls.wheels = rospy.Publisher("wheels", Odometry, queue_size=200)
        cls.imu = rospy.Publisher("imu", Imu, queue_size=200)
        cls.beacon = rospy.Publisher("beacon", PoseWithCovarianceStamped, queue_size=200)
        cls.seen = {topic: queue.Queue() for topic in ("odometry/filtered", "odometry/map")}
        listeners = [rospy.Subscriber(topic, Odometry, seen.put) for topic, seen in cls.seen.items()]
        cls.buffer = tf2_ros.Buffer()
        cls.listener = tf2_ros.TransformListener(cls.buffer)
        for end in (cls.wheels, cls.imu, cls.beacon, *listeners):
            while end.get_num_connections() == 0:
                rospy.rostime.wallsleep(0.02)
        # Who hears the mount of the unit here, hears it there as well: it is latched.
        while not cls.buffer.can_transform("base_link", "imu_link", rospy.Time(0)) or cls.clock.get_num_connections() < 3:
            rospy.rostime.wallsleep(0.02)

    def tick(self, until=None):
        """The time goes on: a little while others work, or at once until then."""
        type(self).now = until or self.now + rospy.Duration(0.0005)
        self.clock.publish(self.now)
        rospy.rostime.wallsleep(0.002)

    def estimate(self, topic, stamp):
        """The first estimate from then on; the time goes on meanwhile."""
        for _ in range(20_000):
            try:
                message = self.seen[topic].get_nowait()
            except queue.Empty:
                self.tick()
                continue
            if message.header.stamp >= stamp:
                return message
        self.fail(f"no estimate on {topic} for {stamp.to_sec()} s")

    def drive(self, start, until):
        """Sends what is felt for ``until`` s from ``start`` on, 25 times a second, and waits until each is taken in.

        Returns the last estimates.
        """
        for step in range(int(until * 25) + 1):
            t = step / 25
            stamp = start + rospy.Duration.from_sec(t)
            if self.now < stamp:
                self.tick(stamp)
            wheels = Odometry(child_frame_id="base_link")
            wheels.header.stamp, wheels.header.frame_id = stamp, "odom"
            wheels.twist.twist.linear.x, wheels.twist.covariance = SPEED, covariance(6)
            imu = Imu(orientation_covariance=covariance(3), angular_velocity_covariance=covariance(3))
            imu.header.stamp, imu.header.frame_id = stamp, "imu_link"
            heading = 2.0 + math.pi / 2 + RATE * t  # the unit's own north, and turned to the left
            imu.orientation.z, imu.orientation.w = math.sin(heading / 2), math.cos(heading / 2)
            imu.angular_velocity.z = RATE
            beacon = PoseWithCovarianceStamped()
            beacon.header.stamp, beacon.header.frame_id = stamp, "map"
            beacon.pose.covariance = covariance(6)
            turned = RATE * t
            beacon.pose.pose.position.x, beacon.pose.pose.position.y = 10 + 2 * math.sin(turned), 2 - 2 * math.cos(turned)
            beacon.pose.pose.orientation.z, beacon.pose.pose.orientation.w = math.sin(turned / 2), math.cos(turned / 2)
            for publisher, message in ((self.wheels, wheels), (self.imu, imu), (self.beacon, beacon)):
                publisher.publish(message)
            estimates = {topic: self.estimate(topic, stamp) for topic in self.seen}
        return estimates

    def test_1_drive(self):
        start = self.now
        estimates = self.drive(start, math.pi)
        for topic, frame, x in (("odometry/filtered", "odom", 0), ("odometry/map", "map", 10)):
            message = estimates[topic]
            turned = RATE * (message.header.stamp - start).to_sec()
            self.assertEqual((message.header.frame_id, message.child_frame_id), (frame, "base_link"))
            position = message.pose.pose.position
            self.assertAlmostEqual(position.x, x + 2 * math.sin(turned), delta=0.05)
            self.assertAlmostEqual(position.y, 2 - 2 * math.cos(turned), delta=0.05)
            self.assertEqual(position.z, 0)
            yaw = 2 * math.atan2(message.pose.pose.orientation.z, message.pose.pose.orientation.w)
            self.assertAlmostEqual(yaw, turned, delta=0.03)
        twist = estimates["odometry/filtered"].twist.twist  # the other filter is still finding it out from the poses
        self.assertAlmostEqual(twist.angular.z, RATE, delta=0.03)
        self.assertAlmostEqual(twist.linear.x, SPEED, delta=0.05)
        # One filter tells odom -> base_link, the other map -> odom: they make one tree.
        shift = self.buffer.lookup_transform("map", "odom", rospy.Time(0)).transform
        self.assertAlmostEqual(shift.translation.x, 10, delta=0.15)
        state = rospy.ServiceProxy("/ekf/get_state", GetState)(rospy.Time(0), "").state
        self.assertAlmostEqual(state[11], RATE, delta=0.03)

    def test_2_set_pose(self):
        put = PoseWithCovarianceStamped()
        put.header.stamp, put.header.frame_id = self.now, "odom"
        put.pose.pose.position.x, put.pose.pose.orientation.w = -7.0, 1.0
        rospy.ServiceProxy("set_pose", SetPose)(put)
        message = self.estimate("odometry/filtered", put.header.stamp)
        while abs(message.pose.pose.position.x + 7) > 1e-3:
            message = self.estimate("odometry/filtered", put.header.stamp)
        self.assertAlmostEqual(message.twist.twist.linear.x, 0, delta=1e-3)

    def test_3_bad_messages_do_no_harm(self):
        broken = Odometry(child_frame_id="base_link")
        broken.header.stamp = self.now
        broken.twist.twist.linear.x = math.nan
        self.wheels.publish(broken)
        unknown = Odometry(child_frame_id="nowhere")
        unknown.header.stamp = self.now
        self.wheels.publish(unknown)
        twisted = Imu()
        twisted.header.stamp, twisted.header.frame_id, twisted.orientation.x = self.now, "imu_link", 7.0
        self.imu.publish(twisted)
        message = self.estimate("odometry/filtered", self.now + rospy.Duration(1))
        self.assertTrue(math.isfinite(message.pose.pose.position.x))

    def test_wrong_parameters_are_said(self):
        for parameter, said in (
            ("_odom0_config:=[true]", "/ekf_wrong/odom0_config must be a list of 15 truth values"),
            ("_world_frame:=moon", "world_frame must be map_frame (map) or odom_frame (odom), but is moon"),
            ("_frequency:=.nan", "/ekf_wrong/frequency must be a number, but is nan"),
        ):
            ended = subprocess.run(
                ["rosrun", "robot_localization", "ekf_localization_node", "__name:=ekf_wrong", "_odom0:=nothing", parameter],
                capture_output=True,
                text=True,
                timeout=60,
            )
            rospy.delete_param("/ekf_wrong")
            self.assertEqual(ended.returncode, 1)
            self.assertIn(said, ended.stderr)
            self.assertNotIn("Traceback", ended.stderr)


if __name__ == "__main__":
    rospy.init_node("localization_rostest")
    rostest.rosrun("robot_localization", "localization_rostest", Localization)

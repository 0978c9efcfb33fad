#!/usr/bin/env python3
"""A robot with a receiver 1 m before its origin stands, and is told where: by a fix, by a datum, in another zone."""

import math
import subprocess
import unittest

import rospy
import rostest
import tf2_ros
from geographic_msgs.msg import GeoPoint, GeoPose
from geometry_msgs.msg import Point, Quaternion
from nav_msgs.msg import Odometry
from robot_localization.srv import FromLL, SetDatum, SetUTMZone, ToLL
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, NavSatFix, NavSatStatus

LATITUDE, LONGITUDE, ALTITUDE = 48.1, 11.6, 500.0
METRE = 1 / 111_195.0  # degrees of latitude there
HEADING = 0.6  # of the robot from the east: 0.5 + 0.1 of the parameters, the unit itself says 0


class Navsat(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.now = rospy.Time(100)
        cls.clock = rospy.Publisher("/clock", Clock, queue_size=1)
        cls.odometry = rospy.Publisher("odometry/filtered", Odometry, queue_size=1)
        cls.fixes = rospy.Publisher("gps/fix", NavSatFix, queue_size=1)
        cls.imu = rospy.Publisher("imu/data", Imu, queue_size=1)
        cls.buffer = tf2_ros.Buffer()
        cls.listener = tf2_ros.TransformListener(cls.buffer)
        cls.seen = {"odometry/gps": None, "gps/filtered": None}
        cls.listeners = [
            rospy.Subscriber("odometry/gps", Odometry, cls.keep, "odometry/gps"),
            rospy.Subscriber("gps/filtered", NavSatFix, cls.keep, "gps/filtered"),
        ]

    @classmethod
    def keep(cls, message, topic):
        cls.seen[topic] = message

    def tick(self, north=0.0, odometry=True, fix=True):
        """20 ms pass; the robot says that it has not moved, its receiver that it is that many metres farther north."""
        type(self).now += rospy.Duration(0.02)
        self.clock.publish(self.now)
        if odometry:
            message = Odometry(child_frame_id="base_link")
            message.header.stamp, message.header.frame_id, message.pose.pose.orientation.w = self.now, "odom", 1.0
            self.odometry.publish(message)
        unit = Imu()
        unit.header.stamp, unit.header.frame_id, unit.orientation.w = self.now, "base_link", 1.0
        self.imu.publish(unit)
        if fix:
            message = NavSatFix(latitude=LATITUDE + north * METRE, longitude=LONGITUDE, altitude=ALTITUDE)
            message.header.stamp, message.header.frame_id = self.now, "gps_link"
            message.position_covariance = [4.0, 0, 0, 0, 4.0, 0, 0, 0, 9.0]
            self.fixes.publish(message)
        rospy.rostime.wallsleep(0.01)

    def until(self, condition, **passing):
        for _ in range(6000):
            found = condition()
            if found:
                return found
            self.tick(**passing)
        self.fail("it does not come")

    def odometry_gps(self, **passing):
        """The first of a stamp from now on."""
        since = self.now + rospy.Duration(0.1)
        self.until(lambda: self.seen["odometry/gps"] and self.seen["odometry/gps"].header.stamp >= since, **passing)
        return self.seen["odometry/gps"]

    def test_1_nothing_is_known_at_first(self):
        rospy.wait_for_service("toLL", 60)
        with self.assertRaisesRegex(rospy.ServiceException, "No transform available"):
            rospy.ServiceProxy("toLL", ToLL)(Point())
        # No fix yet, and then one that the receiver itself does not believe in.
        for _ in range(80):
            self.tick(fix=False)
        self.fixes.publish(NavSatFix(status=NavSatStatus(status=NavSatStatus.STATUS_NO_FIX)))
        self.fixes.publish(NavSatFix(latitude=math.nan))
        for _ in range(20):
            self.tick(fix=False)
        self.assertIsNone(self.seen["odometry/gps"])

    def test_2_fixes_become_odometry(self):
        message = self.odometry_gps()
        at, covariance = message.pose.pose.position, message.pose.covariance
        self.assertEqual(message.header.frame_id, "odom")
        for value in (at.x, at.y, at.z):  # the antenna is where it was at first: the robot in its origin
            self.assertAlmostEqual(value, 0, delta=1e-6)
        self.assertEqual(message.pose.pose.orientation.w, 1)
        self.assertAlmostEqual(covariance[0], 4, delta=1e-6)
        self.assertAlmostEqual(covariance[14], 9, delta=1e-6)
        at = self.odometry_gps(north=10.0).pose.pose.position
        self.assertAlmostEqual(at.x, 10 * math.sin(HEADING), delta=0.02)
        self.assertAlmostEqual(at.y, 10 * math.cos(HEADING), delta=0.02)

    def test_3_places_there_and_back(self):
        to_ll, from_ll = rospy.ServiceProxy("toLL", ToLL), rospy.ServiceProxy("fromLL", FromLL)
        place = to_ll(Point(10 * math.sin(HEADING) + 1, 10 * math.cos(HEADING), 0.5)).ll_point  # 1, 0, 0.5: the antenna
        self.assertAlmostEqual(place.latitude, LATITUDE + 10 * METRE, delta=0.02 * METRE)
        self.assertAlmostEqual(place.longitude, LONGITUDE, delta=0.02 * METRE)
        self.assertAlmostEqual(place.altitude, ALTITUDE, delta=1e-6)
        back = from_ll(place).map_point
        self.assertAlmostEqual(back.x, 10 * math.sin(HEADING) + 1, delta=1e-3)
        self.assertAlmostEqual(back.z, 0.5, delta=1e-6)
        with self.assertRaisesRegex(rospy.ServiceException, "no point on the earth"):
            from_ll(GeoPoint(latitude=200.0))

    def test_4_the_robot_on_the_earth(self):
        self.until(lambda: self.seen["gps/filtered"])
        fix = self.seen["gps/filtered"]
        self.assertEqual((fix.header.frame_id, fix.status.status, fix.position_covariance_type), ("base_link", 2, 3))
        # The robot's origin is 1 m behind the antenna.
        self.assertAlmostEqual(fix.latitude, LATITUDE - math.sin(HEADING) * METRE, delta=0.01 * METRE)
        self.assertAlmostEqual(fix.altitude, ALTITUDE - 0.5, delta=1e-6)
        sent = self.until(
            lambda: (
                self.buffer.can_transform("odom", "local_enu", rospy.Time(0))
                and self.buffer.lookup_transform("odom", "local_enu", rospy.Time(0))
            )
        ).transform
        self.assertAlmostEqual(2 * math.atan2(sent.rotation.z, sent.rotation.w), -HEADING, delta=1e-4)

    def test_5_a_new_datum(self):
        """The origin is put 20 m north of the first fix, looking north."""
        turned = Quaternion(z=math.sqrt(0.5), w=math.sqrt(0.5))
        rospy.ServiceProxy("datum", SetDatum)(GeoPose(GeoPoint(LATITUDE + 20 * METRE, LONGITUDE, ALTITUDE), turned))
        self.until(lambda: self.tick() or self.seen["odometry/gps"].pose.pose.position.x < -15)
        at = self.odometry_gps().pose.pose.position  # the fix is of the antenna, the declared north is 0.6 rad off
        self.assertAlmostEqual(math.hypot(at.x + 1, at.y), 20, delta=0.05)
        with self.assertRaisesRegex(rospy.ServiceException, "no point on the earth"):
            rospy.ServiceProxy("datum", SetDatum)(GeoPose(GeoPoint(latitude=100.0), turned))

    def test_6_a_datum_of_the_parameters(self):
        place = rospy.ServiceProxy("/other/toLL", ToLL)
        rospy.wait_for_service("/other/toLL", 60)

        def known():
            try:
                return place(Point(0, 100, 7)).ll_point
            except rospy.ServiceException:
                return None

        ahead = self.until(known)
        # 110 920 m a degree there; the grid shrinks by 0.03 %
        self.assertAlmostEqual(ahead.latitude, -33.9 + 100 / 110_920, delta=1e-6)
        self.assertAlmostEqual(ahead.longitude, 18.4, delta=1e-7)
        # Another zone: its fixes are waited for.
        rospy.ServiceProxy("/other/setUTMZone", SetUTMZone)("33H")
        with self.assertRaisesRegex(rospy.ServiceException, "No transform available"):
            place(Point())
        with self.assertRaisesRegex(rospy.ServiceException, "as in 31U"):
            rospy.ServiceProxy("/other/setUTMZone", SetUTMZone)("99")

    def test_wrong_parameters_are_said(self):
        for parameter, said in (
            ("_datum:=[1,2]", "/wrong/datum must be a list [latitude, longitude, yaw]"),
            ("_yaw_offset:=.inf", "/wrong/yaw_offset must be a number, but is inf"),
        ):
            ended = subprocess.run(
                ["rosrun", "robot_localization", "navsat_transform_node", "__name:=wrong", "_wait_for_datum:=true", parameter],
                capture_output=True,
                text=True,
                timeout=60,
            )
            rospy.delete_param("/wrong")
            self.assertEqual(ended.returncode, 1)
            self.assertIn(said, ended.stderr)
            self.assertNotIn("Traceback", ended.stderr)


if __name__ == "__main__":
    rospy.init_node("navsat_rostest")
    rostest.rosrun("robot_localization", "navsat_rostest", Navsat)

#!/usr/bin/env python3
"""Readings of a tilted sensor in, its orientation out; the same node of the complementary filter takes this test too."""

import math
import queue
import sys
import unittest

import rospy
import rostest
from geometry_msgs.msg import Vector3
from imu_filters.rotation import about, conjugate, product, turned
from sensor_msgs.msg import Imu, MagneticField
from std_msgs.msg import Header

TILT, YAW = 0.4, 1.1
PLACED = product(about((0.0, 0.0, 1.0), YAW), about((1.0, 0.0, 0.0), TILT))
DRIFT = 0.05  # rad/s that the sensor feels though it stands


class Orientation(unittest.TestCase):
    def test_a_tilted_sensor(self):
        heard = queue.Queue()
        rospy.Subscriber("imu/data", Imu, heard.put)
        readings = rospy.Publisher("imu/data_raw", Imu, queue_size=10)
        fields = rospy.Publisher("imu/mag", MagneticField, queue_size=10)
        up = Vector3(*turned(conjugate(PLACED), (0.0, 0.0, 9.81)))
        north = Vector3(*turned(conjugate(PLACED), (0.0, 2e-5, -4e-5)))
        for i in range(600):
            header = Header(stamp=rospy.Time(100 + 0.01 * i), frame_id="imu")
            readings.publish(Imu(header=header, angular_velocity=Vector3(0, 0, DRIFT), linear_acceleration=up))
            fields.publish(MagneticField(header=header, magnetic_field=north))
            try:
                told = heard.get(timeout=0.02 if i else 1.0)
            except queue.Empty:
                continue
            if told.header.stamp.to_sec() > 102:
                break
        else:
            self.fail("no orientation")
        q = told.orientation
        expected = product(about((0.0, 0.0, 1.0), rospy.get_param("~yaw", 0.0)), PLACED)
        off = product(conjugate(expected), (q.w, q.x, q.y, q.z))
        self.assertLess(2 * math.acos(min(abs(off[0]), 1.0)), 0.06)
        self.assertEqual(told.header.frame_id, "imu")
        self.assertAlmostEqual(told.linear_acceleration.z, up.z)


if __name__ == "__main__":
    rospy.init_node("orientation_rostest")
    rostest.rosrun("imu_filter_madgwick", "imu_filter", Orientation, sys.argv)

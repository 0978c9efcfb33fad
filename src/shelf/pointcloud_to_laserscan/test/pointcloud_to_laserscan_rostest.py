#!/usr/bin/env python3
"""A cloud in, a scan in another frame out."""

import math
import queue
import unittest

import rospy
import rostest
from sensor_msgs.msg import LaserScan
from sensor_msgs.point_cloud2 import create_cloud_xyz32
from std_msgs.msg import Header


class Scans(unittest.TestCase):
    def test_a_scan_of_a_cloud(self):
        scans = queue.Queue()
        clouds = rospy.Publisher("points", type(create_cloud_xyz32(Header(), [])), queue_size=1)
        self.assertEqual(clouds.get_num_connections(), 0)  # nobody listens to the scan yet
        rospy.Subscriber("scan", LaserScan, scans.put)
        # the camera looks along x, lies on its side (roll of a quarter turn): its y is up
        points = [(2.0, 0.2, 0.0), (3.0, 0.2, 0.0), (1.0, 2.0, 0.0), (2.0, 0.0, -2.0)]
        for _ in range(200):
            clouds.publish(create_cloud_xyz32(Header(frame_id="camera"), points))
            try:
                scan = scans.get(timeout=0.1)
                break
            except queue.Empty:
                pass
        else:
            self.fail("no scan")
        self.assertEqual(scan.header.frame_id, "base")
        hits = {round(scan.angle_min + (i + 0.5) * scan.angle_increment, 2): r for i, r in enumerate(scan.ranges) if math.isfinite(r)}
        self.assertEqual(len(hits), 2, hits)
        self.assertAlmostEqual(min(hits.values()), 2.0, places=3)
        self.assertAlmostEqual(max(hits.values()), math.hypot(2, 2), places=3)


if __name__ == "__main__":
    rospy.init_node("pointcloud_to_laserscan_rostest")
    rostest.rosrun("pointcloud_to_laserscan", "pointcloud_to_laserscan", Scans)

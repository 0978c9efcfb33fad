#!/usr/bin/env python3
"""A cloud in, a scan in another frame out."""

import math
import queue
import time
import unittest

import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import LaserScan, PointCloud2
from sensor_msgs.point_cloud2 import create_cloud_xyz32, read_points
from std_msgs.msg import Header


class Scans(unittest.TestCase):
    def test_a_scan_of_a_cloud(self):
        scans = queue.Queue()
        clouds = rospy.Publisher("points", PointCloud2, queue_size=1)
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

    def test_clouds_wait_for_a_transform_that_comes_later(self):
        """As behind a tf2 MessageFilter: as many as the concurrency level may wait, and the oldest of more than those goes."""
        scans = queue.Queue()
        listener = rospy.Subscriber("late_scan", LaserScan, lambda scan: scans.put(scan.header.stamp))
        clouds = rospy.Publisher("late_points", PointCloud2, queue_size=10)
        tf = tf2_ros.TransformBroadcaster()
        end = time.monotonic() + 30
        while not (clouds.get_num_connections() and listener.get_num_connections() and tf.pub_tf.get_num_connections()):
            self.assertLess(time.monotonic(), end, "the node is not connected")
            time.sleep(0.01)
        start = rospy.Time.now()

        def known(after):
            place = TransformStamped(header=Header(stamp=start + rospy.Duration(after), frame_id="odom"), child_frame_id="base")
            place.transform.rotation.w = 1.0
            tf.sendTransform(place)

        known(-1.0)
        stamps = [start + rospy.Duration(0.1 * i) for i in range(5)]
        for stamp in stamps:
            clouds.publish(create_cloud_xyz32(Header(frame_id="base", stamp=stamp), [(2.0, 0.2, 0.5)]))
        with self.assertRaises(queue.Empty):
            scans.get(timeout=1.0)  # much longer than transform_tolerance, 10 ms
        end = time.monotonic() + 20
        while scans.qsize() < 2 and time.monotonic() < end:
            known(-1.0)  # again and again: whether this node, of several that listen to /tf, is connected already is not known here
            known(0.35)
            time.sleep(0.1)
        # the third and the fourth are ready, the first two have gone
        self.assertEqual([scans.get(timeout=20), scans.get(timeout=20)], stamps[2:4])
        known(1.0)
        self.assertEqual(scans.get(timeout=20), stamps[4])
        self.assertTrue(scans.empty())

    def test_a_cloud_of_a_scan(self):
        """What laser_geometry's projectLaser makes: rays from range_min to below range_max, with intensity and index."""
        clouds = queue.Queue()
        rospy.Subscriber("front/cloud", PointCloud2, clouds.put)
        scans = rospy.Publisher("front/scan", LaserScan, queue_size=1)
        scan = LaserScan(angle_min=-math.pi / 2, angle_increment=math.pi / 2, range_min=0.5, range_max=10.0)
        scan.header.frame_id = "camera"
        scan.ranges, scan.intensities = [2.0, 0.4, 3.0, 10.0, math.inf, math.nan], [5.0, 6.0, 7.0, 8.0, 9.0, 10.0]
        for _ in range(200):
            scans.publish(scan)
            try:
                cloud = clouds.get(timeout=0.1)
                break
            except queue.Empty:
                pass
        else:
            self.fail("no cloud")
        self.assertEqual([(field.name, field.offset) for field in cloud.fields][3:], [("intensity", 12), ("index", 16)])
        self.assertEqual((cloud.header.frame_id, cloud.width, cloud.height, cloud.point_step), ("base", 2, 1, 20))
        # the camera lies on its side 0.3 m above the base: its y is up
        for found, wanted in zip(read_points(cloud), [(0.0, 0.0, 0.3 - 2.0, 5.0, 0), (0.0, 0.0, 0.3 + 3.0, 7.0, 2)]):
            for a, b in zip(found, wanted):
                self.assertAlmostEqual(a, b, places=3)


if __name__ == "__main__":
    rospy.init_node("pointcloud_to_laserscan_rostest")
    rostest.rosrun("pointcloud_to_laserscan", "pointcloud_to_laserscan", Scans)

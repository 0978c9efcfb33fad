#!/usr/bin/env python3
"""A scan through a chain of two filters; one of them is changed while it runs."""

import math
import queue
import time
import unittest

import rospy
import rostest
import tf2_ros
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import LaserScan, PointCloud2
from sensor_msgs.point_cloud2 import read_points


class Scans(unittest.TestCase):
    def told(self, wanted, topic="scan", scan=None):
        """Publish ``scan`` until what comes back has the ranges ``wanted``."""
        heard = queue.Queue()
        listener = rospy.Subscriber("scan_filtered" if topic == "scan" else "wide_filtered", LaserScan, heard.put)
        scans = rospy.Publisher(topic, LaserScan, queue_size=1)
        if scan is None:
            scan = LaserScan(angle_min=-0.1, angle_max=0.1, angle_increment=0.1, range_min=0.1, range_max=10.0, ranges=[0.2, 2.0, 4.0])
            scan.header.frame_id = "laser"
        ranges = []
        for _ in range(300):
            scans.publish(scan)
            try:
                ranges = [str(round(r, 3)) for r in heard.get(timeout=0.1).ranges]
            except queue.Empty:
                continue
            if ranges == wanted:
                break
        listener.unregister()
        scans.unregister()
        self.assertEqual(ranges, wanted)

    def test_a_chain_that_is_changed(self):
        self.told(["0.0", "nan", "4.0"])
        Client("/laser_filter/box", timeout=20).update_configuration({"max_x": 6.0, "min_x": 4.0})
        self.told(["0.0", "2.0", "nan"])

    def test_b_values_beyond_the_bounds_hold_until_a_client_asks(self):
        """configure() of upstream's filters hands the chain's values to updateConfig, which does not look at the bounds."""
        # 360 degrees in steps of a radian: only the rays at 4 and 5 rad are in the sector from 3.4 to 5.1
        scan = LaserScan(
            angle_min=0.0, angle_increment=1.0, range_min=0.1, range_max=1000.0, ranges=[400.0, 0.2, 1.0, 700.0, 1.0, 1.0, 2.0]
        )
        scan.header.frame_id = "wide"
        scan.intensities = [500000.0] * 7
        self.told(["400.0", "-inf", "1.0", "inf", "nan", "nan", "2.0"], "wide_scan", scan)
        box = Client("/wide/box", timeout=20)
        config = box.get_configuration(timeout=20)
        self.assertEqual((config["max_x"], config["min_x"], config["min_z"]), (500.0, -100.0, -1.0))
        self.assertEqual(box.update_configuration({"max_x": 400.0})["max_x"], 100.0, "what a client asks for is kept in range")
        sector = Client("/wide/sector", timeout=20)
        self.assertEqual(sector.get_configuration(timeout=20)["angle_max"], 5.1)

    def test_scans_wait_for_a_transform_that_comes_later(self):
        """As behind a tf MessageFilter: up to 50 wait, until the transform is known at their time and 0.03 s later."""
        heard = queue.Queue()
        listener = rospy.Subscriber("late_filtered", LaserScan, lambda scan: heard.put(scan.header.stamp))
        scans = rospy.Publisher("late_scan", LaserScan, queue_size=60)
        tf = tf2_ros.TransformBroadcaster()
        end = time.monotonic() + 30
        while not (scans.get_num_connections() and listener.get_num_connections() and tf.pub_tf.get_num_connections() >= 5):
            self.assertLess(time.monotonic(), end, "the nodes are not connected")
            time.sleep(0.01)
        start = rospy.Time.now()
        stamps = [start + rospy.Duration(0.1 * i) for i in range(20)]
        place = TransformStamped(child_frame_id="laser_late")
        place.header.frame_id, place.header.stamp, place.transform.rotation.w = "odom", start - rospy.Duration(1.0), 1.0
        tf.sendTransform(place)
        for stamp in stamps:
            scan = LaserScan(angle_increment=0.1, range_max=10.0, ranges=[1.0])
            scan.header.frame_id, scan.header.stamp = "laser_late", stamp
            scans.publish(scan)
        with self.assertRaises(queue.Empty):
            heard.get(timeout=1.5)
        place.header.stamp = start + rospy.Duration(1.92)  # the last one, of 1.9 s, is not known 0.03 s later
        tf.sendTransform(place)
        self.assertEqual([heard.get(timeout=20) for _ in stamps[:-1]], stamps[:-1])
        with self.assertRaises(queue.Empty):
            heard.get(timeout=0.5)
        place.header.stamp = start + rospy.Duration(2.0)
        tf.sendTransform(place)
        self.assertEqual(heard.get(timeout=20), stamps[-1])

    def answer(self, topic, out, kind):
        """What comes on ``out`` for a scan in the frame laser on ``topic``."""
        heard = queue.Queue()
        listener = rospy.Subscriber(out, kind, heard.put)
        self.addCleanup(listener.unregister)
        scans = rospy.Publisher(topic, LaserScan, queue_size=1)
        scan = LaserScan(angle_min=0.0, angle_increment=math.pi / 2, range_min=0.1, range_max=10.0, ranges=[0.5, 2.0], intensities=[1, 2])
        scan.header.frame_id = "laser"
        for _ in range(300):
            scans.publish(scan)
            try:
                return heard.get(timeout=0.1)
            except queue.Empty:
                pass
        self.fail(f"nothing on {out}")

    def test_a_cloud_in_another_frame(self):
        cloud = self.answer("cloud_scan", "cloud_filtered", PointCloud2)
        self.assertEqual([field.name for field in cloud.fields], ["x", "y", "z", "intensity", "index", "distances"])
        self.assertEqual(cloud.header.frame_id, "base_link")
        (point,) = read_points(cloud)  # the other ray's range is 0 now; the sensor is at (1, 0, 0.2)
        for found, wanted in zip(point, (1.0, 2.0, 0.2, 2.0, 1, 2.0)):
            self.assertAlmostEqual(found, wanted, places=4)

    def test_the_generic_node(self):
        self.assertEqual(self.answer("scan_in", "output", LaserScan).ranges, (0.0, 2.0))


if __name__ == "__main__":
    rospy.init_node("scan_filters_rostest")
    rostest.rosrun("laser_filters", "scan_filters", Scans)

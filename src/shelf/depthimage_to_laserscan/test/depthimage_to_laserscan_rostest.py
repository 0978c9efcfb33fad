#!/usr/bin/env python3
"""Depth images of known walls, through the node and the nodelet."""

import queue
import unittest

import numpy as np
import rospy
import rostest
from sensor_msgs.msg import CameraInfo, Image, LaserScan

WIDTH, HEIGHT, FOCAL, CX, CY = 64, 48, 50.0, 31.5, 23.5


def info():
    return CameraInfo(
        width=WIDTH,
        height=HEIGHT,
        distortion_model="plumb_bob",
        D=[0.0] * 5,
        R=[1, 0, 0, 0, 1, 0, 0, 0, 1],
        K=[FOCAL, 0, CX, 0, FOCAL, CY, 0, 0, 1],
        P=[FOCAL, 0, CX, 0, 0, FOCAL, CY, 0, 0, 0, 1, 0],
    )


def image(depth):
    """:param depth: (HEIGHT, WIDTH), float32 in m or uint16 in mm"""
    return Image(
        width=WIDTH,
        height=HEIGHT,
        encoding={"float32": "32FC1", "uint16": "16UC1"}[depth.dtype.name],
        step=WIDTH * depth.itemsize,
        data=depth.tobytes(),
    )


class DepthImageToLaserScan(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.images = rospy.Publisher("/camera/depth/image_raw", Image, queue_size=1)
        cls.infos = rospy.Publisher("/camera/depth/camera_info", CameraInfo, queue_size=1)
        cls.stamp = 0

    def scan(self, topic, message):
        """The scan of this image; sends it again until the listener is connected."""
        type(self).stamp += 1
        seen = queue.Queue()
        subscriber = rospy.Subscriber(topic, LaserScan, seen.put)
        self.addCleanup(subscriber.unregister)
        camera = info()
        message.header.stamp = camera.header.stamp = rospy.Time(self.stamp)
        message.header.frame_id = camera.header.frame_id = "camera_depth_optical_frame"
        for _ in range(600):
            self.images.publish(message)
            self.infos.publish(camera)
            try:
                scan = seen.get(timeout=0.1)
            except queue.Empty:
                continue
            if scan.header.stamp == message.header.stamp:
                return scan
        self.fail(f"no scan on {topic}")

    def wall(self, scan, distance):
        """Ranges of a wall straight ahead (m), with the step of one column allowed for."""
        angles = scan.angle_min + scan.angle_increment * np.arange(WIDTH)
        near, far = (distance / np.cos(np.maximum(np.abs(angles) + side * scan.angle_increment, 0)) for side in (-1, 1))
        ranges = np.array(scan.ranges)
        seen = np.isfinite(ranges)
        self.assertGreater(seen.sum(), 0.8 * WIDTH)
        self.assertTrue(((ranges >= near - 1e-4) & (ranges <= far + 1e-4))[seen].all(), (ranges, near, far))

    def test_wall_in_metres(self):
        scan = self.scan("scan", image(np.full((HEIGHT, WIDTH), 2.0, np.float32)))
        self.assertEqual(scan.header.frame_id, "camera_depth_frame")
        self.assertAlmostEqual(scan.angle_max, np.arctan(CX / FOCAL), 6)
        self.assertAlmostEqual(scan.angle_min, -np.arctan((WIDTH - 1 - CX) / FOCAL), 6)
        self.assertAlmostEqual(scan.range_max, 10.0)
        self.wall(scan, 2.0)

    def test_wall_in_millimetres_and_nothing_known(self):
        depth = np.full((HEIGHT, WIDTH), 1500, np.uint16)
        depth[:, : WIDTH // 4] = 0
        scan = self.scan("scan", image(depth))
        ranges = np.array(scan.ranges)
        self.assertTrue(np.isnan(ranges[-WIDTH // 8 :]).all(), "the image's left is the scan's end")
        self.assertAlmostEqual(ranges[WIDTH // 2 - 4], 1.5, 2)

    def test_nearest_of_the_rows_within_the_limits(self):
        depth = np.full((HEIGHT, WIDTH), np.inf, np.float32)
        depth[20], depth[22], depth[24], depth[2] = 3.0, 0.2, 5.0, 1.0  # m: seen, too near, too far, beside the ten rows
        scan = self.scan("/nodelet/scan", image(depth))
        self.assertEqual(scan.header.frame_id, "laser")
        self.wall(scan, 3.0)

    def test_nothing_there_is_infinite(self):
        scan = self.scan("/nodelet/scan", image(np.full((HEIGHT, WIDTH), np.inf, np.float32)))
        ranges = np.array(scan.ranges)
        self.assertGreater(np.isposinf(ranges).sum(), 0.8 * WIDTH)
        self.assertFalse(np.isfinite(ranges).any())

    def test_a_torn_image_does_no_harm(self):
        torn = image(np.full((HEIGHT, WIDTH), 2.0, np.float32))
        torn.data = torn.data[:100]
        torn.header.frame_id = "torn"
        for _ in range(5):
            self.images.publish(torn)
            self.infos.publish(info())
        self.wall(self.scan("scan", image(np.full((HEIGHT, WIDTH), 2.5, np.float32))), 2.5)


if __name__ == "__main__":
    rospy.init_node("depthimage_to_laserscan_rostest")
    rostest.rosrun("depthimage_to_laserscan", "depthimage_to_laserscan_rostest", DepthImageToLaserScan)

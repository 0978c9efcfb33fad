#!/usr/bin/env python3
"""The frame with all sensors stands in an empty world; every sensor tells something of it, in its frame."""

import unittest

import rospy
import rostest
from sensor_msgs.msg import CameraInfo, Image, LaserScan, PointCloud2, Range

TOPICS = {  # frame, and what is in a message
    "/front/scan": (LaserScan, "front_laser", lambda scan: len(scan.ranges) == 720 and scan.range_max == 30),
    "/tim310/scan": (LaserScan, "tim310", lambda scan: len(scan.ranges) == 271 and scan.range_max == 4),
    "/tim551/scan": (LaserScan, "tim551", lambda scan: abs(scan.angle_min + 1) < 1e-6),
    "/hokuyo/scan": (LaserScan, "hokuyo_frame", lambda scan: abs(scan.angle_max - 2.356) < 1e-3),
    "/hokuyo_gpu/scan": (LaserScan, "hokuyo_gpu_frame", lambda scan: len(scan.ranges) == 1081),
    "/sonar": (Range, "sonar_link", lambda told: abs(told.max_range - 3) < 1e-6 and abs(told.field_of_view - 0.698) < 1e-2),
    "/blackfly/image_raw": (Image, "blackfly_optical", lambda image: (image.width, image.height) == (160, 120)),
    "/flea/image_raw": (Image, "flea_optical", lambda image: (image.width, image.height) == (160, 128)),
    "/bumblebee2/right/camera_info": (CameraInfo, "bumblebee2_optical", lambda told: told.P[3] < -50),  # 0.12 m of fx
    "/generic/image": (Image, "generic_optical_frame", lambda image: image.encoding == "rgb8"),
    "/asus/depth/points": (PointCloud2, "asus_depth_optical_frame", lambda cloud: cloud.width * cloud.height == 640 * 480),
}


class Sensors(unittest.TestCase):
    def test_all(self):
        heard = {}
        listeners = [
            rospy.Subscriber(topic, kind, lambda message, topic=topic: heard.setdefault(topic, message), queue_size=1)
            for topic, (kind, _, _) in TOPICS.items()
        ]
        for _ in range(1800):
            if len(heard) == len(TOPICS):
                break
            rospy.rostime.wallsleep(0.1)
        self.assertEqual(set(TOPICS) - set(heard), set())
        for listener in listeners:
            listener.unregister()
        for topic, message in heard.items():
            _, frame, right = TOPICS[topic]
            self.assertEqual(message.header.frame_id, frame, topic)
            self.assertTrue(right(message), topic)


if __name__ == "__main__":
    rospy.init_node("sensors_rostest")
    rostest.rosrun("sensor_descriptions_tests", "sensors_rostest", Sensors)

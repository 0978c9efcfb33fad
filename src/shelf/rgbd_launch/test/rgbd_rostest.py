#!/usr/bin/env python3
"""A wall 2 m before the camera: its cloud, and its cloud in the colours of the other camera."""

import struct
import unittest

import numpy as np
import rospy
import rostest
from sensor_msgs.msg import CameraInfo, Image, PointCloud2

WIDTH, HEIGHT, F = 64, 48, 60.0


def pictures(stamp):
    """What a device without registration of its own sends: topics and messages."""
    for name, frame, encoding, picture in (
        ("depth", "depth", "16UC1", np.full((HEIGHT, WIDTH), 2000, np.uint16)),
        ("rgb", "rgb", "rgb8", np.full((HEIGHT, WIDTH, 3), (250, 20, 30), np.uint8)),
    ):
        image = Image(height=HEIGHT, width=WIDTH, encoding=encoding, step=picture.strides[0], data=picture.tobytes())
        info = CameraInfo(
            height=HEIGHT,
            width=WIDTH,
            distortion_model="plumb_bob",
            D=[0.0] * 5,
            R=[1, 0, 0, 0, 1, 0, 0, 0, 1],
            K=[F, 0, WIDTH / 2, 0, F, HEIGHT / 2, 0, 0, 1],
            P=[F, 0, WIDTH / 2, 0, 0, F, HEIGHT / 2, 0, 0, 0, 1, 0],
        )
        for message in (image, info):
            message.header.stamp, message.header.frame_id = stamp, f"camera_{frame}_optical_frame"
        yield name, image, info


class Clouds(unittest.TestCase):
    def test_clouds(self):
        heard = {}
        listeners = [
            rospy.Subscriber(topic, PointCloud2, lambda cloud, topic=topic: heard.setdefault(topic, cloud), queue_size=1)
            for topic in ("/camera/depth/points", "/camera/depth_registered/points")
        ]
        sent = {
            name: (
                rospy.Publisher(f"/camera/{name}/image_raw", Image, queue_size=2),
                rospy.Publisher(f"/camera/{name}/camera_info", CameraInfo, queue_size=2),
            )
            for name in ("depth", "rgb")
        }
        for _ in range(600):
            if len(heard) == len(listeners):
                break
            for name, image, info in pictures(rospy.Time.now()):
                sent[name][0].publish(image)
                sent[name][1].publish(info)
            rospy.rostime.wallsleep(0.1)
        self.assertEqual(len(heard), 2, list(heard))
        colours = []
        for cloud in heard.values():
            self.assertEqual((cloud.width, cloud.height), (WIDTH, HEIGHT))
            at = {field.name: field.offset for field in cloud.fields}
            middle = cloud.data[(HEIGHT // 2 * WIDTH + WIDTH // 2) * cloud.point_step :][: cloud.point_step]
            self.assertAlmostEqual(struct.unpack_from("<f", middle, at["z"])[0], 2.0, places=3)
            if "rgb" in at:
                colours.append(tuple(middle[at["rgb"] : at["rgb"] + 3]))
        self.assertEqual(colours, [(30, 20, 250)])


if __name__ == "__main__":
    rospy.init_node("rgbd_rostest")
    rostest.rosrun("rgbd_launch", "rgbd", Clouds)

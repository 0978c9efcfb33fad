#!/usr/bin/env python3
"""Images through image_transport's republish and the plugins of all transports, and back."""

import unittest

import numpy as np
import rospy
import rostest
from sensor_msgs.msg import Image
from theora_image_transport.publisher import TheoraPublisher

HEIGHT, WIDTH = 48, 64


def colour():
    rows, columns = np.indices((HEIGHT, WIDTH))
    return np.stack([4 * columns, 5 * rows, 255 - 4 * columns], axis=2).astype(np.uint8)


def depth():
    return np.linspace(0.5, 9.0, HEIGHT * WIDTH, dtype=np.float32).reshape(HEIGHT, WIDTH)


def image(encoding, pixels):
    message = Image(height=HEIGHT, width=WIDTH, encoding=encoding, step=pixels.strides[0], data=pixels.tobytes())
    message.header.frame_id, message.header.stamp = "camera", rospy.Time.now()
    return message


class Transports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.ways = {"compressed": None, "compressedDepth": None, "theora": None, "python": None}
        cls.listeners = [rospy.Subscriber(f"out/{way}", Image, cls.keep, way) for way in cls.ways]
        cls.senders = {"rgb8": rospy.Publisher("colour", Image, queue_size=1), "32FC1": rospy.Publisher("depth", Image, queue_size=1)}
        cls.python = TheoraPublisher("/python", "rgb8", (HEIGHT, WIDTH), 2)

    @classmethod
    def keep(cls, message, way):
        cls.ways[way] = message

    def come(self, way):
        """The first image that has come all the way."""
        for _ in range(1200):
            for encoding, pixels in (("rgb8", colour()), ("32FC1", depth())):
                self.senders[encoding].publish(image(encoding, pixels))
            self.python.publish(image("rgb8", colour()).header, colour().tobytes())
            rospy.rostime.wallsleep(0.05)
            if self.ways[way] is not None:
                return self.ways[way]
        self.fail(f"nothing came by {way}")

    def pixels(self, message, kind, order=1):
        self.assertEqual((message.height, message.width, message.header.frame_id), (HEIGHT, WIDTH, "camera"))
        return np.frombuffer(message.data, kind).reshape(HEIGHT, WIDTH, -1)[..., ::order].astype(float)

    def test_compressed(self):
        got = self.come("compressed")
        self.assertEqual(got.encoding, "rgb8")
        self.assertLess(np.abs(self.pixels(got, np.uint8) - colour()).mean(), 4)

    def test_depth(self):
        got = self.come("compressedDepth")
        self.assertEqual(got.encoding, "32FC1")
        self.assertLess(np.abs(self.pixels(got, np.float32)[..., 0] - depth()).max(), 0.01)

    def test_theora(self):
        for way in ("theora", "python"):
            got = self.come(way)
            self.assertEqual(got.encoding, "bgr8")
            self.assertLess(np.abs(self.pixels(got, np.uint8, -1) - colour()).mean(), 8, way)

    def test_parameters(self):
        for name in ("packed/compressed/jpeg_quality", "packed_depth/compressedDepth/png_level", "packed_theora/theora/quality"):
            self.assertTrue(rospy.has_param(name), name)


if __name__ == "__main__":
    rospy.init_node("transports_rostest")
    rostest.rosrun("theora_image_transport", "transports_rostest", Transports)

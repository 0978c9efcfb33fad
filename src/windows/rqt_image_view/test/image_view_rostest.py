#!/usr/bin/env python3
"""Images of a real publisher: raw, compressed and as a Theora stream, on topics that come after the window."""

import sys
import unittest

import numpy as np
import rospy
import rostest

from rqt_testing.in_process import errors, open_plugin, wait_until  # isort: skip
import cv2
from geometry_msgs.msg import Point
from rqt_image_view.source import image_topics
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import Header
from theora_image_transport.msg import Packet
from theora_image_transport.publisher import TheoraPublisher

PICTURE = np.full((120, 160, 3), (200, 60, 30), np.uint8)


class ImageView(unittest.TestCase):
    def shows_orange(self, topic, kind, messages):
        """Opens the window first, then publishes until the colour is there."""
        with open_plugin("rqt_image_view", [topic]) as gui:
            publisher = rospy.Publisher(topic, kind, queue_size=10)
            wait_until(publisher.get_num_connections)
            canvas = gui.plugin._widget.canvas

            def seen():
                publisher.publish(next(messages))
                return canvas.picture is not None and canvas.picture.shape == PICTURE.shape

            wait_until(seen)
            self.assertLess(np.abs(canvas.picture[60, 80].astype(int) - (200, 60, 30)).max(), 12)
            publisher.unregister()
        self.assertEqual(errors, [])

    def test_raw(self):
        image = Image(height=120, width=160, encoding="bgr8", step=480, data=PICTURE[..., ::-1].tobytes())
        self.shows_orange("/camera/image", Image, iter(lambda: image, None))

    def test_compressed(self):
        data = cv2.imencode(".jpg", PICTURE[..., ::-1])[1].tobytes()
        image = CompressedImage(format="rgb8; jpeg compressed bgr8", data=data)
        self.shows_orange("/camera/image/compressed", CompressedImage, iter(lambda: image, None))

    def test_theora(self):
        """The heads of a stream come once, in one burst with the first picture."""
        with open_plugin("rqt_image_view", ["/scene/theora"]) as gui:
            publisher = TheoraPublisher("/scene", "rgb8", (120, 160), 2)
            wait_until(publisher.wanted)
            canvas, step = gui.plugin._widget.canvas, [0]

            def seen():
                picture = PICTURE.copy()
                picture[:20, step[0] % 100 : step[0] % 100 + 20] = 255
                step[0] += 1
                publisher.publish(Header(), picture.tobytes())
                return canvas.picture is not None and canvas.picture.shape == PICTURE.shape

            wait_until(seen)
            self.assertLess(np.abs(canvas.picture[60, 80].astype(int) - (200, 60, 30)).max(), 12)
            publisher.shutdown()
        self.assertEqual(errors, [])

    def test_list_of_topics(self):
        kinds = (
            ("/b/image", Image),
            ("/b/image/compressed", CompressedImage),
            ("/a/only/compressed", CompressedImage),
            ("/b/image/theora", Packet),
            ("/point", Point),
        )
        publishers = [rospy.Publisher(name, kind, queue_size=1) for name, kind in kinds]
        listed = [name for name in image_topics() if not name.startswith(("/camera", "/scene"))]  # of the other tests
        self.assertEqual(listed, ["/b/image", "/b/image/compressed", "/b/image/theora", "/a/only/compressed"])
        for publisher in publishers:
            publisher.unregister()


if __name__ == "__main__":
    rospy.init_node("image_view_rostest")
    rostest.rosrun("rqt_image_view", "image_view", ImageView, sys.argv)

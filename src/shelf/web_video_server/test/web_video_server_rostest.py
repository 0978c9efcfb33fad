#!/usr/bin/env python3
"""The server over real HTTP: streams, single pictures, pages, and what it says of what it does not have."""

import re
import signal
import subprocess
import unittest
import urllib.error
import urllib.request

import cv2
import numpy as np
import rospy
import rostest
from sensor_msgs.msg import CameraInfo, CompressedImage, Image
from test_support import wait_until

PATIENCE = 60.0


def image(colour, height=40, width=60, stamp=1.5):
    pixels = np.zeros((height, width, 3), np.uint8)
    pixels[: height // 2] = colour
    message = Image(height=height, width=width, encoding="rgb8", step=3 * width, data=pixels.tobytes())
    message.header.stamp = rospy.Time.from_sec(stamp)
    return message


class WebVideoServer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("watcher")
        cls.colours = rospy.Publisher("/camera/image_raw", Image, queue_size=1)
        cls.compressed = rospy.Publisher("/camera/image_raw/compressed", CompressedImage, queue_size=1, latch=True)
        cls.info = rospy.Publisher("/camera/camera_info", CameraInfo, queue_size=1)
        cls.depth = rospy.Publisher("/depth", Image, queue_size=1, latch=True)
        cls.server = subprocess.Popen(
            ["rosrun", "web_video_server", "web_video_server", "_port:=0", "_address:=127.0.0.1"], stdout=subprocess.PIPE, text=True
        )
        cls.addClassCleanup(cls.end)
        cls.port = next(
            int(found[1])
            for found in (re.search(r"Waiting For connections on 127.0.0.1:(\d+)", line) for line in cls.server.stdout)
            if found
        )

    @classmethod
    def end(cls):
        cls.server.send_signal(signal.SIGINT)
        code = cls.server.wait(PATIENCE)
        cls.server.stdout.close()
        assert code == 0, code

    def get(self, path):
        return urllib.request.urlopen(f"http://127.0.0.1:{self.port}{path}", timeout=PATIENCE)

    def parts(self, stream):
        """(headers, data) of each picture as it comes."""
        self.assertEqual(stream.headers["Content-type"], "multipart/x-mixed-replace;boundary=boundarydonotcross")
        while True:
            self.assertEqual(stream.readline().strip(), b"--boundarydonotcross")
            headers = {}
            for line in iter(stream.readline, b"\r\n"):
                name, _, value = line.decode().partition(":")
                headers[name] = value.strip()
            data = stream.read(int(headers["Content-Length"]))
            stream.readline()
            yield headers, data

    def test_a_stream_shows_each_picture_that_comes(self):
        with self.get("/stream?topic=/camera/image_raw&width=30") as stream:
            pictures = self.parts(stream)
            wait_until(lambda: self.colours.get_num_connections(), "a subscriber")
            for colour, stamp in (((255, 0, 0), 1.5), ((0, 0, 255), 2.25)):
                self.colours.publish(image(colour, stamp=stamp))
                headers, data = next(pictures)
                self.assertEqual((headers["Content-type"], headers["X-Timestamp"]), ("image/jpeg", f"{stamp:.6f}"))
                shown = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR)
                self.assertEqual(shown.shape, (40, 30, 3))
                np.testing.assert_allclose(shown[5, 15, ::-1], colour, atol=12)
                np.testing.assert_allclose(shown[35, 15], 0, atol=12)
        wait_until(lambda: not self.colours.get_num_connections(), "an end of the subscription when the browser has gone")

    def test_what_was_compressed_is_passed_on(self):
        self.compressed.publish(CompressedImage(format="png", data=b"any bytes"))
        with self.get("/stream?topic=/camera/image_raw&type=ros_compressed") as stream:
            headers, data = next(self.parts(stream))
        self.assertEqual((headers["Content-type"], data), ("image/png", b"any bytes"))

    def test_a_single_picture_of_depth(self):
        metres = np.array([[0.0, 1.0], [2.0, np.nan]], np.float32)
        self.depth.publish(Image(height=2, width=2, encoding="32FC1", step=8, data=metres.tobytes()))
        with self.get("/snapshot?topic=depth&type=png&invert") as answer:
            self.assertEqual(answer.headers["Content-type"], "image/png")
            shown = cv2.imdecode(np.frombuffer(answer.read(), np.uint8), cv2.IMREAD_UNCHANGED)
        self.assertEqual(shown.tolist(), [[0, 255], [128, 0]])

    def test_pages(self):
        page = self.get("/").read().decode()
        self.assertRegex(page, r'<li>/camera/<ul><li><a href="/stream_viewer\?topic=/camera/image_raw">image_raw</a>')
        self.assertIn('href="/snapshot?topic=/depth"', page)
        page = self.get("/stream_viewer?topic=/depth&width=20").read().decode()
        self.assertIn('<img src="/stream?topic=/depth&amp;width=20">', page)

    def test_what_is_not_there_is_said(self):
        for path, sentence in (
            ("/stream?topic=/cam", "nobody publishes /cam; image topics: /camera/image_raw, /depth"),
            ("/stream?topic=/depth&type=vp8", "type=vp8 is not supplied here; ask for type=mjpeg"),
            ("/stream?topic=/rosout", "/rosout has messages of rosgraph_msgs/Log, which are no pictures"),
            ("/snapshot?topic=/camera/camera_info", "has messages of sensor_msgs/CameraInfo, which are no pictures"),
            ("/snapshot?topic=/camera/%0a[ERROR]%20forged", "/camera/\\n[ERROR] forged is no name of a topic"),
            ("/%1b[2J", "there is nothing at /%1b[2J"),
            ("/index.html", "there is nothing at /index.html"),
        ):
            with self.subTest(path), self.assertRaises(urllib.error.HTTPError) as caught:
                self.get(path)
            self.assertEqual(caught.exception.code, 404)
            answer = caught.exception.read().decode()
            self.assertIn(sentence, answer)
            self.assertTrue(answer[:-1].isprintable(), answer)

    def test_a_port_that_is_taken_ends_it_with_one_line(self):
        ended = subprocess.run(
            ["rosrun", "web_video_server", "web_video_server", f"_port:={self.port}", "_address:=127.0.0.1", "__name:=second"],
            capture_output=True,
            text=True,
            timeout=PATIENCE,
        )
        self.assertEqual((ended.returncode, ended.stderr.count("\n")), (1, 1), ended.stderr)
        self.assertIn("cannot be had: Address already in use; give another one with _port:=8081", ended.stderr)


if __name__ == "__main__":
    rostest.rosrun("web_video_server", "web_video_server", WebVideoServer)

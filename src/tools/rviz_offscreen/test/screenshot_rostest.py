#!/usr/bin/env python3
"""The screenshot command on a running system: a cross of coloured boxes whose pixels are known by geometry."""

import math
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import PIL.Image
import rosgraph
import rospy
import rostest
from sensor_msgs.msg import Image, LaserScan

HERE = os.path.dirname(os.path.abspath(__file__))
CONFIG = os.path.join(HERE, "cross.rviz")
WIDTH, HEIGHT, DISTANCE = 640, 480, 3.0
FOCAL = HEIGHT / 2 / math.tan(0.7853982 / 2)  # RViz's vertical field of view is 45 degrees
BACKGROUND = (48, 48, 48)


def screenshot(*arguments, **environment):
    return subprocess.run(
        ["rosrun", "rviz_offscreen", "screenshot", *arguments], capture_output=True, text=True, env={**os.environ, **environment}
    )


def pixel_of(y, z):
    """Pixel (column, row) of the front face point (x 0.1, y, z) seen from +x, pitch 0."""
    return round(WIDTH / 2 + FOCAL * y / (DISTANCE - 0.1)), round(HEIGHT / 2 - FOCAL * z / (DISTANCE - 0.1))


class Screenshot(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()

    def picture(self, backend, *arguments):
        path = os.path.join(self.folder, backend + ".png")
        result = screenshot(
            "--config",
            CONFIG,
            "--output",
            path,
            "--size",
            f"{WIDTH}x{HEIGHT}",
            "--backend",
            backend,
            "--view",
            "front:pitch=0,distance=3",
            *arguments,
        )
        self.assertEqual(result.returncode, 0, result.stderr)
        return np.asarray(PIL.Image.open(path).convert("RGB")).astype(int)

    def test_boxes_stand_where_geometry_says_with_both_backends(self):
        pictures = {backend: self.picture(backend) for backend in ("xvfb", "osmesa")}
        for backend, picture in pictures.items():
            for (y, z), dominant in (((0, 0), 2), ((0.5, 0), 0), ((0, 0.5), 1)):
                column, row = pixel_of(y, z)
                value = picture[row, column]
                self.assertEqual(int(np.argmax(value)), dominant, f"{backend} at {(y, z)}: {value}")
                self.assertGreater(value[dominant], 200)
                self.assertLess(sorted(value)[1], 20)
            for y, z in ((-0.5, 0), (0, -0.5), (0.5, 0.5)):
                column, row = pixel_of(y, z)
                self.assertEqual(tuple(picture[row, column]), BACKGROUND, backend)
        different = np.abs(pictures["xvfb"] - pictures["osmesa"]).max(axis=2) > 8
        self.assertLess(different.mean(), 0.001, "the two back-ends draw the same picture")

    def test_several_views_and_the_whole_window(self):
        path = os.path.join(self.folder, "v.png")
        result = screenshot("-d", CONFIG, "-o", path, "--window", "--view", "top", "--view", "yaw=1")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.split(), [os.path.join(self.folder, n) for n in ("v-top.png", "v-2.png")])
        window = np.asarray(PIL.Image.open(os.path.join(self.folder, "v-2.png")).convert("RGB"))
        self.assertEqual(window.shape, (800, 1280, 3))
        self.assertGreater(window[:40].mean(), 180, "the light menu and tool bars are there")
        self.assertTrue((window == BACKGROUND).all(axis=2).mean() > 0.3, "and the dark 3D view")

    def test_a_named_view_has_the_robot_in_its_frame_and_fills_it(self):
        path = os.path.join(self.folder, "fit.png")
        result = screenshot("-d", CONFIG, "-o", path, "--size", f"{WIDTH}x{HEIGHT}", "--view", "iso", "--view", "front")
        self.assertEqual(result.returncode, 0, result.stderr)
        for view in ("iso", "front"):
            picture = np.asarray(PIL.Image.open(os.path.join(self.folder, f"fit-{view}.png")).convert("RGB")).astype(int)
            rows, columns = np.nonzero(picture.max(axis=2) - picture.min(axis=2) > 60)  # the boxes have colours, the rest none
            spans = np.ptp(columns) / WIDTH, np.ptp(rows) / HEIGHT
            self.assertTrue(0.6 < max(spans) < 0.98, f"{view}: the boxes span {spans} of the picture")
            self.assertTrue(rows.min() > 0 and rows.max() < HEIGHT - 1 and columns.min() > 0 and columns.max() < WIDTH - 1)

    def config(self, *displays):
        """The configuration of the cross with more displays in it."""
        path = os.path.join(self.folder, "more.rviz")
        with open(CONFIG) as plain, open(path, "w") as file:
            lines = "".join(f"    - {{{display}, Enabled: true}}\n" for display in displays)
            file.write(plain.read().replace("  Displays:\n", "  Displays:\n" + lines, 1))
        return path

    def test_window_with_panels_of_images(self):
        """Each image in its own panel in the dock, the 3D view in its place."""
        config = self.config(
            "Class: rviz/Image, Name: Left eye, Image Topic: /red", "Class: rviz/Image, Name: Right eye, Image Topic: /yellow"
        )
        publishers = []
        for topic, colour in (("/red", (255, 0, 0)), ("/yellow", (255, 255, 0))):
            publishers.append(rospy.Publisher(topic, Image, latch=True, queue_size=1))
            publishers[-1].publish(Image(height=120, width=160, step=480, encoding="rgb8", data=bytes(colour) * 19200))
        for backend in ("xvfb", "osmesa"):
            path = os.path.join(self.folder, "image.png")
            result = screenshot("-d", config, "-o", path, "--window", "--backend", backend)
            self.assertEqual(result.returncode, 0, result.stderr)
            window = np.asarray(PIL.Image.open(path).convert("RGB"))
            self.assertTrue((window == BACKGROUND).all(axis=2).mean() > 0.3, "the dark 3D view has its full size")
            rows = {}
            for topic, colour in (("/red", (255, 0, 0)), ("/yellow", (255, 255, 0))):
                pixels = np.argwhere((window == colour).all(axis=2))
                self.assertGreater(len(pixels), 5000, f"{backend}: the image of {topic}")
                self.assertLess(np.percentile(pixels[:, 1], 99), 400, "in a dock left of the 3D view")
                rows[topic] = pixels[:, 0].mean()
            self.assertGreater(abs(rows["/red"] - rows["/yellow"]), 50, "each in a panel of its own; Qt picks the order")

    def test_what_nobody_publishes_is_named_and_not_waited_for(self):
        config = self.config("Class: rviz/Image, Name: Eye, Image Topic: /nothing", "Class: rviz/LaserScan, Name: Laser, Topic: /none")
        path = os.path.join(self.folder, "nothing.png")
        # whoever waited would not be back within the limit of this test
        result = screenshot("-d", config, "-o", path, "--window", "--timeout", "1000", "--grace", "0.5")
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertEqual(
            result.stderr.splitlines(),
            ["screenshot: nobody publishes /nothing of display 'Eye'", "screenshot: nobody publishes /none of display 'Laser'"],
        )
        self.assertTrue(os.path.getsize(path))

    def test_the_first_message_is_waited_for(self):
        config = self.config(
            "Class: rviz/LaserScan, Name: Laser, Topic: /slow, Style: Points, Size (Pixels): 6, "
            "Color Transformer: FlatColor, Color: 255; 0; 255"
        )
        path = os.path.join(self.folder, "scan.png")
        publisher = rospy.Publisher("/slow", LaserScan, queue_size=1)
        result = screenshot("-d", config, "-o", path, "--timeout", "1")
        self.assertEqual(result.returncode, 3)
        self.assertIn("Laser (no message on /slow yet)", result.stderr)
        scan = LaserScan(angle_min=-1, angle_increment=0.01, range_max=9, ranges=[1.0] * 200)
        scan.header.frame_id = "base_link"
        timer = rospy.Timer(rospy.Duration(1), lambda _: publisher.publish(scan))
        result = screenshot("-d", config, "-o", path, "--timeout", "60")
        timer.shutdown()
        self.assertEqual(result.returncode, 0, result.stderr)
        picture = np.asarray(PIL.Image.open(path).convert("RGB"))
        self.assertGreater((picture == (255, 0, 255)).all(axis=2).sum(), 100)

    def test_no_node_is_left_in_the_graph(self):
        self.picture("xvfb")
        nodes = {n for group in rosgraph.Master("/test").getSystemState() for _, names in group for n in names}
        self.assertFalse([n for n in nodes if "rviz" in n])

    def test_what_a_crash_left_in_the_graph_goes_and_who_lives_stays(self):
        node = (
            "import rospy; rospy.init_node('rviz_{0}'); rospy.Publisher('/n{0}/seen', rospy.AnyMsg, queue_size=1); "
            "rospy.Subscriber('/n{0}/heard', rospy.AnyMsg, print); rospy.Service('/n{0}/asked', Empty, print); "
            "print('up', flush=True); rospy.spin()"
        )
        started = [
            subprocess.Popen([sys.executable, "-c", "from std_srvs.srv import Empty; " + node.format(k)], stdout=subprocess.PIPE)
            for k in (4711, 4712)
        ]
        try:
            for process in started:
                self.assertEqual(process.stdout.readline(), b"up\n")
            started[0].kill()
            started[0].wait()
            self.assertIn("/rviz_4711", self.graph())
            self.picture("xvfb")
            listed = str(self.graph())
            self.assertNotIn("4711", listed)
            self.assertTrue(all(name in listed for name in ("/rviz_4712", "/n4712/seen", "/n4712/heard", "/n4712/asked")), listed)
        finally:
            for process in started:
                process.kill()
                process.wait()
                process.stdout.close()

    @staticmethod
    def graph():
        return str(rosgraph.Master("/test").getSystemState())

    def test_what_is_not_drawn_is_named(self):
        path = os.path.join(self.folder, "n.png")
        result = screenshot("-d", CONFIG, "-o", path, "-f", "nowhere", "--timeout", "1")
        self.assertEqual(result.returncode, 3)
        self.assertIn("RobotModel (Error)", result.stderr)
        self.assertTrue(os.path.getsize(path))

    def test_bad_input_is_one_line(self):
        not_rviz = os.path.join(self.folder, "x.rviz")
        with open(not_rviz, "w") as file:
            file.write("a: 1\n")
        for arguments, words in (
            (("-d", "/nowhere.rviz"), "No such file"),
            (("-d", not_rviz), "not an RViz configuration"),
            (("--size", "0x5"), "--size 0x5"),
            (("--view", "bogus"), "--view bogus"),
            (("-o", "/nowhere/a.png"), "no folder /nowhere"),
        ):
            result = screenshot(*arguments)
            self.assertEqual(result.returncode, 1)
            self.assertIn(words, result.stderr)
            self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)

    def test_no_master_is_said_and_does_not_hang(self):
        result = screenshot(ROS_MASTER_URI="http://localhost:1")
        self.assertEqual(result.returncode, 1)
        self.assertIn("no ROS master at http://localhost:1", result.stderr)


if __name__ == "__main__":
    rospy.init_node("screenshot_rostest")
    rostest.rosrun("rviz_offscreen", "screenshot", Screenshot, sys.argv)

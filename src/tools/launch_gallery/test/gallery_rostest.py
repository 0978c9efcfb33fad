#!/usr/bin/env python3
"""The gallery command on launch files that work and on some that do not."""

import os
import subprocess
import tempfile
import unittest

import numpy as np
import PIL.Image
import rostest

LAUNCHES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "launches")


def gallery(*arguments):
    return subprocess.run(["rosrun", "launch_gallery", "gallery", *arguments], capture_output=True, text=True)


def green(path):
    """Share of the picture's pixels that are more green than anything else."""
    pixels = np.asarray(PIL.Image.open(path).convert("RGB")).astype(int)
    return ((pixels[..., 1] > 80) & (pixels[..., 1] > 2 * pixels[..., 0]) & (pixels[..., 1] > 2 * pixels[..., 2])).mean()


class Gallery(unittest.TestCase):
    def setUp(self):
        self.folder = os.path.join(tempfile.mkdtemp(), "gallery")

    def picture(self, name):
        return os.path.join(self.folder, name)

    def test_pictures_of_the_scene_of_rviz_and_of_a_camera(self):
        result = gallery(os.path.join(LAUNCHES, "green_box.launch"), "-o", self.folder)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("gui:=false: 4 pictures", result.stdout)
        self.assertNotIn("RViz:", result.stdout, "nothing is missing in RViz, its fixed frame is the root of the transforms")
        self.assertGreater(green(self.picture("green_box-robot.png")), 0.02, "the box from near")
        self.assertGreater(green(self.picture("green_box-world.png")), 0.001, "and from afar")
        self.assertGreater(green(self.picture("green_box-eye-image_raw.png")), 0.1, "as its own camera sees it")
        window = self.picture("green_box-rviz.png")
        self.assertEqual(PIL.Image.open(window).size, (1280, 800))
        self.assertGreater(green(window), 0.002, "that image is in a panel of RViz")
        with open(self.picture("index.html")) as page:
            text = page.read()
        for name in os.listdir(self.folder):
            if name.endswith(".png"):
                self.assertIn(f'<img src="{name}"', text)

    def test_launch_files_without_pictures_say_why_and_do_not_stop_the_rest(self):
        result = gallery(*(os.path.join(LAUNCHES, name) for name in ("wants_a_value.launch", "dies.launch")), "-o", self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("needs a value for argument robot: add robot:=...", result.stdout)
        self.assertRegex(result.stdout, r"roslaunch ended by itself with code \d: REQUIRED process \[dies-2\] has died!")
        self.assertNotIn("Traceback", result.stdout + result.stderr)
        with open(self.picture("index.html")) as page:
            self.assertIn("dies.launch", page.read())

    def test_bad_targets_are_one_line(self):
        for target, words in (
            ("no_such_package", "neither a file nor a package"),
            ("launch_gallery/none.launch", "has no launch file none.launch"),
        ):
            result = gallery(target, "-o", self.folder)
            self.assertEqual(result.returncode, 1)
            self.assertIn(words, result.stderr)
            self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)


if __name__ == "__main__":
    rostest.rosrun("launch_gallery", "gallery", Gallery)

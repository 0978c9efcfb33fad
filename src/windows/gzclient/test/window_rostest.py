#!/usr/bin/env python3
"""gzclient on a desktop: a window of its own, used and closed as a person does; the simulator goes on. A private X server."""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import psutil
import rosgraph
import rospy
import rostest
from gazebo_msgs.srv import GetPhysicsProperties
from PIL import Image
from rqt_testing.desktop import Desktop
from std_srvs.srv import Empty

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from browser import PATIENCE, wait  # noqa: E402

MISSING = [name for name in ("chromium", "openbox", "xdotool") if not shutil.which(name)]


def streams():
    return any(name == "/gazebo/view" for name, _ in rosgraph.Master(rospy.get_name()).getSystemState()[1])


def paused():
    rospy.wait_for_service("/gazebo/get_physics_properties", PATIENCE)
    return rospy.ServiceProxy("/gazebo/get_physics_properties", GetPhysicsProperties)().pause


@unittest.skipIf(MISSING, f"not installed: {' '.join(MISSING)}")
class Window(unittest.TestCase):
    def setUp(self):
        rospy.wait_for_service("/gazebo/unpause_physics", PATIENCE)
        rospy.ServiceProxy("/gazebo/unpause_physics", Empty)()
        self.desktop = Desktop().__enter__()
        self.addCleanup(self.desktop.__exit__)
        self.client = subprocess.Popen(
            ["rosrun", "gazebo_ros", "gzclient", "--port", "0"],
            env=self.desktop.environment,
            stdout=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        self.addCleanup(self.client.stdout.close)
        self.addCleanup(self.end)
        self.window = wait(self.find, "a window named Gazebo")
        wait(self.red_pixels, "the red box of the world in the window")
        self.assertTrue(streams())

    def end(self):
        if self.client.poll() is None:
            os.killpg(self.client.pid, signal.SIGINT)  # one that is killed stays in the master's book as somebody who looks
            try:
                self.client.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                os.killpg(self.client.pid, signal.SIGKILL)
                self.client.wait()

    def find(self):
        found = subprocess.run(
            ["xdotool", "search", "--onlyvisible", "--name", "^Gazebo$"], env=self.desktop.environment, capture_output=True, text=True
        )
        return found.stdout.split()[-1:]

    def red_pixels(self):
        """Whether the red box of the world is seen on the screen."""
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(os.environ.get("BROWSER_SHOTS", folder), "window.png")
            self.desktop.screenshot(file)
            red, green, blue = (np.asarray(part, int) for part in Image.open(file).convert("RGB").split())
        return ((red > 80) & (green < red / 4) & (blue < red / 4)).sum() > 2000

    def browsers(self):
        """Processes of the browser; a window of its own has a profile of its own."""
        return [
            part
            for part in psutil.process_iter(["cmdline"])
            if any(
                "gzclient_" in word and "user-data-dir" in word and self.desktop.environment["HOME"] not in word
                for word in part.info["cmdline"] or ()
            )
            and part.pid in {child.pid for child in psutil.Process(self.client.pid).children(recursive=True)}
        ]

    def test_closing_the_window_ends_gzclient_only(self):
        self.desktop.xdotool("windowfocus", "--sync", *self.window)
        self.desktop.keys("ctrl+w")  # as in every browser
        self.assertEqual(self.client.wait(PATIENCE), 0)
        wait(lambda: not streams(), "nobody looks any more")
        self.assertFalse(paused())

    def test_a_page_that_crashed_is_loaded_again(self):
        """The browser says so, and has a button for it."""
        renderers = [part for part in psutil.Process(self.client.pid).children(recursive=True) if "--type=renderer" in part.cmdline()]
        for part in renderers:
            part.kill()
        wait(lambda: not self.red_pixels(), "a window without the box")
        self.assertIsNone(self.client.poll())
        self.desktop.xdotool("windowfocus", "--sync", *self.window)
        self.desktop.keys("F5")
        wait(self.red_pixels, "the red box again")
        self.assertTrue(streams())
        self.assertFalse(paused())

    def test_the_end_of_gzclient_closes_the_window(self):
        browsers = self.browsers()
        self.assertTrue(browsers)
        os.killpg(self.client.pid, signal.SIGINT)
        self.assertIn(self.client.wait(PATIENCE), (0, 130))  # as a shell says of Ctrl-C
        psutil.wait_procs(browsers, PATIENCE)
        self.assertFalse([part for part in browsers if part.is_running() and part.status() != psutil.STATUS_ZOMBIE])
        self.assertFalse(paused())


if __name__ == "__main__":
    rospy.init_node("window_test", disable_rostime=True)
    rostest.rosrun("gzclient", "window", "__main__")

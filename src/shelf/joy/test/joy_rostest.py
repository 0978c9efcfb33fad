#!/usr/bin/env python3
"""A joystick made of a pipe is plugged in, moved, pulled out and plugged in again."""

import os
import queue
import tempfile
import unittest

import pexpect
import rospy
import rostest
from joystick.state import AXIS, BUTTON, EVENT, INIT
from sensor_msgs.msg import Joy


class Joystick(unittest.TestCase):
    def test_plugged_in_late_and_again(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        device = os.path.join(folder.name, "js0")
        seen = queue.Queue()
        rospy.Subscriber("joy", Joy, seen.put)
        node = pexpect.spawn("rosrun", ["joy", "joy_node", f"_dev:={device}", "_deadzone:=0"], encoding="utf-8", timeout=60)
        self.addCleanup(node.close, force=True)
        node.expect_exact(f"Couldn't open joystick {device}. Will retry every second. (No such file or directory)")
        os.mkfifo(device)
        node.expect_exact(f"Opened joystick: {device}.")
        for _ in range(2):
            pipe = os.open(device, os.O_WRONLY)
            while not seen.empty():
                seen.get()
            for value, kind, number in ((0, AXIS | INIT, 1), (0, BUTTON | INIT, 3), (-32767, AXIS, 0), (1, BUTTON, 3)):
                os.write(pipe, EVENT.pack(0, value, kind, number))
            message = seen.get(timeout=60)
            while message.buttons != (0, 0, 0, 1):
                message = seen.get(timeout=60)
            self.assertEqual(message.axes, (1.0, 0.0))
            os.close(pipe)
            node.expect_exact("is gone; waiting for it to come back.")
            node.expect_exact(f"Opened joystick: {device}.")
        node.sendintr()
        node.expect(pexpect.EOF)


if __name__ == "__main__":
    rospy.init_node("joy_rostest")
    rostest.rosrun("joy", "joy_rostest", Joystick)

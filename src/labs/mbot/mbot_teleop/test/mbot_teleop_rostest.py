#!/usr/bin/env python3
"""Types into mbot_teleop.py, in a real pseudo-terminal and through a pipe, and watches /cmd_vel."""

import queue
import subprocess
import unittest

import pexpect
import rospy
import rostest
from geometry_msgs.msg import Twist

COMMAND = ["rosrun", "mbot_teleop", "mbot_teleop.py"]


class MbotTeleop(unittest.TestCase):
    def setUp(self):
        self.twists = queue.Queue()
        self.subscriber = rospy.Subscriber("/cmd_vel", Twist, self.twists.put)

    def tearDown(self):
        self.subscriber.unregister()

    def wait_for(self, linear, angular):
        """Returns when /cmd_vel has reached the two velocities; fails when no message in a hundred does."""
        seen = []
        for _ in range(100):
            twist = self.twists.get(timeout=60)
            seen.append((round(twist.linear.x, 9), round(twist.angular.z, 9)))
            if seen[-1] == (linear, angular):
                return
        self.fail("not reached: %s, but %s" % ((linear, angular), seen))

    def test_keys_in_a_terminal(self):
        terminal = pexpect.spawn(COMMAND[0], COMMAND[1:], encoding="utf-8", timeout=60)
        try:
            terminal.expect_exact("Control mbot!")
            terminal.expect_exact("currently:\tspeed 0.2\tturn 1 ")
            self.wait_for(0, 0)
            terminal.send("u" * 12)
            self.wait_for(0.2, 1.0)
            terminal.send("w")
            terminal.expect("currently:\tspeed 0.22\\d*\tturn 1 ")
            terminal.send("k")
            self.wait_for(0, 0)
            terminal.send("," * 15)
            self.wait_for(-0.22, 0)
            terminal.send("\x03")
            terminal.expect(pexpect.EOF)
            terminal.wait()
            self.assertEqual(terminal.exitstatus, 0)
            self.assertNotIn("Traceback", terminal.before)
            self.wait_for(0, 0)  # from full speed: its last word
        finally:
            terminal.close(force=True)

    def test_keys_in_a_pipe(self):
        node = subprocess.Popen(COMMAND, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.wait_for(0, 0)  # it is heard: without keys it says that the robot stands
        _, errors = node.communicate("i" * 12, timeout=60)
        self.assertEqual((node.returncode, errors), (0, ""))
        self.wait_for(0.2, 0)
        self.wait_for(0, 0)


if __name__ == "__main__":
    rospy.init_node("mbot_teleop_rostest")
    rostest.rosrun("mbot_teleop", "mbot_teleop", MbotTeleop)

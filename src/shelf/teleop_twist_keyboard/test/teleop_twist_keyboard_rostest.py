#!/usr/bin/env python3
"""Types into teleop_twist_keyboard.py, and watches cmd_vel."""

import queue
import subprocess
import unittest

import pexpect
import rospy
import rostest
from geometry_msgs.msg import Twist, TwistStamped

NODE = "teleop_twist_keyboard.py"


class TeleopTwistKeyboard(unittest.TestCase):
    def start(self, *arguments):
        node = pexpect.spawn("rosrun", ["teleop_twist_keyboard", NODE, *arguments], encoding="utf-8", timeout=60)
        self.addCleanup(node.close, force=True)
        return node

    def listen(self, topic, kind=Twist):
        seen = queue.Queue()
        subscriber = rospy.Subscriber(topic, kind, seen.put)
        self.addCleanup(subscriber.unregister)
        return seen

    def test_keys(self):
        node = self.start("cmd_vel:=base/cmd_vel", "_speed:=0.9", "_turn:=0.8")
        node.expect_exact("Waiting for subscriber to connect to /base/cmd_vel")
        seen = self.listen("/base/cmd_vel")
        node.expect_exact("CTRL-C to quit")
        node.expect_exact("currently:\tspeed 0.9\tturn 0.8 ")
        self.assertEqual(seen.get(timeout=60), Twist())
        node.send("u")
        twist = seen.get(timeout=60)
        self.assertEqual((twist.linear.x, twist.angular.z), (0.9, 0.8))
        node.send("L")
        twist = seen.get(timeout=60)
        self.assertEqual((twist.linear.x, twist.linear.y, twist.angular.z), (0, -0.9, 0))
        node.send("w")
        node.expect("currently:\tspeed 0.99\\d*\tturn 0.8 ")
        self.assertAlmostEqual(seen.get(timeout=60).linear.y, -0.99)
        node.send("\x03")
        node.expect(pexpect.EOF)
        node.wait()
        self.assertEqual(node.exitstatus, 0)
        self.assertEqual(seen.get(timeout=60), Twist())
        self.assertTrue(seen.empty())

    def test_repeated_stamped_and_stopped_without_keys(self):
        seen = self.listen("/stamped", TwistStamped)
        node = self.start(
            "cmd_vel:=/stamped", "_stamped:=true", "_frame_id:=base_link", "_repeat_rate:=50", "_key_timeout:=0.2", "_speed:=0.5"
        )
        node.expect_exact("currently:")
        node.send("i")
        driven = [seen.get(timeout=60)]
        while driven[-1].twist.linear.x == 0:
            driven.append(seen.get(timeout=60))
        while driven[-1].twist.linear.x != 0:
            driven.append(seen.get(timeout=60))
        self.assertEqual({message.header.frame_id for message in driven}, {"base_link"})
        self.assertGreater(sum(message.twist.linear.x == 0.5 for message in driven), 2)

    def test_bad_parameter(self):
        ended = subprocess.run(
            ["rosrun", "teleop_twist_keyboard", NODE, "_speed:=-1"], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60
        )
        self.assertEqual(
            (ended.returncode, ended.stderr),
            (1, "teleop_twist_keyboard: parameter /teleop_twist_keyboard/speed must be a number, 0 or more, but is -1\n"),
        )


if __name__ == "__main__":
    rospy.init_node("teleop_twist_keyboard_rostest")
    rostest.rosrun("teleop_twist_keyboard", "teleop_twist_keyboard", TeleopTwistKeyboard)

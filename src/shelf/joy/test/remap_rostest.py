#!/usr/bin/env python3
"""ps4joy.launch: what a pad of a PlayStation 4 says comes out in the other one's order; wrong formulas end with one line."""

import queue
import subprocess
import unittest

import rospy
import rostest
from sensor_msgs.msg import Joy


class Remap(unittest.TestCase):
    def told(self, axes, buttons):
        """What comes out where that goes in."""
        seen = queue.Queue()
        listener = rospy.Subscriber("joy", Joy, seen.put)
        self.addCleanup(listener.unregister)
        publisher = rospy.Publisher("joy_orig", Joy, queue_size=1)
        message = Joy(axes=axes, buttons=buttons)
        message.header.stamp = rospy.Time(7)
        for _ in range(600):
            publisher.publish(message)
            try:
                return seen.get(timeout=0.1)
            except queue.Empty:
                pass
        self.fail("nothing came out")

    def test_order(self):
        made = self.told([0.25, -0.5, 0.125, 1.0, 0.0, 0.5, 0, 0, 0, -1.0, 1.0, 0], [0, 1] + [0] * 10 + [1, 0])
        self.assertEqual((len(made.axes), len(made.buttons), made.header.stamp.secs), (27, 17, 7))
        self.assertEqual(made.axes[:4], (0.25, -0.5, 0.125, 0.5))
        self.assertEqual((made.axes[8], made.axes[9], made.axes[13], made.axes[18]), (-1.0, -1.0, -0.5, -1.0))
        self.assertEqual([i for i, pressed in enumerate(made.buttons) if pressed], [4, 5, 14, 16])

    def test_a_smaller_pad_says_zero(self):
        made = self.told([0.5, 0.25], [1])
        self.assertEqual((made.axes[:3], made.buttons[15]), ((0.5, 0.25, 0.0), 1))

    def test_wrong_formula(self):
        rospy.set_param("wrong/mappings", {"axes": ["exec('x')"]})
        ended = subprocess.run(["rosrun", "joy", "joy_remap.py", "__name:=wrong"], capture_output=True, text=True, timeout=60)
        self.assertEqual(ended.returncode, 1)
        self.assertIn("~mappings/axes", ended.stderr)
        self.assertIn("'exec('x')' is not understood", ended.stderr.replace(" in 'exec('x')'", ""))
        self.assertNotIn("Traceback", ended.stderr)


if __name__ == "__main__":
    rospy.init_node("remap_rostest")
    rostest.rosrun("joy", "remap_rostest", Remap)

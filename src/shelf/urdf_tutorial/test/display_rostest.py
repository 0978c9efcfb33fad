#!/usr/bin/env python3
"""display.launch publishes the robot's frames."""

import unittest

import rospy
import rostest
import tf2_ros


class Display(unittest.TestCase):
    def test_frames(self):
        buffer = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(buffer)
        self.addCleanup(listener.unregister)
        moved = buffer.lookup_transform("base_link", "right_leg", rospy.Time(0), rospy.Duration(50))
        self.assertEqual(moved.transform.rotation.w, 1.0)


if __name__ == "__main__":
    rospy.init_node("display_rostest")
    rostest.rosrun("urdf_tutorial", "display_rostest", Display)

#!/usr/bin/env python3
"""teleop.launch without a joystick: what comes on joy drives."""

import queue
import unittest

import rospy
import rostest
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy


class TeleopTwistJoy(unittest.TestCase):
    def test_drives_and_stops(self):
        driven = queue.Queue()
        rospy.Subscriber("cmd_vel", Twist, driven.put)
        joy = rospy.Publisher("joy", Joy, queue_size=10)
        while joy.get_num_connections() == 0:
            rospy.rostime.wallsleep(0.02)
        joy.publish(Joy(axes=[0, 1.0], buttons=[0, 0, 1]))
        self.assertAlmostEqual(driven.get(timeout=60).linear.x, 0.7)
        joy.publish(Joy(axes=[0, 1.0], buttons=[0, 0, 0, 0, 0, 1]))
        self.assertAlmostEqual(driven.get(timeout=60).linear.x, 1.5)
        joy.publish(Joy(axes=[0, 1.0], buttons=[0, 0, 0]))
        self.assertEqual(driven.get(timeout=60), Twist())


if __name__ == "__main__":
    rospy.init_node("teleop_twist_joy_rostest")
    rostest.rosrun("teleop_twist_joy", "teleop_twist_joy_rostest", TeleopTwistJoy)

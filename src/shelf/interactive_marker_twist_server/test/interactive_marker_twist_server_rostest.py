#!/usr/bin/env python3
"""Drags the marker as RViz does, and watches the velocities."""

import math
import queue
import unittest

import rospy
import rostest
from geometry_msgs.msg import Twist
from visualization_msgs.msg import InteractiveMarkerFeedback, InteractiveMarkerInit

SERVER = "/twist_marker_server/"


class MarkerServer(unittest.TestCase):
    def test_dragged(self):
        shown = rospy.wait_for_message(SERVER + "update_full", InteractiveMarkerInit, 60).markers[0]
        self.assertEqual((shown.name, shown.header.frame_id), ("robot_twist_marker", "base_link"))
        self.assertEqual([control.name for control in shown.controls], ["move_x", "move_y", "rotate_z"])
        driven = queue.Queue()
        rospy.Subscriber(SERVER + "cmd_vel", Twist, driven.put)
        feedback = rospy.Publisher(SERVER + "feedback", InteractiveMarkerFeedback, queue_size=1)
        drag = InteractiveMarkerFeedback(client_id="test", marker_name=shown.name, event_type=InteractiveMarkerFeedback.POSE_UPDATE)
        drag.pose.position.x, drag.pose.position.y = 0.5, -4.0
        drag.pose.orientation.z, drag.pose.orientation.w = math.sin(0.1), math.cos(0.1)
        for _ in range(600):
            feedback.publish(drag)
            try:
                twist = driven.get(timeout=0.1)
                break
            except queue.Empty:
                pass
        self.assertEqual((twist.linear.x, twist.linear.y), (0.5, -1.0))
        self.assertAlmostEqual(twist.angular.z, 0.44)


if __name__ == "__main__":
    rospy.init_node("interactive_marker_twist_server_rostest")
    rostest.rosrun("interactive_marker_twist_server", "interactive_marker_twist_server_rostest", MarkerServer)

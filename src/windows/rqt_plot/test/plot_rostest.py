#!/usr/bin/env python3
"""Topics of a real master: they come late, hold arrays, and arrive often."""

import sys
import unittest

import rospy
import rostest

from rqt_testing.in_process import errors, open_plugin, wait_until  # isort: skip
from sensor_msgs.msg import JointState
from std_msgs.msg import Header


class Plot(unittest.TestCase):
    def test_curves_start_when_their_topic_appears(self):
        with open_plugin("rqt_plot", ["/robot/joints/position[0]:velocity[1]"]) as gui:
            widget = gui.plugin._widget
            self.assertEqual(len(widget._waiting), 2)
            publisher = rospy.Publisher("/robot/joints", JointState, queue_size=100)
            wait_until(lambda: len(widget._rosdata) == 2 and publisher.get_num_connections())
            begin = rospy.Time.now()
            for i in range(100):
                publisher.publish(
                    JointState(header=Header(stamp=begin + rospy.Duration(i * 0.01)), position=[0.1 * i], velocity=[0.0, -0.1 * i])
                )
            curves = wait_until(lambda: all(len(c) == 100 for c in widget.data_plot._curves.values()) and widget.data_plot._curves)
            position, velocity = curves["/robot/joints/position[0]"], curves["/robot/joints/velocity[1]"]
            self.assertAlmostEqual(position.y[-1], 9.9)
            self.assertAlmostEqual(velocity.y[50], -5.0)
            self.assertAlmostEqual(position.x[-1] - position.x[0], 0.99, places=5)
            wait_until(lambda: abs(widget.data_plot.get_xlim()[1] - position.x[-1]) < 1e-6)
        self.assertEqual(errors, [])


if __name__ == "__main__":
    rospy.init_node("plot_rostest")
    rostest.rosrun("rqt_plot", "plot", Plot, sys.argv)

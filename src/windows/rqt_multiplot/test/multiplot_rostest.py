#!/usr/bin/env python3
"""A topic of a real master that comes after the window."""

import os
import sys
import tempfile
import unittest

import rospy
import rostest

from rqt_testing.in_process import errors, open_plugin, wait_until  # isort: skip
from rqt_multiplot.config import Curve, CurveAxes, CurveAxis, FieldType, Plot, Table, write
from std_msgs.msg import Float64


class Multiplot(unittest.TestCase):
    def test_a_topic_that_comes_late_over_receipt_time(self):
        curve = Curve(
            title="speed",
            axes=CurveAxes(
                CurveAxis("/speed", "std_msgs/Float64", FieldType.RECEIPT_TIME),
                CurveAxis("/speed", "std_msgs/Float64", FieldType.DATA, "data"),
            ),
        )
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.xml")
            with open(path, "w") as file:
                file.write(write(Table(plots=[[Plot(curves=[curve])]])))
            with open_plugin("rqt_multiplot", ["--multiplot-config", path, "--multiplot-run-all"]) as gui:
                points = gui.plugin._widget.view.panels[0][0].points[0]
                begin = rospy.get_time()
                publisher = rospy.Publisher("/speed", Float64, queue_size=100)
                wait_until(publisher.get_num_connections)
                for i in range(50):
                    publisher.publish(Float64(i))
                wait_until(lambda: len(points) == 50)
                self.assertEqual(points.y.tolist(), [float(i) for i in range(50)])
                self.assertTrue(begin <= points.x[0] <= points.x[-1] <= rospy.get_time())
        self.assertEqual(errors, [])


if __name__ == "__main__":
    rospy.init_node("multiplot_rostest")
    rostest.rosrun("rqt_multiplot", "multiplot", Multiplot, sys.argv)

#!/usr/bin/env python3
"""A scan through a chain of two filters; one of them is changed while it runs."""

import queue
import unittest

import rospy
import rostest
from dynamic_reconfigure.client import Client
from sensor_msgs.msg import LaserScan


class Scans(unittest.TestCase):
    def setUp(self):
        self.heard = queue.Queue()
        self.listener = rospy.Subscriber("scan_filtered", LaserScan, self.heard.put)
        self.scans = rospy.Publisher("scan", LaserScan, queue_size=1)

    def told(self, wanted):
        scan = LaserScan(angle_min=-0.1, angle_max=0.1, angle_increment=0.1, range_min=0.1, range_max=10.0, ranges=[0.2, 2.0, 4.0])
        scan.header.frame_id = "laser"
        for _ in range(300):
            self.scans.publish(scan)
            try:
                ranges = [str(round(r, 3)) for r in self.heard.get(timeout=0.1).ranges]
            except queue.Empty:
                continue
            if ranges == wanted:
                return
        self.fail(f"not {wanted}")

    def test_a_chain_that_is_changed(self):
        self.told(["0.0", "nan", "4.0"])
        Client("/laser_filter/box", timeout=20).update_configuration({"max_x": 6.0, "min_x": 4.0})
        self.told(["0.0", "2.0", "nan"])


if __name__ == "__main__":
    rospy.init_node("scan_filters_rostest")
    rostest.rosrun("laser_filters", "scan_filters", Scans)

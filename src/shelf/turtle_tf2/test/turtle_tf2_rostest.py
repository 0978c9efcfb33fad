#!/usr/bin/env python3
"""turtle_tf2_sensor_cpp.launch: turtle2 comes to turtle1, and turtle1 is told where it sees turtle3."""

import math
import queue
import re
import unittest

import rospy
import rostest
from geometry_msgs.msg import PointStamped
from rosgraph_msgs.msg import Log
from turtlesim.msg import Pose


class TurtleTf2(unittest.TestCase):
    def listen(self, topic, kind):
        seen = queue.Queue()
        self.addCleanup(rospy.Subscriber(topic, kind, seen.put).unregister)
        return seen

    def test_turtle2_comes_to_turtle1(self):
        seen = self.listen("/turtle2/pose", Pose)
        for _ in range(5000):
            pose = seen.get(timeout=60)
            if math.dist((pose.x, pose.y), (5.544445, 5.544445)) < 0.2:
                return
        self.fail(f"turtle2 is still at {pose.x}, {pose.y}")

    def test_turtle3_in_the_frame_of_turtle1(self):
        """turtle1 looks along x, so that what it sees is shifted by where it is."""
        points, said = self.listen("/turtle_point_stamped", PointStamped), self.listen("/rosout", Log)
        text = ""
        while not text.startswith("point of turtle 3"):
            text = said.get(timeout=60).msg
        seen = [float(number) for number in re.findall(r"[xyz]:(-?[\d.]+)", text)]
        for _ in range(1000):
            point = points.get(timeout=60).point
            if math.dist((point.x - 5.544445, point.y - 5.544445, 0), seen) < 0.1:
                return
        self.fail(f"{seen} is nowhere near {point}")


if __name__ == "__main__":
    rospy.init_node("turtle_tf2_rostest")
    rostest.rosrun("turtle_tf2", "turtle_tf2", TurtleTf2)
